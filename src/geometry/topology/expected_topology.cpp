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

bool points_outwards(const TriMesh& surface, const Component& component) {
  const Vec3 origin = surface.corners(component.tris.front())[0];
  double volume6 = 0;
  for (TriId t : component.tris) {
    const auto p = surface.corners(t);
    volume6 += det(p[0] - origin, p[1] - origin, p[2] - origin);
  }
  return volume6 > 0;
}

enum class Exposure { Bounding, Hidden, Mixed };

constexpr std::size_t kNumSamples = 24;  // of each kind

double height_over_longest_edge(const std::array<Vec3, 3>& p) {
  const double longest =
      std::max({distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])});
  return longest > 0 ? norm(cross(p[1] - p[0], p[2] - p[0])) / longest : 0;
}

/// Triangles at even steps of the component's list: small ones count as much as large ones, and
/// where parts of a component cross each other the triangles are mostly small. Slivers are left
/// out: along the edge of a blade the wall itself is thinner than any step off the surface.
void sample_by_number(const TriMesh& surface, const std::vector<TriId>& tris, double least_height,
                      std::vector<TriId>& samples) {
  const std::size_t stride = std::max<std::size_t>(1, tris.size() / kNumSamples);
  for (std::size_t i = 0; i < tris.size(); i += stride)
    if (height_over_longest_edge(surface.corners(tris[i])) >= least_height)
      samples.push_back(tris[i]);
}

/// Triangles at even steps of the component's area; slivers only for their area's worth.
void sample_by_area(const TriMesh& surface, const std::vector<TriId>& tris,
                    std::vector<TriId>& samples) {
  std::vector<double> area_before = {0};  // the sum up to each triangle
  for (TriId t : tris) {
    const auto p = surface.corners(t);
    area_before.push_back(area_before.back() + norm(cross(p[1] - p[0], p[2] - p[0])));
  }
  for (std::size_t i = 0; i < kNumSamples; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / kNumSamples * area_before.back();
    const auto after = std::upper_bound(area_before.begin() + 1, area_before.end() - 1, share);
    samples.push_back(tris[static_cast<std::size_t>(after - area_before.begin()) - 1]);
  }
}

/// Whether the component separates inside from outside, judged at a few of its triangles.
Exposure find_exposure(const SurfaceTree& tree, const Component& component) {
  constexpr double kSliver = 10;  // a height of so many steps leaves room for the samples beside it
  const double step = 1e-5 * tree.box().diagonal();
  std::vector<TriId> samples;
  sample_by_number(tree.surface(), component.tris, kSliver * step, samples);
  sample_by_area(tree.surface(), component.tris, samples);
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
    expected.num_solids += points_outwards(tree.surface(), c);
    expected.euler_characteristic += c.euler_characteristic();
  }
  expected.is_known = expected.num_components > 0;
  return expected;
}

}  // namespace hexwright
