// Names of a surface's parts through preparation, and the features and names they give.
#include "hexwright/geometry/surface_names.h"

#include <gtest/gtest.h>

#include "hexwright/geometry/prepare_surface.h"

#include "helpers.h"

namespace hexwright {
namespace {

/// The unit cube whose sides are the groups "x-", "x+" ... but for the two top triangles, which are
/// "left" and "right", parted by a diagonal in a plane.
TriMesh named_cube() {
  TriMesh cube = test::unit_cube_surface();
  cube.group_names = {"x-", "x+", "y-", "y+", "z-", "left", "right"};
  for (TriId t : cube.tris.ids()) cube.group.push_back(t.value() < 11 ? t.value() / 2 : 6);
  return cube;
}

std::string group_of(const TriMesh& mesh, TriId t) {
  return mesh.group[t] < 0 ? "-" : mesh.group_names[static_cast<std::size_t>(mesh.group[t])];
}

/// Every triangle of the cube's side planes has the side's group.
void expect_groups_in_place(const TriMesh& mesh) {
  ASSERT_FALSE(mesh.find_problem());
  ASSERT_EQ(mesh.group.size(), mesh.num_tris());
  for (TriId t : mesh.tris.ids()) {
    const auto c = mesh.corners(t);
    const Vec3 n = normalized(cross(c[1] - c[0], c[2] - c[0]));
    const char axis = n.x != 0 ? 'x' : n.y != 0 ? 'y' : 'z';
    const std::string side = {axis, n.x + n.y + n.z > 0 ? '+' : '-'};
    if (side == "z+")
      EXPECT_TRUE(group_of(mesh, t) == "left" || group_of(mesh, t) == "right");
    else
      EXPECT_EQ(group_of(mesh, t), side);
  }
}

TEST(SurfaceNames, StayThroughWeldingTurningAndCleaning) {
  const TriMesh cube = named_cube();
  TriMesh soup;  // unwelded, with a needle and a duplicate in front, every third triangle turned
  soup.group_names = cube.group_names;
  const auto add = [&](TriId t, bool is_turned) {
    std::array<VertId, 3> tri;
    for (std::size_t k = 0; k < 3; ++k)
      tri[k] = soup.positions.push_back(cube.positions[cube.tris[t][k]]);
    if (is_turned) std::swap(tri[1], tri[2]);
    soup.tris.push_back(tri);
    soup.group.push_back(cube.group[t]);
  };
  soup.tris.push_back({VertId(0), VertId(0), VertId(1)});
  soup.group.push_back(6);
  add(TriId(3), false);
  for (TriId t : cube.tris.ids()) add(t, t.value() % 3 == 2);
  const PreparedSurface prepared = prepare_surface(soup, {});
  EXPECT_EQ(prepared.mesh.num_tris(), 12u);
  EXPECT_GT(prepared.diagnosis.num_flipped_tris, 0u);
  expect_groups_in_place(prepared.mesh);
}

TEST(SurfaceNames, AHoleInsideOneGroupIsClosedWithoutAName) {
  TriMesh cube = named_cube();
  cube.group.assign(12, 0);
  cube.tris.resize(10);  // without its top
  cube.group.resize(10);
  const PreparedSurface prepared = prepare_surface(cube, {});
  const TriMesh& closed = prepared.mesh;
  ASSERT_EQ(closed.num_tris(), 12u);
  for (TriId t : closed.tris.ids())
    EXPECT_EQ(closed.group[t], prepared.source_tri[t].is_valid() ? 0 : -1);
  EXPECT_EQ(name_of_body(closed), "x-");
}

TEST(SurfaceNames, AHoleBetweenGroupsTakesThatWithMostOfTheBorder) {
  TriMesh cube = named_cube();
  cube.group.assign(12, 1);
  cube.group[TriId(0)] = cube.group[TriId(1)] = 0;
  cube.tris.resize(10);
  cube.group.resize(10);
  const PreparedSurface prepared = prepare_surface(cube, {});
  for (TriId t : prepared.mesh.tris.ids())
    if (!prepared.source_tri[t].is_valid()) {
      EXPECT_EQ(prepared.mesh.group[t], 1);
    }
}

TEST(SurfaceNames, ABorderBetweenGroupsIsAFeatureWhateverItsAngle) {
  TriMesh cube = named_cube();
  EXPECT_EQ(extract_features(cube, {}).curves.size(), 13u);
  EXPECT_EQ(extract_features(SurfaceTree(cube), {}).curves.size(), 13u);
  cube.group[TriId(11)] = -1;  // added, not named: no border of its own
  EXPECT_EQ(extract_features(cube, {}).curves.size(), 12u);
  cube.group.clear();
  EXPECT_EQ(extract_features(cube, {}).curves.size(), 12u);
}

TEST(SurfaceNames, CurvesAreNamedByTheGroupsOnBothSides) {
  TriMesh cube = named_cube();
  const FeatureGraph features = extract_features(cube, {});
  const auto names = name_curves(cube, features);
  ASSERT_EQ(names.size(), 13u);
  EXPECT_EQ(std::count(names.begin(), names.end(), "left-right"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "x--y-"), 1);
  for (std::int32_t& group : cube.group) group = group == 0 ? 0 : 1;
  const auto two = name_curves(cube, extract_features(cube, {}));
  EXPECT_EQ(std::count(two.begin(), two.end(), ""), 8);
  EXPECT_EQ(std::count(two.begin(), two.end(), "x+-x-.4"), 1);
  cube.group.assign(12, 3);
  EXPECT_TRUE(name_curves(cube, features).empty());
  EXPECT_EQ(name_of_body(cube), "y+");
  EXPECT_FALSE(has_named_patches(cube));
}

TEST(SurfaceNames, RepeatedOnesAreNumbered) {
  std::vector<std::string> names = {"wall", "inlet", "", "wall", ""};
  number_repeated(names);
  EXPECT_EQ(names, (std::vector<std::string>{"wall.1", "inlet", "", "wall.2", ""}));
  names = {"wall", "wall.2", "wall", "wall.1"};
  number_repeated(names);
  EXPECT_EQ(names, (std::vector<std::string>{"wall.3", "wall.2", "wall.4", "wall.1"}));
}

}  // namespace
}  // namespace hexwright
