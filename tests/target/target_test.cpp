// One value for the surface that is meshed: the same whatever the units, and what is wished of it
// is wished in the world.
#include "hexwright/target/target.h"

#include <cmath>

#include <gtest/gtest.h>

#include "helpers.h"

namespace hexwright {
namespace {

/// A box about the origin, with all edges creases.
TriMesh box_surface(const Vec3& size) {
  TriMesh box = test::unit_cube_surface();
  for (Vec3& p : box.positions)
    p = {(p.x - 0.5) * size.x, (p.y - 0.5) * size.y, (p.z - 0.5) * size.z};
  return box;
}

TriMesh moved(TriMesh surface, double scale, const Vec3& shift) {
  for (Vec3& p : surface.positions) p = p * scale + shift;
  return surface;
}

TriMesh turned(TriMesh surface, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (Vec3& p : surface.positions) p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  return surface;
}

TEST(Target, IsTheSameInAnyUnits) {
  const TriMesh box = box_surface({3, 2, 1});
  const Target plain = make_target(box, {}, {});
  const Target micro = make_target(moved(box, std::ldexp(1, -20), {}), {}, {});
  EXPECT_EQ(plain.surface().positions, micro.surface().positions);
  EXPECT_EQ(plain.diagonal(), micro.diagonal());
  EXPECT_EQ(plain.features.total_length(), micro.features.total_length());
  EXPECT_EQ(micro.frame.to_world(micro.surface().positions[VertId(0)]),
            box.positions[VertId(0)] * std::ldexp(1, -20));
}

TEST(Target, KnowsWhatItsSurfaceIs) {
  const Target target = make_target(box_surface({3, 2, 1}), {}, {});
  EXPECT_EQ(target.features.curves.size(), 12u);
  EXPECT_EQ(target.features.corners.size(), 8u);
  EXPECT_TRUE(target.topology.is_closed_manifold());
  EXPECT_TRUE(target.expected.is_known);
  EXPECT_EQ(target.expected.genus(), 0);
  EXPECT_TRUE(target.diagnosis.is_closed);
  ASSERT_EQ(target.stages.size(), 3u);
  EXPECT_EQ(target.stages[0].counts.at("triangles"), 12);
  EXPECT_EQ(target.stages[2].counts.at("curves"), 12);
}

// Tolerances are shares of the diagonal that the user knows, not of the turned box's.
TEST(Target, KeepsTheDiagonalOfTheSurfaceAsGiven) {
  const TriMesh box = turned(box_surface({3, 2, 1}), 0.5);
  TargetOptions options;
  const Target given = make_target(box, options, {});
  EXPECT_TRUE(given.frame.pose.is_identity());
  EXPECT_EQ(given.diagonal(), given.tree.box().diagonal());
  options.placement = Placement::Faces;
  const Target placed = make_target(box, options, {});
  EXPECT_FALSE(placed.frame.pose.is_identity());
  EXPECT_EQ(placed.diagonal(), given.diagonal());
  EXPECT_LT(placed.tree.box().diagonal(), 0.99 * placed.diagonal());
  for (VertId v : box.positions.ids())
    EXPECT_LT(placed.tree.distance(placed.frame.to_unit(box.positions[v])), 1e-12);
}

// Segments along an edge or several count, others are said; lengths are the world's.
TEST(Target, TakesLengthsAndFeatureEdgesInTheWorld) {
  constexpr double kScale = 1000;
  const TriMesh box = moved(box_surface({4, 4, 1}), kScale, {5000, 0, 0});
  TargetOptions options;
  const Vec3 a = box.positions[box.tris[TriId(0)][0]], b = box.positions[box.tris[TriId(0)][1]],
             c = box.positions[box.tris[TriId(0)][2]];
  options.features.extra_segments = {{a, b}, {b, c}, {c, a}};  // two are creases, one a diagonal
  EXPECT_EQ(make_target(box, options, {}).features.num_unmatched_segments, 0u);
  EXPECT_EQ(make_target(box, options, {}).features.curves.size(), 13u);
  options.features.extra_segments = {{a, {5000, 0, 0}}};
  std::string warning;
  Context context;
  context.on_warning = [&](std::string_view text) { warning = text; };
  EXPECT_EQ(make_target(box, options, context).features.num_unmatched_segments, 1u);
  EXPECT_NE(warning.find("1 of the feature edges"), std::string::npos) << warning;

  // All edges together are 4 * (4 + 4 + 1) * kScale long.
  options.features.extra_segments.clear();
  options.features.min_length = 35.9 * kScale;
  EXPECT_EQ(make_target(box, options, {}).features.curves.size(), 12u);
  // The rims of a solid that is thinner than they are long stay, however short.
  options.features.min_length = 36.1 * kScale;
  EXPECT_EQ(make_target(box, options, {}).features.curves.size(), 12u);
}

TEST(Target, WrapsASoundSurfaceAsItIs) {
  const TriMesh box = box_surface({3, 2, 1});
  const Target target = wrap_target(box);
  EXPECT_EQ(target.surface().positions, box.positions);
  EXPECT_EQ(target.surface().tris, box.tris);
  EXPECT_EQ(target.features.curves.size(), 12u);
  EXPECT_EQ(target.frame.to_world({1, 2, 3}), (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace hexwright
