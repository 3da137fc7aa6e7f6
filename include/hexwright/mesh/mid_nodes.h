// The further nodes of a hex mesh of second order, and the 27 nodes of its elements.
//
// An element has its 8 corners, a node on each of its 12 edges and, where files give them, on its 6
// faces and in its middle. Where they do not (20 nodes), the serendipity element and the one of 27
// nodes with faces and middle by transfinite interpolation have the same shape.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hexwright/base/ids.h"
#include "hexwright/base/issue.h"
#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"

namespace hexwright {

struct HexMesh;

using EdgeId = Id<struct EdgeTag>;  ///< edge of the hex mesh at hand

/// Nodes of a hex: corners 0-7, edges 8-19, faces 20-25 in the order of hex_numbering.h, middle 26;
/// this is also VTK's order.
using QuadraticHex = std::array<Vec3, 27>;

/// Edges are shared between hexes, so that a mesh of second order is as conforming as its corners.
struct MidNodes {
  IdVector<HexId, std::array<EdgeId, 12>> hex_to_edge;  ///< in the order of kHexEdges
  IdVector<EdgeId, Vec3> edges;                         ///< position of each edge's node
  /// Of elements with 27 nodes: the faces and the middle; empty: they follow from the edges.
  IdVector<HexId, std::array<Vec3, 7>> inner;

  /// First index out of range, coordinate that is not finite, or array of a wrong length.
  std::optional<Issue> find_problem(std::size_t num_hexes) const;
};

/// Edges in the order in which hexes and kHexEdges name them, each with its node in the middle.
MidNodes make_straight_mid_nodes(const HexMesh& mesh);

/// The vertices of each edge, lower first. Requires mid-nodes.
IdVector<EdgeId, std::array<VertId, 2>> edge_verts(const HexMesh& mesh);

/// Nodes of a hex; of a mesh without mid-nodes, those of its trilinear shape.
QuadraticHex quadratic_hex(const HexMesh& mesh, HexId h);

/// Faces and middle by transfinite interpolation of the edges.
void fill_inner_nodes(QuadraticHex& nodes);

/// Nodes of a face: corners 0-3, sides 4-7 (k between corners k and k + 1), middle 8.
using QuadraticQuad = std::array<Vec3, 9>;
/// Of local face `lf`, counter-clockwise seen from outside.
QuadraticQuad quadratic_face(const QuadraticHex& nodes, int lf);
/// The point at (u, v) in [0, 1]^2, which run from corner 0 to 1 and to 3.
Vec3 point_on(const QuadraticQuad& quad, double u, double v);

/// Edges found by their vertices.
class EdgeTable {
 public:
  /// Requires mid-nodes.
  explicit EdgeTable(const HexMesh& mesh);
  /// Invalid when no hex has this edge; vertices in any order.
  EdgeId find(VertId a, VertId b) const;

 private:
  struct Entry {
    std::array<VertId, 2> verts;
    EdgeId edge;
  };
  std::vector<Entry> entries_;  // by vertices
};

/// A quad by its vertices, its middle by transfinite interpolation; sides that are no edges of a
/// hex are straight.
QuadraticQuad quadratic_quad(const HexMesh& mesh, const EdgeTable& edges,
                             const std::array<VertId, 4>& verts);

}  // namespace hexwright
