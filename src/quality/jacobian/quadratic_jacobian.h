// The Jacobian determinant of a triquadratic hexahedron in Bernstein form.
#pragma once

#include <array>
#include <cstddef>

#include "hexwright/mesh/mid_nodes.h"

namespace hexwright {

/// Coefficients over [0, 1]^3 of the determinant, whose degree is 5 in each coordinate: entry
/// i + 6 j + 36 k belongs to B5_i(x) B5_j(y) B5_k(z). The determinant lies between the least and
/// the largest of them, and is equal to them at the corners.
using QuadraticBezier = std::array<double, 216>;

QuadraticBezier compute_quadratic_bezier(const QuadraticHex& nodes);

/// The same polynomial over the 8 halves.
std::array<QuadraticBezier, 8> subdivide(const QuadraticBezier& bezier);

/// Volume of the element: the mean of the coefficients.
double volume_of(const QuadraticBezier& bezier);

/// The determinant at each of the 27 nodes.
std::array<double, 27> jacobians_at_nodes(const QuadraticHex& nodes);

}  // namespace hexwright
