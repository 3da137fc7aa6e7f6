#include "quality/bezier_jacobian.h"

#include "hexwright/mesh/hex_numbering.h"

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

// Splits three coefficients of one direction at the middle.
struct Halves {
  std::array<double, 3> lo, hi;
};
Halves split(double a, double b, double c) {
  const double ab = 0.5 * (a + b);
  const double bc = 0.5 * (b + c);
  const double mid = 0.5 * (ab + bc);
  return {{a, ab, mid}, {mid, bc, c}};
}

// Splits along the direction whose coefficients are `stride` apart.
std::array<JacobianBezier, 2> split_along(const JacobianBezier& b, std::size_t stride) {
  std::array<JacobianBezier, 2> halves;
  for (std::size_t i = 0; i < 27; ++i) {
    if (i / stride % 3 != 0) continue;
    const Halves h = split(b[i], b[i + stride], b[i + 2 * stride]);
    for (std::size_t k = 0; k < 3; ++k) {
      halves[0][i + k * stride] = h.lo[k];
      halves[1][i + k * stride] = h.hi[k];
    }
  }
  return halves;
}

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

std::array<JacobianBezier, 8> subdivide(const JacobianBezier& b) {
  std::array<JacobianBezier, 8> parts;
  const auto in_x = split_along(b, 1);
  for (std::size_t x = 0; x < 2; ++x) {
    const auto in_y = split_along(in_x[x], 3);
    for (std::size_t y = 0; y < 2; ++y) {
      const auto in_z = split_along(in_y[y], 9);
      parts[x + 2 * y] = in_z[0];
      parts[x + 2 * y + 4] = in_z[1];
    }
  }
  return parts;
}

}  // namespace hexwright
