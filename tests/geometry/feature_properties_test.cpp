// Features, patches and the preparation of surfaces under renumbering, rotation and mirroring, and
// against plain definitions.
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "hexwright/geometry/feature_graph.h"
#include "hexwright/geometry/prepare_surface.h"
#include "hexwright/geometry/surface_topology.h"

#include "geometry/random_soup.h"
#include "helpers.h"
#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

/// A closed surface of unit squares: the outside of a random heap of cubes, each square in two
/// triangles, vertices shared by place.
TriMesh cube_heap(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::set<std::array<int, 3>> cubes = {{1, 1, 1}};
  while (cubes.size() < 8) {  // grown face to face
    auto it = cubes.begin();
    std::advance(it, long(random() % cubes.size()));
    std::array<int, 3> next = *it;
    next[random() % 3] += random() % 2 ? 1 : -1;
    cubes.insert(next);
  }
  TriMesh mesh;
  std::map<std::array<int, 3>, VertId> vert_at;
  const auto vert = [&](const std::array<int, 3>& p) {
    const auto [it, is_new] = vert_at.try_emplace(p);
    if (is_new) it->second = mesh.positions.push_back({double(p[0]), double(p[1]), double(p[2])});
    return it->second;
  };
  for (const auto& cube : cubes)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int up = 0; up < 2; ++up) {
        auto beyond = cube;
        beyond[axis] += up ? 1 : -1;
        if (cubes.contains(beyond)) continue;
        std::array<VertId, 4> q;
        for (std::size_t k = 0; k < 4; ++k) {
          auto p = cube;
          p[axis] += up;
          p[(axis + 1) % 3] += k == 1 || k == 2;
          p[(axis + 2) % 3] += k >= 2;
          q[k] = vert(p);
        }
        if (!up) std::swap(q[1], q[3]);
        mesh.tris.push_back({q[0], q[1], q[2]});
        mesh.tris.push_back({q[0], q[2], q[3]});
      }
  return mesh;
}

/// The same surface with vertices and triangles in another order and triangles begun elsewhere.
TriMesh renumbered(const TriMesh& mesh, std::mt19937_64& random) {
  std::vector<std::size_t> order(mesh.num_verts());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), random);
  TriMesh out;
  out.positions.resize(mesh.num_verts());
  for (VertId v : mesh.positions.ids()) out.positions[VertId(order[v.index()])] = mesh.positions[v];
  for (auto t : mesh.tris) {
    for (VertId& v : t) v = VertId(order[v.index()]);
    std::rotate(t.begin(), t.begin() + long(random() % 3), t.end());
    out.tris.push_back(t);
  }
  std::shuffle(out.tris.begin(), out.tris.end(), random);
  return out;
}

using Segment = std::set<std::array<double, 3>>;
std::array<double, 3> key(const Vec3& p) { return {p.x, p.y, p.z}; }

/// Edges between triangles of different normals, by their places.
std::multiset<Segment> crease_segments(const TriMesh& mesh) {
  std::map<std::set<VertId>, std::vector<Vec3>> normals;
  for (const auto& t : mesh.tris)
    for (std::size_t k = 0; k < 3; ++k)
      normals[{t[k], t[(k + 1) % 3]}].push_back(
          normalized(cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                           mesh.positions[t[2]] - mesh.positions[t[0]])));
  std::multiset<Segment> segments;
  for (const auto& [edge, around] : normals)
    if (around.size() != 2 || dot(around[0], around[1]) < 0.5)
      segments.insert({key(mesh.positions[*edge.begin()]), key(mesh.positions[*edge.rbegin()])});
  return segments;
}

std::multiset<Segment> curve_segments(const TriMesh& mesh, const FeatureGraph& features) {
  std::multiset<Segment> segments;
  for (const FeatureCurve& c : features.curves)
    for (std::size_t i = 1; i < c.verts.size(); ++i)
      segments.insert({key(mesh.positions[c.verts[i - 1]]), key(mesh.positions[c.verts[i]])});
  return segments;
}

// Every crease edge is in exactly one curve; arc lengths add up; curves end in corners only.
TEST(Features, CurvesAreThePartitionOfTheCreases) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriMesh mesh = cube_heap(seed);
    const FeatureGraph features = extract_features(mesh, {});
    EXPECT_EQ(curve_segments(mesh, features), crease_segments(mesh)) << seed;
    for (const FeatureCurve& c : features.curves) {
      ASSERT_EQ(c.arc_length.size(), c.verts.size());
      for (std::size_t i = 1; i < c.verts.size(); ++i)
        EXPECT_NEAR(c.arc_length[i] - c.arc_length[i - 1],
                    distance(mesh.positions[c.verts[i - 1]], mesh.positions[c.verts[i]]), 1e-12);
      EXPECT_EQ(c.is_closed, c.verts.front() == c.verts.back() &&
                                 !std::binary_search(features.corners.begin(),
                                                     features.corners.end(), c.verts.front()));
      for (std::size_t i = 1; i + 1 < c.verts.size(); ++i)
        EXPECT_FALSE(
            std::binary_search(features.corners.begin(), features.corners.end(), c.verts[i]));
    }
  }
}

