// Hands a binary program to HiGHS through its C interface.
//
// One thread and a fixed seed: the answer is the same from run to run unless the time limit ends
// it.
#include "grid/ilp/ilp_model.h"

#include <cmath>
#include <memory>

#include <highs/interfaces/highs_c_api.h>

#include "hexwright/base/error.h"

namespace hexwright::grids {
namespace {

struct HighsDeleter {
  void operator()(void* highs) const { Highs_destroy(highs); }
};

void check(HighsInt status, const char* step) {
  if (status == kHighsStatusError)
    throw Error(ErrorCode::OutOfResources, std::string("HiGHS failed to ") + step);
}

}  // namespace

std::int32_t IlpModel::add_binary(double cost) {
  costs_.push_back(cost);
  return num_columns() - 1;
}

void IlpModel::add_row(const std::vector<IlpTerm>& terms, double lower, double upper) {
  row_start_.push_back(static_cast<std::int32_t>(columns_.size()));
  for (const IlpTerm& t : terms) {
    columns_.push_back(t.column);
    factors_.push_back(t.factor);
  }
  lower_.push_back(lower);
  upper_.push_back(upper);
}

IlpSolution IlpModel::solve(const std::vector<char>& start, double time_limit_seconds) const {
  const std::unique_ptr<void, HighsDeleter> highs(Highs_create());
  Highs_setBoolOptionValue(highs.get(), "output_flag", 0);
  Highs_setIntOptionValue(highs.get(), "threads", 1);
  Highs_setIntOptionValue(highs.get(), "random_seed", 1);
  // The relative gap's default (1e-4) could accept a labelling one block above the optimum.
  Highs_setDoubleOptionValue(highs.get(), "mip_rel_gap", 0);
  Highs_setDoubleOptionValue(highs.get(), "mip_abs_gap", 0.5);  // objectives are whole numbers
  Highs_setDoubleOptionValue(highs.get(), "time_limit", time_limit_seconds);

  const std::vector<double> zeros(costs_.size(), 0), ones(costs_.size(), 1);
  const std::vector<HighsInt> integrality(costs_.size(), kHighsVarTypeInteger);
  const std::vector<HighsInt> starts(row_start_.begin(), row_start_.end());
  const std::vector<HighsInt> columns(columns_.begin(), columns_.end());
  check(Highs_passMip(highs.get(), num_columns(), static_cast<HighsInt>(num_rows()),
                      static_cast<HighsInt>(columns.size()), kHighsMatrixFormatRowwise,
                      kHighsObjSenseMinimize, 0, costs_.data(), zeros.data(), ones.data(),
                      lower_.data(), upper_.data(), starts.data(), columns.data(), factors_.data(),
                      integrality.data()),
        "accept the program");
  if (!start.empty()) {
    const std::vector<double> values(start.begin(), start.end());
    check(Highs_setSolution(highs.get(), values.data(), nullptr, nullptr, nullptr),
          "accept the start");
  }
  check(Highs_run(highs.get()), "solve");

  IlpSolution out;
  HighsInt has_solution = 0;
  Highs_getIntInfoValue(highs.get(), "primal_solution_status", &has_solution);
  Highs_getDoubleInfoValue(highs.get(), "mip_dual_bound", &out.lower_bound);
  // No solution in time is an outcome, not an error: the caller sees empty values and the bound.
  if (has_solution != kHighsSolutionStatusFeasible) return out;
  std::vector<double> values(costs_.size()), duals(costs_.size()), row_values(num_rows()),
      row_duals(num_rows());
  Highs_getSolution(highs.get(), values.data(), duals.data(), row_values.data(), row_duals.data());
  // Values are whole up to the solver's tolerance; the objective is summed anew from rounded ones.
  for (std::size_t i = 0; i < values.size(); ++i) {
    out.values.push_back(values[i] > 0.5 ? 1 : 0);
    out.objective += values[i] > 0.5 ? costs_[i] : 0;
  }
  out.is_optimal = Highs_getModelStatus(highs.get()) == kHighsModelStatusOptimal;
  if (out.is_optimal) out.lower_bound = out.objective;
  return out;
}

}  // namespace hexwright::grids
