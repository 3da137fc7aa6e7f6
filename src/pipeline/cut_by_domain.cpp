// Triangles are split along the domain's planes; those beyond share no vertex with others, so that
// no patch goes on through them.
#include "pipeline/cut_by_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace hexwright {
namespace {

constexpr double kOnPlane = 1e-7;  // of the object's diagonal: nearer vertices are on the plane
/// How far what stands on a side goes on beyond it, of the diagonal: about as far as cells look.
constexpr double kSkirt = 0.05;

using Crease = std::array<VertId, 2>;

/// One side of the domain.
struct Plane {
  int axis = 0;
  double at = 0;
  double sign = 1;  ///< positive: beyond it coordinates are larger
};

/// Cuts a mesh and its creases by one plane after another.
class Cutter {
 public:
  Cutter(TriMesh mesh, std::vector<Crease> creases, double diagonal)
      : mesh_(std::move(mesh)),
        creases_(std::move(creases)),
        diagonal_(diagonal),
        is_beyond_(mesh_.num_tris(), 0) {}

  void cut(const Plane& plane) {
    plane_ = plane;
    middles_.clear();
    snap();
    const std::size_t num_tris = mesh_.num_tris();
    for (std::size_t t = 0; t < num_tris; ++t) split(TriId(t));
    extend_flush();
    for (TriId t : mesh_.tris.ids())
      if (is_off(t)) is_beyond_[t] = 1;
    cut_creases();
  }

  /// Whether anything is beyond a plane.
  bool has_cut() const { return std::ranges::find(is_beyond_, 1) != is_beyond_.end(); }

  /// What is beyond comes last and has no name, so that numbers and names are those of the rest.
  TriMesh take_mesh() {
    TriMesh mesh;
    mesh.positions = mesh_.positions;
    mesh.group_names = mesh_.group_names;
    for (char beyond : {0, 1})
      for (TriId t : mesh_.tris.ids()) {
        if (is_beyond_[t] != beyond) continue;
        std::array<VertId, 3> tri = mesh_.tris[t];
        if (beyond)
          for (VertId& v : tri) v = mesh.positions.push_back(Vec3(mesh.positions[v]));
        mesh.tris.push_back(tri);
        if (!mesh_.group.empty()) mesh.group.push_back(beyond ? -1 : mesh_.group[t]);
      }
    return mesh;
  }
  const std::vector<Crease>& creases() const { return creases_; }

 private:
  double height(VertId v) const {
    return plane_.sign * (mesh_.positions[v][plane_.axis] - plane_.at);
  }
  bool is_on(VertId v) const { return height(v) == 0; }

  void snap() {
    for (Vec3& p : mesh_.positions)
      if (std::abs(p[plane_.axis] - plane_.at) <= kOnPlane * diagonal_) p[plane_.axis] = plane_.at;
  }

  /// Not in front of the plane, and not all of it on the plane.
  bool is_off(TriId t) const {
    const auto& v = mesh_.tris[t];
    return std::ranges::all_of(v, [&](VertId w) { return height(w) >= 0; }) &&
           !std::ranges::all_of(v, [&](VertId w) { return is_on(w); });
  }

  VertId middle(VertId a, VertId b) {
    const auto key = std::minmax(a, b);
    const auto [found, is_new] = middles_.try_emplace({key.first, key.second}, VertId());
    if (is_new) {
      const double low = height(key.first), high = height(key.second);
      Vec3 p = mesh_.positions[key.first] +
               (mesh_.positions[key.second] - mesh_.positions[key.first]) * (low / (low - high));
      p[plane_.axis] = plane_.at;
      found->second = mesh_.positions.push_back(p);
    }
    return found->second;
  }

  void add(const std::array<VertId, 3>& tri, TriId of) {
    mesh_.tris.push_back(tri);
    if (!mesh_.group.empty()) mesh_.group.push_back(std::int32_t(mesh_.group[of]));
    is_beyond_.push_back(char(is_beyond_[of]));
  }

