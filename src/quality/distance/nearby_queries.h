// The nearest triangles of a surface to points that follow each other closely.
#pragma once

#include <cmath>
#include <optional>

#include "hexwright/geometry/surface_tree.h"

namespace hexwright {

/// What the last query found bounds the next one: a point is no farther from the surface than the
/// last one is, and the step between them.
class NearbyQueries {
 public:
  /// The tree must outlive the queries; none are made of null.
  explicit NearbyQueries(const SurfaceTree* tree) : tree_(tree) {}

  /// The same as the tree's answer. Absent when there are no triangles.
  std::optional<ClosestPoint> find(const Vec3& p) {
    constexpr double kSlack = 1 + 1e-9;  // covers rounding
    ClosestFilter filter;
    filter.hint = nearest_;
    if (nearest_.is_valid()) filter.max_distance = (distance_ + distance(p, point_)) * kSlack;
    auto hit = tree_->closest(p, filter);
    if (!hit && nearest_.is_valid()) hit = tree_->closest(p);
    if (!hit) return {};
    nearest_ = hit->tri;
    point_ = p;
    distance_ = std::sqrt(hit->distance_sq);
    return hit;
  }

  TriId nearest() const { return nearest_; }  ///< to the last point
  double last_distance() const { return distance_; }

 private:
  const SurfaceTree* tree_;
  TriId nearest_;
  Vec3 point_;
  double distance_ = 0;
};

}  // namespace hexwright
