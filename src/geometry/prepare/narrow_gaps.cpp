// A closing: growth by an offset of all faces, and the same back. Walls of a gap that overlap when
// grown are inside the union, whatever noise they have.
#include "geometry/prepare/narrow_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hexwright/base/parallel.h"
#include "hexwright/geometry/surface_tree.h"

#include "geometry/tree/triangle_math.h"

namespace hexwright {
namespace {

/// The sum over faces around a vertex of angle * (normal . way - 1)^2, to be minimised.
class FaceOffsets {
 public:
  void add(const Vec3& normal, double angle) {
    for (int k = 0; k < 3; ++k) columns_[static_cast<std::size_t>(k)] += angle * normal[k] * normal;
    right_ += angle * normal;
  }

  /// Moves each face by 1 along its normal, as far as they agree; no longer than 2.
  Vec3 solve() const {
    constexpr double kRegular = 0.02, kLongest = 2;
    std::array<Vec3, 3> c = columns_;
    for (int k = 0; k < 3; ++k) c[static_cast<std::size_t>(k)][k] += kRegular;
    const double det = dot(c[0], cross(c[1], c[2]));
    const Vec3 way = Vec3{dot(right_, cross(c[1], c[2])), dot(right_, cross(c[2], c[0])),
                          dot(right_, cross(c[0], c[1]))} /
                     det;
    return way * std::min(1.0, kLongest / std::max(norm(way), kLongest / 2));
  }

 private:
  std::array<Vec3, 3> columns_{};
  Vec3 right_;
};

/// With all faces moved along their normals by `offset`.
TriMesh with_offset(const TriMesh& mesh, double offset) {
  IdVector<VertId, FaceOffsets> faces(mesh.num_verts());
  for (TriId t : mesh.tris.ids()) {
    const auto p = mesh.corners(t);
    const Vec3 normal = unit_normal(p);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = p[(k + 1) % 3] - p[k], b = p[(k + 2) % 3] - p[k];
      faces[mesh.tris[t][k]].add(normal, std::atan2(norm(cross(a, b)), dot(a, b)));
    }
  }
  TriMesh moved = mesh;
  for (VertId v : faces.ids()) moved.positions[v] += offset * faces[v].solve();
  return moved;
}

/// Of a surface, and of its walls of slits.
struct Areas {
  double all = 0, slits = 0;
};

}  // namespace

double measure_slits(const TriMesh& surface, double width) {
  const SurfaceTree tree(surface);
  const auto measure = [&](std::size_t begin, std::size_t end) {
    Areas areas;
    for (std::size_t i = begin; i < end; ++i) {
      const TriId t(i);
      const auto p = surface.corners(t);
      const Vec3 normal = tree.normal(t);
      const double area = 0.5 * norm(cross(p[1] - p[0], p[2] - p[0]));
      const auto hit = tree.first_hit((p[0] + p[1] + p[2]) / 3, normal, [&](const RayHit& at) {
        return at.tri != t && at.length <= width && dot(tree.normal(at.tri), normal) < -0.5;
      });
      areas.all += area;
      areas.slits += hit ? area : 0;
    }
    return areas;
  };
  const Areas areas = parallel_reduce(
      surface.num_tris(), Areas{}, measure,
      [](const Areas& a, const Areas& b) {
        return Areas{a.all + b.all, a.slits + b.slits};
      },
      256);
  return areas.all > 0 ? areas.slits / areas.all : 0;
}

UnitedSurface unite_closing_gaps(std::span<const Solid> solids, double width) {
  std::vector<Solid> grown;
  for (const Solid& solid : solids) {
    Solid& own = grown.emplace_back(Solid{with_offset(solid.mesh, width / 2), {}});
    for (TriId t : solid.mesh.tris.ids())
      own.tri_to_face.push_back(t);  // faces are no longer plane to the last bit
  }
  constexpr double kNoise = 0.05;  // of the width: shorter edges are noise of the meeting walls
  UnitedSurface united = unite_solids(grown, kNoise * width);
  united.mesh = with_offset(united.mesh, -width / 2);
  return united;
}

}  // namespace hexwright