  /// A triangle that the plane passes becomes two or three.
  void split(TriId t) {
    const std::array<VertId, 3> v = mesh_.tris[t];
    for (std::size_t k = 0; k < 3; ++k) {
      // `a` alone on its side, or opposite to a vertex on the plane.
      const VertId a = v[k], b = v[(k + 1) % 3], c = v[(k + 2) % 3];
      const double x = height(a), y = height(b), z = height(c);
      if (x * y < 0 && x * z < 0) {
        const VertId ab = middle(a, b), ac = middle(a, c);
        mesh_.tris[t] = {a, ab, ac};
        add({ab, b, c}, t);
        add({ab, c, ac}, t);
        return;
      }
      if (x == 0 && y * z < 0) {
        const VertId bc = middle(b, c);
        mesh_.tris[t] = {a, b, bc};
        add({a, bc, c}, t);
        return;
      }
    }
  }

  /// Triangles on the plane whose object is before it are moved beyond it, with a skirt between.
  void extend_flush() {
    Vec3 step;
    step[plane_.axis] = plane_.sign * kSkirt * diagonal_;
    std::vector<TriId> flush;
    std::map<std::pair<VertId, VertId>, int> rim;  // once each way: inside the flush part
    for (TriId t : mesh_.tris.ids()) {
      const auto& v = mesh_.tris[t];
      if (is_beyond_[t] || !std::ranges::all_of(v, [&](VertId w) { return is_on(w); })) continue;
      const auto p = mesh_.corners(t);
      if (plane_.sign * cross(p[1] - p[0], p[2] - p[0])[plane_.axis] <= 0) continue;
      flush.push_back(t);
      for (std::size_t k = 0; k < 3; ++k) ++rim[{v[k], v[(k + 1) % 3]}];
    }
    std::map<VertId, VertId> moved;
    const auto beyond = [&](VertId v) {
      const auto [found, is_new] = moved.try_emplace(v, VertId());
      if (is_new) found->second = mesh_.positions.push_back(mesh_.positions[v] + step);
      return found->second;
    };
    for (TriId t : flush) {
      const std::array<VertId, 3> v = mesh_.tris[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const VertId a = v[k], b = v[(k + 1) % 3];
        if (rim.contains({b, a})) continue;
        add({a, b, beyond(b)}, t);
        add({a, beyond(b), beyond(a)}, t);
      }
      mesh_.tris[t] = {beyond(v[0]), beyond(v[1]), beyond(v[2])};
    }
  }

  /// What is before the plane stays.
  void cut_creases() {
    std::vector<Crease> kept;
    for (const auto& [a, b] : creases_) {
      const double x = height(a), y = height(b);
      if (x >= 0 && y >= 0) continue;
      if (x * y < 0)
        kept.push_back({x < 0 ? a : b, middle(a, b)});
      else
        kept.push_back({a, b});
    }
    creases_ = std::move(kept);
  }

  TriMesh mesh_;
  std::vector<Crease> creases_;
  double diagonal_;
  IdVector<TriId, char> is_beyond_;
  Plane plane_;
  std::map<std::pair<VertId, VertId>, VertId> middles_;  // of edges that the plane passes
};

}  // namespace

void cut_by_domain(const Box3& domain, Target& target) {
  const Box3& object = target.tree.box();
  const double room = kOnPlane * target.diagonal();
  Cutter cutter(target.surface(), target.creases, target.diagonal());
  for (int a = 0; a < 3; ++a) {
    if (object.lo[a] <= domain.lo[a] + room) cutter.cut({a, domain.lo[a], -1});
    if (object.hi[a] >= domain.hi[a] - room) cutter.cut({a, domain.hi[a], 1});
  }
  if (!cutter.has_cut()) return;
  target.creases = cutter.creases();
  target.tree = SurfaceTree(cutter.take_mesh(), target.diagonal());
  target.features = extract_features(target.tree, target.feature_options, target.creases);
}

}  // namespace hexwright
