// Thin parts and narrow gaps keep their topology where the grid can hold it.
#include <bit>
#include <set>

#include <gtest/gtest.h>

#include "hexwright/fit/carve.h"
#include "hexwright/quality/hex_topology.h"

#include "fit/carve/approach_set.h"
#include "fit/carve/carve_repair.h"
#include "fit/carve/set_topology.h"
#include "fit_helpers.h"

namespace hexwright {
namespace {

using namespace fitting;

TopologyReport carved_topology(const HexMesh& grid, const TriMesh& surface) {
  const CarveResult result = carve(grid, SurfaceTree(surface), {}, {});
  const TopologyReport topology = check_topology(extract_hexes(grid, result.is_kept));
  EXPECT_EQ(topology.num_nonmanifold_edges, 0u);
  EXPECT_EQ(topology.num_nonmanifold_verts, 0u);
  EXPECT_EQ(result.euler_characteristic, topology.boundary_euler_characteristic);
  EXPECT_EQ(result.num_boundary_components, topology.num_boundary_components);
  return topology;
}

/// A plate whose thickness falls from `thick` to nothing along x: a blade.
TriMesh wedge_surface(double length, double width, double thick) {
  TriMesh t;
  for (double y : {0.0, width}) {
    t.positions.push_back({0, y, -thick / 2});
    t.positions.push_back({0, y, thick / 2});
    t.positions.push_back({length, y, 0});
  }
  const auto tri = [&](int a, int b, int c) {
    t.tris.push_back({VertId(a), VertId(b), VertId(c)});
  };
  tri(0, 2, 1);
  tri(3, 4, 5);
  const int sides[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  for (const auto& s : sides) {
    tri(s[0], s[1], s[1] + 3);
    tri(s[0], s[1] + 3, s[0] + 3);
  }
  return t;
}

/// Two slabs a `gap` apart, joined at one end: a clip.
TriMesh clip_surface(double gap) {
  const double outline[8][2] = {{0, 0},           {2, 0},         {2, 0.6},       {0.4, 0.6},
                                {0.4, 0.6 + gap}, {2, 0.6 + gap}, {2, 1.2 + gap}, {0, 1.2 + gap}};
  TriMesh t;
  for (double z : {0.0, 1.0})
    for (const auto& p : outline) t.positions.push_back({p[0], p[1], z});
  const auto tri = [&](int a, int b, int c) {
    t.tris.push_back({VertId(a), VertId(b), VertId(c)});
  };
  const int caps[6][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 7}, {4, 5, 6}, {4, 6, 7}};
  for (const auto& c : caps) {
    tri(c[2], c[1], c[0]);
    tri(c[0] + 8, c[1] + 8, c[2] + 8);
  }
  for (int i = 0; i < 8; ++i) {
    const int j = (i + 1) % 8;
    tri(i, j, j + 8);
    tri(i, j + 8, i + 8);
  }
  return t;
}

// Blades pierced by the threshold alone, in any position of the grid, come out whole.
TEST(CarveTopology, BladesHaveNoHoles) {
  std::mt19937 rng(5);
  int num_pierced = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const TriMesh blade = test::randomly_rotated(wedge_surface(2, 2, 0.12), rng);
    const HexMesh grid = test::grid_around(bounding_box(blade), 0.1);
    const ExpectedTopology unknown;  // nothing to aim for
    num_pierced += carve(grid, SurfaceTree(blade), unknown, {}, {}).euler_characteristic != 2;
    const TopologyReport topology = carved_topology(grid, blade);
    EXPECT_EQ(topology.num_boundary_components, 1u) << "trial " << trial;
    EXPECT_EQ(topology.genus(), 0) << "trial " << trial;
  }
  EXPECT_GE(num_pierced, 4);
}

// Bridges across a gap narrower than a hex are handles; they go.
TEST(CarveTopology, GapsHaveNoBridges) {
  std::mt19937 rng(11);
  int num_bridged = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const TriMesh clip = test::randomly_rotated(clip_surface(0.09), rng);
    const HexMesh grid = test::grid_around(bounding_box(clip), 0.12);
    const ExpectedTopology unknown;
    num_bridged += carve(grid, SurfaceTree(clip), unknown, {}, {}).euler_characteristic != 2;
    EXPECT_EQ(carved_topology(grid, clip).genus(), 0) << "trial " << trial;
  }
  EXPECT_GE(num_bridged, 4);
}

