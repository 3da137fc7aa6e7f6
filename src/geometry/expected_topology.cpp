// Counts the components of a surface that bound the solid, by winding numbers on both sides.
#include "hexwright/geometry/expected_topology.h"

#include <algorithm>
#include <vector>

#include "hexwright/geometry/surface_topology.h"

namespace hexwright {
namespace {

struct Component {
  std::vector<TriId> tris;
  std::size_t num_verts = 0;
  /// Closed: E = 3F/2.
  long euler_characteristic() const {
    return static_cast<long>(num_verts) - static_cast<long>(tris.size()) / 2;
  }
};

std::vector<Component> collect_components(const TriMesh& surface, std::size_t count) {
  const IdVector<TriId, int> component = compute_components(surface);
  std::vector<Component> components(count);
  IdVector<VertId, char> is_counted(surface.num_verts(), 0);
  for (TriId t : surface.tris.ids()) {
    Component& c = components[static_cast<std::size_t>(component[t])];
    c.tris.push_back(t);
    for (VertId v : surface.tris[t])
      if (!is_counted[v]) {
        is_counted[v] = 1;
        ++c.num_verts;
      }
  }
  return components;
}

enum class Exposure { Bounding, Hidden, Mixed };

/// Whether the component separates inside from outside, judged at a few of its triangles.
Exposure find_exposure(const SurfaceTree& tree, const Component& component) {
  constexpr std::size_t kNumSamples = 24;
  const double step = 1e-5 * tree.box().diagonal();
  const std::size_t stride = std::max<std::size_t>(1, component.tris.size() / kNumSamples);
  std::size_t num_samples = 0, num_bounding = 0;
  for (std::size_t i = 0; i < component.tris.size(); i += stride) {
    const TriId t = component.tris[i];
    const auto p = tree.surface().corners(t);
    const Vec3 center = (p[0] + p[1] + p[2]) / 3, n = tree.normal(t) * step;
    ++num_samples;
    num_bounding += tree.is_inside(center - n) != tree.is_inside(center + n);
  }
  if (num_bounding == num_samples) return Exposure::Bounding;
  return num_bounding == 0 ? Exposure::Hidden : Exposure::Mixed;
}

}  // namespace

ExpectedTopology find_expected_topology(const SurfaceTree& tree) {
  const SurfaceTopology topology = compute_topology(tree.surface());
  if (!topology.is_closed_manifold()) return {};
  ExpectedTopology expected;
  for (const Component& c : collect_components(tree.surface(), topology.num_components)) {
    const Exposure exposure = find_exposure(tree, c);
    if (exposure == Exposure::Mixed) return {};
    if (exposure == Exposure::Hidden) continue;
    ++expected.num_components;
    expected.euler_characteristic += c.euler_characteristic();
  }
  expected.is_known = expected.num_components > 0;
  return expected;
}

}  // namespace hexwright
