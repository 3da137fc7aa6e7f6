// Passes: untangle if need be, raise the worst elements with energies that the worst corners
// dominate more and more, then smooth everything as far as the worst allow. The best positions seen
// are kept.
#include "hexwright/relax/improve.h"

#include <algorithm>
#include <cmath>

#include "hexwright/quality/hex_quality.h"

#include "mesh/quad.h"
#include "relax/kernel/boundary_quads.h"
#include "relax/kernel/fixed_bound.h"
#include "relax/passes/finish.h"
#include "relax/passes/sweep.h"
#include "relax/passes/untangle.h"
#include "relax/state/targets.h"

namespace hexwright {
namespace {

using namespace relax;

constexpr double kSharpCosine = 0.766;  // boundary edges bent by more than 40 degrees stay

// Vertices of labelled features and of sharp boundary edges.
void hold_features(FitState& state) {
  for (const LabeledEdge& edge : state.mesh.labels.edges)
    for (VertId v : edge.verts) state.move[v] = MoveIn::Point;
  for (VertId v : state.mesh.labels.corners) state.move[v] = MoveIn::Point;
  IdVector<QuadId, Vec3> normal;
  for (const auto& quad : state.quads) normal.push_back(quad_normal(state.mesh.positions, quad));
  const BoundaryGraph graph(state.num_verts(),
                            IdSpan<QuadId, const std::array<VertId, 4>>(state.quads));
  for (std::size_t i = 0; i < graph.num_edges(); ++i) {
    const auto& edge = graph.edge(BoundaryEdgeId(i));
    if (edge.num_quads == 2 && dot(normal[edge.quads[0]], normal[edge.quads[1]]) > kSharpCosine)
      continue;
    state.move[edge.a] = state.move[edge.b] = MoveIn::Point;
  }
}

class Improver {
 public:
  Improver(HexMesh& mesh, const ImproveOptions& options, const Context& context)
      : mesh_(mesh), options_(options), context_(context), state_(mesh) {
    if (options.slide_on) {
      hold_features(state_);
    } else {
      for (VertId v : state_.kind.ids())
        if (state_.is_boundary(v)) state_.move[v] = MoveIn::Point;
    }
    is_held_.assign(state_.num_verts(), 0);
    for (VertId v : state_.kind.ids()) is_held_[v] = state_.move[v] == MoveIn::Point;
    bound_ = bound_quality(mesh, state_.vert_to_hex, is_held_);
  }

  ImproveReport run() {
    const QualitySummary before = summarize_quality(mesh_);
    report_.min_before = best_min_ = before.min_scaled_jacobian;
    report_.avg_before = best_avg_ = before.avg_scaled_jacobian;
    best_ = mesh_.positions;
    if (before.num_inverted > 0) {
      untangle(state_, context_);
      keep_if_better();
    }
    if (best_min_ > 0) {
      raise_worst();
      smooth();
    }
    mesh_.positions = best_;
    conclude();
    return report_;
  }

 private:
  // A mesh is better with a larger least scaled Jacobian, or the same least and a larger average.
  bool keep_if_better() {
    if (options_.slide_on) snap_to_targets(state_, {options_.slide_on->tree, nullptr}, 0);
    const QualitySummary now = summarize_quality(state_.mesh);
    const double gain = now.min_scaled_jacobian - best_min_;
    const bool better = gain > 1e-9 || (gain >= 0 && now.avg_scaled_jacobian > best_avg_);
    if (!better) return false;
    const bool progress = gain > 1e-4;
    best_ = state_.mesh.positions;
    best_min_ = now.min_scaled_jacobian;
    best_avg_ = now.avg_scaled_jacobian;
    return progress;
  }

  // Boundary vertices move in the surface's tangent plane; keep_if_better brings them back to it.
  void update_slide_targets(std::span<const char> only = {}) {
    if (!options_.slide_on) return;
    update_targets(state_, {options_.slide_on->tree, nullptr}, 0, only);
    for (VertId v : state_.kind.ids()) {
      if (!state_.is_boundary(v) || is_held_[v]) continue;
      state_.move[v] = MoveIn::Plane;
      state_.axis[v] = normalized(state_.direction[v]);
    }
  }

