// A bounding volume hierarchy split at the median of the longest axis.
#include "fit/curves/vert_reach.h"

#include <algorithm>

namespace hexwright::fitting {

using namespace relax;
namespace {

constexpr std::size_t kLeafSize = 8;

bool overlap(const Box3& a, const Box3& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.lo[axis] > b.hi[axis] || b.lo[axis] > a.hi[axis]) return false;
  return true;
}

int longest_axis(const Vec3& extent) {
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

}  // namespace

VertReach::VertReach(const BoundaryQuads& boundary, const std::vector<VertId>& verts, double reach)
    : boundary_(boundary), reach_(reach), verts_(verts) {
  if (!verts_.empty()) build(0, verts_.size());
}

Box3 VertReach::box_of(VertId v) const {
  const double r = reach_ * boundary_.edge_length[v];
  const Vec3& p = boundary_.positions[v];
  return {p - Vec3{r, r, r}, p + Vec3{r, r, r}};
}

void VertReach::build(std::size_t begin, std::size_t end) {
  const std::size_t node = nodes_.size();
  nodes_.push_back({{}, begin, end, 0});
  Box3 centers;
  for (std::size_t i = begin; i < end; ++i) {
    nodes_[node].box.extend(box_of(verts_[i]));
    centers.extend(boundary_.positions[verts_[i]]);
  }
  if (end - begin <= kLeafSize) return;
  const int axis = longest_axis(centers.extent());
  const std::size_t middle = (begin + end) / 2;
  const auto at = [&](std::size_t i) { return verts_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](VertId v, VertId w) {
    const double x = boundary_.positions[v][axis], y = boundary_.positions[w][axis];
    return x != y ? x < y : v < w;
  });
  build(begin, middle);
  nodes_[node].right = nodes_.size();
  build(middle, end);
}

void VertReach::find(const Box3& box, std::vector<VertId>& found) const {
  if (nodes_.empty()) return;
  std::vector<std::size_t> stack{0};
  while (!stack.empty()) {
    const std::size_t i = stack.back();
    const Node& node = nodes_[i];
    stack.pop_back();
    if (!overlap(node.box, box)) continue;
    if (node.right != 0) {
      stack.push_back(node.right);
      stack.push_back(i + 1);
      continue;
    }
    for (std::size_t k = node.begin; k < node.end; ++k)
      if (overlap(box_of(verts_[k]), box)) found.push_back(verts_[k]);
  }
}

}  // namespace hexwright::fitting
