// From wishes about sizes to what the stages keep to.
#pragma once

#include "hexwright/grid/size_field.h"
#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// The wishes with all lengths in the surface's unit. Errors: BadArgument when a length has a unit
/// and the surface none. Pure.
MeshOptions resolve_units(MeshOptions wishes);

/// The wishes with what follows from the sizes among them. With any of them the mean distance has
/// no goal of its own; with `size`, `cells` or a field levels are not evened out; with `size` the
/// distance goal is a quarter of the edge unless one was given. Checks them against each other.
/// Pure. Errors: BadArgument, also those of resolve_units().
MeshOptions resolve_sizes(const MeshOptions& wishes, const TriMesh& surface);

/// Whether the deepest level was asked for, so that no wish about sizes may go beyond.
bool is_level_given(const MeshOptions& wishes);

/// The distance goal that goes with the options' size, where none was given. Lengths and diagonal
/// in the same unit.
MeshOptions resolve_tolerance(MeshOptions options, double diagonal);

/// In the target's unit coordinates.
struct SizePlan {
  SizeField field;                    ///< bounds of cells
  std::optional<SizedDomain> domain;  ///< absent: one root cube around the object
  std::optional<Box3> box;            ///< that the domain fills, with the outside meshed
};

/// Errors: BadArgument when a rule names no patch or curve of the target, the box does not meet
/// the object, or a size is below what a given deepest level allows.
SizePlan plan_sizes(const MeshOptions& wishes, const Target& target, const Context& context);

/// The box of the target's surface, in the surface's coordinates, where it is not turned.
Box3 object_box(const Target& target);

/// The box of the domain around the object, in the surface's coordinates; absent: inside, or none
/// was asked for.
std::optional<Box3> find_domain_box(const MeshOptions& wishes, const Box3& object);

}  // namespace hexwright
