// Parts that bound nothing because the solid lies on both of their sides: shells inside another
// solid with the same orientation, and walls across its interior.
#include <algorithm>
#include <cmath>

#include "hexwright/geometry/surface_tree.h"

#include "geometry/prepare/surface_clean.h"

namespace hexwright {
namespace {

/// Mean winding number of a triangle's two sides: 1/2 where outside meets inside, 1 on a wall
/// inside a solid, 3/2 on a solid within a solid.
constexpr double kInsideMean = 0.8;
constexpr double kAccuracy = 4;

std::vector<int> number_parts(const SurfaceEdges& edges, std::size_t num_tris) {
  UnionFind sets(num_tris);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto s = edges.sides_of(e);
    if (s.size() == 2) sets.unite(s[0].tri.value(), s[1].tri.value());
  }
  return number_sets(sets, num_tris);
}

/// Parts with an edge that nothing else touches: without them the surface could lose its inside.
std::vector<char> find_loose_parts(const SurfaceEdges& edges, const std::vector<int>& tri_to_part,
                                   std::size_t num_parts) {
  std::vector<char> is_loose(num_parts, 0);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto s = edges.sides_of(e);
    if (s.size() == 1) is_loose[static_cast<std::size_t>(tri_to_part[s[0].tri.index()])] = 1;
  }
  return is_loose;
}

bool lies_inside(const SurfaceTree& tree, TriId t) {
  const auto c = tree.surface().corners(t);
  const double size = std::sqrt(norm(cross(c[1] - c[0], c[2] - c[0])));
  const Vec3 center = (c[0] + c[1] + c[2]) / 3, step = tree.normal(t) * (1e-3 * size);
  const double sum =
      tree.winding_number(center + step, kAccuracy) + tree.winding_number(center - step, kAccuracy);
  return sum > 2 * kInsideMean;
}

}  // namespace

std::size_t drop_hidden_parts(WorkingSurface& surface) {
  const SurfaceEdges edges = compute_surface_edges(surface.mesh);
  const std::vector<int> tri_to_part = number_parts(edges, surface.mesh.num_tris());
  std::size_t num_parts = 0;
  for (int p : tri_to_part) num_parts = std::max(num_parts, static_cast<std::size_t>(p) + 1);
  if (num_parts < 2) return 0;
  std::vector<char> is_visible = find_loose_parts(edges, tri_to_part, num_parts);
  const SurfaceTree tree(surface.mesh);
  for (TriId t : surface.mesh.tris.ids()) {
    char& visible = is_visible[static_cast<std::size_t>(tri_to_part[t.index()])];
    if (!visible && !lies_inside(tree, t)) visible = 1;
  }
  const auto num_hidden =
      static_cast<std::size_t>(std::count(is_visible.begin(), is_visible.end(), 0));
  if (num_hidden == 0 || num_hidden == num_parts) return 0;
  std::vector<char> is_kept;
  for (int p : tri_to_part) is_kept.push_back(is_visible[static_cast<std::size_t>(p)]);
  surface.keep(is_kept);
  return num_hidden;
}

}  // namespace hexwright
