// Weights by Cramer's rule.
#include "io/field/tet_tree.h"

#include <utility>
#include <vector>

namespace hexwright::io {
namespace {

constexpr double kRounding = 1e-12;  // of a weight, and of a box

std::array<Vec3, 4> corners(const TetMesh& mesh, TetId t) {
  const auto& v = mesh.tets[t];
  return {mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]], mesh.positions[v[3]]};
}

/// Absent outside.
std::optional<TetLocation> locate_in(const TetMesh& mesh, TetId t, const Vec3& p) {
  const auto q = corners(mesh, t);
  const Vec3 a = q[1] - q[0], b = q[2] - q[0], c = q[3] - q[0], d = p - q[0];
  const double volume = det(a, b, c);
  if (volume == 0) return {};
  TetLocation at{t, {0, det(d, b, c) / volume, det(a, d, c) / volume, det(a, b, d) / volume}};
  at.weights[0] = 1 - at.weights[1] - at.weights[2] - at.weights[3];
  for (double w : at.weights)
    if (!(w >= -kRounding)) return {};
  return at;
}

std::vector<Box3> boxes_of(const TetMesh& mesh) {
  std::vector<Box3> boxes;
  for (TetId t : mesh.tets.ids()) {
    Box3 box;
    for (const Vec3& q : corners(mesh, t)) box.extend(q);
    const double room = kRounding * box.diagonal();
    const Vec3 r = {room, room, room};
    boxes.push_back({box.lo - r, box.hi + r});
  }
  return boxes;
}

}  // namespace

TetTree::TetTree(TetMesh mesh) : mesh_(std::move(mesh)), tree_(boxes_of(mesh_)) {}

std::optional<TetLocation> TetTree::locate(const Vec3& p) const {
  std::optional<TetLocation> found;
  tree_.visit([&](const Box3& box) { return box.contains(p); },
              [&](BoxTree::Item i) {
                const TetId t(i);
                if (!found || t < found->tet)
                  if (const auto at = locate_in(mesh_, t, p)) found = at;
              });
  return found;
}

}  // namespace hexwright::io
