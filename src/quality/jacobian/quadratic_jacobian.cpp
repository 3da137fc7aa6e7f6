// Positions become Bezier control points; their differences are those of the derivatives, and the
// products of Bernstein functions are again Bernstein functions.
//
// Based on: Johnen, Remacle, Geuzaine, "Geometrical validity of curvilinear finite elements",
// Journal of Computational Physics 233, 2013, sections 2 and 3. Differs: coefficients by products
// of polynomials instead of sampling and a matrix, so that they are exact but for rounding.
#include "quality/jacobian/quadratic_jacobian.h"

#include "hexwright/mesh/hex_numbering.h"

#include "quality/jacobian/bezier_subdivision.h"

namespace hexwright {
namespace {

/// Place (x, y, z) of a node in the 3 x 3 x 3 lattice, as x + 3 y + 9 z.
constexpr std::size_t lattice_place(int x, int y, int z) {
  return static_cast<std::size_t>(x + 3 * y + 9 * z);
}

/// Twice the mean of corners: a face's or edge's middle lies between those of its corners.
template <std::size_t N>
constexpr std::size_t middle_of(const std::array<int, N>& corners) {
  int sum[3] = {0, 0, 0};
  for (int lv : corners)
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] += 2 * (kHexBitsOfVertex[static_cast<std::size_t>(lv)] >> axis & 1);
  const int count = static_cast<int>(N);
  return lattice_place(sum[0] / count, sum[1] / count, sum[2] / count);
}

constexpr std::array<std::size_t, 27> make_places() {
  std::array<std::size_t, 27> places{};
  for (int lv = 0; lv < 8; ++lv)
    places[static_cast<std::size_t>(lv)] = middle_of(std::array<int, 1>{lv});
  for (std::size_t le = 0; le < 12; ++le) places[8 + le] = middle_of(kHexEdges[le]);
  for (std::size_t lf = 0; lf < 6; ++lf) places[20 + lf] = middle_of(kHexFaces[lf]);
  places[26] = lattice_place(1, 1, 1);
  return places;
}
constexpr auto kPlaceOfNode = make_places();

/// Control points of the position, by lattice place.
std::array<Vec3, 27> to_control_points(const QuadraticHex& nodes) {
  std::array<Vec3, 27> b;
  for (std::size_t n = 0; n < 27; ++n) b[kPlaceOfNode[n]] = nodes[n] - nodes[0];
  for (std::size_t stride : {1, 3, 9})
    for (std::size_t i = 0; i < 27; ++i)
      if (i / stride % 3 == 1) b[i] = 2.0 * b[i] - 0.5 * (b[i - stride] + b[i + stride]);
  return b;
}

/// A polynomial as Bernstein coefficients times their binomials, in which form a product is a plain
/// convolution. Degrees per coordinate; x runs fastest.
template <class Value, std::size_t Dx, std::size_t Dy, std::size_t Dz>
struct Scaled {
  static constexpr std::size_t kX = Dx, kY = Dy, kZ = Dz;
  std::array<Value, (Dx + 1) * (Dy + 1) * (Dz + 1)> c{};
  Value& at(std::size_t i, std::size_t j, std::size_t k) {
    return c[i + (Dx + 1) * (j + (Dy + 1) * k)];
  }
  const Value& at(std::size_t i, std::size_t j, std::size_t k) const {
    return c[i + (Dx + 1) * (j + (Dy + 1) * k)];
  }
};

template <class A, class B, class Out, class Product>
void convolve(const A& a, const B& b, Out& out, Product product) {
  for (std::size_t k = 0; k <= A::kZ; ++k)
    for (std::size_t j = 0; j <= A::kY; ++j)
      for (std::size_t i = 0; i <= A::kX; ++i)
        for (std::size_t n = 0; n <= B::kZ; ++n)
          for (std::size_t m = 0; m <= B::kY; ++m)
            for (std::size_t l = 0; l <= B::kX; ++l)
              out.at(i + l, j + m, k + n) += product(a.at(i, j, k), b.at(l, m, n));
}

constexpr double kBinomial2[3] = {1, 2, 1};
constexpr double kBinomial5[6] = {1, 5, 10, 10, 5, 1};

/// Derivative along the axis of this stride: degree 1 in it and 2 in the others.
template <class Derivative>
Derivative differentiate(const std::array<Vec3, 27>& b, std::size_t stride) {
  Derivative d;
  const auto binomial = [](std::size_t degree, std::size_t i) {
    return degree == 2 ? kBinomial2[i] : 1.0;
  };
  for (std::size_t k = 0; k <= Derivative::kZ; ++k)
    for (std::size_t j = 0; j <= Derivative::kY; ++j)
      for (std::size_t i = 0; i <= Derivative::kX; ++i) {
        const std::size_t place = i + 3 * j + 9 * k;
        const double scale = 2 * binomial(Derivative::kX, i) * binomial(Derivative::kY, j) *
                             binomial(Derivative::kZ, k);
        d.at(i, j, k) = scale * (b[place + stride] - b[place]);
      }
  return d;
}

}  // namespace

QuadraticBezier compute_quadratic_bezier(const QuadraticHex& nodes) {
  const auto b = to_control_points(nodes);
  const auto dx = differentiate<Scaled<Vec3, 1, 2, 2>>(b, 1);
  const auto dy = differentiate<Scaled<Vec3, 2, 1, 2>>(b, 3);
  const auto dz = differentiate<Scaled<Vec3, 2, 2, 1>>(b, 9);
  Scaled<Vec3, 4, 3, 3> normal;
  convolve(dy, dz, normal, [](const Vec3& a, const Vec3& c) { return cross(a, c); });
  Scaled<double, 5, 5, 5> det;
  convolve(dx, normal, det, [](const Vec3& a, const Vec3& c) { return dot(a, c); });
  for (std::size_t i = 0; i < det.c.size(); ++i)
    det.c[i] /= kBinomial5[i % 6] * kBinomial5[i / 6 % 6] * kBinomial5[i / 36];
  return det.c;
}

std::array<QuadraticBezier, 8> subdivide(const QuadraticBezier& b) { return subdivide_cube<6>(b); }

double volume_of(const QuadraticBezier& bezier) {
  double sum = 0;
  for (double value : bezier) sum += value;
  return sum / static_cast<double>(bezier.size());
}

std::array<double, 27> jacobians_at_nodes(const QuadraticHex& nodes) {
  std::array<Vec3, 27> p;  // by lattice place
  for (std::size_t n = 0; n < 27; ++n) p[kPlaceOfNode[n]] = nodes[n];
  // Derivative of the parabola through three points at the first, the middle and the last.
  const auto derivative = [&](std::size_t place, std::size_t stride) {
    const std::size_t i = place / stride % 3, first = place - i * stride;
    const Vec3 &a = p[first], &m = p[first + stride], &c = p[first + 2 * stride];
    return i == 0   ? 4.0 * (m - a) - (c - a)
           : i == 1 ? c - a
                    : (c - a) + 4.0 * (c - m) - 2.0 * (c - a);
  };
  std::array<double, 27> values;
  for (std::size_t n = 0; n < 27; ++n) {
    const std::size_t place = kPlaceOfNode[n];
    values[n] = det(derivative(place, 1), derivative(place, 3), derivative(place, 9));
  }
  return values;
}

}  // namespace hexwright
