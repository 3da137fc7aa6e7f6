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

/// In the target's unit coordinates.
struct SizePlan {
  SizeField field;                    ///< bounds of cells
  std::optional<SizedDomain> domain;  ///< absent: one root cube around the object
};

/// Errors: BadArgument when a rule names no patch or curve of the target, or the box does not meet
/// the object.
SizePlan plan_sizes(const MeshOptions& wishes, const Target& target, const Context& context);

/// The box of the domain around the object, in the surface's coordinates; absent: inside, or none
/// was asked for.
std::optional<Box3> find_domain_box(const MeshOptions& wishes, const Box3& object);

}  // namespace hexwright
