#include "polycube/sample_map.h"

#include <algorithm>
#include <limits>
#include <span>

#include "hexwright/base/parallel.h"
#include "hexwright/grid/locate.h"

namespace hexwright::polycube {
namespace {

// Widths of a growing point set along 13 directions: the largest is a lower bound of its diameter,
// at most 4% short.
class Spread {
 public:
  void add(const Vec3& p) {
    for (std::size_t k = 0; k < kDirections.size(); ++k) {
      const double x = dot(p, kDirections[k]);
      lo_[k] = std::min(lo_[k], x);
      hi_[k] = std::max(hi_[k], x);
    }
  }
  double width() const {
    double widest = 0;
    for (std::size_t k = 0; k < kDirections.size(); ++k) widest = std::max(widest, hi_[k] - lo_[k]);
    return widest;
  }
  Spread() {
    lo_.fill(std::numeric_limits<double>::infinity());
    hi_.fill(-std::numeric_limits<double>::infinity());
  }

 private:
  static constexpr double kS = 0.70710678118654752, kT = 0.57735026918962576;
  static constexpr std::array<Vec3, 13> kDirections = {{{1, 0, 0},
                                                        {0, 1, 0},
                                                        {0, 0, 1},
                                                        {kS, kS, 0},
                                                        {kS, -kS, 0},
                                                        {kS, 0, kS},
                                                        {kS, 0, -kS},
                                                        {0, kS, kS},
                                                        {0, kS, -kS},
                                                        {kT, kT, kT},
                                                        {kT, kT, -kT},
                                                        {kT, -kT, kT},
                                                        {-kT, kT, kT}}};
  std::array<double, 13> lo_, hi_;
};

// The tet vertices that lie in each cell of the grid.
class VertsByCell {
 public:
  VertsByCell(const Grid& grid, const TetMesh& tets) : offset_(grid.num_cells() + 1, 0) {
    std::vector<CellId> vert_to_cell(tets.num_verts());
    parallel_for(tets.num_verts(), [&](std::size_t v) {
      vert_to_cell[v] = find_leaf_at(grid, tets.positions[VertId(v)]);
    });
    for (CellId c : vert_to_cell)
      if (c.is_valid()) ++offset_[c.index() + 1];
    for (std::size_t c = 0; c < grid.num_cells(); ++c) offset_[c + 1] += offset_[c];
    verts_.resize(offset_.back());
    std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
    for (std::size_t v = 0; v < vert_to_cell.size(); ++v)
      if (vert_to_cell[v].is_valid()) verts_[next[vert_to_cell[v].index()]++] = VertId(v);
  }
  std::span<const VertId> operator[](CellId c) const {
    return {verts_.data() + offset_[c.index()], verts_.data() + offset_[c.index() + 1]};
  }

 private:
  std::vector<std::size_t> offset_;
  std::vector<VertId> verts_;
};

}  // namespace

Grid sample_map(const TetMesh& object, const Lattice& lattice, const TetLocator& locator,
                const PolycubeOptions& options, const Context& context) {
  Box3 box;
  for (const Vec3& p : object.positions) box.extend(p);
  const double limit = options.max_stretch * box.diagonal();

  std::vector<CellSpec> cells;
  for (const LatticeCoord& root : lattice.roots) cells.push_back({0, root});
  Grid grid = make_grid({}, lattice.roots, cells);
  for (int level = 0; level < options.max_level; ++level) {
    context.check_cancelled();
    context.progress("sample the map", double(level) / options.max_level);
    const VertsByCell verts_by_cell(grid, lattice.tets);
    std::vector<char> is_marked(grid.num_cells(), 0);
    parallel_for(
        grid.num_cells(),
        [&](std::size_t c) {
          if (grid.cells[CellId(c)].level != level) return;
          const Box3 cell = cell_box(grid, CellId(c));
          Spread spread;
          for (VertId v : verts_by_cell[CellId(c)]) spread.add(object.positions[v]);
          for (int k = 0; k < 27; ++k) {
            const Vec3 at = {k % 3 / 2.0, k / 3 % 3 / 2.0, k / 9 % 3 / 2.0};
            const Vec3 e = cell.extent();
            spread.add(interpolate(
                object, locator.locate(cell.lo + Vec3{at.x * e.x, at.y * e.y, at.z * e.z})));
          }
          is_marked[c] = level < options.min_level || spread.width() > limit;
        },
        16);
    const auto num_marked =
        static_cast<std::size_t>(std::count(is_marked.begin(), is_marked.end(), 1));
    if (num_marked == 0) break;
    if (grid.num_cells() + 7 * num_marked > options.max_cells)
      throw Error(ErrorCode::OutOfResources,
                  "level " + std::to_string(level + 1) + " of the polycube needs more than " +
                      std::to_string(options.max_cells) +
                      " cells; raise --max-cells or --max-stretch, or lower --max-level");
    grid = split_cells(grid, is_marked);
  }
  return grid;
}

}  // namespace hexwright::polycube
