// Completion for the fewest hexes: sheets, unless blocks need fewer.
#pragma once

#include "hexwright/grid/complete.h"

namespace hexwright {

/// As complete(), but when asked for sheets it also completes the grid by blocks, counts the hexes
/// of both and returns the grid that has fewer: sheets nearly always, blocks on some grids of a few
/// dozen cells. Either can be meshed in sheets mode. Costs two completions and two topologies.
CompleteResult complete_with_fewest_hexes(const Grid& grid, const CompleteOptions& options,
                                          const Context& context);

}  // namespace hexwright
