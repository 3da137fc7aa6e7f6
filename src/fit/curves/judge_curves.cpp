// Residuals per curve.
#include "fit/curves/judge_curves.h"

#include <algorithm>

namespace hexwright::fitting {

using namespace relax;
namespace {

/// The shortest mapped curve that ends at a surface vertex.
CurveId shortest_curve_at(const FeatureGraph& features, const FeatureMapping& mapping,
                          VertId corner) {
  CurveId best;
  for (CurveId c : features.curves.ids()) {
    const FeatureCurve& curve = features.curves[c];
    if (!mapping.curves[c].is_mapped() || curve.is_closed) continue;
    if (curve.verts.front() != corner && curve.verts.back() != corner) continue;
    if (!best.is_valid() || curve.length() < features.curves[best].length()) best = c;
  }
  return best;
}

}  // namespace

CurveVerdicts judge_curves(const FitState& state, const FeatureGraph& features,
                           const FeatureMapping& mapping, double limit) {
  CurveVerdicts verdicts;
  verdicts.residual.assign(features.curves.size(), 0);
  verdicts.is_bad.assign(features.curves.size(), 0);
  for (VertId v : state.kind.ids()) {
    if (state.kind[v] == VertKind::Curve) {
      double& r = verdicts.residual[state.curve[v]];
      r = std::max(r, state.residual(v));
    } else if (state.kind[v] == VertKind::Corner && state.residual(v) > limit) {
      const CurveId c = shortest_curve_at(features, mapping, state.feature_point[v]);
      if (c.is_valid()) verdicts.residual[c] = std::max(verdicts.residual[c], state.residual(v));
    }
  }
  for (CurveId c : features.curves.ids()) {
    const bool is_mapped = mapping.curves[c].is_mapped();
    if (is_mapped && verdicts.residual[c] > limit) {
      verdicts.is_bad[c] = 1;
      ++verdicts.num_bad;
    }
    if (!is_mapped || verdicts.is_bad[c]) verdicts.bad_length += features.curves[c].length();
  }
  return verdicts;
}

void report_features(const FitState& state, const FeatureGraph& features,
                     const FeatureMapping& mapping, FitReport& report) {
  report.num_curves = features.curves.size();
  report.num_corners = features.corners.size();
  report.curve_length = features.total_length();
  report.curves.clear();
  for (CurveId c : features.curves.ids()) {
    const CurvePath& path = mapping.curves[c];
    report.curves.push_back({c, path.is_mapped(), 0, path.reason});
    if (!path.is_mapped()) continue;
    ++report.num_curves_mapped;
    report.curve_length_mapped += features.curves[c].length();
  }
  for (VertId v : mapping.corner_verts) report.num_corners_mapped += v.is_valid() ? 1 : 0;
  for (VertId v : state.kind.ids()) {
    if (state.kind[v] != VertKind::Curve) continue;
    double& r = report.curves[state.curve[v].index()].max_residual;
    r = std::max(r, state.residual(v) * state.size[v]);
  }
}

}  // namespace hexwright::fitting
