// The last resort for hexes without a proof: a search by steps, one vertex at a time, off the
// surface where it must be.
//
// The determinant inside a trilinear hex may vanish while its corners are well shaped: as where two
// vertices of a face have slid past each other along one crease. Energies of corners see nothing of
// it, the Bezier coefficients do.
#include <algorithm>
#include <cmath>

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
  Freer(FitState& state, double slack, double floor)
      : state_(state), slack_(slack), floor_(floor), start_(state.mesh.positions) {}

  // All that moved goes back when the hex stays without a proof. Curves are left last.
  void free(HexId h) {
    for (const VertKind last : {VertKind::Surface, VertKind::Corner}) {
      const auto before = state_.mesh.positions;
      for (int round = 0; round < kMaxRounds && improve_around(h, last); ++round) {
      }
      if (check_positivity(state_.mesh.corners(h)) == Positivity::Positive) return;
      state_.mesh.positions = before;
    }
  }

 private:
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

  bool is_allowed(VertId v, const Vec3& place) const {
    if (!state_.is_boundary(v)) return true;
    const double longest = std::min(slack_, state_.size[v]);
    return distance(place, start_[v]) + state_.residual(v) * state_.size[v] <= longest;
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
        if (!is_allowed(v, place)) continue;
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
  const double slack_, floor_;
  const IdVector<VertId, Vec3> start_;
};

}  // namespace

void free_unproven(FitState& state, const std::vector<HexId>& unproven, double slack,
                   double floor) {
  Freer freer(state, slack, floor);
  for (HexId h : unproven) freer.free(h);
}

}  // namespace hexwright::relax
