// The root grows to up to twice its edge and the levels deepen by one, so that the cells of a level
// shrink by any factor down to a half. From the top down, a cell splits while it overlaps the
// core of an old leaf whose new level is deeper.
#include "hexwright/grid/rescale.h"

#include <algorithm>

#include "hexwright/base/error.h"

namespace hexwright {
namespace {

/// A cell that overlaps a leaf by less than this share of the leaf's edge need not be as small:
/// otherwise regions of fine cells would grow with every rescaling.
constexpr double kTouch = 0.25;

struct OldLeaf {
  Box3 box;
  int level = 0;  // in the new grid
};

class Rescaler {
 public:
  Rescaler(const GridFrame& frame, std::vector<OldLeaf> leaves)
      : frame_(frame), leaves_(std::move(leaves)) {}

  std::vector<CellSpec> run() {
    std::vector<std::size_t> all(leaves_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    descend(0, {0, 0, 0}, all);
    return std::move(specs_);
  }

 private:
  Box3 box_of(int level, const LatticeCoord& index) const {
    const double h = frame_.root_size / static_cast<double>(1 << level);
    const Vec3 lo = frame_.origin + Vec3{index[0] * h, index[1] * h, index[2] * h};
    return {lo, lo + Vec3{h, h, h}};
  }

  static bool overlaps(const Box3& cell, const Box3& leaf) {
    const double touch = kTouch * leaf.extent().x;
    for (int axis = 0; axis < 3; ++axis)
      if (leaf.hi[axis] - cell.lo[axis] <= touch || cell.hi[axis] - leaf.lo[axis] <= touch)
        return false;
    return true;
  }

  /// `deeper`: leaves that overlap the cell's parent and whose level is the cell's or deeper.
  void descend(int level, const LatticeCoord& index, const std::vector<std::size_t>& deeper) {
    const Box3 box = box_of(level, index);
    std::vector<std::size_t> mine;
    for (std::size_t i : deeper)
      if (leaves_[i].level > level && overlaps(box, leaves_[i].box)) mine.push_back(i);
    if (mine.empty()) {
      specs_.push_back({level, index});
      return;
    }
    for (int k = 0; k < 8; ++k)
      descend(level + 1,
              {2 * index[0] + (k & 1), 2 * index[1] + (k >> 1 & 1), 2 * index[2] + (k >> 2)}, mine);
  }

  const GridFrame frame_;
  const std::vector<OldLeaf> leaves_;
  std::vector<CellSpec> specs_;
};

}  // namespace

Grid rescale_grid(const Grid& grid, double factor, double least_root_size,
                  std::span<const char> is_needed) {
  if (grid.roots.size() != 1 || !(grid.frame.stretch == Vec3{1, 1, 1}))
    throw Error(ErrorCode::BadArgument, "only a grid of a single root cube can be rescaled");
  if (!(factor > 0.5 && factor <= 1))
    throw Error(ErrorCode::BadArgument, "the factor of rescaling must be above 0.5, at most 1");
  if (!is_needed.empty() && is_needed.size() != grid.num_cells())
    throw Error(ErrorCode::BadArgument, "rescaling takes one flag per leaf, or none");
  const double old_size = grid.frame.root_size;
  if (!(least_root_size > 0)) least_root_size = old_size;
  const LatticeCoord& root = grid.roots[0];
  const Vec3 center =
      grid.frame.origin + old_size * Vec3{root[0] + 0.5, root[1] + 0.5, root[2] + 0.5};

  int deepening = 0;
  double size = factor * old_size;
  for (; size < least_root_size * (1 - 1e-12); size *= 2) ++deepening;
  if (grid.finest_level + deepening > kMaxGridLevel)
    throw Error(ErrorCode::OutOfResources, "rescaling would exceed the deepest level");

  std::vector<OldLeaf> leaves;
  for (CellId c : grid.cells.ids())
    if (is_needed.empty() || is_needed[c.index()])
      leaves.push_back({cell_box(grid, c), grid.cells[c].level + deepening});
  const GridFrame frame{center - Vec3{size / 2, size / 2, size / 2}, size};
  return make_grid(frame, {{0, 0, 0}}, Rescaler(frame, std::move(leaves)).run());
}

}  // namespace hexwright
