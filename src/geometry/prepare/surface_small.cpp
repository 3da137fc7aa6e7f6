// Crumbs, slivers that booleans leave, and voids between parts that do not quite touch.
#include <algorithm>

#include "hexwright/geometry/surface_topology.h"

#include "geometry/prepare/surface_clean.h"

namespace hexwright {
namespace {

/// Mean thickness, in the unit frame, below which a closed component is rounding.
constexpr double kNoThickness = 1e-7;
/// And voids below this share of the least part: crevices between parts that do not quite meet.
constexpr double kThinVoid = 0.1;

struct Component {
  Box3 box;
  Vec3 origin;  // of the volume's summands: near, lest they cancel
  double area2 = 0, volume6 = 0;
  bool is_closed = true;

  double size() const { return std::max({box.extent().x, box.extent().y, box.extent().z}); }
  bool is_void() const { return is_closed && volume6 < 0; }
  /// Volume over half the area: the thickness, were it a sheet.
  bool is_thinner(double than) const {
    return is_closed && std::abs(volume6) / 6 < than * area2 / 4;
  }
  bool is_flat() const { return is_thinner(kNoThickness); }
};

std::vector<Component> measure_components(const TriMesh& mesh,
                                          const IdVector<TriId, int>& tri_to_component) {
  std::vector<Component> components;
  for (TriId t : mesh.tris.ids()) {
    const auto i = static_cast<std::size_t>(tri_to_component[t]);
    if (i >= components.size()) components.resize(i + 1);
    Component& c = components[i];
    const auto p = mesh.corners(t);
    if (c.box.is_empty()) c.origin = p[0];
    for (const Vec3& corner : p) c.box.extend(corner);
    c.area2 += norm(cross(p[1] - p[0], p[2] - p[0]));
    c.volume6 += det(p[0] - c.origin, p[1] - c.origin, p[2] - c.origin);
  }
  const SurfaceEdges edges = compute_surface_edges(mesh);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges.sides_of(e).size() == 1)
      components[static_cast<std::size_t>(tri_to_component[edges.sides_of(e)[0].tri])].is_closed =
          false;
  return components;
}

}  // namespace

std::vector<SmallPart> drop_small_parts(WorkingSurface& surface, double least) {
  const IdVector<TriId, int> tri_to_component = compute_components(surface.mesh);
  const std::vector<Component> components = measure_components(surface.mesh, tri_to_component);
  if (components.size() < 2) return {};
  const auto is_small = [&](const Component& c) {
    return c.size() <= least || (c.is_void() && c.is_thinner(kThinVoid * least));
  };
  if (std::ranges::all_of(components,
                          [&](const Component& c) { return is_small(c) || c.is_flat(); }))
    return {};
  std::vector<SmallPart> dropped;
  bool has_flat = false;
  for (const Component& c : components) {
    has_flat = has_flat || c.is_flat();
    if (is_small(c) && !c.is_flat()) dropped.push_back({c.box, c.volume6 < 0});
  }
  if (dropped.empty() && !has_flat) return {};
  std::vector<char> is_kept;
  for (int i : tri_to_component) {
    const Component& c = components[static_cast<std::size_t>(i)];
    is_kept.push_back(!is_small(c) && !c.is_flat());
  }
  surface.keep(is_kept);
  return dropped;
}

}  // namespace hexwright
