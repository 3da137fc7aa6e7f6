// Bezier polynomials of three parameters, cut in half along each (de Casteljau).
#pragma once

#include <array>
#include <cstddef>

namespace hexwright {

/// N coefficients along each parameter, index i + N j + N^2 k.
template <std::size_t N>
using BezierCube = std::array<double, N * N * N>;

/// Along the parameter whose coefficients are `stride` apart: the lower half, the upper half.
template <std::size_t N>
std::array<BezierCube<N>, 2> split_along(const BezierCube<N>& b, std::size_t stride) {
  std::array<BezierCube<N>, 2> halves;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (i / stride % N != 0) continue;
    std::array<double, N> row;
    for (std::size_t k = 0; k < N; ++k) row[k] = b[i + k * stride];
    for (std::size_t level = 0; level < N; ++level) {
      const std::size_t last = N - 1 - level;
      halves[0][i + level * stride] = row[0];
      halves[1][i + last * stride] = row[last];
      for (std::size_t k = 0; k < last; ++k) row[k] = 0.5 * (row[k] + row[k + 1]);
    }
  }
  return halves;
}

/// The same polynomial on the 8 halves-in-every-direction of the unit cube; bit 0 of a part's
/// number is its half along the first parameter.
template <std::size_t N>
std::array<BezierCube<N>, 8> subdivide_cube(const BezierCube<N>& b) {
  std::array<BezierCube<N>, 8> parts;
  const auto in_x = split_along<N>(b, 1);
  for (std::size_t x = 0; x < 2; ++x) {
    const auto in_y = split_along<N>(in_x[x], N);
    for (std::size_t y = 0; y < 2; ++y) {
      const auto in_z = split_along<N>(in_y[y], N * N);
      parts[x + 2 * y] = in_z[0];
      parts[x + 2 * y + 4] = in_z[1];
    }
  }
  return parts;
}

}  // namespace hexwright
