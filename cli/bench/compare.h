// What changed between two evaluations, and whether for the worse.
#pragma once

#include <string>
#include <vector>

#include "bench/results.h"

namespace hexwright::cli {

/// How much worse a figure of the second run may be.
struct CompareTolerances {
  double count = 0.02;     ///< cells and hexes, relative
  double min_sj = 0.05;    ///< least scaled Jacobian, absolute
  double avg_sj = 0.02;    ///< average scaled Jacobian, absolute
  double distance = 0.10;  ///< largest two-way distance, relative; below 1e-4 of the diagonal never
  double features = 0.01;  ///< share of the features' length, absolute
  double time = 0;         ///< seconds over all models, relative; 0 = not judged
};

struct Comparison {
  std::string text;                      ///< a table of ratios, second to first
  std::vector<std::string> regressions;  ///< one sentence each, naming the model
};

/// Compares the models both have; a model that the first has and the second lacks is a regression,
/// and so is one that is no longer done or valid.
Comparison compare_results(const std::vector<Json>& before, const std::vector<Json>& after,
                           const CompareTolerances& tolerances);

}  // namespace hexwright::cli
