// From a labelled surface to a polycube map, and on to its hexes.
#include "hexwright/pipeline/polycube_map.h"

#include <cmath>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/polycube/polycube.h"
#include "hexwright/quality/hex_quality.h"

#include "helpers.h"
#include "polycube/tet_builders.h"
#include "polycube/tets/tet_boundary.h"
#include "polycube/tets/tet_locator.h"

namespace hexwright {
namespace {

std::vector<std::uint8_t> labels_of_places(const TriMesh& surface) {
  std::vector<std::uint8_t> labels;
  for (TriId t : surface.tris.ids()) {
    const auto p = surface.corners(t);
    const Vec3 c = p[0] + p[1] + p[2];
    int axis = 0;
    for (int a = 1; a < 3; ++a)
      if (std::abs(c[a]) > std::abs(c[axis])) axis = a;
    labels.push_back(static_cast<std::uint8_t>(2 * axis + (c[axis] < 0)));
  }
  return labels;
}

// A cube's surface, cut into squares, blown up to a ball.
TriMesh round_cube(int cuts) {
  const TetMesh cube = test::tet_cubes({{0, 0, 0}}, cuts);
  TriMesh surface{cube.positions, polycube::boundary_facets(cube), {}, {}};
  for (Vec3& p : surface.positions) {
    const Vec3 q = p - Vec3{0.5, 0.5, 0.5};
    p = normalized(q) * (2 * std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z)}));
  }
  return surface;
}

TEST(PolycubeMap, BallBecomesACubeAndHexes) {
  const TriMesh ball = round_cube(6);
  PolycubeMapOptions options;
  options.tolerance = 0.02;
  const PolycubeMap map = make_polycube_map(ball, labels_of_places(ball), options, {});
  EXPECT_EQ(map.num_charts, 6u);
  EXPECT_EQ(map.num_corners, 8u);
  EXPECT_LT(map.max_distance, 0.04);
  EXPECT_EQ(map.object.tets, map.polycube.tets);
  EXPECT_EQ(polycube::count_nonpositive(map.object), 0u);
  EXPECT_EQ(polycube::count_nonpositive(map.polycube), 0u);
  EXPECT_GT(map.least_stretch, 0);
  EXPECT_GT(map.greatest_stretch, map.least_stretch);

  PolycubeOptions coarse;
  coarse.max_stretch = 0.2;
  coarse.max_surface_error = 0.02;
  const PolycubeResult hexes = mesh_polycube(map.object, map.polycube, coarse, {});
  EXPECT_TRUE(hexes.verdict.is_valid());
  EXPECT_EQ(hexes.report.num_charts, 6u);
  EXPECT_NEAR(summarize_quality(hexes.mesh).total_volume, 4.0 / 3 * 3.14159, 0.4);
}

TEST(PolycubeMap, NamesItsOwnBudget) {
  const TriMesh ball = round_cube(2);
  PolycubeMapOptions options;
  options.max_hexes = 5;
  try {
    make_polycube_map(ball, labels_of_places(ball), options, {});
    FAIL() << "made of five hexes";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::OutOfResources);
    const std::string said = error.what();
    EXPECT_NE(said.find("--map-hexes"), std::string::npos) << said;
    EXPECT_EQ(said.find("--max-hexes"), std::string::npos) << said;
  }
}

TEST(PolycubeMap, RefusesWhatIsNoPolycubeBeforeMeshing) {
  const TriMesh ball = round_cube(2);
  auto labels = labels_of_places(ball);
  try {
    make_polycube_map(ball, std::span(labels).first(7), {}, {});
    FAIL() << "seven labels were taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadArgument);
    EXPECT_NE(std::string(error.what()).find("give one per triangle"), std::string::npos)
        << error.what();
  }
  for (std::uint8_t& label : labels) label = label == 5 ? 4 : label;
  try {
    make_polycube_map(ball, labels, {}, {});
    FAIL() << "a labelling without -z was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no triangle is labelled -z"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace hexwright
