// Builds the adaptive grid of a surface, level by level.
//
// Based on: Pitzalis et al. 2021, section 6.1 (Thickness: a node is split while its edge is longer
// than half the least shape diameter of the facets that meet it).
// Differs: the default criterion is the surface's departure from a plane inside the node, and the
// distance of the opposite wall (docs/algorithms/sizing.md).
#include "hexwright/grid/sizing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

#include "grid/sizing/box_clip.h"
#include "grid/sizing/sizing_scene.h"

namespace hexwright {

using namespace grids;

namespace {

/// Positions in kSplitReasons; Keep = the node stays a leaf.
enum class Reason : int { Keep = -1, MinLevel, Deviation, Wall, Thickness, Creases };

struct Node {
  LatticeCoord index = {0, 0, 0};  ///< on its level's lattice
  std::size_t parent = 0;          ///< whose candidates it inherits
};

struct Outcome {
  Reason reason = Reason::Keep;
  SizingCandidates candidates;
};

NodeCube cube_of(const GridFrame& frame, int level, const LatticeCoord& index) {
  const double h = frame.root_size / static_cast<double>(1 << level);
  const Vec3& s = frame.stretch;
  return {frame.origin + Vec3{(index[0] + 0.5) * h * s.x, (index[1] + 0.5) * h * s.y,
                              (index[2] + 0.5) * h * s.z},
          h,
          {h * s.x, h * s.y, h * s.z}};
}

SizingCandidates make_root_candidates(const SizingScene& scene) {
  SizingCandidates all;
  for (TriId t : scene.surface.tris.ids()) all.tris.push_back(t);
  all.walls.resize(scene.walls.size());
  std::iota(all.walls.begin(), all.walls.end(), 0u);
  all.segments.resize(scene.crease_segments.size());
  std::iota(all.segments.begin(), all.segments.end(), 0u);
  if (!all.segments.empty()) all.corners = scene.features.corners;
  return all;
}

SizingCandidates select_near(const SizingScene& scene, const NodeCube& node, double reach,
                             const SizingCandidates& from) {
  SizingCandidates near;
  const double half = 0.5 + kDeviationMargin;
  for (TriId t : from.tris)
    if (meets_cube(node.to_local(scene.surface.corners(t)), half)) near.tris.push_back(t);
  for (std::uint32_t s : from.walls)
    if (in_cube(node.to_local(scene.walls[s].point), half)) near.walls.push_back(s);
  for (std::uint32_t s : from.segments) {
    const CreaseSegment& segment = scene.crease_segments[s];
    if (segment_meets_cube(node.to_local(segment.a), node.to_local(segment.b), 0.5 + reach))
      near.segments.push_back(s);
  }
  for (VertId v : from.corners)
    if (in_cube(node.to_local(scene.surface.positions[v]), 0.5 + reach)) near.corners.push_back(v);
  return near;
}

/// The tests one node is put through, cheapest first.
class Criteria {
 public:
  Criteria(const SizingScene& scene, const SizingOptions& options, const SizeField* sizes)
      : scene_(scene), options_(options), sizes_(sizes) {}

  Outcome evaluate(const NodeCube& node, int level, const SizingCandidates& inherited) const {
    Outcome outcome;
    outcome.candidates = select_near(scene_, node, options_.crease_proximity, inherited);
    outcome.reason = find_reason(node, level, outcome.candidates);
    if (outcome.reason == Reason::Keep) outcome.candidates = {};  // no child will ask
    return outcome;
  }

 private:
  Reason find_reason(const NodeCube& node, int level, const SizingCandidates& near) const {
    if (!touches_surface(node, near.tris)) return Reason::Keep;
    if (sizes_ && node.edge / 2 < sizes_->least(node.box())) return Reason::Keep;
    if (level < options_.min_level) return Reason::MinLevel;
    if (options_.sizing == Sizing::Thickness)
      return is_thicker_than_half(node, near.tris) ? Reason::Thickness : Reason::Keep;
    // Halving the node must not go below the least edge.
    if (node.edge / 2 < options_.min_edge * scene_.diagonal) return Reason::Keep;
    if (faces_near_wall(node, near.walls)) return Reason::Wall;
    const double limit = options_.deviation_factor * options_.tolerance * scene_.diagonal;
    if (compute_plane_spread(scene_, node, near.tris) * node.edge > limit) return Reason::Deviation;
    if (options_.crease_proximity > 0 &&
        has_crowded_creases(scene_, node, near, options_.crease_proximity))
      return Reason::Creases;
    return Reason::Keep;
  }

  bool touches_surface(const NodeCube& node, std::span<const TriId> tris) const {
    return std::any_of(tris.begin(), tris.end(), [&](TriId t) {
      return meets_cube(node.to_local(scene_.surface.corners(t)), 0.5 + kTouchMargin);
    });
  }

  bool is_thicker_than_half(const NodeCube& node, std::span<const TriId> tris) const {
    return std::any_of(tris.begin(), tris.end(), [&](TriId t) {
      return node.edge > scene_.diameter[t] / 2 &&
             meets_cube(node.to_local(scene_.surface.corners(t)), 0.5);
    });
  }

  bool faces_near_wall(const NodeCube& node, std::span<const std::uint32_t> walls) const {
    return std::any_of(walls.begin(), walls.end(), [&](std::uint32_t s) {
      const WallSample& wall = scene_.walls[s];
      return options_.wall_factor * node.edge > wall.inner &&
             in_cube(node.to_local(wall.point), 0.5 + kTouchMargin);
    });
  }

