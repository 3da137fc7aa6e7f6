// Does a surface separate inside from outside here, or does it only cross the solid?
//
// Based on: the winding number on both sides, as Zhou, Grinspun, Zorin, Jacobson, "Mesh
// Arrangements for Solid Geometry", ACM TOG 35(4), 2016, section 5, select the triangles that bound
// a union. Differs: decided point by point and without cutting triangles along their intersections.
#pragma once

#include "hexwright/geometry/surface_tree.h"

namespace hexwright {

/// Whether the solid {winding number > 1/2} lies on exactly one side of triangle t at point p of
/// it. Where it lies on both sides (a wall inside the union of overlapping parts) or on neither (a
/// sheet that encloses nothing), no mesh of the solid can come near the surface, and none should.
///
/// The sides are probed off the triangle by 1e-3 of its size, at most 1e-5 of the surface's
/// diagonal, a little way from p towards the centroid, so that points on a sharp edge are judged by
/// the triangle's own side of it. A closed wall thinner than the probe's step counts as bounding
/// nothing. Two winding numbers: microseconds. False for a triangle without area.
bool bounds_solid(const SurfaceTree& surface, TriId t, const Vec3& p);

/// The same, probed no farther than ten steps from p: on large triangles that are in part inside
/// the solid, p is judged by itself. Less sure on the edges of needles.
bool bounds_solid_near(const SurfaceTree& surface, TriId t, const Vec3& p);

/// The same with a step of 7e-4 of the triangle's altitude instead of its size, so that a needle
/// along the edge of a narrow wedge is not left by the wedge's other side. Finer than many a soup's
/// coordinates: for triangles whose normal can be trusted.
bool bounds_solid_closely(const SurfaceTree& surface, TriId t, const Vec3& p);

}  // namespace hexwright
