// The scaled Jacobian of a hex and of its corners, and its volume: the one definition that every
// module measures by. (relax/kernel/vertex_newton.h evaluates the same for four corners at a time.)
//
// Based on: Stimpson, Ernst, Knupp, Pebay, Thompson, "The Verdict Geometric Quality Library",
// SAND2007-1751, section 6.10. Differs: the 8 corners count, without Verdict's ninth frame at the
// centre; the published minima do the same (docs/algorithms/quality.md).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "hexwright/base/vec3.h"
#include "hexwright/mesh/hex_numbering.h"

namespace hexwright {

/// A corner by its three edge vectors.
struct CornerShape {
  double det = 0;         ///< positive at a corner that is not inverted
  double lengths_sq = 0;  ///< product of the squared lengths

  /// In [-1, 1]; -1 when an edge has no length.
  double scaled_jacobian() const {
    return lengths_sq > 0 ? std::clamp(det / std::sqrt(lengths_sq), -1.0, 1.0) : -1.0;
  }
};

/// Of local vertex `lv` of a hex, ordered as in hex_numbering.h.
inline CornerShape corner_shape(const std::array<Vec3, 8>& p, int lv) {
  const auto& n = kHexCornerNeighbors[static_cast<std::size_t>(lv)];
  const Vec3& origin = p[static_cast<std::size_t>(lv)];
  const auto edge = [&](std::size_t k) { return p[static_cast<std::size_t>(n[k])] - origin; };
  const Vec3 a = edge(0), b = edge(1), c = edge(2);
  return {det(a, b, c), norm_sq(a) * norm_sq(b) * norm_sq(c)};
}

/// Scaled Jacobian at one corner: the determinant of its unit edge vectors.
inline double corner_scaled_jacobian(const std::array<Vec3, 8>& p, int lv) {
  return corner_shape(p, lv).scaled_jacobian();
}

/// Least scaled Jacobian over the 8 corners, in [-1, 1]; -1 when an edge has no length.
double scaled_jacobian(const std::array<Vec3, 8>& p);

/// Volume by the divergence theorem with bilinear faces.
double hex_volume(const std::array<Vec3, 8>& p);

}  // namespace hexwright
