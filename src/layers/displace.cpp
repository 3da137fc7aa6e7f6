// Harmonic displacements by Jacobi sweeps. Edges count by one over their length, so that rows of
// cells between two walls are compressed alike, whatever their heights.
#include "layers/displace.h"

#include <algorithm>

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

namespace hexwright::layers {
namespace {

using namespace relax;

constexpr int kNumSweeps = 60;
constexpr double kFloor = 0.02;  // scaled Jacobian
constexpr int kMaxHalvings = 8;  // then vertices stay

/// A displacement within what the vertex may do.
Vec3 allowed(const FitState& state, VertId v, const Vec3& u) {
  const Vec3& axis = state.axis[v];
  switch (state.move[v]) {
    case MoveIn::Point:
      return {};
    case MoveIn::Line:
      return axis * dot(axis, u);
    case MoveIn::Plane:
      return u - axis * dot(axis, u);
    case MoveIn::Space:
      break;
  }
  return u;
}

Vec3 mean_around(const FitState& state, const IdVector<VertId, Vec3>& way, VertId v) {
  const auto& p = state.mesh.positions;
  Vec3 sum;
  double total = 0;
  for (const HexStar& star : state.stars[v])
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = 1 / std::max(1e-3 * state.size[v], distance(p[star[k]], p[v]));
      sum += way[star[k]] * weight;
      total += weight;
    }
  return total > 0 ? sum / total : Vec3{};
}

void extend(const FitState& state, const std::vector<char>& is_driven,
            IdVector<VertId, Vec3>& way) {
  IdVector<VertId, Vec3> next = way;
  for (int sweep = 0; sweep < kNumSweeps; ++sweep) {
    parallel_for(
        way.size(),
        [&](std::size_t i) {
          const VertId v(i);
          if (is_driven[i] || state.move[v] == MoveIn::Point) return;
          next[v] = allowed(state, v, mean_around(state, way, v));
        },
        256);
    std::swap(way, next);
  }
}

}  // namespace

void displace(FitState& state, const std::vector<char>& is_driven, IdVector<VertId, Vec3> way) {
  extend(state, is_driven, way);
  auto& p = state.mesh.positions;
  const IdVector<VertId, Vec3> from = p;
  const auto before = compute_scaled_jacobians(state.mesh);
  IdVector<VertId, double> share(p.size(), 1.0);
  for (int round = 0;; ++round) {
    for (VertId v : p.ids()) p[v] = from[v] + way[v] * share[v];
    const auto after = compute_scaled_jacobians(state.mesh);
    bool any = false;
    for (HexId h : after.ids()) {
      if (after[h] > 0 && after[h] >= std::min(kFloor, before[h])) continue;
      for (VertId v : state.mesh.hexes[h]) {
        any |= share[v] > 0;
        share[v] = round < kMaxHalvings ? 0.5 * share[v] : 0;
      }
    }
    if (!any) break;
  }
  state.mark_all_dirty();
}

}  // namespace hexwright::layers
