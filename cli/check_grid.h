// The part of `hexwright check` that judges adaptive grids.
#pragma once

#include <optional>
#include <string>

#include "hexwright/grid/complete.h"

#include "commands.h"

namespace hexwright::cli {

/// What to judge a grid by. Files may be empty: not asked for.
struct GridCheck {
  std::string input;   ///< the grid's file
  std::string before;  ///< the grid that it was completed from
  std::string report;  ///< JSON goes here
  bool as_json = false;
  std::optional<Balance> balance;  ///< demanded; else any that a pairing can do with
  bool needs_blocks = false;       ///< pairing by blocks is demanded
};

/// Prints balance, pairing and the first violation of each, and sets the exit code: Valid when the
/// dual stage takes the grid, it is nowhere coarser than `before`, and it has what is demanded.
/// Throws Error{BadFile} when the cells of a file do not tile the roots.
void check_grid(const GridCheck& check, Program& program);

}  // namespace hexwright::cli
