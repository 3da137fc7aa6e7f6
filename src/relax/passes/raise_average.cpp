// Maximises the sum over hexes of a soft minimum over their corners of the scaled Jacobian J:
//     sum_h (mean_c J_c^-2p)^(-1/2p)
// The outer power is concave in the inner mean, so that its tangent bounds it: minimising the sum
// of w_h mean_c J_c^-2p with w_h = (mean_c J_c^-2p)^(-1/2p - 1) from the present positions never
// lowers the average. Weights and positions take turns.
//
// Based on: majorisation-minimisation (Hunter, Lange, "A Tutorial on MM Algorithms", The American
// Statistician 58(1), 2004); the inner energy is VertexNewton's with blend 1 and power p.
#include <algorithm>
#include <cmath>

#include "hexwright/base/context.h"
#include "hexwright/base/parallel.h"
#include "hexwright/mesh/hex_shape.h"
#include "hexwright/quality/hex_quality.h"

#include "relax/passes/finish.h"
#include "relax/passes/slide_only.h"
#include "relax/passes/sweep.h"
#include "relax/state/targets.h"

namespace hexwright::relax {
namespace {

double integer_power(double x, int n) {
  double result = 1;
  for (; n > 0; n >>= 1, x *= x)
    if (n & 1) result *= x;
  return result;
}

// The mean over the corners of J^-2p. No roots are needed: J^-2 is a ratio of squares.
double mean_power(const std::array<Vec3, 8>& corners, int power) {
  double sum = 0;
  for (int lv = 0; lv < 8; ++lv) {
    const CornerShape c = corner_shape(corners, lv);
    sum += integer_power(c.lengths_sq / (c.det * c.det), power);
  }
  return sum / 8;
}

IdVector<HexId, double> compute_weights(const HexMesh& mesh, int power) {
  IdVector<HexId, double> weight(mesh.num_hexes(), 1);
  parallel_for(
      mesh.num_hexes(),
      [&](std::size_t i) {
        const double mean = mean_power(mesh.corners(HexId(i)), power);
        // mean^(-1/2p - 1), as a soft minimum over the mean.
        weight[HexId(i)] = std::pow(mean, -0.5 / power) / mean;
      },
      256);
  return weight;
}

}  // namespace

void sweep_for_average(FitState& state, double least, const AverageOptions& options,
                       const Context& context) {
  for (int s = 0; s < options.sweeps; ++s) {
    context.check_cancelled();
    const auto weight = compute_weights(state.mesh, options.power);
    SweepOptions sweep_options{{1, options.power, 0}, 0, options.tolerance};
    sweep_options.quality_floor = least;
    sweep_options.edge_floor = kEdgeFloor;
    sweep_options.relaxation = options.relaxation;
    sweep_options.hex_weight = &weight;
    sweep(state, sweep_options);
  }
}

void raise_average(FitState& state, const FitTarget& target, const AverageOptions& options,
                   const Context& context) {
  update_targets(state, target, 0);
  state.mark_all_dirty();
  {
    // Curves keep their vertices: where these gather, chords elsewhere leave the curve.
    const SlideOnly slide(state, std::vector<char>(state.num_verts(), 1), true);
    sweep_for_average(state, options.floor, options, context);
  }
  snap_to_targets(state, target, options.floor);
}

}  // namespace hexwright::relax
