// Kinds of surfaces that users bring, each as small as it can be, and what is right for it.
#include <gtest/gtest.h>

#include "hexwright/pipeline/mesh_surface.h"

#include "helpers.h"
#include "solids.h"

namespace hexwright {
namespace {

using test::box_surface;
using test::joined;

struct Outcome {
  MeshResult result;
  std::size_t num_hexes() const { return result.mesh.num_hexes(); }
};

/// Meshes with the defaults; the mesh must pass the gate, with this many bodies and this volume.
Outcome expect_meshed(const TriMesh& surface, std::size_t num_bodies, double volume) {
  Outcome outcome{mesh_surface(surface, {}, {})};
  const Verdict& v = outcome.result.verdict;
  EXPECT_TRUE(outcome.result.failures.empty()) << outcome.result.failures.front();
  EXPECT_EQ(v.topology.num_components, num_bodies);
  EXPECT_NEAR(v.quality.total_volume, volume, 0.01 * volume);
  EXPECT_GT(v.quality.min_scaled_jacobian, 0.2);
  EXPECT_LT(v.distance->max_two_way(), 0.005);
  return outcome;
}

TEST(FieldInputs, CrossingBoxesAreMeshedAsTheirUnion) {
  const Outcome crossing = expect_meshed(
      joined({box_surface({0, 0, 0}, {10, 10, 2}), box_surface({3, 3, -1}, {7, 7, 9})}), 1, 328);
  EXPECT_LT(crossing.num_hexes(), 1.2 * 385);
  EXPECT_EQ(crossing.result.surface.num_united_parts, 2u);
  EXPECT_EQ(crossing.result.verdict.features->num_corners_recovered, 24u);
}

TEST(FieldInputs, TouchingBoxesAreOneBody) {
  const Outcome touching = expect_meshed(
      joined({box_surface({0, 0, 0}, {10, 5, 4}), box_surface({2, 1, 4}, {8, 4, 7})}), 1, 254);
  EXPECT_LT(touching.num_hexes(), 1000u);
}

TEST(FieldInputs, ASmallBodyBesideALargeOneIsKept) {
  // A thousandth of the volume, and nearer than its own size.
  expect_meshed(
      joined({box_surface({0, 0, 0}, {10, 10, 10}), box_surface({10.8, 4, 4}, {11.8, 5, 5})}), 2,
      1001);
}

TEST(FieldInputs, ACrumbIsLeftOutWithItsPlace) {
  const Outcome outcome = expect_meshed(
      joined({box_surface({0, 0, 0}, {10, 8, 6}), box_surface({11, 1, 1}, {11.02, 1.02, 1.02})}), 1,
      480);
  EXPECT_EQ(outcome.result.surface.num_small_parts, 1u);
  ASSERT_FALSE(outcome.result.warnings.empty());
  EXPECT_NE(outcome.result.warnings[0].find("the part at (11.01, 1.01, 1.01)"), std::string::npos)
      << outcome.result.warnings[0];
}

TEST(FieldInputs, ABladeInAShaftIsWhole) {
  expect_meshed(
      joined({test::cylinder_surface(0, 2, 0, 6, 48), box_surface({1, -0.1, 1}, {8, 0.1, 5})}), 1,
      75.2 + 0.2 * 4 * 6.005);
}

TEST(FieldInputs, ASlenderRodKeepsItsVolumeAndItsRims) {
  const TriMesh rod = test::cylinder_surface(0, 0.5, 0, 200, 32);
  const Outcome outcome = expect_meshed(rod, 1, 200 * 0.25 * 3.1214);
  EXPECT_LT(std::abs(outcome.result.verdict.volume_error.value()), 0.01);
  EXPECT_NEAR(outcome.result.verdict.features->total_length, 2 * 3.1365, 0.01);
  EXPECT_GT(outcome.result.verdict.features->length_share, 0.9);
}

TEST(FieldInputs, ASheetIsNoSolid) {
  TriMesh sheet;
  constexpr int kSide = 12;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x)
      sheet.positions.push_back({double(x), double(y), std::sin(0.9 * x) * std::cos(0.7 * y)});
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const int a = y * (kSide + 1) + x;
      sheet.tris.push_back({VertId(a), VertId(a + 1), VertId(a + kSide + 2)});
      sheet.tris.push_back({VertId(a), VertId(a + kSide + 2), VertId(a + kSide + 1)});
    }
  try {
    mesh_surface(sheet, {}, {});
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("encloses no volume"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace hexwright
