#include "hexwright/pipeline/inspect.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "helpers.h"

namespace hexwright {
namespace {

TriMesh box(const Vec3& lo, const Vec3& hi) {
  TriMesh mesh = test::unit_cube_surface();
  for (Vec3& p : mesh.positions)
    p = {lo.x + p.x * (hi.x - lo.x), lo.y + p.y * (hi.y - lo.y), lo.z + p.z * (hi.z - lo.z)};
  return mesh;
}

void append(TriMesh& to, const TriMesh& from, const std::string& name) {
  const std::size_t base = to.num_verts();
  for (const Vec3& p : from.positions) to.positions.push_back(p);
  for (const auto& t : from.tris)
    to.tris.push_back(
        {VertId(base + t[0].index()), VertId(base + t[1].index()), VertId(base + t[2].index())});
  to.group.resize(to.num_tris(), static_cast<std::int32_t>(to.group_names.size()));
  to.group_names.push_back(name);
}

TEST(Inspect, CrossingSolidsAreCountedWithTheirPlaces) {
  TriMesh surface;
  append(surface, box({0, 0, 0}, {10, 10, 2}), "plate");
  append(surface, box({3, 3, -1}, {7, 7, 9}), "post");
  const SurfaceInspection s = inspect_surface(surface, {}, {});
  EXPECT_EQ(s.num_solids, 2u);
  EXPECT_EQ(s.num_open_edges + s.num_nonmanifold_edges + s.num_open_tris, 0u);
  EXPECT_GE(s.num_crossings, 16u);
  ASSERT_FALSE(s.crossings.empty());
  for (const InspectedPlace& p : s.crossings) {
    EXPECT_TRUE(std::abs(p.position.z) < 1e-9 || std::abs(p.position.z - 2) < 1e-9);
    EXPECT_NEAR(std::max(std::abs(p.position.x - 5), std::abs(p.position.y - 5)), 2, 1e-9);
  }
  EXPECT_NEAR(s.volume, 328, 1e-9);
  EXPECT_NEAR(s.least_thickness, 2, 1e-6);
  EXPECT_EQ(s.num_thin_samples, 0u);
  EXPECT_EQ(s.num_corners, 24u);
  ASSERT_EQ(s.names.size(), 2u);
  EXPECT_EQ(s.names[1].name, "post");
  EXPECT_EQ(s.names[1].num_tris, 12u);
  EXPECT_EQ(s.notes, std::vector<std::string>{"2 parts that overlap or touch united into 1"});
  EXPECT_NE(inspection_to_text(s).find("2 solids"), std::string::npos);
  const auto json = nlohmann::json::parse(inspection_to_json(s));
  EXPECT_EQ(json["solids"], 2);
  EXPECT_EQ(json["crossings"], s.num_crossings);
}

TEST(Inspect, ThinSpotsAndCavitiesAreTold) {
  TriMesh surface;
  append(surface, box({0, 0, 0}, {100, 100, 0.2}), "sheet");
  append(surface, box({0, 0, 50}, {40, 40, 90}), "block");
  TriMesh hole = box({10, 10, 60}, {20, 20, 70});
  for (auto& t : hole.tris) std::swap(t[1], t[2]);
  append(surface, hole, "hole");
  const SurfaceInspection s = inspect_surface(surface, {}, {});
  EXPECT_EQ(s.num_solids, 2u);
  EXPECT_EQ(s.num_cavities, 1u);
  EXPECT_GT(s.num_thin_samples, 0u);
  ASSERT_FALSE(s.thin.empty());
  EXPECT_NEAR(s.thin[0].length, 0.2, 1e-4);
  EXPECT_LT(s.thin[0].position.z, 0.3);
}

TEST(Inspect, WhatWouldBeRefusedIsSaidAndNotThrown) {
  TriMesh sheet;
  append(sheet, test::unit_cube_surface(), "flat");
  for (Vec3& p : sheet.positions) p.z = 0;
  const SurfaceInspection s = inspect_surface(sheet, {}, {});
  EXPECT_NE(s.refusal.find("flat"), std::string::npos) << s.refusal;
  EXPECT_NE(inspection_to_text(s).find("would refuse"), std::string::npos);
}

}  // namespace
}  // namespace hexwright
