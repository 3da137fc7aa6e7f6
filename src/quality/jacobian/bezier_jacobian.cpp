#include "quality/jacobian/bezier_jacobian.h"

#include "hexwright/mesh/hex_numbering.h"

#include "quality/jacobian/bezier_subdivision.h"

namespace hexwright {
namespace {

// Edge vectors along each axis: edges[axis][s + 2 t], (s, t) the bits of the two other axes in
// increasing order.
using AxisEdges = std::array<std::array<Vec3, 4>, 3>;

AxisEdges compute_axis_edges(const std::array<Vec3, 8>& p) {
  const auto at = [&](int bits) { return p[kHexVertexOfBits[static_cast<std::size_t>(bits)]]; };
  AxisEdges edges;
  for (int i = 0; i < 4; ++i) {
    const int s = i & 1;
    const int t = i >> 1;
    const auto n = static_cast<std::size_t>(i);
    edges[0][n] = at(1 + 2 * s + 4 * t) - at(2 * s + 4 * t);
    edges[1][n] = at(s + 2 + 4 * t) - at(s + 4 * t);
    edges[2][n] = at(s + 2 * t + 4) - at(s + 2 * t);
  }
  return edges;
}

// Product of two linear Bernstein functions: B1_p B1_q = kProduct[p ^ q] B2_{p+q}.
constexpr double kProduct[2] = {1, 0.5};

}  // namespace

JacobianBezier compute_jacobian_bezier(const std::array<Vec3, 8>& p) {
  const AxisEdges edges = compute_axis_edges(p);
  JacobianBezier b{};
  // The derivative along an axis is constant in it and bilinear in the two others. Their triple
  // product multiplies two linear Bernstein functions in each direction.
  for (std::size_t y = 0; y < 4; ++y) {    // bits x, z of the derivative along y
    for (std::size_t z = 0; z < 4; ++z) {  // bits x, y of the derivative along z
      const Vec3 normal = cross(edges[1][y], edges[2][z]);
      const std::size_t i = (y & 1) + (z & 1);
      const double weight_x = kProduct[(y & 1) ^ (z & 1)];
      for (std::size_t x = 0; x < 4; ++x) {  // bits y, z of the derivative along x
        const std::size_t j = (x & 1) + (z >> 1);
        const std::size_t k = (x >> 1) + (y >> 1);
        const double weight =
            weight_x * kProduct[(x & 1) ^ (z >> 1)] * kProduct[(x >> 1) ^ (y >> 1)];
        b[i + 3 * j + 9 * k] += weight * dot(edges[0][x], normal);
      }
    }
  }
  return b;
}

std::array<JacobianBezier, 8> subdivide(const JacobianBezier& b) { return subdivide_cube<3>(b); }

}  // namespace hexwright
