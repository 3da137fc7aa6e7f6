// Finds the boundary vertices near a box, where "near" is measured in each vertex's own edge
// length.
#pragma once

#include <vector>

#include "base/box_tree.h"
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
  Box3 box_of(VertId v) const;

  const BoundaryQuads& boundary_;
  double reach_;
  std::vector<VertId> verts_;
  BoxTree tree_;  // over verts_
};

}  // namespace hexwright::fitting
