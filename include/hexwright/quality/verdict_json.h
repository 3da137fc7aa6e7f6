// A verdict as JSON for programs and as text for people.
#pragma once

#include <string>

#include "hexwright/quality/judge.h"

namespace hexwright {

/// One JSON object with the members valid, failures, warnings, topology, quality and, with a
/// surface, distance, features and surface. Distances are shares of the diagonal; what is not
/// finite is null. `indent` < 0 puts everything on one line.
std::string verdict_to_json(const Verdict& verdict, int indent = 2);

/// A report of some twenty lines, with a histogram of the scaled Jacobian. Ends with a newline.
std::string verdict_to_text(const Verdict& verdict);

/// The part of it that is figures: mesh, topology, quality, volume, and distance and features where
/// they were measured; a line or two each. For callers that say failures and warnings themselves.
std::string figures_to_text(const Verdict& verdict);

}  // namespace hexwright
