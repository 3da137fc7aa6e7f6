#include "hexwright/pipeline/fewest_hexes.h"

#include "hexwright/dual/dual_mesh.h"

namespace hexwright {

// A block's pillows share their rims; single nodes on two sides of a vertex may each cut partners
// that the block would have split anyway. Only the count tells which is fewer.
CompleteResult complete_with_fewest_hexes(const Grid& grid, const CompleteOptions& options,
                                          const Context& context) {
  const auto watch = context.watch();
  CompleteResult sheets = complete(grid, options, context);
  if (options.pairing != Pairing::Sheets) return sheets;
  CompleteOptions by_blocks = options;
  by_blocks.pairing = Pairing::Blocks;
  if (options.balance == Balance::Relaxed) by_blocks.balance = Balance::Weak;
  CompleteResult blocks = complete(grid, by_blocks, context);
  const std::size_t num_by_sheets = count_dual_hexes(sheets.grid, DualMode::Sheets, context);
  const std::size_t num_by_blocks = count_dual_hexes(blocks.grid, DualMode::Blocks, context);
  return num_by_blocks < num_by_sheets ? std::move(blocks) : std::move(sheets);
}

}  // namespace hexwright