  // All vertices with the energy that serves the average, as far as the least allows.
  void smooth() {
    state_.mesh.positions = best_;
    state_.mark_all_dirty();
    for (int round = 0; round < 6; ++round) {
      context_.check_cancelled();
      update_slide_targets();
      sweep_for_average(state_, best_min_ + 1e-9, {3, 8, 0.01}, context_);
    }
    keep_if_better();
  }

  // The neighbourhoods of the worst elements; their power is doubled when it leads no further, up
  // to where the energy of the worst corner is still far from overflowing.
  void raise_worst() {
    int power = 4;
    for (int round = 0; round < options_.max_rounds && !is_done(); ++round) {
      context_.check_cancelled();
      context_.progress("improve", static_cast<double>(round) / options_.max_rounds);
      const auto quality = compute_scaled_jacobians(state_.mesh);
      const double least = *std::min_element(quality.begin(), quality.end());
      const double low = least + 0.1 * (1 - least);
      std::vector<char> region = verts_of_hexes(state_, [&](HexId h) { return quality[h] <= low; });
      grow_vert_set(state_, region, 1);
      update_slide_targets(region);
      const LocalSweep local(state_, region);
      SweepOptions sweep_options{{1, power, 0}, 0, 0.01};
      sweep_options.edge_floor = kEdgeFloor;
      for (int s = 0; s < 6; ++s) local.run(state_, sweep_options);
      if (keep_if_better()) continue;
      if (power >= 256 || 2 * power * -std::log10(least) > 100) break;
      power *= 2;
    }
  }

  bool is_done() const { return best_min_ >= std::min(options_.goal, bound_.value - 1e-4); }

  void conclude() {
    const QualitySummary after = summarize_quality(mesh_);
    report_.min_after = after.min_scaled_jacobian;
    report_.avg_after = after.avg_scaled_jacobian;
    report_.worst_hex = after.worst_hex;
    report_.upper_bound = bound_.value;
    report_.bounding_hex = bound_.hex;
    if (!after.worst_hex.is_valid()) return;
    const auto corners = mesh_.corners(after.worst_hex);
    int worst = 0;
    for (int lv = 1; lv < 8; ++lv)
      if (corner_scaled_jacobian(corners, lv) < corner_scaled_jacobian(corners, worst)) worst = lv;
    const auto& hex = mesh_.hexes[after.worst_hex];
    report_.worst_is_fixed = is_held_[hex[static_cast<std::size_t>(worst)]];
    for (int n : kHexCornerNeighbors[static_cast<std::size_t>(worst)])
      if (!is_held_[hex[static_cast<std::size_t>(n)]]) report_.worst_is_fixed = false;
  }

  HexMesh& mesh_;
  const ImproveOptions& options_;
  const Context& context_;
  FitState state_;
  IdVector<VertId, char> is_held_;
  QualityBound bound_;
  IdVector<VertId, Vec3> best_;
  double best_min_ = 0, best_avg_ = 0;
  ImproveReport report_;
};

}  // namespace

Target make_slide_target(const TriMesh& surface) {
  const Similarity frame = compute_unit_frame(surface);
  return {.frame = frame, .tree = SurfaceTree(to_unit(surface, frame))};
}

ImproveReport improve(HexMesh& mesh, const ImproveOptions& options, const Context& context) {
  const auto watch = context.watch();
  if (const auto issue = mesh.find_problem()) throw Error(ErrorCode::BadArgument, issue->message);
  if (mesh.num_hexes() == 0) return {};
  if (mesh.mid_nodes) {
    context.warn(
        "the nodes of second order are left out: vertices move, and edges become straight");
    mesh.mid_nodes.reset();
  }
  if (!options.slide_on) return Improver(mesh, options, context).run();
  const Similarity& frame = options.slide_on->frame;
  HexMesh unit = to_unit(mesh, frame);
  const IdVector<VertId, Vec3> before = unit.positions;
  const ImproveReport report = Improver(unit, options, context).run();
  for (VertId v : before.ids())  // the others keep every bit
    if (!(unit.positions[v] == before[v])) mesh.positions[v] = frame.to_world(unit.positions[v]);
  return report;
}

}  // namespace hexwright
