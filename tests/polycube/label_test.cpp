// Labelled surfaces: which labellings are those of a polycube, and the deformation to it.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "hexwright/base/error.h"
#include "hexwright/polycube/deform.h"
#include "hexwright/polycube/polycube.h"
#include "hexwright/polycube/surface_labels.h"
#include "hexwright/quality/hex_quality.h"

#include "helpers.h"
#include "polycube/tet_builders.h"
#include "polycube/tets/tet_boundary.h"
#include "polycube/tets/tet_locator.h"

namespace hexwright {
namespace {

using Facet = std::array<VertId, 3>;

std::uint8_t label_of_normal(const Vec3& n) {
  int axis = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(n[a]) > std::abs(n[axis])) axis = a;
  return static_cast<std::uint8_t>(2 * axis + (n[axis] < 0));
}

std::uint8_t label_in(const TetMesh& mesh, const Facet& f) {
  const auto& p = mesh.positions;
  return label_of_normal(cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]));
}

std::vector<std::uint8_t> labels_of_normals(const TriMesh& surface) {
  std::vector<std::uint8_t> labels;
  for (TriId t : surface.tris.ids()) {
    const auto p = surface.corners(t);
    labels.push_back(label_of_normal(cross(p[1] - p[0], p[2] - p[0])));
  }
  return labels;
}

std::string message_of(const TriMesh& surface, const std::vector<std::uint8_t>& labels) {
  try {
    find_label_charts(surface, labels);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadGeometry);
    return error.what();
  }
  return "";
}

TEST(SurfaceLabels, CubeHasSixChartsAndEightCorners) {
  const TriMesh cube = test::unit_cube_surface();
  const LabelCharts charts = find_label_charts(cube, labels_of_normals(cube));
  EXPECT_EQ(charts.chart_label.size(), 6u);
  EXPECT_EQ(charts.corners.size(), 8u);
  EXPECT_EQ(label_name(0) + label_name(1) + label_name(2) + label_name(5), "+x-x+y-z");
}

TEST(SurfaceLabels, OppositeFacesMayNotShareAnEdge) {
  const TriMesh cube = test::unit_cube_surface();
  auto labels = labels_of_normals(cube);
  for (std::uint8_t& label : labels)
    if (label == 2) label = 1;  // the faces +y and -x become neighbours of +x and of each other
  const std::string message = message_of(cube, labels);
  EXPECT_NE(message.find("faces +x and -x share an edge at ("), std::string::npos) << message;
  EXPECT_NE(message.find("put a face of another axis between them"), std::string::npos) << message;
}

TEST(SurfaceLabels, FacesNeedFourCorners) {
  const TetMesh cube = test::tet_cubes({{0, 0, 0}}, 3);
  TriMesh surface{cube.positions, polycube::boundary_facets(cube), {}, {}};
  auto labels = labels_of_normals(surface);
  for (TriId t : surface.tris.ids()) {  // a patch of +y in the middle of +z
    const auto p = surface.corners(t);
    const Vec3 c = (p[0] + p[1] + p[2]) / 3.0;
    if (labels[t.index()] == 4 && std::abs(c.x - 0.5) < 0.2 && std::abs(c.y - 0.5) < 0.2)
      labels[t.index()] = 2;
  }
  const std::string message = message_of(surface, labels);
  EXPECT_NE(message.find("has 0 corners; it needs four or more"), std::string::npos) << message;
}

TEST(SurfaceLabels, OnlyThreeFacesMeetInACorner) {
  const TetMesh cube = test::tet_cubes({{0, 0, 0}}, 2);
  TriMesh surface{cube.positions, polycube::boundary_facets(cube), {}, {}};
  auto labels = labels_of_normals(surface);
  // Two opposite quarters of the face +z join the faces +x and -x, and touch in its middle.
  for (TriId t : surface.tris.ids()) {
    const auto p = surface.corners(t);
    const Vec3 c = (p[0] + p[1] + p[2]) / 3.0;
    if (labels[t.index()] != 4) continue;
    if (c.x > 0.5 && c.y > 0.5) labels[t.index()] = 0;
    if (c.x < 0.5 && c.y < 0.5) labels[t.index()] = 1;
  }
  const std::string message = message_of(surface, labels);
  EXPECT_NE(message.find("4 borders of faces meet at (0.5, 0.5, 1)"), std::string::npos) << message;
}

TEST(SurfaceLabels, RefusesOpenSurfacesAndWrongCounts) {
  TriMesh cube = test::unit_cube_surface();
  const auto labels = labels_of_normals(cube);
  EXPECT_THROW(find_label_charts(cube, std::span(labels).first(5)), Error);
  auto wrong = labels;
  wrong[3] = 6;
  try {
    find_label_charts(cube, wrong);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::BadArgument);
    EXPECT_NE(std::string(error.what()).find("triangle 3 is 6"), std::string::npos);
  }
  cube.tris.raw().pop_back();
  EXPECT_NE(message_of(cube, {labels.begin(), labels.end() - 1}).find("not closed"),
            std::string::npos);
}