// How many of these faces can be reached from the first one across shared edges.
int count_reachable(unsigned faces) {
  unsigned reached = faces & (~faces + 1);
  for (int step = 0; step < 6; ++step)
    for (unsigned f = 0; f < 6; ++f)
      for (unsigned g = 0; g < 6; ++g)
        if ((reached >> f & 1) && (faces >> g & 1) && f / 2 != g / 2) reached |= 1u << g;
  return std::popcount(reached);
}

// A hole narrower than the hexes is closed at every threshold: the places that could open it are
// named. A hole that is open needs none.
TEST(CarveTopology, NamesThePlacesOfAHandleItCannotMake) {
  const TriMesh narrow = test::torus_surface(1, 0.97, 90, 60);
  const CarveResult closed =
      carve(test::grid_around(bounding_box(narrow), 0.3), SurfaceTree(narrow), {}, {});
  ASSERT_EQ(closed.euler_characteristic, 2);
  ASSERT_FALSE(closed.thin.empty());
  double nearest = 10;
  for (const Vec3& p : closed.thin) nearest = std::min(nearest, std::hypot(p.x, p.y));
  EXPECT_LT(nearest, 0.3);
  const TriMesh wide = test::torus_surface(1, 0.4, 60, 30);
  EXPECT_TRUE(
      carve(test::grid_around(bounding_box(wide), 0.13), SurfaceTree(wide), {}, {}).thin.empty());
}

// The table against the definition: a disc is in one piece and has Euler characteristic one.
TEST(SetTopology, DiscsOfFacesAreConnectedWithCharacteristicOne) {
  for (unsigned faces = 0; faces < 64; ++faces) {
    std::set<int> verts;
    std::set<std::pair<int, int>> edges;
    for (unsigned f = 0; f < 6; ++f)
      for (std::size_t k = 0; (faces >> f & 1) && k < 4; ++k) {
        const int a = kHexFaces[f][k], b = kHexFaces[f][(k + 1) % 4];
        verts.insert(a);
        edges.insert({std::min(a, b), std::max(a, b)});
      }
    const int num_faces = std::popcount(faces);
    const int euler = static_cast<int>(verts.size()) - static_cast<int>(edges.size()) + num_faces;
    EXPECT_EQ(is_disc(faces), euler == 1 && count_reachable(faces) == num_faces) << faces;
  }
}

// From random smooth blobs at one threshold to another: same topology, still manifold and visible,
// and no farther from the target.
TEST(ApproachThreshold, KeepsTopologyAndComesNearer) {
  std::mt19937 rng(29);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::size_t num_flips = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const HexMesh mesh = test::box_hex_mesh(12, 12, 12);
    const VertToHex vert_to_hex(mesh);
    const HexNeighbors neighbors = compute_hex_neighbors(mesh);
    HexFilling filling;
    filling.fraction.resize(mesh.num_hexes());
    filling.edge.assign(mesh.num_hexes(), 1);
    const double kx = 0.5 + uniform(rng), ky = 0.5 + uniform(rng), kz = 0.5 + uniform(rng);
    for (HexId h : mesh.hexes.ids()) {
      const Vec3 p = mesh.positions[mesh.hexes[h][0]];
      filling.fraction[h] = static_cast<float>(
          0.5 + 0.25 * std::sin(kx * p.x + trial) * std::sin(ky * p.y) + 0.25 * std::sin(kz * p.z));
    }
    const SetScene scene{mesh, vert_to_hex, neighbors, filling, 0.1};
    const double start = trial % 2 == 0 ? 0.3 : 0.7;
    std::vector<char> set(mesh.num_hexes());
    for (HexId h : mesh.hexes.ids()) set[h.index()] = filling.fraction[h] > start;
    repair_set(mesh, vert_to_hex, neighbors, filling, 0.1, set);
    const SetTopology before = compute_set_topology(mesh, neighbors, set);
    const std::vector<char> original = set;
    const std::size_t flips = approach_threshold(scene, 0.5, set);
    num_flips += flips;
    const SetTopology after = compute_set_topology(mesh, neighbors, set);
    EXPECT_EQ(after.num_components, before.num_components);
    EXPECT_EQ(after.euler_characteristic, before.euler_characteristic);
    SetCheck check(mesh, vert_to_hex, neighbors, true);
    for (VertId v : mesh.positions.ids()) EXPECT_EQ(check.check(v, set, 0.1), SetFault::None);
    std::size_t num_changed = 0;
    for (HexId h : mesh.hexes.ids()) {
      if (set[h.index()] == original[h.index()]) continue;
      ++num_changed;
      EXPECT_EQ(set[h.index()] != 0, filling.fraction[h] > 0.5f);
    }
    EXPECT_EQ(num_changed, flips);
  }
  EXPECT_GT(num_flips, 500u);
}

