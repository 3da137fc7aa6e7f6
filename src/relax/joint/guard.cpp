#include "relax/joint/guard.h"

#include <algorithm>
#include <cmath>

#include "hexwright/quality/hex_quality.h"

namespace hexwright::relax {
namespace {

// What already was farther off may grow by rounding, not by more.
constexpr double kSame = 1.02;
constexpr double kCurveWindow = 3;  // in h, around where a vertex was on its curve

}  // namespace

JointGuard::JointGuard(const FitState& state, const FitTarget& target, const JointRegion& region)
    : state_(state), target_(target), region_(region) {
  find_middles();
  std::vector<Vec3> positions;
  for (VertId v : region.verts()) positions.push_back(state.mesh.positions[v]);
  for (Middle& middle : middles_)
    middle.at_first = distance_of(middle, positions, std::numeric_limits<double>::infinity());
  unproven_ = count_unproven(positions);
}

void JointGuard::add_middle(const std::array<LocalVert, 4>& verts, CurveId curve) {
  if (std::any_of(verts.begin(), verts.end(), [&](LocalVert v) { return region_.is_movable(v); }))
    middles_.push_back({verts, curve, 0});
}

// Of the faces that are fitted to the surface, and of their edges, each once.
void JointGuard::find_middles() {
  std::vector<std::array<LocalVert, 2>> edges;
  for (std::size_t k = 0; k < region_.hexes().size(); ++k) {
    const HexId h = region_.hexes()[k];
    for (std::size_t lf = 0; lf < 6; ++lf) {
      if (!state_.is_fitted_face({h, static_cast<int>(lf)})) continue;
      std::array<LocalVert, 4> face{};
      for (std::size_t i = 0; i < 4; ++i)
        face[i] = region_.local_hexes()[k][static_cast<std::size_t>(kHexFaces[lf][i])];
      add_middle(face, {});
      for (std::size_t i = 0; i < 4; ++i)
        edges.push_back(
            {std::min(face[i], face[(i + 1) % 4]), std::max(face[i], face[(i + 1) % 4])});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [a, b] : edges) add_middle({a, b, a, b}, curve_along(a, b));
}

// The curve that an edge between these vertices follows, if any.
CurveId JointGuard::curve_along(LocalVert a, LocalVert b) const {
  VertId v = region_.verts()[a], w = region_.verts()[b];
  if (state_.kind[v] != VertKind::Curve) std::swap(v, w);
  if (state_.kind[v] != VertKind::Curve || target_.features == nullptr) return {};
  const CurveId curve = state_.curve[v];
  const FeatureCurve& on = target_.features->curves[curve];
  double arc = state_.arc[w];
  if (state_.kind[w] == VertKind::Corner) {
    const VertId point = state_.feature_point[w];
    if (point != on.verts.front() && point != on.verts.back()) return {};
    arc = point == on.verts.front() ? 0 : on.length();
  } else if (state_.kind[w] != VertKind::Curve || state_.curve[w] != curve) {
    return {};
  }
  double apart = std::abs(arc - state_.arc[v]);
  if (on.is_closed) apart = std::min(apart, on.length() - apart);
  const double length = distance(state_.mesh.positions[v], state_.mesh.positions[w]);
  return apart <= 2 * length ? curve : CurveId();
}

double JointGuard::distance_of(const Middle& middle, std::span<const Vec3> positions,
                               double limit) const {
  Vec3 x;
  for (LocalVert v : middle.verts) x += 0.25 * positions[v];
  if (middle.curve.is_valid()) {
    VertId v = region_.verts()[middle.verts[0]];
    if (state_.kind[v] != VertKind::Curve) v = region_.verts()[middle.verts[1]];
    const double window = kCurveWindow * state_.size[v];
    return std::sqrt(closest_on_curve(target_.tree.surface(),
                                      target_.features->curves[middle.curve], x,
                                      state_.arc[v] - window, state_.arc[v] + window)
                         .distance_sq);
  }
  ClosestFilter filter;
  filter.max_distance = limit;
  const auto found = target_.tree.closest(x, filter);
  return found ? std::sqrt(found->distance_sq) : std::numeric_limits<double>::infinity();
}

int JointGuard::count_unproven(std::span<const Vec3> positions) const {
  int count = 0;
  for (const auto& hex : region_.local_hexes()) {
    std::array<Vec3, 8> corners;
    for (std::size_t lv = 0; lv < 8; ++lv) corners[lv] = positions[hex[lv]];
    count += check_positivity(corners) != Positivity::Positive;
  }
  return count;
}

bool JointGuard::allows(std::span<const Vec3> positions, const JointStage& stage) const {
  for (const Middle& middle : middles_) {
    const double sag = middle.curve.is_valid() ? stage.curve_sag : stage.quad_sag;
    const double limit = std::max(sag, kSame * middle.at_first);
    if (!(distance_of(middle, positions, limit) <= limit)) return false;
  }
  return count_unproven(positions) <= unproven_;
}

}  // namespace hexwright::relax
