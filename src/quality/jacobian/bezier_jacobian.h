// The Jacobian determinant of a trilinear hex as a Bezier polynomial of degree 2 in each parameter.
//
// Based on: Johnen, Weill, Remacle, "Robust and efficient validation of the linear hexahedral
// element", 2017, sections 2 and 3.
#pragma once

#include <array>

#include "hexwright/base/vec3.h"

namespace hexwright {

/// Coefficients of the determinant, index i + 3 j + 9 k for the Bernstein functions i, j, k of the
/// parameters along x, y, z. The determinant lies in their convex hull, and equals them at the 8
/// corners (i, j, k in {0, 2}).
using JacobianBezier = std::array<double, 27>;

JacobianBezier compute_jacobian_bezier(const std::array<Vec3, 8>& p);

/// The same polynomial on the 8 halves-in-every-direction of the unit cube (de Casteljau).
std::array<JacobianBezier, 8> subdivide(const JacobianBezier& b);

}  // namespace hexwright
