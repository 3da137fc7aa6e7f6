// Targets on curves: fixed parameters first, then the closest point near the parameter.
#include "relax/state/curve_targets.h"

#include <algorithm>
#include <cmath>

namespace hexwright::relax {
namespace {

constexpr double kWindow = 1.5;  // sizes around the parameter

}  // namespace

void update_feature_target(FitState& state, VertId v, const TriMesh& surface,
                           const FeatureGraph& features, double hold) {
  state.is_dirty[v] = 1;
  if (state.kind[v] == VertKind::Corner) {
    state.target[v] = surface.positions[state.feature_point[v]];
    state.direction[v] = {};
    return;
  }
  const FeatureCurve& curve = features.curves[state.curve[v]];
  if (hold > 0) {
    const CurvePoint p = point_at_arc(surface, curve, state.arc[v]);
    state.target[v] = p.point;
    state.direction[v] = p.tangent * std::sqrt(1 - std::min(1.0, hold));
    return;
  }
  const double window = kWindow * state.size[v];
  const CurvePoint p = closest_on_curve(surface, curve, state.mesh.positions[v],
                                        state.arc[v] - window, state.arc[v] + window);
  state.arc[v] = p.arc;
  state.target[v] = p.point;
  state.direction[v] = p.tangent;
}

}  // namespace hexwright::relax
