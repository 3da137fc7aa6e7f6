// The unit frame over the whole range of doubles.
#include "hexwright/geometry/similarity.h"

#include <gtest/gtest.h>

#include "geometry/random_soup.h"
#include "helpers.h"

namespace hexwright {
namespace {

double longest_side(const TriMesh& mesh) {
  const Vec3 e = bounding_box(mesh).extent();
  return std::max({e.x, e.y, e.z});
}

TEST(Similarity, TheUnitFrameHoldsTheBoxWhateverTheScale) {
  std::mt19937_64 random(61);
  for (double scale : {1e-300, 1e-150, 1e-20, 1.0, 3.7, 1e20, 1e150, 1e300}) {
    TriMesh mesh = test::unit_cube_surface();
    for (Vec3& p : mesh.positions) p = (p + test::random_point(random, 0.2)) * scale;
    const Similarity frame = compute_unit_frame(mesh);
    const TriMesh unit = to_unit(mesh, frame);
    EXPECT_GE(longest_side(unit), 1) << scale;
    EXPECT_LT(longest_side(unit), 2) << scale;
    const Vec3 middle = bounding_box(unit).center();
    EXPECT_NEAR(norm(middle), 0, 1e-15) << scale;
    EXPECT_EQ(unit.tris, mesh.tris);
  }
}

// Only the shift rounds: around the origin the way to the unit frame and back loses not one bit.
TEST(Similarity, ScalingIsExactAndTheShiftRoundsOnce) {
  std::mt19937_64 random(62);
  for (int exponent : {-1000, -300, -3, 0, 5, 300, 1000}) {
    const Similarity centered{{}, exponent};
    const Similarity moved{test::random_point(random, 10), exponent};
    for (int i = 0; i < 100; ++i) {
      const Vec3 u = test::random_point(random, 2);
      EXPECT_EQ(centered.to_unit(centered.to_world(u)), u);
      const Vec3 there_and_back = moved.to_unit(moved.to_world(u));
      EXPECT_LE(distance(there_and_back, u), 1e-14 / moved.length_to_world(1) + 1e-14);
      EXPECT_EQ(centered.length_to_unit(centered.length_to_world(u.x)), u.x);
    }
  }
}

// Doubling a model doubles the frame and leaves the unit surface as it was, bit by bit.
TEST(Similarity, TheUnitSurfaceIsTheSameForEveryPowerOfTwo) {
  const TriMesh soup = test::random_soup(50, 63);
  const TriMesh reference = to_unit(soup, compute_unit_frame(soup));
  for (int exponent : {-900, -64, -1, 1, 10, 700}) {
    TriMesh scaled = soup;
    for (Vec3& p : scaled.positions)
      for (int a = 0; a < 3; ++a) p[a] = std::ldexp(p[a], exponent);
    EXPECT_EQ(to_unit(scaled, compute_unit_frame(scaled)).positions, reference.positions)
        << "2^" << exponent;
  }
}

TEST(Similarity, SurfacesWithoutExtentHaveTheIdentity) {
  TriMesh point;
  for (int i = 0; i < 3; ++i) point.positions.push_back({7, 7, 7});
  point.tris = {{VertId(0), VertId(1), VertId(2)}};
  for (const TriMesh& mesh : {TriMesh{}, point}) {
    const Similarity frame = compute_unit_frame(mesh);
    EXPECT_EQ(frame.exponent, 0);
    EXPECT_EQ(frame.to_unit({1, 2, 3}), (Vec3{1, 2, 3}));
  }
}

}  // namespace
}  // namespace hexwright
