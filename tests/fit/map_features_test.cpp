// Feature mapping: complete on plain shapes, disjoint and connected on crowded ones.
#include "fit/curves/map_features.h"

#include <numbers>
#include <random>
#include <set>

#include "boundary_fixtures.h"
#include "fit/curves/regions.h"
#include "fit/curves/vert_reach.h"

namespace hexwright::fitting {
namespace {

using namespace relax;

using test::OwnedBoundary;

/// First violated rule of a mapping; empty when all hold.
std::string find_violation(const OwnedBoundary& boundary, const FeatureGraph& features,
                           const FeatureMapping& mapping) {
  const BoundaryGraph graph(boundary.positions.size(), boundary.view().quads);
  std::set<VertId> corners, used;
  for (VertId v : mapping.corner_verts)
    if (v.is_valid() && !corners.insert(v).second) return "two corners on one vertex";
  std::set<std::pair<VertId, VertId>> used_edges;
  for (CurveId c : mapping.curves.ids()) {
    const CurvePath& path = mapping.curves[c];
    if (!path.is_mapped()) {
      if (path.reason.empty()) return "dropped without a reason";
      continue;
    }
    const bool is_closed = features.curves[c].is_closed;
    if (path.arcs.size() != path.verts.size()) return "arcs do not match";
    if (!std::is_sorted(path.arcs.begin(), path.arcs.end())) return "arcs descend";
    if (is_closed != (path.verts.front() == path.verts.back()) &&
        features.curves[c].verts.front() != features.curves[c].verts.back())
      return "loop is open";
    const std::size_t n = path.verts.size();
    for (std::size_t i = 0; i < n; ++i) {
      const VertId v = path.verts[i];
      const bool is_end = i == 0 || i + 1 == n;
      if (!is_closed && is_end != (corners.count(v) > 0)) return "corner inside or end without one";
      if (!(is_end && !is_closed) && !(is_closed && i + 1 == n) && !used.insert(v).second)
        return "vertex used twice";
      if (i + 1 == n) break;
      const VertId w = path.verts[i + 1];
      if (!graph.find_edge(v, w).is_valid()) return "path jumps";
      if (!used_edges.insert({std::min(v, w), std::max(v, w)}).second) return "edge used twice";
    }
    for (std::size_t i = 0; i + 3 < n && n > 7; ++i)
      if (path.verts[i] != path.verts[i + 3] &&
          graph.find_edge(path.verts[i], path.verts[i + 3]).is_valid())
        return "detour around a quad";
  }
  for (std::size_t k = 0; k < features.corners.size(); ++k) {
    if (!mapping.corner_verts[k].is_valid()) continue;
    bool has_curve = false;
    for (CurveId c : mapping.curves.ids()) {
      const auto& verts = mapping.curves[c].verts;
      has_curve |= !verts.empty() && (verts.front() == mapping.corner_verts[k] ||
                                      verts.back() == mapping.corner_verts[k]);
    }
    if (!has_curve) return "corner without a curve";
  }
  return {};
}

struct Mapped {
  FeatureGraph features;
  FeatureMapping mapping;
  RegionMap regions;
  IdVector<TriId, PatchId> patches;
  std::size_t num_mapped = 0;
};

Mapped map_all(const OwnedBoundary& boundary, const TriMesh& surface,
               const FeatureOptions& options = {}) {
  Mapped m;
  m.features = extract_features(surface, options);
  m.mapping = map_features(boundary.view(), surface, m.features, {});
  EXPECT_EQ(find_violation(boundary, m.features, m.mapping), "");
  for (const CurvePath& path : m.mapping.curves) m.num_mapped += path.is_mapped() ? 1 : 0;
  const BoundaryGraph graph(boundary.positions.size(), boundary.view().quads);
  m.regions = compute_regions(graph, mark_edges(graph, collect_marked_edges(m.mapping)));
  const SurfaceTree tree(surface);
  m.patches = compute_patches(surface, m.features, mapped_curves(m.mapping));
  vote_patches(boundary.view(), tree, PatchIndex(tree, m.patches), m.regions);
  return m;
}

/// Every region has a patch, every patch exactly one region.
void expect_regions_match_patches(const Mapped& m) {
  std::set<PatchId> surface_patches(m.patches.begin(), m.patches.end());
  std::set<PatchId> region_patches;
  for (PatchId p : m.regions.region_to_patch) {
    EXPECT_TRUE(p.is_valid());
    EXPECT_TRUE(region_patches.insert(p).second) << "patch " << p.value() << " twice";
  }
  EXPECT_EQ(region_patches, surface_patches);
}

TEST(MapFeatures, MapsACubeCompletely) {
  HexMesh grid = test::box_hex_mesh(6, 6, 6);
  TriMesh cube = test::unit_cube_surface();
  test::transform(cube.positions, [](const Vec3& p) { return p * 6.3 + Vec3{-0.2, 0.1, -0.25}; });
  const Mapped m = map_all(test::boundary_of(grid), cube);
  ASSERT_EQ(m.features.curves.size(), 12u);
  ASSERT_EQ(m.features.corners.size(), 8u);
  EXPECT_EQ(m.num_mapped, 12u);
  EXPECT_EQ(m.regions.num_regions(), 6u);
  expect_regions_match_patches(m);
  for (const CurvePath& path : m.mapping.curves) EXPECT_EQ(path.verts.size(), 7u);
}

TEST(MapFeatures, MapsACubeRotatedAgainstItsGrid) {
  TriMesh cube = test::unit_cube_surface();
  const Vec3 center{8, 8, 8};
  test::transform(cube.positions, [&](const Vec3& p) {
    return test::rotated((p - Vec3{.5, .5, .5}) * 8, 0.4) + center;
  });
  const SurfaceTree tree(cube);
  const HexMesh mesh = test::voxels(16, [&](const Vec3& p) { return tree.is_inside(p); });
  const Mapped m = map_all(test::boundary_of(mesh), cube);
  EXPECT_EQ(m.num_mapped, 12u);
  expect_regions_match_patches(m);
}

TEST(MapFeatures, MapsAnLShape) {
  const auto l_shape = [](const Vec3& p) { return p.x < 3 || p.z < 3; };
  TriMesh surface = test::surface_of(test::voxels(6, l_shape));
  const HexMesh fine = test::voxels(6, l_shape);
  const Mapped m = map_all(test::boundary_of(fine), surface);
  EXPECT_EQ(m.features.curves.size(), 18u);
  EXPECT_EQ(m.features.corners.size(), 12u);
  EXPECT_EQ(m.num_mapped, 18u);
  EXPECT_EQ(m.regions.num_regions(), 8u);
  expect_regions_match_patches(m);
}

TEST(MapFeatures, MapsTheLoopsOfACylinder) {
  const TriMesh cylinder = test::cylinder_surface(6, 4.2, 1.1, 9.2, 48);
  const SurfaceTree tree(cylinder);
  const HexMesh mesh = test::voxels(12, [&](const Vec3& p) { return tree.is_inside(p); });
  const Mapped m = map_all(test::boundary_of(mesh), cylinder);
  ASSERT_EQ(m.features.curves.size(), 2u);
  EXPECT_EQ(m.num_mapped, 2u);
  expect_regions_match_patches(m);
  for (CurveId c : m.mapping.curves.ids()) {
    const CurvePath& path = m.mapping.curves[c];
    EXPECT_NEAR(path.arcs.back() - path.arcs.front(), m.features.curves[c].length(), 1e-9);
  }
}

/// A prism along y over a drop: a round nose about `nose` and two straight sides to a tip.
TriMesh drop_surface(double angle, const Vec3& nose, double radius, double width) {
  const double half = 0.5 * angle;
  std::vector<Vec3> outline{nose + Vec3{radius / std::sin(half), 0, 0}};
  for (int i = 0; i <= 24; ++i) {  // from one point of contact around the nose to the other
    const double a = std::numbers::pi / 2 - half + (std::numbers::pi + angle) * i / 24;
    outline.push_back(nose + Vec3{std::cos(a), 0, std::sin(a)} * radius);
  }
  const auto n = static_cast<int>(outline.size());
  TriMesh t;
  for (double y : {0.0, width})
    for (const Vec3& p : outline) t.positions.push_back({p.x, nose.y + y, p.z});
  const auto add = [&](int a, int b, int c) {
    t.tris.push_back({VertId(a), VertId(b), VertId(c)});
  };
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    add(i, j + n, j);
    add(i, i + n, j + n);
  }
  for (int i = 1; i + 1 < n; ++i) {
    add(0, i, i + 1);
    add(n, n + i + 1, n + i);
  }
  return t;
}

// The grid loses a wedge's tip over several hexes, and the loops around its ends come back to their
// corner beside themselves.
TEST(MapFeatures, FollowsTheEdgesOfANarrowWedge) {
  for (double degrees : {16.0, 20.0, 26.0, 40.0})
    for (double lift : {0.0, 0.21, 0.5, 0.77}) {
      const TriMesh drop =
          drop_surface(degrees * std::numbers::pi / 180, {5.3, 3.2, 15 + lift}, 3, 8.1);
      const SurfaceTree tree(drop);
      const HexMesh mesh = test::voxels(30, [&](const Vec3& p) { return tree.is_inside(p); });
      const Mapped m = map_all(test::boundary_of(mesh), drop);
      ASSERT_EQ(m.features.curves.size(), 3u);
      EXPECT_EQ(m.num_mapped, 3u) << degrees << " " << lift;
    }
}

/// The boundary of a 12 x 12 x 12 grid cube as a surface, with user lines on its top at given y.
FeatureOptions lines_on_top(const TriMesh& surface, const std::vector<double>& ys) {
  FeatureOptions options;
  for (TriId t : surface.tris.ids())
    for (std::size_t k = 0; k < 3; ++k) {
      const VertId a = surface.tris[t][k], b = surface.tris[t][(k + 1) % 3];
      const Vec3 &p = surface.positions[a], &q = surface.positions[b];
      if (p.z < 11.99 || q.z < 11.99 || p.y != q.y) continue;
      if (std::find(ys.begin(), ys.end(), p.y) != ys.end()) options.extra_edges.push_back({a, b});
    }
  return options;
}

TEST(MapFeatures, SeparatesCurvesCloserThanAnEdge) {
  // Lines at y = 5 and 6 of the surface; the mesh's edges are 4/3 long, so both are nearest to
  // the same row of mesh vertices for a while.
  const TriMesh surface = test::surface_of(test::box_hex_mesh(12, 12, 12));
  HexMesh mesh = test::box_hex_mesh(9, 9, 9);
  test::transform(mesh.positions, [](const Vec3& p) { return p * (12.0 / 9); });
  const Mapped m = map_all(test::boundary_of(mesh), surface, lines_on_top(surface, {5, 6}));
  EXPECT_EQ(m.num_mapped, m.features.curves.size());
  EXPECT_EQ(m.regions.num_regions(), 8u);
}

TEST(MapFeatures, DropsCurvesItHasNoRoomForAndSaysWhy) {
  // Eleven lines on a face with five rows of edges inside: at most five or so can have paths.
  const TriMesh surface = test::surface_of(test::box_hex_mesh(12, 12, 12));
  HexMesh mesh = test::box_hex_mesh(6, 6, 6);
  test::transform(mesh.positions, [](const Vec3& p) { return p * 2; });
  const Mapped m =
      map_all(test::boundary_of(mesh), surface, lines_on_top(surface, {3, 4, 5, 6, 7, 8, 9}));
  EXPECT_LT(m.num_mapped, m.features.curves.size());
  EXPECT_GE(m.num_mapped, 12u);
}

TEST(MapFeatures, LeavesShortFreeEndsOut) {
  // One user edge on the top of a fine cube, two coarse mesh edges long: no way to follow it well.
  const TriMesh surface = test::surface_of(test::box_hex_mesh(12, 12, 12));
  HexMesh mesh = test::box_hex_mesh(6, 6, 6);
  test::transform(mesh.positions, [](const Vec3& p) { return p * 2; });
  FeatureOptions options;
  for (TriId t : surface.tris.ids())
    for (std::size_t k = 0; k < 3; ++k) {
      const VertId a = surface.tris[t][k], b = surface.tris[t][(k + 1) % 3];
      const Vec3 &p = surface.positions[a], &q = surface.positions[b];
      if (p.z == 12 && q.z == 12 && p.y == 6 && q.y == 6 && std::min(p.x, q.x) >= 4 &&
          std::max(p.x, q.x) <= 8)
        options.extra_edges.push_back({a, b});
    }
  const Mapped m = map_all(test::boundary_of(mesh), surface, options);
  EXPECT_EQ(m.features.curves.size(), 13u);
  EXPECT_EQ(m.num_mapped, 12u);
}

/// A helix of user edges on a cylinder whose turns are four edges apart.
TEST(MapFeatures, FollowsAHelixTurnByTurn) {
  TriMesh s;
  FeatureOptions options;
  const int num_around = 48, num_up = 240;  // a turn rises by 48 rows of 0.1
  for (int r = 0; r <= num_up; ++r)
    for (int k = 0; k < num_around; ++k) {
      const double a = 2 * std::numbers::pi * k / num_around;
      s.positions.push_back({16 + 8 * std::cos(a), 16 + 8 * std::sin(a), 4 + 0.1 * r});
    }
  const auto id = [&](int r, int k) { return VertId(r * num_around + k % num_around); };
  for (int r = 0; r < num_up; ++r)
    for (int k = 0; k < num_around; ++k) {
      s.tris.push_back({id(r, k), id(r, k + 1), id(r + 1, k + 1)});
      s.tris.push_back({id(r, k), id(r + 1, k + 1), id(r + 1, k)});
    }
  for (int r = 20; r < num_up - 20; ++r)
    options.extra_edges.push_back({id(r, r), id(r + 1, r + 1)});
  const HexMesh mesh = test::voxels(
      32, [](const Vec3& p) { return std::hypot(p.x - 16, p.y - 16) < 8 && p.z > 4 && p.z < 28; });
  const Mapped m = map_all(test::boundary_of(mesh), s, options);
  EXPECT_EQ(m.num_mapped, m.features.curves.size());
  for (CurveId c : m.mapping.curves.ids()) {
    const FeatureCurve& curve = m.features.curves[c];
    if (curve.is_closed) continue;
    // Steps across turns would skip 50 units of arc at once.
    const auto& path = m.mapping.curves[c];
    for (VertId v : path.verts) {
      const CurvePoint p = closest_on_curve(s, curve, mesh.positions[v]);
      EXPECT_LT(p.distance_sq, 2.25);
    }
    EXPECT_GT(static_cast<double>(path.verts.size()), curve.length() * 0.9);
  }
}

TEST(MapFeatures, LeavesBannedCurvesOut) {
  const HexMesh grid = test::box_hex_mesh(4, 4, 4);
  TriMesh cube = test::unit_cube_surface();
  test::transform(cube.positions, [](const Vec3& p) { return p * 4; });
  const FeatureGraph features = extract_features(cube, {});
  FeatureMapOptions options;
  options.is_banned.assign(features.curves.size(), 0);
  options.is_banned[CurveId(3)] = 1;
  const OwnedBoundary boundary = test::boundary_of(grid);
  const FeatureMapping mapping = map_features(boundary.view(), cube, features, options);
  EXPECT_EQ(find_violation(boundary, features, mapping), "");
  for (CurveId c : mapping.curves.ids()) EXPECT_EQ(mapping.curves[c].is_mapped(), c != CurveId(3));
}

TEST(MapFeatures, KeepsPathsDisjointOnRandomCrowds) {
  const TriMesh fine = test::surface_of(test::box_hex_mesh(12, 12, 12));
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    TriMesh surface = fine;
    FeatureOptions options;
    for (TriId t : fine.tris.ids())
      for (std::size_t k = 0; k < 3; ++k) {
        const VertId a = fine.tris[t][k], b = fine.tris[t][(k + 1) % 3];
        if (unit(random) < 0.04 && a < b) options.extra_edges.push_back({a, b});
      }
    const double angle = unit(random);
    test::transform(surface.positions, [&](const Vec3& p) {
      return test::rotated(p - Vec3{6, 6, 6}, angle) + Vec3{10, 10, 10};
    });
    const SurfaceTree tree(surface);
    const HexMesh mesh = test::voxels(20, [&](const Vec3& p) { return tree.is_inside(p); });
    FeatureMapOptions map_options;
    map_options.min_edges = 0;  // most of the crowd are single edges
    const OwnedBoundary boundary = test::boundary_of(mesh);
    const FeatureGraph features = extract_features(surface, options);
    const FeatureMapping mapping = map_features(boundary.view(), surface, features, map_options);
    EXPECT_EQ(find_violation(boundary, features, mapping), "");
    std::size_t num_mapped = 0;
    for (const CurvePath& path : mapping.curves) num_mapped += path.is_mapped() ? 1 : 0;
    EXPECT_GT(num_mapped, features.curves.size() * 9 / 10);
  }
}

