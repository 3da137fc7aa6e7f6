// Points spread over a triangle surface: every vertex once, then rows of points inside each
// triangle, at most `spacing` apart, with weights that sum to the area.
#pragma once

#include <vector>

#include "hexwright/base/function_ref.h"
#include "hexwright/mesh/tri_mesh.h"

namespace hexwright {

class TriangleSamples {
 public:
  /// The surface must outlive the samples.
  TriangleSamples(const TriMesh& surface, double spacing);
  TriangleSamples(TriMesh&&, double) = delete;

  std::size_t size() const { return used_verts_.size() + offset_.back(); }

  /// The vertices of the surface that come first, in this order.
  const std::vector<VertId>& used_verts() const { return used_verts_; }

  /// Calls `visit(point, weight)` for samples begin .. end-1. The weights of all samples integrate
  /// functions that are linear between samples exactly.
  void visit(std::size_t begin, std::size_t end,
             FunctionRef<void(const Vec3& point, double weight)> visit) const;

 private:
  const TriMesh& surface_;
  double spacing_;
  std::vector<VertId> used_verts_;
  std::vector<double> vert_weight_;  // of used_verts_
  std::vector<std::size_t> offset_;  // per triangle: samples before its own; num_tris + 1
};

}  // namespace hexwright
