// Maximises the sum over hexes of a soft minimum s over their corners of the scaled Jacobian J:
//     sum_h (mean_c J_c^-2p)^(-1/2p)
// The outer power is concave in the inner mean, so that its tangent bounds it: minimising the sum
// of w_h mean_c J_c^-2p with w_h = (mean_c J_c^-2p)^(-1/2p - 1) = s_h^(2p + 1) from the present
// positions never lowers the average.
//
// Based on: majorisation-minimisation (Hunter, Lange, "A Tutorial on MM Algorithms", The American
// Statistician 58(1), 2004).
#include "relax/passes/mean_weights.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "hexwright/base/assert.h"
#include "hexwright/base/parallel.h"
#include "hexwright/mesh/hex_shape.h"

namespace hexwright::relax {
namespace {

double integer_power(double x, int n) {
  double result = 1;
  for (; n > 0; n >>= 1, x *= x)
    if (n & 1) result *= x;
  return result;
}

}  // namespace

// J^-2 is a ratio of squares, and the root square roots only: pow() differs between platforms.
double soft_scaled_jacobian(const std::array<Vec3, 8>& corners, int power) {
  HEXWRIGHT_ASSERT(std::has_single_bit(static_cast<unsigned>(power)));
  double sum = 0;
  for (int lv = 0; lv < 8; ++lv) {
    const CornerShape c = corner_shape(corners, lv);
    if (c.det <= 0) return 0;
    sum += integer_power(c.lengths_sq / (c.det * c.det), power);
  }
  double root = sum / 8;
  for (int n = 2 * power; n > 1; n /= 2) root = std::sqrt(root);
  return 1 / root;
}

IdVector<HexId, double> mean_weights(const HexMesh& mesh, int power, double knee) {
  IdVector<HexId, double> weight(mesh.num_hexes());
  parallel_for(
      mesh.num_hexes(),
      [&](std::size_t i) {
        const double s = std::max(knee, soft_scaled_jacobian(mesh.corners(HexId(i)), power));
        weight[HexId(i)] = integer_power(s, 2 * power + 1);
      },
      256);
  return weight;
}

}  // namespace hexwright::relax
