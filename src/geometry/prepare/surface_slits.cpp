// Slits without width: walls that lie on each other go, and what they leave open is joined.
#include <algorithm>
#include <array>
#include <cmath>

#include "hexwright/base/cancel.h"
#include "hexwright/geometry/surface_topology.h"

#include "geometry/prepare/surface_clean.h"
#include "geometry/tree/point_tree.h"
#include "geometry/tree/triangle_contacts.h"
#include "geometry/tree/triangle_math.h"

namespace hexwright {
namespace {

/// Nearer than this, in the unit frame, walls lie on each other: single precision leaves 1e-7.
constexpr double kContact = 1e-6;
/// Sine of the angle between normals that count as opposite.
constexpr double kParallel = 1e-4;
/// Both walls of a slit are as large, to within this share.
constexpr double kSameArea = 1e-4;

using Polygon = std::vector<Vec3>;

/// What of a polygon lies to the left of a directed line in the plane with this normal.
Polygon cut(const Polygon& polygon, const Vec3& from, const Vec3& to, const Vec3& normal) {
  const Vec3 left = cross(normal, to - from);
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = dot(a - from, left), db = dot(b - from, left);
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

double area_of(const Polygon& polygon) {
  Vec3 sum;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * norm(sum);
}

/// The area in which the two face each other in one plane; a strip along their edges is none.
double area_on_each_other(const Corners& a, const Corners& b) {
  const Vec3 na = unit_normal(a), nb = unit_normal(b);
  if (dot(na, nb) > -0.5 || norm(cross(na, nb)) > kParallel) return 0;
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(dot(na, b[k] - a[0])) > kContact) return 0;
    longest = std::max({longest, distance(a[k], a[(k + 1) % 3]), distance(b[k], b[(k + 1) % 3])});
  }
  Polygon common(b.begin(), b.end());
  for (std::size_t k = 0; k < 3; ++k) common = cut(common, a[k], a[(k + 1) % 3], na);
  const double area = area_of(common);
  return area > 4 * kContact * longest ? area : 0;
}

/// Triangles that others of the same component lie on wholly: a gap between bodies is no slit, and
/// what is covered in part neither.
std::vector<char> find_walls(const TriMesh& mesh) {
  const IdVector<TriId, int> component = compute_components(mesh);
  const std::vector<TriPair> pairs = find_near_pairs(mesh, kContact, [&](TriId a, TriId b) {
    return component[a] == component[b] && area_on_each_other(mesh.corners(a), mesh.corners(b)) > 0;
  });
  IdVector<TriId, double> covered(mesh.num_tris(), 0);
  for (const auto& [a, b] : pairs) {
    const double area = area_on_each_other(mesh.corners(a), mesh.corners(b));
    covered[a] += area;
    covered[b] += area;
  }
  std::vector<char> is_wall;
  for (TriId t : mesh.tris.ids()) {
    const auto c = mesh.corners(t);
    is_wall.push_back(covered[t] > (1 - kSameArea) * area_of({c[0], c[1], c[2]}));
  }
  return is_wall;
}

/// Vertices of open edges.
struct OpenVerts {
  std::vector<VertId> verts;
  PointTree tree;  ///< of their positions
};

/// Those that lie on a side, other than its ends, from its beginning to its end.
std::vector<VertId> find_verts_on(const TriMesh& mesh, const OpenVerts& open, const Vec3& a,
                                  const Vec3& b) {
  const Vec3 along = b - a;
  const double length = norm(along);
  std::vector<std::pair<double, VertId>> found;
  const Vec3 room = {kContact, kContact, kContact};
  open.tree.visit_box({min(a, b) - room, max(a, b) + room}, [&](std::size_t i) {
    const VertId v = open.verts[i];
    const Vec3 p = mesh.positions[v] - a;
    const double at = dot(p, along) / length;
    if (at > 2 * kContact && at < length - 2 * kContact &&
        norm(p - along * (at / length)) <= kContact)
      found.emplace_back(at, v);
  });
  std::sort(found.begin(), found.end());
  std::vector<VertId> verts;
  for (const auto& [at, v] : found)
    if (verts.empty() || distance(mesh.positions[verts.back()], mesh.positions[v]) > 2 * kContact)
      verts.push_back(v);
  return verts;
}

OpenVerts find_open_verts(const TriMesh& mesh, const SurfaceEdges& edges) {
  std::vector<VertId> open;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges.sides_of(e).size() == 1) open.insert(open.end(), {edges.lo(e), edges.hi(e)});
  std::sort(open.begin(), open.end());
  open.erase(std::unique(open.begin(), open.end()), open.end());
  std::vector<Vec3> positions;
  for (const VertId v : open) positions.push_back(mesh.positions[v]);
  return {std::move(open), PointTree(std::move(positions))};
}

/// Gives open sides the vertices of other open edges that lie on them: one side at a time of each
/// triangle. Returns whether there were any.
bool split_open_sides(WorkingSurface& surface) {
  TriMesh& mesh = surface.mesh;
  const SurfaceEdges edges = compute_surface_edges(mesh);
  const OpenVerts open = find_open_verts(mesh, edges);
  CancelCheck check;
  std::vector<char> is_done(mesh.num_tris(), 0);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    check();
    if (edges.sides_of(e).size() != 1) continue;
    const auto side = edges.sides_of(e)[0];
    if (is_done[side.tri.index()]) continue;
    const auto k = static_cast<std::size_t>(side.k);
    const auto tri = mesh.tris[side.tri];
    const VertId a = tri[k], b = tri[(k + 1) % 3], c = tri[(k + 2) % 3];
    const std::vector<VertId> on = find_verts_on(mesh, open, mesh.positions[a], mesh.positions[b]);
    if (on.empty()) continue;
    is_done[side.tri.index()] = 1;
    VertId last = a;
    for (const VertId v : on) {
      mesh.tris.push_back({last, v, c});
      surface.source.push_back(TriId(surface.source[side.tri]));
      last = v;
    }
    mesh.tris[side.tri] = {last, b, c};
  }
  return std::ranges::find(is_done, 1) != is_done.end();
}

/// Edges that keep it from enclosing a volume.
std::size_t count_odd(const TriMesh& mesh) { return count_odd_edges(compute_surface_edges(mesh)); }

}  // namespace

bool close_slits(WorkingSurface& surface, Parts parts) {
  if (parts != Parts::Unite) return false;
  const std::vector<char> is_wall = find_walls(surface.mesh);
  if (std::ranges::find(is_wall, 1) == is_wall.end()) return false;
  std::vector<char> is_kept;
  for (const char wall : is_wall) is_kept.push_back(!wall);
  WorkingSurface closed = surface;
  closed.keep(is_kept);
  if (closed.mesh.num_tris() == 0) return false;
  constexpr int kSidesOfATriangle = 3;
  for (int k = 0; k < kSidesOfATriangle && split_open_sides(closed); ++k) {
  }
  weld_open_edges(closed.mesh);
  if (count_odd(closed.mesh) > count_odd(surface.mesh)) return false;
  surface = std::move(closed);
  return true;
}

}  // namespace hexwright
