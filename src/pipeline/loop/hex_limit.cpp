#include "pipeline/loop/hex_limit.h"

#include <fmt/format.h>

#include "hexwright/base/parallel.h"

namespace hexwright {

bool is_within_limit(const RoundInput& input, const Round& round) {
  const std::size_t most = input.options.most_hexes;
  return most == 0 || round.fit.mesh.num_hexes() <= most;
}

bool may_be_within_limit(const RoundInput& input, const Grid& grid) {
  constexpr double kRoom = 1.5;
  const auto most = kRoom * static_cast<double>(input.options.most_hexes);
  if (most == 0 || static_cast<double>(grid.num_cells()) <= most) return true;
  if (input.options.fit.carve.side != Side::Inside) return false;
  const std::size_t count = parallel_reduce(
      grid.num_cells(), std::size_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::size_t inside = 0;
        for (std::size_t i = begin; i < end; ++i)
          inside += input.target.tree.is_inside(cell_box(grid, CellId(i)).center());
        return inside;
      },
      [](std::size_t a, std::size_t b) { return a + b; });
  return static_cast<double>(count) <= most;
}

std::string say_beyond_limit(const MeshOptions& options) {
  const char* remedy = "the tolerance";
  if (options.sizes.size.is_given()) remedy = "ask for a larger size";
  if (options.sizes.cells > 0) remedy = "ask for fewer cells";
  return fmt::format(
      "the mesh would have more hexes than the budget of {}; raise --max-hexes or {}",
      options.most_hexes, remedy);
}

}  // namespace hexwright
