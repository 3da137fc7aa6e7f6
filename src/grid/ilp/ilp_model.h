// A binary program in sparse rows, and its solution by HiGHS.
#pragma once

#include <cstdint>
#include <vector>

namespace hexwright::grids {

struct IlpTerm {
  std::int32_t column = 0;
  double factor = 1;
};

struct IlpSolution {
  std::vector<char> values;  ///< per column; empty when none was found
  double objective = 0;
  double lower_bound = 0;
  bool is_optimal = false;
};

class IlpModel {
 public:
  /// A 0-1 variable; returns its column.
  std::int32_t add_binary(double cost);
  void add_cost(std::int32_t column, double cost) {
    costs_[static_cast<std::size_t>(column)] += cost;
  }
  std::int32_t num_columns() const { return static_cast<std::int32_t>(costs_.size()); }
  std::size_t num_rows() const { return row_start_.size(); }

  /// lower <= sum of terms <= upper; use -kInfinity and kInfinity for open sides.
  void add_row(const std::vector<IlpTerm>& terms, double lower, double upper);
  static constexpr double kInfinity = 1e30;

  /// Minimises. `start`: a feasible solution to begin with, or empty. Fixed seed, one thread.
  /// Throws Error{OutOfResources} when the solver fails.
  IlpSolution solve(const std::vector<char>& start, double time_limit_seconds) const;

 private:
  std::vector<double> costs_;
  std::vector<std::int32_t> row_start_, columns_;
  std::vector<double> factors_, lower_, upper_;
};

}  // namespace hexwright::grids
