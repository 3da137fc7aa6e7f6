// Points and a tree over them, for "which points lie in this box".
#pragma once

#include <utility>
#include <vector>

#include "hexwright/base/function_ref.h"

#include "base/box_tree.h"

namespace hexwright {

class PointTree {
 public:
  explicit PointTree(std::vector<Vec3> points);

  /// Calls `visit` with the index of every point in the closed box, in an order that depends on the
  /// points alone.
  void visit_box(const Box3& box, FunctionRef<void(std::size_t)> visit) const;

  const std::vector<Vec3>& points() const { return points_; }

 private:
  std::vector<Vec3> points_;
  BoxTree tree_;
};

}  // namespace hexwright
