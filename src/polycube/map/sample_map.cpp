// Splits cells level by level where the images of their points on the object are too far apart.
//
// Based on: Pitzalis et al. 2021, section 6.2: a cell is refined while two points of the object in
// it are farther apart than a share of the diagonal.
// Differs: the points are the object's vertices, and lines of 27 lattice points along the cell's
// edges are carried over besides, since a coarse tet mesh may have no vertex in a cell that the map
// stretches; and the surface's distance is estimated beforehand (surface_misses.h).
#include "polycube/map/sample_map.h"

#include <algorithm>
#include <limits>
#include <span>

#include "hexwright/base/parallel.h"
#include "hexwright/grid/locate.h"

#include "polycube/map/refine_misses.h"
#include "polycube/map/surface_misses.h"

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
  VertsByCell(const Grid& grid, const IdVector<VertId, Vec3>& places)
      : offset_(grid.num_cells() + 1, 0) {
    std::vector<CellId> vert_to_cell(places.size());
    parallel_for(places.size(),
                 [&](std::size_t v) { vert_to_cell[v] = find_leaf_at(grid, places[VertId(v)]); });
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

// The object's points that map into one cell.
struct CellImage {
  Spread spread;       // of the object's vertices
  double longest = 0;  // along an axis of the cell
  double mean_edge = 0;
  Vec3 center;
};

class Sampler {
 public:
  Sampler(const SampledMap& map, const PolycubeOptions& options)
      : map_(map), options_(options), inward_(inward_places(map.lattice.tets)) {
    Box3 box;
    for (const Vec3& p : map.object.positions) box.extend(p);
    diagonal_ = box.diagonal();
  }

  // The cells of this level that are to be split.
  std::vector<char> mark(const Grid& grid, int level) const {
    const VertsByCell verts_by_cell(grid, inward_);
    std::vector<char> marks(grid.num_cells(), 0);
    parallel_for(
        grid.num_cells(),
        [&](std::size_t i) {
          const CellId c(i);
          if (grid.cells[c].level != level) return;
          marks[i] =
              level < options_.min_level || is_coarse(carry(cell_box(grid, c), verts_by_cell[c]));
        },
        16);
    if (options_.max_surface_error > 0) mark_misses(grid, level, marks);
    return marks;
  }

 private:
  // The spread is a lower bound of the diameter, so a cell is never split for a stretch it has not.
  bool is_coarse(const CellImage& image) const {
    const double limit = options_.max_stretch * diagonal_;
    if (image.longest > limit || image.spread.width() > limit) return true;
    return options_.max_edge && image.mean_edge > options_.max_edge(image.center);
  }

  // The images of the cell's corners, edge middles, face centres and centre (k = x + 3 y + 9 z),
  // and of the object's vertices in it.
  CellImage carry(const Box3& cell, std::span<const VertId> verts) const {
    CellImage image;
    for (VertId v : verts) image.spread.add(map_.object.positions[v]);
    std::array<Vec3, 27> at;
    const Vec3 half = cell.extent() * 0.5;
    for (int k = 0; k < 27; ++k) {
      const int x = k % 3, y = k / 3 % 3, z = k / 9;
      const Vec3 step = {x * half.x, y * half.y, z * half.z};
      at[k] = interpolate(map_.object, map_.locator.locate(cell.lo + step));
    }
    image.center = at[13];
    constexpr int kStride[3] = {1, 3, 9};
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < 4; ++k) {  // the four edges along the axis
        const int low =
            (k & 1) * 2 * kStride[(axis + 1) % 3] + (k >> 1) * 2 * kStride[(axis + 2) % 3];
        image.mean_edge += distance(at[low], at[low + 2 * kStride[axis]]) / 12;
      }
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < 9; ++k) {  // the nine lines along the axis, around their middles
        const int stride = kStride[axis];
        const int middle =
            stride + k % 3 * kStride[(axis + 1) % 3] + k / 3 * kStride[(axis + 2) % 3];
        image.longest = std::max(image.longest, distance(at[middle - stride], at[middle]) +
                                                    distance(at[middle], at[middle + stride]));
      }
    return image;
  }

  void mark_misses(const Grid& grid, int level, std::vector<char>& marks) const {
    const auto is_missed = mark_surface_misses(grid, map_.object, map_.lattice, map_.boundary,
                                               inward_, options_.max_surface_error * diagonal_);
    for (CellId c : grid.cells.ids())
      if (grid.cells[c].level == level) marks[c.index()] |= is_missed[c.index()];
  }

  const SampledMap& map_;
  const PolycubeOptions& options_;
  IdVector<VertId, Vec3> inward_;
  double diagonal_ = 0;
};

// Asked before the split, so that a map that stretches without end (a collapsed tet) ends with a
// message and not with the machine's memory.
void require_budget(const Grid& grid, std::size_t num_marked, int level,
                    const PolycubeOptions& options) {
  if (grid.num_cells() + 7 * num_marked <= options.max_cells) return;
  throw Error(ErrorCode::OutOfResources,
              "level " + std::to_string(level) + " of the polycube needs more than " +
                  std::to_string(options.max_cells) +
                  " cells; raise --max-cells or --max-stretch, or lower --max-level");
}

}  // namespace

Grid sample_map(const SampledMap& map, const PolycubeOptions& options, const Context& context) {
  const Sampler sampler(map, options);
  std::vector<CellSpec> cells;
  for (const LatticeCoord& root : map.lattice.roots) cells.push_back({0, root});
  Grid grid = make_grid({}, map.lattice.roots, cells);
  require_budget(grid, 0, 0, options);
  for (int level = 0; level < options.max_level; ++level) {
    context.check_cancelled();
    context.progress("sample the map", static_cast<double>(level) / options.max_level);
    const auto marks = sampler.mark(grid, level);
    const auto num_marked = static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1));
    if (num_marked == 0) break;
    require_budget(grid, num_marked, level + 1, options);
    grid = split_cells(grid, marks);
  }
  return grid;
}

}  // namespace hexwright::polycube
