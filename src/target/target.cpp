// Clean and orient, place, index, and find what the surface is like.
#include "hexwright/target/target.h"

#include <utility>

#include <fmt/format.h>

#include "hexwright/geometry/pose.h"

#include "base/stage_log.h"
#include "geometry/prepare/canonical_order.h"

namespace hexwright {
namespace {

/// How close to one plane, in the unit frame, the vertices of a turned plane face must lie to be
/// put exactly on it: files in single precision leave some 1e-7.
constexpr double kPlaneTolerance = 1e-6;

/// Dangling crease chains and loops shorter than this share of the diagonal do not count.
constexpr double kPruning = 0.03;

/// The surface in unit coordinates.
struct Placed {
  TriMesh mesh;
  Similarity frame;
  double diagonal = 0;  ///< before it is turned: tolerances stay shares of the box that was given
};

void renumber_by_place(TriMesh& mesh) {
  IdVector<TriId, TriId> source;
  for (TriId t : mesh.tris.ids()) source.push_back(t);
  put_in_canonical_order(mesh, source);
  const auto group = mesh.group;
  for (std::size_t t = 0; t < group.size(); ++t) mesh.group[TriId(t)] = group[source[TriId(t)]];
}

Placed place(TriMesh surface, Placement placement) {
  Placed placed;
  placed.frame = compute_unit_frame(surface);
  placed.mesh = to_unit(std::move(surface), placed.frame);
  placed.diagonal = bounding_box(placed.mesh).diagonal();
  if (placement == Placement::AsGiven) return placed;
  placed.frame.pose = find_pose(placed.mesh);
  placed.mesh = turn_surface(placed.mesh, placed.frame.pose, kPlaneTolerance);
  const Rotation turn = find_canonical_turn(placed.mesh);
  if (turn.is_identity()) return placed;
  for (Vec3& p : placed.mesh.positions) p = turn.apply(p);
  renumber_by_place(placed.mesh);
  placed.frame.pose = compose(placed.frame.pose, turn);
  return placed;
}

FeatureOptions to_unit(FeatureOptions options, const Similarity& frame, double diagonal) {
  for (auto& segment : options.extra_segments)
    for (Vec3& p : segment) p = frame.to_unit(p);
  options.min_length =
      options.min_length > 0 ? frame.length_to_unit(options.min_length) : kPruning * diagonal;
  return options;
}

FeatureGraph find_features(Target& target) {
  target.creases = find_creases(target.tree, target.feature_options.crease_angle);
  return extract_features(target.tree, target.feature_options, target.creases);
}

void find_topology(Target& target) {
  target.topology = compute_topology(target.surface());
  target.expected = find_expected_topology(target.tree);
}

void warn_unmatched(const FeatureGraph& features, const Context& context) {
  if (features.num_unmatched_segments > 0)
    context.warn(
        fmt::format("{} of the feature edges given are no edges of the surface and are left out",
                    features.num_unmatched_segments));
}

}  // namespace

Target make_target(const TriMesh& surface, const TargetOptions& options, const Context& context) {
  const auto watch = context.watch();
  std::vector<StageRecord> stages;
  PreparedSurface prepared = run_stage(stages, "prepare", context, [&] {
    return prepare_surface(surface, options.prepare, context);
  });
  stages.back().counts["triangles"] = static_cast<double>(prepared.mesh.num_tris());

  Placed placed = place(std::move(prepared.mesh), options.placement);
  Target target = {.frame = placed.frame, .tree = run_stage(stages, "surface tree", context, [&] {
                                            return SurfaceTree(std::move(placed.mesh),
                                                               placed.diagonal);
                                          })};
  target.diagnosis = std::move(prepared.diagnosis);
  find_topology(target);

  target.feature_options = to_unit(options.features, placed.frame, placed.diagonal);
  target.features = run_stage(stages, "features", context, [&] { return find_features(target); });
  warn_unmatched(target.features, context);
  stages.back().counts["curves"] = static_cast<double>(target.features.curves.size());
  stages.back().counts["corners"] = static_cast<double>(target.features.corners.size());
  target.stages = std::move(stages);
  return target;
}

Target wrap_target(TriMesh surface, const FeatureOptions& features, const Similarity& frame) {
  Target target = {.frame = frame, .tree = SurfaceTree(std::move(surface))};
  target.feature_options = features;
  target.features = find_features(target);
  find_topology(target);
  target.diagnosis.is_closed = target.topology.is_closed_manifold();
  return target;
}

}  // namespace hexwright
