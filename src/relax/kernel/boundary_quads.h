// The boundary of a hex mesh seen as a quad mesh: all that feature mapping and padding need of it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"

namespace hexwright::relax {

using BoundaryEdgeId = Id<struct BoundaryEdgeTag>;  ///< edge of the boundary quads

/// A view of boundary quads. Vertices are those of the hex mesh; interior ones are in no quad.
struct BoundaryQuads {
  IdSpan<VertId, const Vec3> positions;
  IdSpan<QuadId, const std::array<VertId, 4>> quads;  ///< counter-clockwise seen from outside
  IdSpan<VertId, const double> edge_length;  ///< mean length of the boundary edges at a vertex
};

/// Mean length of the boundary edges at each vertex; 0 for a vertex in no quad.
IdVector<VertId, double> compute_edge_lengths(IdSpan<VertId, const Vec3> positions,
                                              IdSpan<QuadId, const std::array<VertId, 4>> quads);

/// Edges and vertex stars of boundary quads, as flat arrays. Linear time.
class BoundaryGraph {
 public:
  struct Edge {
    VertId a, b;      ///< a < b
    QuadId quads[2];  ///< the first two quads at the edge
    std::int32_t num_quads = 0;
    VertId other(VertId v) const { return v == a ? b : a; }
    QuadId other(QuadId q) const { return q == quads[0] ? quads[1] : quads[0]; }
  };

  BoundaryGraph() : BoundaryGraph(0, {}) {}
  BoundaryGraph(std::size_t num_verts, IdSpan<QuadId, const std::array<VertId, 4>> quads);

  /// Vertices in at least one quad, ascending.
  const std::vector<VertId>& verts() const { return verts_; }
  std::size_t num_verts() const { return quad_offset_.size() - 1; }
  std::size_t num_quads() const { return quad_edges_.size(); }
  std::size_t num_edges() const { return edges_.size(); }
  const Edge& edge(BoundaryEdgeId e) const { return edges_[e]; }
  /// The edge between two vertices, invalid when there is none.
  BoundaryEdgeId find_edge(VertId a, VertId b) const;
  /// Neighbours along edges, ascending, and the edges that lead to them, in the same order.
  std::span<const VertId> neighbors(VertId v) const;
  std::span<const BoundaryEdgeId> edges(VertId v) const;
  /// Quads at a vertex, ascending.
  std::span<const QuadId> quads(VertId v) const;
  /// Edge k joins local vertices k and k + 1 of the quad.
  const std::array<BoundaryEdgeId, 4>& quad_edges(QuadId q) const { return quad_edges_[q]; }
  std::size_t valence(VertId v) const { return neighbors(v).size(); }

 private:
  void index_stars(IdSpan<QuadId, const std::array<VertId, 4>> quads);

  IdVector<BoundaryEdgeId, Edge> edges_;
  IdVector<QuadId, std::array<BoundaryEdgeId, 4>> quad_edges_;
  std::vector<VertId> verts_;
  std::vector<std::size_t> edge_offset_, quad_offset_;  // num_verts + 1
  std::vector<VertId> neighbors_;
  std::vector<BoundaryEdgeId> star_edges_;
  std::vector<QuadId> star_quads_;
};

}  // namespace hexwright::relax
