// Based on: the fit's kernel and passes (docs/algorithms/fit.md); Garanzha et al., "Foldover-free
// maps in 50 lines of code", ACM TOG 40(4), 2021, for the regularised determinants of the
// untangling.
//
// Differs: nothing is carved or snapped here, for the map has already said what every boundary
// vertex belongs to. Each way of untangling is undone when it leaves more hexes inverted than it
// found.
#include "polycube/map/relax.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

#include "hexwright/quality/hex_quality.h"

#include "fit/sheets/pad_boundary.h"
#include "relax/passes/finish.h"
#include "relax/passes/pass.h"
#include "relax/passes/untangle.h"
#include "relax/state/fit_state.h"
#include "relax/state/targets.h"

namespace hexwright::polycube {
namespace {

using relax::FitState;
using relax::FitTarget;
using relax::MoveIn;
using relax::VertKind;

constexpr double kClearlyPositive = 0.02;  // scaled Jacobian above which a hex is left alone
constexpr int kMaxSlidingRounds = 12;
const std::vector<double> kShares = {0.1, 0.01, 0.001};

// The polycube's edges on the object as curves, cut only where they meet.
FeatureGraph chart_curves(const ObjectFeatures& object) {
  FeatureOptions options;
  options.crease_angle = std::numbers::pi;
  options.turn_angle = std::numbers::pi;
  options.extra_edges = object.chart_edges;
  return extract_features(object.surface, options);
}

std::map<std::array<VertId, 2>, CurveId> curves_by_edge(const FeatureGraph& graph) {
  std::map<std::array<VertId, 2>, CurveId> result;
  for (CurveId c : graph.curves.ids()) {
    const auto& verts = graph.curves[c].verts;
    for (std::size_t i = 1; i < verts.size(); ++i)
      result[{std::min(verts[i - 1], verts[i]), std::max(verts[i - 1], verts[i])}] = c;
  }
  return result;
}

// Tells the state which face, edge or corner each boundary vertex belongs to.
void constrain(FitState& state, const IdVector<VertId, BoundaryPlace>& place,
               const ObjectFeatures& object, const FeatureGraph& graph,
               const IdVector<TriId, int>& facet_to_chart) {
  const auto edge_to_curve = curves_by_edge(graph);
  for (VertId v : place.ids()) {
    if (!state.is_boundary(v)) continue;
    const BoundaryPlace& at = place[v];
    if (at.corner.is_valid()) {
      state.kind[v] = VertKind::Corner;
      state.feature_point[v] = at.corner;
    } else if (at.crease[0].is_valid()) {
      const auto found = edge_to_curve.find(
          {std::min(at.crease[0], at.crease[1]), std::max(at.crease[0], at.crease[1])});
      if (found == edge_to_curve.end()) continue;
      state.kind[v] = VertKind::Curve;
      state.curve[v] = found->second;
      state.arc[v] =
          closest_on_curve(object.surface, graph.curves[found->second], state.mesh.positions[v])
              .arc;
    } else if (at.facet.is_valid()) {
      state.patch[v] = PatchId(facet_to_chart[at.facet]);
    }
  }
}

std::size_t count_inverted(const FitState& state) {
  return summarize_quality(state.mesh).num_inverted;
}

// Runs a way of untangling, and undoes it when it leaves more hexes inverted than there were.
template <class Way>
void try_untangling(FitState& state, Way&& way) {
  const std::size_t before = count_inverted(state);
  if (before == 0) return;
  const auto positions = state.mesh.positions;
  way();
  if (count_inverted(state) > before) state.mesh.positions = positions;
}

// With the boundary fixed where the map put it: what can be untangled from inside costs no
// distance.
void untangle_inside(FitState& state, const Context& context) {
  const auto move = state.move;
  for (VertId v : state.kind.ids())
    if (state.is_boundary(v)) state.move[v] = MoveIn::Point;
  relax::untangle(state, {.shares = kShares}, context);
  state.move = move;
}

// With boundary vertices gliding on their faces and edges, the looser the smaller the weight.
void untangle_sliding(FitState& state, const FitTarget& target, double weight,
                      const Context& context) {
  relax::UntangleOptions options;
  options.shares = kShares;
  options.max_rounds = kMaxSlidingRounds;
  options.sweeps = 3;
  options.low = kClearlyPositive;
  options.target = &target;
  options.weight = weight;
  relax::untangle(state, options, context);
}

// Vertices of inverted hexes on the polycube's edges and corners become vertices of the surface,
// which is smooth there more often than not. Returns how many did.
std::size_t release_edges(FitState& state) {
  std::size_t num_released = 0;
  const auto quality = compute_scaled_jacobians(state.mesh);
  for (HexId h : quality.ids()) {
    if (quality[h] > 0) continue;
    for (VertId v : state.mesh.hexes[h]) {
      if (state.kind[v] != VertKind::Curve && state.kind[v] != VertKind::Corner) continue;
      state.kind[v] = VertKind::Surface;
      state.patch[v] = {};
      ++num_released;
    }
  }
  return num_released;
}

// From what costs nothing to what gives up the polycube's edges, and at last the surface. Returns
// how many vertices left those edges.
std::size_t untangle(FitState& state, const FitTarget& target, const Context& context) {
  try_untangling(state, [&] { untangle_inside(state, context); });
  for (double weight : {1e4, 10.0})
    try_untangling(state, [&] { untangle_sliding(state, target, weight, context); });
  const std::size_t num_released = release_edges(state);
  for (double weight : {1e4, 10.0, 0.0})
    try_untangling(state, [&] { untangle_sliding(state, target, weight, context); });
  return num_released;
}

// Brings back what the untangling took off the surface, as far as no hex inverts.
void pull_to_surface(FitState& state, const FitTarget& target, const Context& context) {
  relax::update_targets(state, target, 0);
  bool is_off = false;
  for (VertId v : state.kind.ids()) is_off |= state.is_boundary(v) && state.residual(v) > 0.02;
  if (!is_off) return;
  relax::run_schedule(state, target,
                      {{0.9, 1, 0}, relax::geometric_weights(10, 1e5, 5), 2, 0.03, false}, context);
}

// Where the polycube has an edge and the object is smooth, the two faces beside the edge belong to
// one hex and lie in one plane; a layer gives each a hex of its own.
void pad_and_smooth(FitState& state, const FitTarget& target, const Context& context) {
  if (!fitting::pad_boundary(state)) {
    context.warn("no layer fits under the mesh's boundary; it is optimised without padding");
    return;
  }
  relax::run_schedule(
      state, target, {{0.9, 1, 0}, relax::geometric_weights(300, 1e5, 4), 2, 0.03, false}, context);
}

// Vertices farther than `distance` from what they belong to.
std::vector<char> find_far(const FitState& state, double distance) {
  std::vector<char> is_far(state.num_verts(), 0);
  for (VertId v : state.kind.ids())
    is_far[v.index()] = state.is_boundary(v) && state.residual(v) * state.size[v] > distance;
  return is_far;
}

// As at the end of a fit: exactly onto the surface where quality hardly suffers, then the worst
// raised by gliding, then what is still off the surface brought back.
void improve_worst(FitState& state, const FitTarget& target, double near_surface,
                   const Context& context) {
  constexpr double kGentle = 0.4, kLeast = 0.15;  // scaled Jacobians
  relax::run(relax::kPolish, state, target, context);
  relax::snap_to_targets(state, target, kGentle);
  relax::lift_worst(state, target, {}, context);
  relax::snap_to_targets(state, target, kGentle);
  const auto is_far = find_far(state, near_surface);
  if (std::find(is_far.begin(), is_far.end(), 1) == is_far.end()) return;
  relax::snap_to_targets(state, target, kLeast, is_far);
  relax::lift_worst(state, target, {}, context);
}

void find_off_surface(const FitState& state, double near_surface, RelaxReport& report) {
  for (VertId v : state.kind.ids()) {
    if (!state.is_boundary(v)) continue;
    const double off = state.residual(v) * state.size[v];
    if (off <= near_surface) continue;
    ++report.num_off_surface;
    if (off <= report.max_off_surface) continue;
    report.max_off_surface = off;
    report.farthest_off = state.mesh.positions[v];
  }
}

PatchId patch_of_quad(const std::array<VertId, 4>& quad, const IdVector<VertId, PatchId>& patch) {
  for (VertId v : quad)
    if (patch[v].is_valid()) return patch[v];
  return {};
}

void label(const FitState& state, const HexMesh& mapped, const FitTarget& target,
           BoundaryLabels& labels) {
  for (const auto& quad : state.quads) {
    PatchId patch = patch_of_quad(quad, state.patch);
    if (!patch.is_valid()) {
      Vec3 center;
      for (VertId v : quad) center += mapped.positions[v] * 0.25;
      const auto nearest = target.tree.closest(center);
      if (nearest) patch = target.patches->patch(nearest->tri);
    }
    labels.quads.push_back({quad, patch});
    for (std::size_t k = 0; k < 4; ++k) {
      const VertId a = quad[k], b = quad[(k + 1) % 4];
      if (!(a < b)) continue;  // the other quad of the edge lists it
      const bool a_is_curve = state.kind[a] == VertKind::Curve,
                 b_is_curve = state.kind[b] == VertKind::Curve;
      const bool is_on_curve = (a_is_curve && (b_is_curve ? state.curve[a] == state.curve[b]
                                                          : state.kind[b] == VertKind::Corner)) ||
                               (b_is_curve && state.kind[a] == VertKind::Corner);
      if (is_on_curve) labels.edges.push_back({{a, b}, state.curve[a_is_curve ? a : b]});
    }
  }
  for (VertId v : state.kind.ids())
    if (state.kind[v] == VertKind::Corner) labels.corners.push_back(v);
}

}  // namespace

RelaxReport relax(MappedMesh& mapped, const RelaxScene& scene, const RelaxOptions& options,
                  const Context& context) {
  const auto& [object, lattice, tree] = scene;
  const FeatureGraph graph = chart_curves(object);
  IdVector<TriId, PatchId> facet_to_patch(lattice.facets.size());
  for (TriId f : lattice.facets.ids()) facet_to_patch[f] = PatchId(lattice.facet_to_chart[f]);
  const PatchIndex patches(tree, std::move(facet_to_patch));
  const FitTarget target{tree, &graph, &patches};

  FitState state(std::move(mapped.mesh));
  constrain(state, mapped.place, object, graph, lattice.facet_to_chart);
  context.progress("untangle", 0);
  RelaxReport report;
  report.num_off_edges = untangle(state, target, context);
  pull_to_surface(state, target, context);
  context.progress("improve", 0);
  if (options.pad) pad_and_smooth(state, target, context);
  improve_worst(state, target, options.near_surface, context);
  relax::update_targets(state, target, 0);
  find_off_surface(state, options.near_surface, report);
  mapped.mesh = std::move(state.mesh);
  label(state, mapped.mesh, target, mapped.mesh.labels);
  return report;
}

}  // namespace hexwright::polycube
