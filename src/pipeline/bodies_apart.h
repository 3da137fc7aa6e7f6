// Bodies that touch, or lie nearer to each other than cells can tell apart, are meshed one by one:
// each has vertices of its own, and the gap between them stays as it is.
#pragma once

#include <string>
#include <vector>

#include "hexwright/pipeline/mesh_surface.h"

namespace hexwright {

/// The surface in parts, in world coordinates: bodies within `gap` (unit coordinates) of each other
/// are in different parts, all others together. None when all can be meshed together, or when some
/// triangles belong to no body.
std::vector<TriMesh> split_near_bodies(const Target& target, double gap);

/// That they are meshed so.
std::string say_groups(std::size_t num_parts);

/// How near bodies must be to each other to be meshed apart, in the target's coordinates; negative
/// where they never are: with the background meshed as well, with wall layers or sizes asked for by
/// name, or surfaces left as they are.
double plan_gap(const MeshOptions& options, const Target& target);

/// What is wished of a part: lengths are those of the whole, whose shares become shares of the
/// part.
MeshOptions plan_part(const MeshOptions& options, const Target& whole, const TriMesh& part);

/// One mesh of the parts, a region each, with their records together; grid, sizing, completion,
/// dual, pose and best round are those of the first. Shares of the parts' diagonals become shares
/// of the whole's. Patches and curves are numbered over all parts ("wall.1", "wall.2") by the
/// groups of the whole surface.
MeshResult join_parts(std::vector<MeshResult>&& parts, const Target& whole);

}  // namespace hexwright
