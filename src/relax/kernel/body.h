// A hex mesh whose vertices are moved one at a time, with all that takes: who is around each
// vertex, who can be solved at the same time, how each may move and what it is pulled to.
#pragma once

#include <utility>

#include "hexwright/mesh/hex_adjacency.h"

#include "relax/kernel/vertex_newton.h"

namespace hexwright::relax {

/// What part of the surface a vertex belongs to. Interior vertices belong to none.
enum class VertKind : std::uint8_t { Interior, Surface, Curve, Corner };

/// By VertKind: the set a vertex is pulled to, and the set it moves in when it may only slide.
struct Hold {
  AttachTo attach;
  MoveIn slide;
};
constexpr Hold kHolds[] = {{AttachTo::Nothing, MoveIn::Space},
                           {AttachTo::Plane, MoveIn::Plane},
                           {AttachTo::Line, MoveIn::Line},
                           {AttachTo::Point, MoveIn::Point}};
constexpr Hold hold_of(VertKind kind) { return kHolds[static_cast<std::size_t>(kind)]; }

struct Body {
  /// Everything is derived, sizes are mean lengths of edges, vertices move freely and are pulled to
  /// nothing. `around`: as VertToHex(hex_mesh).
  Body(HexMesh hex_mesh, VertToHex around);

  HexMesh mesh;

  IdVector<VertId, MoveIn> move;    ///< vertices on a fixed outer boundary move in it only
  IdVector<VertId, Vec3> axis;      ///< of that plane or line
  IdVector<VertId, double> size;    ///< h: mean length of the edges that count at the vertex
  IdVector<VertId, char> is_dirty;  ///< worth solving: it, a neighbour or its target moved

  // What each vertex is pulled to; empty: to nothing.
  IdVector<VertId, VertKind> kind;
  IdVector<VertId, Vec3> target;
  IdVector<VertId, Vec3> direction;  ///< Surface: normal; Curve: tangent (maybe shorter than 1)

  // Derived from the mesh.
  VertToHex vert_to_hex;
  VertexStars stars;
  VertexColors colors;

  std::size_t num_verts() const { return mesh.num_verts(); }
  void mark_all_dirty() { is_dirty.assign(num_verts(), 1); }

 protected:
  explicit Body(HexMesh hex_mesh) : mesh(std::move(hex_mesh)) {}
  void derive(VertToHex around);
};

/// Mean length of all edges at each vertex; 1 for a vertex without hexes.
IdVector<VertId, double> mean_edge_lengths(const Body& body);

/// Adds `rings` rings of hex-neighbours to a set of vertices, one entry per vertex.
void grow_vert_set(const Body& body, std::vector<char>& is_member, int rings);

/// The vertices of hexes for which `is_member(h)`, one entry per vertex.
template <class IsMember>
std::vector<char> verts_of_hexes(const Body& body, IsMember&& is_member) {
  std::vector<char> region(body.num_verts(), 0);
  for (HexId h : body.mesh.hexes.ids())
    if (is_member(h))
      for (VertId v : body.mesh.hexes[h]) region[v.index()] = 1;
  return region;
}

/// The vertices of hexes whose scaled Jacobian is below a limit, one entry per vertex; empty when
/// there is no such hex.
std::vector<char> verts_of_poor_hexes(const Body& body, double below);

}  // namespace hexwright::relax