// A plate one hex thick is left whole although all of it is below the threshold.
TEST(ApproachThreshold, DoesNotPeelPlatesFromTheirRim) {
  const HexMesh mesh = test::box_hex_mesh(8, 8, 7);
  const VertToHex vert_to_hex(mesh);
  const HexNeighbors neighbors = compute_hex_neighbors(mesh);
  HexFilling filling;
  filling.fraction.assign(mesh.num_hexes(), 0.4f);
  filling.edge.assign(mesh.num_hexes(), 1);
  const SetScene scene{mesh, vert_to_hex, neighbors, filling, 0.1};
  std::vector<char> plate(mesh.num_hexes(), 0);
  for (HexId h : mesh.hexes.ids()) {
    const Vec3 p = mesh.positions[mesh.hexes[h][0]];
    plate[h.index()] = p.z == 3 && p.x > 0 && p.x < 6 && p.y > 0 && p.y < 6;
  }
  const std::vector<char> before = plate;
  EXPECT_EQ(approach_threshold(scene, 0.5, plate), 0u);
  EXPECT_EQ(plate, before);
}

// What is left of a layer taken off is single hexes and rows, each as thin as a wall.
TEST(ApproachThreshold, LeavesNoCrumbsOnAFlatBody) {
  const HexMesh mesh = test::box_hex_mesh(12, 12, 8);
  const VertToHex vert_to_hex(mesh);
  const HexNeighbors neighbors = compute_hex_neighbors(mesh);
  std::mt19937 rng(3);
  std::uniform_real_distribution<float> uniform(0.2f, 0.45f);
  for (bool is_solid : {true, false}) {  // a layer too many on a body, and one too few
    HexFilling filling;
    filling.edge.assign(mesh.num_hexes(), 1);
    std::vector<char> body(mesh.num_hexes(), 0), layer(mesh.num_hexes(), 0);
    for (HexId h : mesh.hexes.ids()) {
      const Vec3 p = mesh.positions[mesh.hexes[h][0]];
      const bool is_in = p.x > 0 && p.x < 11 && p.y > 0 && p.y < 11 && p.z > 0 && p.z < 4;
      const bool is_on = is_in || (p.x > 1 && p.x < 10 && p.y > 2 && p.y < 9 && p.z == 4);
      body[h.index()] = is_in == is_solid;
      layer[h.index()] = is_on == is_solid;
      const float f = is_in ? 1.0f : is_on ? uniform(rng) : 0.0f;
      filling.fraction.push_back(is_solid ? f : 1 - f);
    }
    const SetScene scene{mesh, vert_to_hex, neighbors, filling, 0.1};
    approach_threshold(scene, 0.5, layer);
    std::size_t num_left = 0;
    for (std::size_t i = 0; i < layer.size(); ++i) num_left += layer[i] != body[i];
    EXPECT_EQ(num_left, 0u) << is_solid;
  }
}

// A fin about as thick as a hex is filled to just under one half where its middle is between hexes.
TEST(CarveTopology, RecoversFinsThatTheGridNearlyHolds) {
  TriMesh body = clip_surface(0.6);  // two slabs, of which the upper one becomes the fin
  for (Vec3& p : body.positions)
    if (p.y > 1.3) p.y = 1.2 + 0.19;
  for (double shift = 0; shift < 1; shift += 0.125) {
    HexMesh grid = test::grid_around(bounding_box(body), 0.2);
    for (Vec3& p : grid.positions) p.y += 0.2 * shift;
    const CarveResult result = carve(grid, SurfaceTree(body), {}, {});
    double reach = 0;
    const HexMesh mesh = extract_hexes(grid, result.is_kept);
    for (const auto& hex : mesh.hexes)
      for (VertId v : hex)
        if (mesh.positions[v].y > 1.1) reach = std::max(reach, mesh.positions[v].x);
    EXPECT_GT(reach, 1.8) << shift;
  }
}

// Where all hexes are kept, the background's boundary is the set's: nothing is lost there.
TEST(CarveTopology, LosesNothingWhereTheBackgroundEnds) {
  TriMesh cube = test::unit_cube_surface();
  for (Vec3& p : cube.positions) p = Vec3{0.15, 0.15, 0.15} + 4.7 * p;
  const CarveResult result = carve(test::box_hex_mesh(5, 5, 5), SurfaceTree(cube), {}, {});
  EXPECT_TRUE(result.lost.empty());
  EXPECT_EQ(std::count(result.is_kept.begin(), result.is_kept.end(), 1), 125);
}

}  // namespace
}  // namespace hexwright
