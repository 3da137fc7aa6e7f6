// One sentence for every budget that a run may exceed.
#pragma once

#include <string>

#include "hexwright/pipeline/plan.h"

namespace hexwright {

enum class Budget { Background, Rounds, Growth };

/// Which budget, how much would be used, how much there is, and what to do.
std::string say_exceeded(Budget which, double used, const Budgets& budgets);

}  // namespace hexwright