TEST(BoundaryGraph, AgreesWithTheQuads) {
  const OwnedBoundary boundary = test::boundary_of(test::box_hex_mesh(3, 2, 4));
  const BoundaryGraph graph(boundary.positions.size(), boundary.view().quads);
  EXPECT_EQ(graph.verts().size(), 60u - 2 * 1 * 3);
  EXPECT_EQ(graph.num_edges(), 2 * graph.num_quads());
  for (QuadId q : boundary.quads.ids())
    for (std::size_t k = 0; k < 4; ++k) {
      const VertId v = boundary.quads[q][k], w = boundary.quads[q][(k + 1) % 4];
      const BoundaryEdgeId e = graph.find_edge(v, w);
      EXPECT_EQ(e, graph.quad_edges(q)[k]);
      EXPECT_EQ(graph.edge(e).other(v), w);
      EXPECT_EQ(graph.edge(e).num_quads, 2);
      EXPECT_TRUE(graph.edge(e).quads[0] == q || graph.edge(e).quads[1] == q);
    }
  for (VertId v : graph.verts()) {
    const auto n = graph.neighbors(v);
    EXPECT_TRUE(std::is_sorted(n.begin(), n.end()));
    EXPECT_EQ(graph.quads(v).size(), n.size());
  }
}

TEST(VertReach, FindsWhatBruteForceFinds) {
  OwnedBoundary boundary = test::boundary_of(test::box_hex_mesh(5, 6, 7));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (double& h : boundary.edge_length) h *= 0.2 + unit(random);
  const BoundaryGraph graph(boundary.positions.size(), boundary.view().quads);
  const BoundaryQuads view = boundary.view();
  const VertReach tree(view, graph.verts(), 1.5);
  for (int i = 0; i < 200; ++i) {
    Box3 box;
    for (int k = 0; k < 2; ++k)
      box.extend(Vec3{8 * unit(random) - 1, 8 * unit(random) - 1, 8 * unit(random) - 1});
    std::vector<VertId> found, expected;
    tree.find(box, found);
    std::sort(found.begin(), found.end());
    for (VertId v : graph.verts()) {
      const double r = 1.5 * boundary.edge_length[v];
      const Vec3& p = boundary.positions[v];
      bool meets = true;
      for (int axis = 0; axis < 3; ++axis)
        meets &= p[axis] + r >= box.lo[axis] && p[axis] - r <= box.hi[axis];
      if (meets) expected.push_back(v);
    }
    EXPECT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace hexwright::fitting
