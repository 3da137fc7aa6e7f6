#include "hexwright/pipeline/inspect.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "fit/fit_helpers.h"
#include "solids.h"

namespace hexwright {
namespace {

using test::box_surface;

void append(TriMesh& to, const TriMesh& from, const std::string& name) {
  append(to, from);
  to.group.resize(to.num_tris(), static_cast<std::int32_t>(to.group_names.size()));
  to.group_names.push_back(name);
}

TEST(Inspect, CrossingSolidsAreCountedWithTheirPlaces) {
  TriMesh surface;
  append(surface, box_surface({0, 0, 0}, {10, 10, 2}), "plate");
  append(surface, box_surface({3, 3, -1}, {7, 7, 9}), "post");
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
  append(surface, box_surface({0, 0, 0}, {100, 100, 0.2}), "sheet");
  append(surface, box_surface({0, 0, 50}, {40, 40, 90}), "block");
  append(surface, test::reversed(box_surface({10, 10, 60}, {20, 20, 70})), "hole");
  const SurfaceInspection s = inspect_surface(surface, {}, {});
  EXPECT_EQ(s.num_solids, 2u);
  EXPECT_EQ(s.num_cavities, 1u);
  EXPECT_GT(s.num_thin_samples, 0u);
  ASSERT_FALSE(s.thin.empty());
  EXPECT_NEAR(s.thin[0].length, 0.2, 1e-4);
  EXPECT_LT(s.thin[0].position.z, 0.3);
  EXPECT_TRUE(std::ranges::any_of(s.notes, [](const std::string& note) {
    return note.find("walls thinner than the tolerance") != std::string::npos;
  }));
}

// A tolerance a little above the thickness would not help.
TEST(Inspect, TheToleranceForThinWallsIsNoMoreThanTheirThickness) {
  const TriMesh sheet = box_surface({0, 0, 0}, {100, 100, 0.298});
  const SurfaceInspection s = inspect_surface(sheet, {}, {});
  ASSERT_FALSE(s.notes.empty());
  EXPECT_TRUE(s.notes.back().ends_with("--tolerance 0.21%")) << s.notes.back();
  const TriMesh thinner = box_surface({0, 0, 0}, {100, 100, 0.281});  // 0.1987%
  const SurfaceInspection t = inspect_surface(thinner, {}, {});
  ASSERT_FALSE(t.notes.empty());
  EXPECT_TRUE(t.notes.back().ends_with("--tolerance 0.19%")) << t.notes.back();
}

TEST(Inspect, WhatMeshWouldDoAboutNearBodiesAndCrossingsIsSaid) {
  const auto says = [](const TriMesh& surface, const char* text) {
    return std::ranges::any_of(
        inspect_surface(surface, {}, {}).notes,
        [&](const std::string& note) { return note.find(text) != std::string::npos; });
  };
  TriMesh near, far;
  append(near, box_surface({0, 0, 0}, {10, 10, 4}), "a");
  append(near, box_surface({0, 0, 4.02}, {10, 10, 8}), "b");
  append(far, box_surface({0, 0, 0}, {10, 10, 3}), "a");
  append(far, box_surface({0, 0, 5}, {10, 10, 8}), "b");
  EXPECT_TRUE(says(near, "in 2 groups"));
  EXPECT_FALSE(says(far, "groups"));
  // One closed shell, pulled through itself.
  TriMesh crossed = box_surface({0, 0, 0}, {10, 10, 4});
  crossed.positions[VertId(0)] = {5, 5, 7};
  EXPECT_TRUE(says(crossed, "crosses itself"));
  EXPECT_FALSE(says(far, "crosses itself"));
}

TEST(Inspect, WhatWouldBeRefusedIsSaidAndNotThrown) {
  TriMesh sheet;
  append(sheet, test::unit_cube_surface(), "flat");
  for (Vec3& p : sheet.positions) p.z = 0;
  const SurfaceInspection s = inspect_surface(sheet, {}, {});
  EXPECT_NE(s.refusal.find("flat"), std::string::npos) << s.refusal;
  const std::string text = inspection_to_text(s);
  EXPECT_NE(text.find("would refuse"), std::string::npos);
  EXPECT_EQ(text.find("crossings"), std::string::npos) << "they were not looked for";
}

TEST(Inspect, EdgesAreThoseBeforeHolesAreClosed) {
  TriMesh open = test::unit_cube_surface();
  open.tris.resize(10);  // without its top
  const SurfaceInspection s = inspect_surface(open, {}, {});
  EXPECT_EQ(s.num_open_edges, 4u);
  EXPECT_EQ(s.num_nonmanifold_edges, 0u);
  EXPECT_EQ(s.num_solids, 1u);
  EXPECT_NEAR(s.area, 6, 1e-12);
  // Two cubes that share an edge, and no more.
  const TriMesh both = test::welded(
      test::joined({box_surface({0, 0, 0}, {1, 1, 1}), box_surface({1, 1, 0}, {2, 2, 1})}));
  EXPECT_EQ(inspect_surface(both, {}, {}).num_nonmanifold_edges, 1u);
  EXPECT_EQ(inspect_surface(both, {}, {}).num_solids, 2u);
}

// Lengths, places and volumes are the world's, however the part is placed to be meshed.
TEST(Inspect, SpeaksOfTheSurfaceInItsOwnUnits) {
  TriMesh sheet = box_surface({0, 0, 0}, {100, 80, 0.2});
  const double c = 0.8, s = 0.6;
  for (Vec3& p : sheet.positions) p = Vec3{c * p.x - s * p.z, p.y, s * p.x + c * p.z} * 1000.0;
  const SurfaceInspection found = inspect_surface(sheet, {}, {});
  EXPECT_NEAR(found.volume / 1.6e12, 1, 1e-9);
  EXPECT_NEAR(found.least_thickness, 200, 0.1);
  ASSERT_FALSE(found.thin.empty());
  for (const InspectedPlace& place : found.thin) {
    const Vec3& p = place.position;
    const double across = (c * p.z - s * p.x) / 1000;
    EXPECT_NEAR(std::min(std::abs(across), std::abs(across - 0.2)), 0, 1e-6);
  }
}

TEST(Inspect, PlacesOfCrossingsAreSpreadOverAllOfThem) {
  TriMesh comb;
  append(comb, box_surface({0, 0, 0}, {100, 2, 2}), "bar");
  for (int i = 0; i < 9; ++i)
    append(comb, box_surface({10.0 * i + 5, -1, 0.5}, {10.0 * i + 7, 3, 1.5}), "tooth");
  const SurfaceInspection s = inspect_surface(comb, {}, {});
  ASSERT_EQ(s.crossings.size(), s.kMaxPlaces);
  const auto [first, last] =
      std::ranges::minmax(s.crossings, {}, [](const InspectedPlace& p) { return p.position.x; });
  EXPECT_LT(first.position.x, 20);
  EXPECT_GT(last.position.x, 70);
}

}  // namespace
}  // namespace hexwright
