// Whether a set of hexahedra is a mesh, and of what topology.
#pragma once

#include <string>
#include <vector>

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

struct TopologyReport {
  std::size_t num_hexes = 0, num_verts = 0, num_boundary_quads = 0;
  std::size_t num_repeated_verts = 0;       ///< hexes with fewer than 8 distinct vertices
  std::size_t num_nonconforming_faces = 0;  ///< faces shared by three or more hexes
  std::size_t num_misoriented_faces = 0;  ///< shared faces whose two hexes do not run opposite ways
  std::size_t num_doublets = 0;           ///< pairs of hexes sharing two or more faces
  std::size_t num_nonmanifold_edges = 0;  ///< boundary edges with other than two boundary quads
  std::size_t num_nonmanifold_verts = 0;  ///< boundary vertices with more than one fan of quads
  std::size_t num_singular_verts = 0;  ///< vertices whose link is not a sphere (inside) or a disc
                                       ///< (boundary); not counted when faces or hexes are broken
  /// Vertices lying inside another hex's edge or face: in non-conforming grids, and where the
  /// boundary touches itself. Sorted.
  std::vector<VertId> hanging_verts;
  /// Vertices that lie so in a hex of another body: no vertex in common, and another region.
  std::size_t num_contact_verts = 0;
  std::size_t num_components = 0;  ///< of hexes, connected across faces
  std::size_t num_boundary_components = 0;
  long boundary_euler_characteristic = 0;
  std::vector<std::string> problems;  ///< one sentence per kind, naming its first element
  bool is_valid() const { return problems.empty(); }
  /// Sum of the genera of the boundary's components.
  long genus() const {
    return static_cast<long>(num_boundary_components) - boundary_euler_characteristic / 2;
  }
};

TopologyReport check_topology(const HexMesh& mesh);

}  // namespace hexwright
