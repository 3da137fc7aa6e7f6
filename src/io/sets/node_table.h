// The nodes of a mesh's elements as files have them: vertices first, then those of second order.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "hexwright/io/set_table.h"
#include "hexwright/mesh/hex_mesh.h"

#include "io/sets/face_table.h"

namespace hexwright::io {

/// The hex of 20 nodes in most solvers' order, as indices into VTK's: upright edges come before
/// those of the top.
inline constexpr std::array<std::size_t, 20> kUprightEdgesFirst = {
    0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15};

/// Nodes of one element.
class NodeList {
 public:
  void push_back(VertId v) { nodes_[size_++] = v; }
  const VertId* begin() const { return nodes_.data(); }
  const VertId* end() const { return nodes_.data() + size_; }
  std::size_t size() const { return size_; }
  VertId operator[](std::size_t k) const { return nodes_[k]; }

 private:
  std::array<VertId, 27> nodes_;
  std::size_t size_ = 0;
};

/// Numbers the nodes of elements of first (8 nodes per hex) or second order (20 or 27). An id
/// beyond the mesh's vertices is that of a mid-node: edges come first, then faces, then middles of
/// hexes.
class NodeTable {
 public:
  /// The mesh must outlive the table. Requires mid-nodes for more than 8.
  NodeTable(const HexMesh& mesh, int nodes_per_hex);
  NodeTable(HexMesh&&, int) = delete;

  const HexMesh& mesh() const { return mesh_; }
  int nodes_per_hex() const { return nodes_per_hex_; }
  bool is_linear() const { return nodes_per_hex_ == 8; }
  std::size_t size() const { return positions().size(); }
  const IdVector<VertId, Vec3>& positions() const { return is_linear() ? mesh_.positions : all_; }

  /// In VTK's order: corners, edges as in kHexEdges, faces as in kHexFaces, middle.
  NodeList hex(HexId h) const;
  /// Of a face of a hex: corners, sides, middle. Throws Error{BadArgument} for another quad or edge
  /// of second order.
  NodeList quad(const std::array<VertId, 4>& verts) const;
  /// Of an edge of a hex: ends, middle.
  NodeList edge(const std::array<VertId, 2>& verts) const;
  /// Of a member of a set of this kind.
  NodeList element(SetKind kind, std::size_t member) const;
  /// The nodes of a set's elements, increasing, each once.
  std::vector<VertId> set_nodes(const NamedSet& set) const;
  /// The node in the middle of a hex's face. Requires 27 nodes per hex.
  VertId face(HexFace face) const;
  /// Throws Error{BadArgument} when no hex has it.
  HexFace find_face(const std::array<VertId, 4>& verts) const;
  VertId middle(HexId h) const { return VertId(first_middle_ + h.index()); }

 private:
  void number_faces();
  std::vector<VertId> region_nodes(const NamedSet& set) const;
  VertId edge_node(EdgeId e) const { return VertId(mesh_.num_verts() + e.index()); }
  VertId node_between(VertId a, VertId b) const;

  const HexMesh& mesh_;
  int nodes_per_hex_;
  IdVector<VertId, Vec3> all_;  // vertices and mid-nodes, of second order
  std::optional<EdgeTable> edges_;
  std::optional<FaceTable> faces_;  // with 27 nodes, as what follows
  IdVector<HexId, std::array<VertId, 6>> face_nodes_;
  std::size_t first_middle_ = 0;
};

}  // namespace hexwright::io
