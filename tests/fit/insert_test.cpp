// Sheets keep a mesh conforming and positive; the set check agrees with what a sheet needs.
#include "fit/sheets/insert.h"

#include <random>

#include "hexwright/mesh/hex_adjacency.h"

#include "boundary_fixtures.h"
#include "fit/carve/set_check.h"

namespace hexwright::fitting {
namespace {

using namespace relax;

double min_jacobian(const HexMesh& mesh) {
  double least = 1;
  for (HexId h : mesh.hexes.ids())
    for (std::size_t lv = 0; lv < 8; ++lv) {
      const auto& hex = mesh.hexes[h];
      const Vec3& o = mesh.positions[hex[lv]];
      const auto edge = [&](std::size_t k) {
        return mesh.positions[hex[std::size_t(kHexCornerNeighbors[lv][k])]] - o;
      };
      least = std::min(least, det(edge(0), edge(1), edge(2)));
    }
  return least;
}

/// The sheet around a set; empty directions where a vertex fails the check.
struct SetSheet {
  SheetPlan plan;
  bool is_good = true;
};

SetSheet sheet_around(const HexMesh& mesh, const std::vector<char>& is_in, bool with_boundary) {
  const VertToHex vert_to_hex(mesh);
  const HexNeighbors neighbors = compute_hex_neighbors(mesh);
  SetSheet result;
  for (HexId h : mesh.hexes.ids())
    for (int lf = 0; lf < 6; ++lf) {
      const HexId other = neighbors.neighbor[h][std::size_t(lf)];
      const bool is_face =
          is_in[h.index()] && (other.is_valid() ? !is_in[other.index()] : with_boundary);
      if (is_face) result.plan.sheet.add_face(mesh, {h, lf});
    }
  result.plan.sheet.collect_verts();
  result.plan.takes_copy = is_in;
  SetCheck check(mesh, vert_to_hex, neighbors, with_boundary);
  for (VertId v : result.plan.sheet.verts) {
    result.is_good &= check.check(v, is_in, 0.02) == SetFault::None;
    result.plan.directions.push_back(check.direction(v, is_in).direction);
  }
  return result;
}

TEST(InsertSheet, PadsABoxEverywhere) {
  HexMesh mesh = test::box_hex_mesh(3, 3, 3);
  const std::vector<char> all(mesh.num_hexes(), 1);
  const SetSheet s = sheet_around(mesh, all, true);
  ASSERT_TRUE(s.is_good);
  const auto boundary = compute_hex_neighbors(mesh).boundary.size();
  const auto copies = insert_sheet(mesh, VertToHex(mesh), s.plan).copies;
  EXPECT_EQ(copies.size(), s.plan.sheet.verts.size());
  EXPECT_EQ(mesh.num_hexes(), 27 + boundary);
  const HexNeighbors after = compute_hex_neighbors(mesh);
  EXPECT_TRUE(after.non_conforming.empty());
  EXPECT_EQ(after.boundary.size(), boundary);
  EXPECT_GT(min_jacobian(mesh), 0);
}

TEST(InsertSheet, KeepsRandomSetsValidOrLeavesTheMeshAlone) {
  int num_inserted = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    HexMesh mesh = test::box_hex_mesh(4, 4, 4);
    for (Vec3& p : mesh.positions) p += Vec3{unit(random), unit(random), unit(random)} * 0.3;
    mesh.region.assign(mesh.num_hexes(), 0);
    // A random growth by faces: often good, sometimes not.
    std::vector<char> is_in(mesh.num_hexes(), 0);
    const HexNeighbors neighbors = compute_hex_neighbors(mesh);
    HexId h(random() % mesh.num_hexes());
    for (int k = 0; k < 8; ++k) {
      is_in[h.index()] = 1;
      mesh.region[h] = 1;
      const HexId next = neighbors.neighbor[h][random() % 6];
      if (next.is_valid()) h = next;
    }
    const SetSheet s = sheet_around(mesh, is_in, false);
    if (!s.is_good) continue;
    const HexMesh before = mesh;
    const auto copies = insert_sheet(mesh, VertToHex(mesh), s.plan).copies;
    if (copies.empty()) {
      EXPECT_EQ(mesh.hexes, before.hexes);
      EXPECT_EQ(mesh.positions, before.positions);
      continue;
    }
    ++num_inserted;
    EXPECT_EQ(mesh.num_hexes(), before.num_hexes() + s.plan.sheet.quads.size());
    EXPECT_TRUE(compute_hex_neighbors(mesh).non_conforming.empty());
    EXPECT_GT(min_jacobian(mesh), 0);
    ASSERT_EQ(mesh.region.size(), mesh.num_hexes());
    EXPECT_EQ(mesh.region.raw().back(), 1);
  }
  EXPECT_GT(num_inserted, 15);
}

TEST(InsertSheet, RefusesADirectionThatSeesNothing) {
  HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  const std::vector<char> all(8, 1);
  SetSheet s = sheet_around(mesh, all, true);
  for (Vec3& d : s.plan.directions) d = -d;
  const HexMesh before = mesh;
  const Insertion failed = insert_sheet(mesh, VertToHex(mesh), s.plan);
  EXPECT_TRUE(failed.copies.empty());
  EXPECT_EQ(failed.stuck, s.plan.sheet.verts);  // every hex of the box is turned inside out
  EXPECT_EQ(mesh.hexes, before.hexes);
  EXPECT_EQ(mesh.positions, before.positions);
}

TEST(SetCheck, FindsContactsByEdgeAndByVertex) {
  const HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  const VertToHex vert_to_hex(mesh);
  const HexNeighbors neighbors = compute_hex_neighbors(mesh);
  SetCheck check(mesh, vert_to_hex, neighbors, true);
  const VertId center(13);
  const auto verdict = [&](const std::vector<char>& set) { return check.check(center, set, 0.1); };
  EXPECT_EQ(verdict({1, 1, 1, 1, 0, 0, 0, 0}), SetFault::None);
  EXPECT_EQ(verdict({1, 0, 0, 1, 0, 0, 0, 0}), SetFault::NonManifold);  // edge contact
  EXPECT_EQ(verdict({1, 0, 0, 0, 0, 0, 0, 1}), SetFault::NonManifold);  // vertex contact
  EXPECT_EQ(verdict({0, 1, 1, 1, 1, 1, 1, 0}), SetFault::NonManifold);  // the same outside
  EXPECT_EQ(verdict({0, 0, 0, 0, 0, 0, 0, 0}), SetFault::None);
  EXPECT_EQ(verdict(std::vector<char>(8, 1)), SetFault::None);
  // Three hexes in a row around the centre: manifold, but two faces look at each other's backs.
  EXPECT_EQ(verdict({1, 1, 0, 1, 0, 0, 1, 0}), SetFault::NonManifold);
}

TEST(SetCheck, AgreesWithBruteForceOnAllOctants) {
  const HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  const VertToHex vert_to_hex(mesh);
  const HexNeighbors neighbors = compute_hex_neighbors(mesh);
  SetCheck check(mesh, vert_to_hex, neighbors, true);
  const VertId center(13);
  for (unsigned octants = 0; octants < 256; ++octants) {
    std::vector<char> set;
    for (unsigned h = 0; h < 8; ++h) set.push_back((octants >> h & 1u) != 0 ? 1 : 0);
    bool is_manifold = true;
    for (char side : {0, 1}) {
      std::vector<HexId> reached;
      std::size_t total = 0;
      for (HexId h : mesh.hexes.ids()) {
        if (set[h.index()] != side) continue;
        if (total++ == 0) reached.push_back(h);
      }
      for (std::size_t i = 0; i < reached.size(); ++i)
        for (HexId other : neighbors.neighbor[reached[i]])
          if (other.is_valid() && set[other.index()] == side &&
              std::find(reached.begin(), reached.end(), other) == reached.end())
            reached.push_back(other);
      is_manifold &= reached.size() == total;
    }
    EXPECT_EQ(check.is_manifold(center, set), is_manifold) << octants;
    if (!is_manifold) {
      EXPECT_EQ(check.check(center, set, 0.1), SetFault::NonManifold) << octants;
    }
  }
}

TEST(VisibleDirection, IsTheBestOneOnRandomNormals) {
  std::mt19937 random(3);
  std::normal_distribution<double> gauss;
  const auto unit = [&] { return normalized({gauss(random), gauss(random), gauss(random)}); };
  for (int i = 0; i < 50; ++i) {
    std::vector<Vec3> normals;
    const Vec3 axis = unit();
    for (int k = 0; k < 6; ++k) normals.push_back(normalized(unit() + axis * 0.9));
    const VisibleDirection best = find_visible_direction(normals);
    EXPECT_NEAR(norm(best.direction), 1, 1e-12);
    double sampled = -1;
    for (int k = 0; k < 3000; ++k) {
      const Vec3 d = unit();
      double least = 1;
      for (const Vec3& n : normals) least = std::min(least, dot(n, d));
      sampled = std::max(sampled, least);
    }
    if (sampled > 0.05) {
      EXPECT_GT(best.cosine, sampled - 0.03);
    }
  }
}

}  // namespace
}  // namespace hexwright::fitting
