// The paper's statistics over the records of an evaluation: Table 1, shares, speed.
#pragma once

#include <string>
#include <vector>

#include "bench/results.h"

namespace hexwright::cli {

/// Table 1, the shares that at least double, triple and quadruple, median speed and the fitted
/// exponent of time against size per method, over the models for which every method has a result;
/// the models on which all pairings agree; and how the final meshes came out.
Json summarize(const std::vector<Json>& records);

/// The summary beside the paper's figures, for a terminal.
std::string summary_to_text(const Json& summary);

/// Exponent and factor of y = factor x^exponent, by least squares of the logarithms; both 0 for
/// fewer than two distinct x. Pairs that are not positive are left out.
struct PowerLaw {
  double exponent = 0, factor = 0;
};
PowerLaw fit_power_law(const std::vector<double>& x, const std::vector<double>& y);

/// Middle value, mean of the middle two for an even count; 0 for none.
double median(std::vector<double> values);

}  // namespace hexwright::cli
