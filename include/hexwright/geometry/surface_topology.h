// Counts that tell a surface's topology.
#pragma once

#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

struct SurfaceTopology {
  std::size_t num_components = 0;  ///< components connected across edges
  std::size_t num_boundary_edges = 0;
  std::size_t num_nonmanifold_edges = 0;
  std::size_t num_nonmanifold_verts = 0;  ///< vertices with more than one fan of triangles
  long euler_characteristic = 0;          ///< V - E + F over used vertices
  /// Sum of the components' genera; meaningful when closed and manifold.
  long genus() const { return static_cast<long>(num_components) - euler_characteristic / 2; }
  bool is_closed_manifold() const {
    return num_boundary_edges == 0 && num_nonmanifold_edges == 0 && num_nonmanifold_verts == 0;
  }
};

SurfaceTopology compute_topology(const TriMesh& surface);

/// Every directed edge has as many opposites: the triangles bound something, and their generalised
/// winding number changes across the surface only.
bool is_oriented_cycle(const TriMesh& surface);

/// Component of each triangle (connected across edges), numbered by first triangle.
IdVector<TriId, int> compute_components(const TriMesh& surface);

}  // namespace hexwright
