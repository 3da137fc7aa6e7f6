// The budgets, a row each.
#include "pipeline/loop/budgets.h"

#include <fmt/format.h>

namespace hexwright {
namespace {

struct Row {
  Budget which;
  double (*limit)(const Budgets&);
  const char* subject;
  const char* unit;
  const char* remedy;
};

constexpr const char* kShortened =
    " (a quarter of the usual one, because the surface is open or overlaps itself)";

constexpr Row kRows[] = {
    {Budget::Background, [](const Budgets& b) { return static_cast<double>(b.background); },
     "the background mesh", "cells", "raise --max-hexes or the tolerance"},
    {Budget::Rounds, [](const Budgets& b) { return static_cast<double>(b.rounds); },
     "the background meshes of all rounds together", "hexes", "raise --max-hexes or the tolerance"},
    {Budget::Growth, [](const Budgets& b) { return b.growth; },
     "the next grid for this open or overlapping surface", "times the cells of the last",
     "repair the surface or raise the tolerance"},
};

}  // namespace

std::string say_exceeded(Budget which, double used, const Budgets& budgets) {
  for (const Row& row : kRows)
    if (row.which == which)
      return fmt::format("{} would have {:.7g} {}, more than the budget of {:.7g}{}; {}",
                         row.subject, used, row.unit, row.limit(budgets),
                         which == Budget::Rounds && budgets.is_shortened ? kShortened : "",
                         row.remedy);
  return {};
}

}  // namespace hexwright
