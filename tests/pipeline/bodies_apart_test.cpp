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

TEST(BodiesApart, GapIsAnOptionWithZeroForNever) {
  MeshOptions options;
  for (NamedOption& row : make_option_table(options))
    if (row.name == "gap") {
      row.set("3%");
      EXPECT_DOUBLE_EQ(options.gap, 0.03);
      for (const char* never : {"0", "0.0", "0%"}) {
        options.gap = 1;
        row.set(never);
        EXPECT_EQ(options.gap, 0) << never;
      }
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
