// Where the grid must be fine: builds the adaptive grid of a surface.
//
// Based on: Pitzalis et al. 2021, section 6.1 (thickness); docs/algorithms/sizing.md (deviation and
// opposite walls).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/geometry/feature_graph.h"
#include "hexwright/grid/grid.h"
#include "hexwright/grid/size_field.h"
#include "hexwright/mesh/tri_mesh.h"
#include "hexwright/target/target.h"

namespace hexwright {

enum class Sizing {
  Deviation,  ///< departure from the cells' planes, and opposite walls (the default)
  Thickness   ///< the paper's: a cell's edge is at most half the least shape diameter in it
};

struct SizingOptions {
  Sizing sizing = Sizing::Deviation;
  double tolerance = 0.005;  ///< distance goal, share of the box's diagonal
  double deviation_factor =
      2;                      ///< split when the spread about the plane exceeds factor x tolerance
  double wall_factor = 0.75;  ///< split when factor x edge exceeds the wall's distance; 0 = off
  double crease_proximity =
      0;  ///< split when an unrelated curve or corner is nearer than this x edge; 0 = off
  double margin = 0.02;     ///< room around the object on each side, share of its largest extent
  int min_level = 2;        ///< cells that meet the surface are at least this deep
  int max_level = 9;        ///< none is deeper
  double min_edge = 0.005;  ///< Deviation: no cell is split below this edge, share of the diagonal
  std::size_t max_cells = 2'000'000;  ///< budget of leaves
  /// The root cubes; absent: one around the surface, with the margin.
  std::optional<GridDomain> domain;
};

struct SizingResult {
  Grid grid;
  bool hit_cell_budget =
      false;  ///< refinement stopped level-wise because max_cells would have been exceeded
  int reached_level = 0;
  std::vector<std::size_t> splits_by_reason;  ///< indexed like kSplitReasons

  void to_world(const Similarity& frame) { grid.frame.to_world(frame); }
};
inline constexpr const char* kSplitReasons[] = {"minimum level", "deviation", "wall", "thickness",
                                                "crease proximity"};

/// Builds the grid breadth first, so that a budget stops at a level and not in a corner.
///
/// The surface should be welded (prepare_surface) and about unit size: groups of triangles end at
/// unshared edges. The number of cells never falls when the tolerance does. No node is split below
/// what `sizes`, in the surface's coordinates, allows; that cells are as small as it asks for is up
/// to refine_to_sizes(). Same result for any thread count. Errors: BadArgument (an option out of
/// range), BadGeometry (no triangles).
SizingResult build_grid(const SurfaceTree& surface, const FeatureGraph& features,
                        const SizingOptions& options, const Context& context,
                        const SizeField* sizes = nullptr);
/// Of the target's surface and features, in the target's unit coordinates. Shares are of its
/// diagonal, also where turning has changed the box.
SizingResult build_grid(const Target& target, const SizingOptions& options, const Context& context,
                        const SizeField* sizes = nullptr);

/// The root cube around a box: centred, with the margin on each side.
GridFrame root_frame(const Box3& box, double margin);

/// One flag per leaf: 1 for those that hold at least one of the points and are less deep than
/// `max_level`. Points outside the grid mark nothing.
std::vector<char> mark_cells_with_points(const Grid& grid, std::span<const Vec3> points,
                                         int max_level);

}  // namespace hexwright