/// Bends a bar along x by an angle, about an axis along y.
TetMesh bent(const TetMesh& bar, double length, double angle) {
  return test::mapped(bar, [=](Vec3 p) {
    const double turn = p.x / length * angle, radius = length / angle + 0.5 - p.z;
    return Vec3{radius * std::sin(turn), p.y, -radius * std::cos(turn)};
  });
}

void expect_polycube(const TetMesh& object, const Deformation& d) {
  EXPECT_EQ(d.polycube.tets, object.tets);
  EXPECT_EQ(polycube::count_nonpositive(d.polycube), 0u);
  EXPECT_GT(d.least_det, 0);
  // Exactly flat: one coordinate per chart.
  std::vector<double> plane(d.charts.chart_label.size(), std::nan(""));
  for (TriId t : d.surface.tris.ids()) {
    const auto chart = static_cast<std::size_t>(d.charts.chart[t]);
    const int axis = label_axis(d.charts.chart_label[chart]);
    const auto& f = d.surface.tris[t];
    const auto& p = d.polycube.positions;
    const Vec3 n = cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]);
    EXPECT_GT(n[axis] * label_sign(d.charts.chart_label[chart]), 0);
    for (VertId v : f) {
      if (std::isnan(plane[chart])) plane[chart] = p[v][axis];
      EXPECT_EQ(p[v][axis], plane[chart]);
    }
  }
}

// The bar's ends look the same way: labels by normals could not tell them apart.
TEST(Deform, StraightensABarBentByHalfATurn) {
  const TetMesh bar = test::tet_cubes({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, 3);
  const TetMesh object = bent(bar, 5, std::numbers::pi);
  const Deformation d =
      deform_to_polycube(object, [&](const Facet& f) { return label_in(bar, f); }, {});
  expect_polycube(object, d);
  EXPECT_EQ(d.charts.chart_label.size(), 6u);
  Box3 box;
  for (const Vec3& p : d.polycube.positions) box.extend(p);
  const Vec3 e = box.extent();
  EXPECT_NEAR(e.x / e.y, 5, 0.5);  // the length of its middle line
  EXPECT_NEAR(e.z / e.y, 1, 0.2);
}

TEST(Deform, RoundFrameKeepsItsHole) {
  std::vector<LatticeCoord> cubes;
  for (int x = 0; x < 3; ++x)
    for (int y = 0; y < 3; ++y)
      if (x != 1 || y != 1) cubes.push_back({x, y, 0});
  const TetMesh frame = test::tet_cubes(cubes, 3);
  const TetMesh object = test::mapped(frame, [](Vec3 p) {
    const Vec3 q = p - Vec3{1.5, 1.5, 0.5};
    const double most = std::max(std::abs(q.x), std::abs(q.y)),
                 length = std::sqrt(q.x * q.x + q.y * q.y);
    return Vec3{q.x * most / length, q.y * most / length, q.z};
  });
  // At the frame's edges the round object's tets are nearly flat, but positive.
  ASSERT_EQ(polycube::count_nonpositive(object), 0u);
  const Deformation d =
      deform_to_polycube(object, [&](const Facet& f) { return label_in(frame, f); }, {});
  expect_polycube(object, d);
  EXPECT_EQ(d.charts.chart_label.size(), 10u);
  EXPECT_EQ(d.charts.corners.size(), 16u);
}

// Every corner of the upside-down step is that of a polycube; the whole is not.
TEST(Deform, FacesThatCannotLookTheirWayAreRefused) {
  const TetMesh stair = test::tet_cubes({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, 2);
  const auto label_of = [&](const Facet& f) -> std::uint8_t {
    const std::uint8_t label = label_in(stair, f);
    const auto& p = stair.positions;
    const double x = (p[f[0]].x + p[f[1]].x + p[f[2]].x) / 3,
                 z = (p[f[0]].z + p[f[1]].z + p[f[2]].z) / 3;
    return label == 4 && x > 1 && z > 0.9 ? 5 : label;  // the tread looks down
  };
  try {
    deform_to_polycube(stair, label_of, {});
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("comes to look the other way"), std::string::npos) << text;
  }
}

TEST(Deform, IsTheSameAtAnyScale) {
  const TetMesh bar = test::tet_cubes({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, 2);
  const TetMesh object = test::mapped(bar, [](Vec3 p) {
    return p + Vec3{0.1 * p.z * p.z, 0, 0.1 * p.x * p.y};
  });
  const auto label_of = [&](const Facet& f) { return label_in(bar, f); };
  const Deformation d = deform_to_polycube(object, label_of, {});
  expect_polycube(object, d);
  const TetMesh tiny = test::mapped(object, [](Vec3 p) { return p * 0x1p-30; });
  const Deformation small = deform_to_polycube(tiny, label_of, {});
  for (VertId v : object.positions.ids())
    EXPECT_NEAR(distance(small.polycube.positions[v] * 0x1p30, d.polycube.positions[v]), 0, 1e-9);
}

}  // namespace
}  // namespace hexwright
