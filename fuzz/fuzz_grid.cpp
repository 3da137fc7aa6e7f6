// Any bytes as an adaptive grid: .cells, HyperTreeGrid, hexes with hanging nodes.
#include "hexwright/io/grid_io.h"

#include "fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hexwright;
  constexpr std::array<const char*, 4> kExtensions = {".cells", ".htg", ".vtu", ".mesh"};
  return fuzz::read_input(fuzz::write_input(data, size, kExtensions), [](const std::string& path) {
    const Grid grid = read_grid(path);
    fuzz::require(!grid.find_problem(), "the grid is not sound");
    fuzz::require(grid.num_cells() > 0, "a grid without cells was not refused");
  });
}
