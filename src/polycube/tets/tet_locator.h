// Finds the tetrahedron that contains a point, by a tree of boxes.
#pragma once

#include <array>
#include <vector>

#include "hexwright/mesh/tet_mesh.h"

#include "base/box_tree.h"

namespace hexwright::polycube {

/// A point as a convex combination of a tet's vertices.
struct TetPoint {
  TetId tet;
  std::array<double, 4> weight = {};  ///< non-negative, sum 1
  bool is_bridged =
      false;  ///< the point lies in no positive tet; this is the nearest place that does
};

/// Positive tets only; others are skipped, and points in them bridged. Thread-safe after
/// construction.
class TetLocator {
 public:
  explicit TetLocator(const TetMesh& mesh);

  /// Among the tets around a shared facet, edge or vertex: the one the point is deepest in, then
  /// the lowest id.
  TetPoint locate(const Vec3& p) const;

  std::size_t num_nonpositive() const { return num_nonpositive_; }

 private:
  TetPoint nearest(const Vec3& p) const;

  const TetMesh& mesh_;
  std::vector<TetId> tets_;  // the positive ones
  BoxTree tree_;             // over tets_
  double slack_ = 0;         // boxes are enlarged by this, for points on facets
  std::size_t num_nonpositive_ = 0;
};

/// Barycentric coordinates of p in a tet; they sum to 1 and are negative outside. Requires a
/// positive volume.
std::array<double, 4> barycentric(const std::array<Vec3, 4>& tet, const Vec3& p);

/// Gradients of the barycentric coordinates: each is the area vector of the opposite facet over
/// three times the volume. Requires a positive volume.
std::array<Vec3, 4> barycentric_gradients(const std::array<Vec3, 4>& tet);

/// Signed volume times six.
double tet_det(const std::array<Vec3, 4>& tet);

inline std::array<Vec3, 4> tet_corners(const TetMesh& mesh, TetId t) {
  const auto& v = mesh.tets[t];
  return {mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]], mesh.positions[v[3]]};
}

inline bool is_nonpositive(const TetMesh& mesh, TetId t) {
  return !(tet_det(tet_corners(mesh, t)) > 0);
}
std::size_t count_nonpositive(const TetMesh& mesh);

/// The combination's place in a mesh of the same connectivity.
inline Vec3 interpolate(const TetMesh& mesh, const TetPoint& at) {
  Vec3 p;
  for (std::size_t k = 0; k < 4; ++k) p += mesh.positions[mesh.tets[at.tet][k]] * at.weight[k];
  return p;
}

}  // namespace hexwright::polycube
