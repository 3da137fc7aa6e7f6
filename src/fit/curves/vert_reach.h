// Finds the boundary vertices near a box, where "near" is measured in each vertex's own edge
// length.
#pragma once

#include <vector>

#include "relax/kernel/boundary_quads.h"

namespace hexwright::fitting {

using relax::BoundaryQuads;

/// A tree over boxes of half width `reach` x edge length around vertices.
class VertReach {
 public:
  VertReach(const BoundaryQuads& boundary, const std::vector<VertId>& verts, double reach);

  /// Appends the vertices whose box meets `box`, in an order that depends on the input only.
  void find(const Box3& box, std::vector<VertId>& found) const;

 private:
  struct Node {
    Box3 box;
    std::size_t begin = 0, end = 0;  // leaf: range of verts_
    std::size_t right = 0;           // inner node: right child (left is the next node); 0 = leaf
  };
  void build(std::size_t begin, std::size_t end);
  Box3 box_of(VertId v) const;

  const BoundaryQuads& boundary_;
  double reach_;
  std::vector<VertId> verts_;
  std::vector<Node> nodes_;
};

}  // namespace hexwright::fitting