/// Patches by a flood over edges that are no curve's.
std::vector<int> flooded_patches(const TriMesh& mesh, const FeatureGraph& features) {
  std::set<std::set<VertId>> barriers;
  for (const FeatureCurve& c : features.curves)
    for (std::size_t i = 1; i < c.verts.size(); ++i) barriers.insert({c.verts[i - 1], c.verts[i]});
  std::map<std::set<VertId>, std::vector<std::size_t>> tris_of;
  for (TriId t : mesh.tris.ids())
    for (std::size_t k = 0; k < 3; ++k)
      tris_of[{mesh.tris[t][k], mesh.tris[t][(k + 1) % 3]}].push_back(t.index());
  std::vector<int> patch(mesh.num_tris(), -1);
  int next = 0;
  for (std::size_t seed = 0; seed < patch.size(); ++seed) {
    if (patch[seed] >= 0) continue;
    std::vector<std::size_t> stack = {seed};
    patch[seed] = next;
    while (!stack.empty()) {
      const auto t = mesh.tris[TriId(stack.back())];
      stack.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::set<VertId> edge = {t[k], t[(k + 1) % 3]};
        if (barriers.contains(edge)) continue;
        for (std::size_t other : tris_of[edge])
          if (patch[other] < 0) {
            patch[other] = next;
            stack.push_back(other);
          }
      }
    }
    ++next;
  }
  return patch;
}

TEST(Features, PatchesAreWhatAFloodBetweenTheCurvesReaches) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriMesh mesh = cube_heap(seed);
    const FeatureGraph features = extract_features(mesh, {});
    const auto patches = compute_patches(mesh, features);
    const auto expected = flooded_patches(mesh, features);
    for (TriId t : mesh.tris.ids()) EXPECT_EQ(patches[t].value(), expected[t.index()]) << seed;
    std::map<int, std::set<std::array<double, 3>>> normals;  // a patch of a heap of cubes is flat
    for (TriId t : mesh.tris.ids()) {
      const auto c = mesh.corners(t);
      normals[patches[t].value()].insert(key(cross(c[1] - c[0], c[2] - c[0])));
    }
    for (const auto& [patch, all] : normals) EXPECT_EQ(all.size(), 1u) << seed;
  }
}

TEST(Features, DoNotDependOnNumbers) {
  std::mt19937_64 random(71);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const TriMesh mesh = cube_heap(seed), other = renumbered(mesh, random);
    const FeatureGraph a = extract_features(mesh, {}), b = extract_features(other, {});
    EXPECT_EQ(a.curves.size(), b.curves.size());
    EXPECT_NEAR(a.total_length(), b.total_length(), 1e-9);
    EXPECT_EQ(curve_segments(mesh, a), curve_segments(other, b));
    std::set<std::array<double, 3>> corners_a, corners_b;
    for (VertId v : a.corners) corners_a.insert(key(mesh.positions[v]));
    for (VertId v : b.corners) corners_b.insert(key(other.positions[v]));
    EXPECT_EQ(corners_a, corners_b);
  }
}

/// A surface with work to do: a soup, some triangles turned, one doubled, one missing.
TriMesh damaged(const TriMesh& mesh, std::mt19937_64& random) {
  TriMesh soup;
  for (TriId t : mesh.tris.ids()) {
    std::array<VertId, 3> tri;
    for (std::size_t k = 0; k < 3; ++k) tri[k] = soup.positions.push_back(mesh.corners(t)[k]);
    if (random() % 5 == 0) std::swap(tri[0], tri[1]);
    soup.tris.push_back(tri);
  }
  soup.tris.push_back(soup.tris[TriId(3)]);
  soup.tris[TriId(7)] = soup.tris[TriId(soup.num_tris() - 1)];
  return soup;
}

TEST(PrepareSurface, FindsTheSameSolidInAnyOrderAndPlace) {
  std::mt19937_64 random(72);
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const TriMesh heap = cube_heap(seed);
    if (!compute_topology(heap).is_closed_manifold()) continue;
    const TriMesh input = damaged(heap, random);
    const PreparedSurface reference = prepare_surface(input, {});
    EXPECT_TRUE(reference.diagnosis.is_closed) << seed;
    EXPECT_NEAR(enclosed_volume(reference.mesh), enclosed_volume(heap), 1e-9) << seed;

    const PreparedSurface again = prepare_surface(renumbered(input, random), {});
    EXPECT_EQ(again.diagnosis.num_duplicate_tris, reference.diagnosis.num_duplicate_tris);
    EXPECT_EQ(again.diagnosis.num_filled_holes, reference.diagnosis.num_filled_holes);
    EXPECT_EQ(again.mesh.num_tris(), reference.mesh.num_tris());
    EXPECT_NEAR(enclosed_volume(again.mesh), enclosed_volume(heap), 1e-9) << seed;

    TriMesh mirrored = input;  // inside out, then turned back by the preparation
    for (Vec3& p : mirrored.positions) p = Vec3{-p.x, p.y, p.z} * 1e6 + Vec3{1e7, 0, 0};
    const PreparedSurface turned = prepare_surface(mirrored, {});
    EXPECT_TRUE(turned.diagnosis.is_closed) << seed;
    EXPECT_NEAR(enclosed_volume(turned.mesh) / 1e18, enclosed_volume(heap), 1e-6) << seed;
  }
}

TEST(PrepareSurface, IsIdempotent) {
  std::mt19937_64 random(73);
  int num_solids = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const TriMesh heap = cube_heap(seed);
    if (!compute_topology(heap).is_closed_manifold()) continue;
    ++num_solids;
    const PreparedSurface once = prepare_surface(damaged(heap, random), {});
    const PreparedSurface twice = prepare_surface(once.mesh, {});
    EXPECT_EQ(twice.mesh.tris, once.mesh.tris) << seed;
    EXPECT_EQ(twice.mesh.positions, once.mesh.positions) << seed;
    EXPECT_EQ(twice.diagnosis.num_welded_verts + twice.diagnosis.num_flipped_tris +
                  twice.diagnosis.num_filled_holes + twice.diagnosis.num_duplicate_tris,
              0u)
        << seed;
  }
  EXPECT_GT(num_solids, 3);
}

}  // namespace
}  // namespace hexwright
