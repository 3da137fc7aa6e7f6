// Grids given by their split nodes, and a strict verifier of hex meshes, for the tests of `dual`.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "hexwright/grid/grid.h"
#include "hexwright/mesh/hex_mesh.h"

namespace hexwright::test {

/// A node of an octree: coordinates on the lattice of its depth.
struct NodeSpec {
  int depth = 0;
  LatticeCoord node = {0, 0, 0};
};
/// A 2x2x2 block of nodes around a vertex of the lattice of its depth.
struct BlockSpec {
  int depth = 0;
  LatticeCoord center = {0, 0, 0};
};

std::vector<LatticeCoord> box_roots(int nx, int ny, int nz);

/// Nested sets of split nodes over a union of roots; keeps ancestors split.
class SplitTree {
 public:
  explicit SplitTree(std::vector<LatticeCoord> roots);
  bool contains(int depth, const LatticeCoord& node) const;  ///< inside the domain
  bool is_split(int depth, const LatticeCoord& node) const;
  bool exists(int depth, const LatticeCoord& node) const;  ///< its parent is split
  void split(int depth, const LatticeCoord& node);         ///< and its ancestors
  void split_block(const BlockSpec& block);                ///< its nodes inside the domain
  /// Splits until neighbours across faces (weak) or vertices (strong) differ by one level at most.
  void balance(bool is_strong);
  int num_depths() const { return static_cast<int>(split_.size()); }
  const std::set<LatticeCoord>& split_at(int depth) const {
    return split_[static_cast<std::size_t>(depth)];
  }
  const std::vector<LatticeCoord>& roots() const { return roots_; }
  Grid grid() const;
  bool is_box() const;  ///< the roots fill a box

 private:
  std::vector<LatticeCoord> roots_;
  std::set<LatticeCoord> root_set_;
  std::vector<std::set<LatticeCoord>> split_;
};

/// A box of n^3 roots with these nodes split.
Grid grid_of_splits(const std::vector<LatticeCoord>& roots, const std::vector<NodeSpec>& nodes);
Grid grid_of_blocks(int n, const std::vector<BlockSpec>& blocks);

/// Empty when the mesh is a valid mesh of the grid's domain: 8 distinct vertices per hex, faces in
/// at most two hexes and running opposite ways, no two hexes sharing two faces, no two quads
/// sharing two edges, every vertex link a sphere or a disc, and (with `check_shape`) boundary quads
/// on the domain's boundary and the domain's volume. Else the first problem found.
std::string find_mesh_problem(const HexMesh& mesh, const Grid& grid, bool check_shape = true);

}  // namespace hexwright::test