  const SizingScene& scene_;
  const SizingOptions& options_;
  const SizeField* sizes_;  ///< null: cells may be of any size
};

std::vector<Outcome> evaluate_level(const Criteria& criteria, const GridFrame& frame, int level,
                                    const std::vector<Node>& nodes,
                                    const std::vector<Outcome>& parents) {
  std::vector<Outcome> outcomes(nodes.size());
  parallel_for(
      nodes.size(),
      [&](std::size_t i) {
        outcomes[i] = criteria.evaluate(cube_of(frame, level, nodes[i].index), level,
                                        parents[nodes[i].parent].candidates);
      },
      8);
  return outcomes;
}

/// Sorts a level's nodes into leaves and the next level's nodes.
std::vector<Node> split_level(const std::vector<Node>& nodes, int level,
                              const std::vector<Outcome>& outcomes, std::vector<CellSpec>& leaves) {
  std::vector<Node> children;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const LatticeCoord& q = nodes[i].index;
    if (outcomes[i].reason == Reason::Keep) {
      leaves.push_back({level, q});
      continue;
    }
    for (int c = 0; c < 8; ++c)
      children.push_back(
          {{2 * q[0] + (c & 1), 2 * q[1] + (c >> 1 & 1), 2 * q[2] + (c >> 2 & 1)}, i});
  }
  return children;
}

void check_options(const TriMesh& surface, const SizingOptions& o) {
  const auto require = [](bool ok, const char* message) {
    if (!ok) throw Error(ErrorCode::BadArgument, message);
  };
  if (surface.tris.empty())
    throw Error(ErrorCode::BadGeometry, "the surface has no triangles to size a grid for");
  require(o.tolerance > 0 && o.tolerance < 1, "the tolerance must lie between 0 and 1");
  require(o.margin >= 0 && std::isfinite(o.margin), "the margin must not be negative");
  require(o.min_level >= 0 && o.min_level <= o.max_level && o.max_level <= kMaxGridLevel,
          "levels must satisfy 0 <= minimum <= maximum <= 20");
  require(o.max_cells >= 1, "the cell budget must be at least 1");
}

}  // namespace

GridFrame root_frame(const Box3& box, double margin) {
  const Vec3 extent = box.extent();
  const double size = std::max({extent.x, extent.y, extent.z}) * (1 + 2 * margin);
  return {box.center() - Vec3{size / 2, size / 2, size / 2}, size};
}

SizingResult build_grid(const SurfaceTree& tree, const FeatureGraph& features,
                        const SizingOptions& options, const Context& context,
                        const SizeField* sizes) {
  const auto watch = context.watch();
  check_options(tree.surface(), options);
  const SizingScene scene = make_sizing_scene(tree, features, options, context);
  const Criteria criteria(scene, options, sizes);
  const GridDomain domain =
      options.domain.value_or(GridDomain{root_frame(tree.box(), options.margin), {{0, 0, 0}}});
  const GridFrame& frame = domain.frame;

  SizingResult result;
  result.splits_by_reason.assign(std::size(kSplitReasons), 0);
  std::vector<CellSpec> leaves;
  std::vector<Node> nodes;
  for (const LatticeCoord& root : domain.roots) nodes.push_back({root, 0});
  std::vector<Outcome> parents(1);
  parents[0].candidates = make_root_candidates(scene);
  std::size_t num_cells = nodes.size();
  for (int level = 0; !nodes.empty(); ++level) {
    context.check_cancelled();
    context.progress("sizing", static_cast<double>(level) / (options.max_level + 1));
    std::vector<Outcome> outcomes(nodes.size());
    if (level < options.max_level)
      outcomes = evaluate_level(criteria, frame, level, nodes, parents);
    const auto num_splits = static_cast<std::size_t>(
        std::count_if(outcomes.begin(), outcomes.end(),
                      [](const Outcome& o) { return o.reason != Reason::Keep; }));
    if (num_cells + 7 * num_splits > options.max_cells) {
      result.hit_cell_budget = true;
      context.warn(fmt::format(
          "the grid stops at level {}: {} of its cells should be split further, which would make "
          "{} cells, more than the budget of {}; raise the budget or the tolerance",
          level, num_splits, num_cells + 7 * num_splits, options.max_cells));
      for (Outcome& o : outcomes) o.reason = Reason::Keep;
    } else {
      num_cells += 7 * num_splits;
      for (const Outcome& o : outcomes)
        if (o.reason != Reason::Keep) ++result.splits_by_reason[static_cast<std::size_t>(o.reason)];
    }
    result.reached_level = level;
    nodes = split_level(nodes, level, outcomes, leaves);
    parents = std::move(outcomes);
  }
  result.grid = make_grid(frame, domain.roots, leaves);
  context.progress("sizing", 1);
  return result;
}

SizingResult build_grid(const Target& target, const SizingOptions& options, const Context& context,
                        const SizeField* sizes) {
  SizingOptions of_box = options;
  const double turned = target.diagonal() / target.tree.box().diagonal();
  of_box.tolerance *= turned;
  of_box.min_edge *= turned;
  return build_grid(target.tree, target.features, of_box, context, sizes);
}

}  // namespace hexwright
