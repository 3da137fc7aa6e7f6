#include "fit/curves/vert_reach.h"

namespace hexwright::fitting {

using namespace relax;

VertReach::VertReach(const BoundaryQuads& boundary, const std::vector<VertId>& verts, double reach)
    : boundary_(boundary), reach_(reach), verts_(verts) {
  std::vector<Box3> boxes;
  for (VertId v : verts_) boxes.push_back(box_of(v));
  tree_ = BoxTree(boxes);
}

Box3 VertReach::box_of(VertId v) const {
  const double r = reach_ * boundary_.edge_length[v];
  const Vec3& p = boundary_.positions[v];
  return {p - Vec3{r, r, r}, p + Vec3{r, r, r}};
}

void VertReach::find(const Box3& box, std::vector<VertId>& found) const {
  tree_.visit([&](const Box3& node) { return do_overlap(node, box); },
              [&](BoxTree::Item i) {
                if (do_overlap(box_of(verts_[i]), box)) found.push_back(verts_[i]);
              });
}

}  // namespace hexwright::fitting
