// The last resort for hexes without a proof: a search by steps, one vertex at a time, off the
// surface where it must be.
//
// The determinant inside a trilinear hex may vanish while its corners are well shaped: as where two
// vertices of a face have slid past each other along one crease. Energies of corners see nothing of
// it, the Bezier coefficients do.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hexwright/base/cancel.h"
#include "hexwright/mesh/hex_shape.h"
#include "hexwright/quality/hex_quality.h"

#include "quality/jacobian/bezier_jacobian.h"
#include "relax/passes/finish.h"
#include "relax/state/proof.h"

namespace hexwright::relax {
namespace {

constexpr int kMaxRounds = 30;
constexpr double kEnough = 0.02;  // least coefficient, as a share of the mean one
constexpr double kProgress = 1e-4;
constexpr double kSteps[] = {0.4, 0.2, 0.1, 0.05, 0.02, 0.01};  // in h

// The least of the coefficients of the hex's eighths: what a proof needs above 0.
double least_share(const std::array<Vec3, 8>& p) {
  const JacobianBezier whole = compute_jacobian_bezier(p);
  double mean = 0;
  for (double b : whole) mean += b / static_cast<double>(whole.size());
  double least = mean;
  for (const JacobianBezier& part : subdivide(whole))
    least = std::min(least, *std::min_element(part.begin(), part.end()));
  return mean > 0 ? least / mean : -1;
}

struct Around {
  double lack = 0;     // of the hexes at a vertex together: what their shares fall short of kEnough
  double quality = 1;  // their least
  int num_bad = 0;     // hexes without a proof by their eighths
};

class Freer {
 public:
  Freer(FitState& state, double slack)
      : state_(state),
        start_(state.mesh.positions),
        room_(state.num_verts(), std::numeric_limits<double>::infinity()) {
    for (VertId v : room_.ids())
      if (state.is_boundary(v))
        room_[v] = std::min(slack, state.size[v]) - state.residual(v) * state.size[v];
  }

  // All that moved goes back when the hex stays without a proof. Curves are left last.
  void free(HexId h, double floor) {
    check_cancelled();
    floor_ = floor;
    for (const VertKind last : {VertKind::Surface, VertKind::Corner}) {
      if (last > VertKind::Surface && !has_features(h)) return;
      const std::array<Vec3, 8> before = state_.mesh.corners(h);
      for (int round = 0; round < kMaxRounds && improve_around(h, last); ++round) {
      }
      if (check_positivity(state_.mesh.corners(h)) == Positivity::Positive) return;
      for (std::size_t k = 0; k < 8; ++k)
        state_.mesh.positions[state_.mesh.hexes[h][k]] = before[k];
    }
  }

 private:
  bool has_features(HexId h) const {
    const auto& hex = state_.mesh.hexes[h];
    return std::any_of(hex.begin(), hex.end(),
                       [&](VertId v) { return state_.kind[v] > VertKind::Surface; });
  }

  // Whether a vertex of the hex moved.
  bool improve_around(HexId h, VertKind last) {
    if (least_share(state_.mesh.corners(h)) >= kEnough) return false;
    bool any = false;
    for (VertId v : state_.mesh.hexes[h])
      if (state_.kind[v] <= last) any = improve(v) || any;
    return any;
  }

  Around look(VertId v) const {
    Around around;
    for (const HexCorner& corner : state_.vert_to_hex[v]) {
      const auto p = state_.mesh.corners(corner.hex);
      const double share = least_share(p);
      around.lack += std::max(0.0, kEnough - share);
      around.num_bad += share <= 0;
      around.quality = std::min(around.quality, scaled_jacobian(p));
    }
    return around;
  }

  // To the best of the places around that a cube's faces, edges and corners show the way to.
  bool improve(VertId v) {
    if (state_.move[v] != MoveIn::Space) return false;
    const Around now = look(v);
    if (now.lack == 0) return false;
    const Vec3 from = state_.mesh.positions[v];
    const double floor = std::min(now.quality, floor_);
    for (double step : kSteps) {
      Vec3 best = from;
      double least = now.lack - kProgress;
      for (int i = 0; i < 27; ++i) {
        const int x = i % 3 - 1, y = i / 3 % 3 - 1, z = i / 9 - 1;
        const Vec3 way{double(x), double(y), double(z)};
        if (i == 13) continue;
        const Vec3 place = from + step * state_.size[v] / norm(way) * way;
        if (!(distance(place, start_[v]) <= room_[v])) continue;
        state_.mesh.positions[v] = place;
        const Around there = look(v);
        if (there.quality < floor || there.lack >= least || there.num_bad > now.num_bad) continue;
        least = there.lack;
        best = place;
      }
      state_.mesh.positions[v] = best;
      if (least < now.lack - kProgress) return true;
    }
    return false;
  }

  FitState& state_;
  double floor_ = 0;
  const IdVector<VertId, Vec3> start_;
  IdVector<VertId, double> room_;  // how far from the start a vertex may go
};

}  // namespace

std::vector<HexId> free_unproven(FitState& state, std::vector<HexId> unproven, double slack,
                                 std::span<const double> floors) {
  Freer freer(state, slack);
  for (double floor : floors) {
    for (HexId h : unproven) freer.free(h, floor);
    unproven = find_unproven(state.mesh);
    if (unproven.empty()) break;
  }
  return unproven;
}

}  // namespace hexwright::relax
