// From wishes about sizes to what the stages keep to.
#pragma once

#include "hexwright/grid/size_field.h"
#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// The wishes with what follows from the sizes among them: with `size`, the distance goal is a
/// quarter of the edge unless one was given, levels are not evened out, and the mean distance has
/// no goal of its own. Checks them against each other. Pure.
MeshOptions resolve_sizes(const MeshOptions& wishes, const TriMesh& surface);

/// The distance goal that goes with the options' size, where none was given. Lengths and diagonal
/// in the same unit.
MeshOptions resolve_tolerance(MeshOptions options, double diagonal);

/// The bounds of cells in the target's unit coordinates. Errors: BadArgument when a rule names no
/// patch or curve of the target.
SizeField make_size_field(const MeshOptions& wishes, const Target& target, const Context& context);

/// The lattice and the domain that the wishes ask for, in unit coordinates; absent: one root cube
/// around the object. Errors: BadArgument when the box does not hold the object's box.
std::optional<SizedDomain> choose_domain(const MeshOptions& wishes, const Target& target);

/// The box of the domain around the object, in the surface's coordinates; absent: inside, or none
/// was asked for.
std::optional<Box3> find_domain_box(const MeshOptions& wishes, const Box3& object);

}  // namespace hexwright
