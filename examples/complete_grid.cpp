// Makes a user's own adaptive cells hexmeshable: the library without any surface.
//
// Two root cubes; cells become finer towards a point on the edge between them.
#include <cstdio>

#include "hexwright/base/error.h"
#include "hexwright/grid/complete.h"

int main() {
  using namespace hexwright;
  try {
    // 1. Cells as {level, {i, j, k}}: here one root cube split into 8, one left whole.
    std::vector<CellSpec> cells = {{0, {1, 0, 0}}};
    for (int q = 0; q < 8; ++q) cells.push_back({1, {q & 1, q >> 1 & 1, q >> 2}});
    const GridFrame frame{{0, 0, 0}, 2.5};  // the roots' edge is 2.5 in world units
    Grid grid = make_grid(frame, {{0, 0, 0}, {1, 0, 0}}, cells);

    // 2. Refine wherever your own criterion says so: a flag per cell.
    for (int round = 0; round < 4; ++round) {
      std::vector<char> is_marked(grid.num_cells(), 0);
      for (const CellId c : grid.cells.ids()) {
        const Box3 box = cell_box(grid, c);
        is_marked[c.index()] = distance(box.center(), {2.5, 0, 0}) < 1.2 * box.extent().x;
      }
      grid = split_cells(grid, is_marked);
    }

    // 3. Complete it: balanced, paired, no cell coarser than before.
    const CompleteOptions options{Balance::Weak, Pairing::Blocks, true};
    const CompleteResult result = complete(grid, options, Context{});
    std::printf("%zu cells in, %zu cells out\n", result.report.num_input_cells,
                result.report.num_output_cells);

    // 4. Check it, independently of how it was made.
    if (const auto issue = find_unbalanced(result.grid, options.balance))
      std::printf("not balanced: %s\n", issue->message.c_str());
    if (const auto issue = find_unpaired(result.grid))
      std::printf("not paired: %s\n", issue->message.c_str());
    return find_unpaired(result.grid) ? 1 : 0;
  } catch (const Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
