// Sizes of cells as functions and arrays of Python: each becomes a rule with a field.
#pragma once

#include <array>
#include <cstddef>

#include "hexwright/mesh/tri_mesh.h"
#include "hexwright/pipeline/size_wishes.h"

#include "arrays.h"

namespace hexwright::python {

/// A function of places, shape (n, 3), that gives the largest edge at each, float64 of shape (n,).
/// It is called with the interpreter's lock.
SizeRule function_rule(const nb::object& function);

/// Sizes at points, shapes (n, 3) and (n,). Throws Error{BadArgument} for other shapes.
SizeRule points_rule(const AnyArray& points, const AnyArray& sizes);

/// Values of a lattice with so many points along x, y and z, two or more each, x fastest. The outer
/// ones lie on the sides of the box x0, y0, z0, x1, y1, z1; nothing is asked for beyond. Throws
/// Error{BadArgument} for other numbers of values.
SizeRule lattice_rule(const AnyArray& values, const std::array<std::size_t, 3>& counts,
                      const AnyArray& box);

/// One size per vertex or triangle of the surface, for cells at it; the vertices count where there
/// are as many of both. Throws Error{BadArgument} for another number of sizes.
SizeRule surface_rule(const TriMesh& surface, const AnyArray& sizes);

}  // namespace hexwright::python
