// A k-d tree over points, for "which points lie in this box".
#pragma once

#include <cstdint>
#include <vector>

#include "hexwright/base/function_ref.h"
#include "hexwright/base/vec3.h"

namespace hexwright {

class PointTree {
 public:
  explicit PointTree(std::vector<Vec3> points);

  /// Calls `visit` with the index of every point in the closed box, in an order that depends on the
  /// points alone.
  void visit_box(const Box3& box, FunctionRef<void(std::size_t)> visit) const;

  const std::vector<Vec3>& points() const { return points_; }

 private:
  void build(std::size_t begin, std::size_t end);

  std::vector<Vec3> points_;
  std::vector<std::uint32_t> order_;  // the middle of each range splits it along axis_
  std::vector<std::uint8_t> axis_;
};

}  // namespace hexwright
