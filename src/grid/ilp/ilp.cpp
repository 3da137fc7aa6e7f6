// Completion by integer programs, one per depth or one for all.
//
// Based on: Pitzalis et al. 2021, section 4, as the oracle for the labelling solver; and the whole
// hierarchy at once (docs/algorithms/pairing.md, "All depths together").
#include "hexwright/grid/ilp.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <highs/interfaces/highs_c_api.h>

#include "hexwright/base/error.h"

#include "grid/ilp/ilp_program.h"
#include "grid/pairing/balance.h"

namespace hexwright {

using namespace grids;

namespace {

/// One time limit shared by the programs of all depths. A program that begins late gets a hundredth
/// of a second, and fails by its own limit, which is reported.
class Deadline {
 public:
  explicit Deadline(double seconds) : seconds_(seconds) {}
  double remaining() const {
    const std::chrono::duration<double> used = std::chrono::steady_clock::now() - start_;
    return std::max(0.01, seconds_ - used.count());
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double seconds_;
};

[[noreturn]] void throw_no_solution() {
  throw Error(ErrorCode::OutOfResources,
              "the integer program found no solution in time; allow more, or use the exact sweep");
}

/// Sets the bound on leaves from a bound on split nodes.
std::size_t leaves_of(double split_nodes, const LatticeDomain& domain) {
  const double whole = std::max(0.0, std::ceil(split_nodes - 1e-6));
  return domain.shifted_roots().size() + 7 * static_cast<std::size_t>(whole);
}

/// As the sweep: from the deepest depth on, each program's answer fixes what the next must split.
/// The bounds of the depths add up, given the answers below them.
NestedSets solve_depths(const NestedSets& input, const IlpOptions& options,
                        const LatticeDomain& domain, const Context& context, IlpResult& result) {
  const Deadline deadline(options.time_limit_seconds);
  NestedSets split(input.size());
  double bound = 0;
  result.is_optimal = true;
  for (int d = static_cast<int>(input.size()) - 1; d >= 0; --d) {
    context.check_cancelled();
    const BrickSet required =
        d + 1 < static_cast<int>(input.size())
            ? required_above(split[d + 1], d + 1, options.balance, domain, input[d])
            : input[d];
    const IlpSolution solution =
        solve_depth_program(required, required, d, domain, deadline.remaining(), &split[d]);
    if (solution.values.empty()) throw_no_solution();
    bound += std::ceil(solution.lower_bound - 1e-6);
    result.is_optimal = result.is_optimal && solution.is_optimal;
  }
  result.lower_bound = leaves_of(bound, domain);
  return split;
}

/// Starts from the descent's answer, so that it can only get better, and a time limit costs nothing
/// but the proof.
NestedSets solve_hierarchy(const Grid& grid, const NestedSets& input, const IlpOptions& options,
                           const LatticeDomain& domain, const Context& context, IlpResult& result) {
  const Grid start = complete(grid, {options.balance, Pairing::Blocks, true}, context).grid;
  NestedSets split;
  const IlpSolution solution =
      solve_hierarchy_program(input, split_sets_of(start, domain), options.balance, domain,
                              options.time_limit_seconds, &split);
  if (solution.values.empty()) throw_no_solution();
  result.is_optimal = solution.is_optimal;
  result.lower_bound = leaves_of(solution.lower_bound, domain);
  return split;
}

}  // namespace

IlpResult complete_by_ilp(const Grid& grid, const IlpOptions& options, const Context& context) {
  const auto watch = context.watch();
  if (const auto issue = grid.find_problem())
    throw Error(ErrorCode::BadArgument, "complete_by_ilp: " + issue->message);
  if (options.balance == Balance::Relaxed)
    throw Error(ErrorCode::BadArgument, "complete_by_ilp: blocks need weak or strong balance");
  const LatticeDomain domain(grid.roots, grid.finest_level);
  const NestedSets input = split_sets_of(grid, domain);
  IlpResult result;
  const NestedSets split = options.scope == IlpScope::Depth
                               ? solve_depths(input, options, domain, context, result)
                               : solve_hierarchy(grid, input, options, domain, context, result);
  result.grid = grid_of(split, grid, domain);
  result.num_cells = result.grid.num_cells();
  return result;
}

std::string ilp_solver_name() { return std::string("HiGHS ") + Highs_version(); }

}  // namespace hexwright
