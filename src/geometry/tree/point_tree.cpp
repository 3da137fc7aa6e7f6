#include "geometry/tree/point_tree.h"

namespace hexwright {
namespace {

BoxTree tree_of(const std::vector<Vec3>& points) {
  std::vector<Box3> boxes;
  boxes.reserve(points.size());
  for (const Vec3& p : points) boxes.push_back({p, p});
  return BoxTree(boxes);
}

}  // namespace

PointTree::PointTree(std::vector<Vec3> points)
    : points_(std::move(points)), tree_(tree_of(points_)) {}

void PointTree::visit_box(const Box3& box, FunctionRef<void(std::size_t)> visit) const {
  tree_.visit([&](const Box3& node) { return do_overlap(node, box); },
              [&](BoxTree::Item i) {
                if (box.contains(points_[i])) visit(i);
              });
}

}  // namespace hexwright
