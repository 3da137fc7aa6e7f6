// Counts the components of a surface that bound the solid, by winding numbers on both sides.
//
// The solid is where the winding number exceeds one half. A component with the solid on one side
// bounds it, one with the solid on both sides lies hidden in it; one that does both overlaps
// another, and then the union's genus cannot be had by counting.
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

/// Triangles at even steps of the component's area: slivers, whose neighbourhood is thinner than
/// any step off the surface (along the edge of a blade), are sampled for their area's worth only.
std::vector<TriId> sample_by_area(const TriMesh& surface, const std::vector<TriId>& tris) {
  constexpr int kNumSamples = 24;
  std::vector<double> area_before = {0};  // the sum up to each triangle
  for (TriId t : tris) {
    const auto p = surface.corners(t);
    area_before.push_back(area_before.back() + norm(cross(p[1] - p[0], p[2] - p[0])));
  }
  std::vector<TriId> samples;
  for (int i = 0; i < kNumSamples; ++i) {
    const double share = (i + 0.5) / kNumSamples * area_before.back();
    const auto after = std::upper_bound(area_before.begin() + 1, area_before.end() - 1, share);
    samples.push_back(tris[static_cast<std::size_t>(after - area_before.begin()) - 1]);
  }
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  return samples;
}

/// Whether the component separates inside from outside, judged at a few of its triangles.
Exposure find_exposure(const SurfaceTree& tree, const Component& component) {
  const double step = 1e-5 * tree.box().diagonal();
  const std::vector<TriId> samples = sample_by_area(tree.surface(), component.tris);
  std::size_t num_bounding = 0;
  for (TriId t : samples) {
    const auto p = tree.surface().corners(t);
    const Vec3 center = (p[0] + p[1] + p[2]) / 3, n = tree.normal(t) * step;
    num_bounding += tree.is_inside(center - n) != tree.is_inside(center + n);
  }
  if (num_bounding == samples.size()) return Exposure::Bounding;
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
    if (exposure == Exposure::Hidden) {
      ++expected.num_hidden;
      continue;
    }
    ++expected.num_components;
    expected.euler_characteristic += c.euler_characteristic();
  }
  expected.is_known = expected.num_components > 0;
  return expected;
}

}  // namespace hexwright
