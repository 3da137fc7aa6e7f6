// Bodies that touch or nearly touch: each with vertices of its own, exact, and cheap.
#include <gtest/gtest.h>

#include "hexwright/pipeline/mesh_surface.h"
#include "hexwright/pipeline/option_table.h"

#include "helpers.h"
#include "solids.h"

namespace hexwright {
namespace {

using test::box_surface;
using test::joined;

MeshResult mesh_of(const TriMesh& surface, const MeshOptions& options = {}) {
  return mesh_surface(surface, options, {});
}

double distance_of(const MeshResult& result) { return result.verdict.distance->max_two_way(); }

TEST(BodiesApart, AGapNarrowerThanTheToleranceStays) {
  const TriMesh two =
      joined({box_surface({0, 0, 0}, {10, 10, 4}), box_surface({0, 0, 4.02}, {10, 10, 8})});
  const MeshResult result = mesh_of(two);
  EXPECT_TRUE(result.failures.empty());
  EXPECT_EQ(result.verdict.topology.num_components, 2u);
  EXPECT_LT(distance_of(result), 1e-5);
  EXPECT_NEAR(result.verdict.quality.total_volume, 798, 1e-3);
  EXPECT_LT(result.mesh.num_hexes(), 1000u);
  EXPECT_EQ(result.mesh.region.raw().front(), 0);
  EXPECT_EQ(result.mesh.region.raw().back(), 1);
}

TEST(BodiesApart, CubesThatShareAnEdgeOrACornerStayTwo) {
  for (const double z : {0.0, 1.0}) {
    const MeshResult result =
        mesh_of(joined({box_surface({0, 0, 0}, {1, 1, 1}), box_surface({1, 1, z}, {2, 2, z + 1})}));
    EXPECT_TRUE(result.failures.empty()) << z;
    EXPECT_EQ(result.verdict.topology.num_components, 2u);
    EXPECT_LT(distance_of(result), 1e-6);
    EXPECT_NEAR(result.verdict.quality.total_volume, 2, 1e-6);
  }
}

TEST(BodiesApart, BoxesThatTouchAreUnitedUnlessTheyAreToBeSeparate) {
  const TriMesh two =
      joined({box_surface({0, 0, 0}, {4, 4, 2}), box_surface({1, 1, 2}, {3, 3, 5})});
  EXPECT_EQ(mesh_of(two).verdict.topology.num_components, 1u);
  MeshOptions options;
  options.target.prepare.parts = Parts::Separate;
  const MeshResult apart = mesh_of(two, options);
  EXPECT_TRUE(apart.failures.empty()) << apart.failures.front();
  EXPECT_EQ(apart.verdict.topology.num_components, 2u);
  EXPECT_NEAR(apart.verdict.quality.total_volume, 44, 1e-6);
}

TEST(BodiesApart, FarBodiesShareOneGridAndARowOfNeighboursNeedsTwo) {
  std::vector<TriMesh> row;
  for (int i = 0; i < 5; ++i) row.push_back(box_surface({i * 1.001, 0, 0}, {i * 1.001 + 1, 1, 1}));
  const MeshResult result = mesh_of(joined(row));
  EXPECT_TRUE(result.failures.empty());
  EXPECT_EQ(result.verdict.topology.num_components, 5u);
  const auto& regions = result.mesh.region.raw();
  EXPECT_EQ(*std::max_element(regions.begin(), regions.end()), 1);
  MeshOptions never;
  never.gap = 0;
  const TriMesh far =
      joined({box_surface({0, 0, 0}, {1, 1, 1}), box_surface({2, 0, 0}, {3, 1, 1})});
  EXPECT_EQ(mesh_of(far).mesh.hexes.raw(), mesh_of(far, never).mesh.hexes.raw());
  EXPECT_TRUE(mesh_of(far).mesh.region.empty());
}

// A large box that is met exactly, and a ball beside it that is not.
TEST(BodiesApart, RecordsAndSentencesSayWhatTheyAreSharesOf) {
  TriMesh ball = test::unit_sphere_surface(3);
  for (Vec3& p : ball.positions) p += {5, 5, 5.01};
  const TriMesh two = joined({box_surface({0, 0, 0}, {10, 10, 4}), ball});
  MeshOptions options;
  options.gap = 0.01;
  options.max_rounds = 0;
  options.sizing.tolerance = 0.002;
  const MeshResult result = mesh_of(two, options);
  ASSERT_EQ(result.rounds.size(), 2u);
  const double farthest = std::max(result.rounds[0].max_distance, result.rounds[1].max_distance);
  EXPECT_NEAR(farthest, distance_of(result), 0.1 * distance_of(result));
  options.sizing.tolerance = 0.0005;
  options.sizing.max_level = 2;  // too coarse by far
  const MeshResult coarse = mesh_of(two, options);
  ASSERT_FALSE(coarse.failures.empty());
  const std::vector<std::string>& said = coarse.failures;
  EXPECT_TRUE(std::ranges::any_of(said, [](const std::string& s) {
    return s.starts_with("group ") && s.find("its own diagonal): the mesh departs") != s.npos;
  })) << said.front();
}

TEST(BodiesApart, GapIsAnOptionWithZeroForNever) {
  MeshOptions options;
  for (NamedOption& row : make_option_table(options))
    if (row.name == "gap") {
      row.set("3%");
      EXPECT_DOUBLE_EQ(options.gap, 0.03);
      for (const char* never : {"0", "0.0", "0%", "0.00", "0e3"}) {
        options.gap = 1;
        row.set(never);
        EXPECT_EQ(options.gap, 0) << never;
      }
      for (const char* wrong : {"-1%", "", "100%", "never"})
        EXPECT_THROW(row.set(wrong), Error) << wrong;
    }
}

TEST(BodiesApart, NamesAreThoseOfTheWhole) {
  TriMesh two =
      joined({box_surface({0, 0, 0}, {10, 10, 4}), box_surface({0, 0, 4.02}, {10, 10, 8})});
  two.group_names = {"lower", "upper"};
  two.group.resize(two.num_tris(), 0);
  for (TriId t : two.tris.ids())
    if (t.index() >= two.num_tris() / 2) two.group[t] = 1;
  const MeshResult result = mesh_of(two);
  EXPECT_EQ(result.mesh.region_names, (std::vector<std::string>{"lower", "upper"}));
  const auto& names = result.mesh.labels.patch_names.raw();
  EXPECT_EQ(names.size(), 12u);
  EXPECT_EQ(std::count(names.begin(), names.end(), "lower.6"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "upper.6"), 1);
}

}  // namespace
}  // namespace hexwright
