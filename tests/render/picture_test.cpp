#include <algorithm>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/render/picture_sheet.h"

#include "helpers.h"
#include "render/camera.h"
#include "render/color.h"
#include "render/visible_faces.h"

namespace hexwright {
namespace {

struct Pixel {
  int r, g, b;
  bool is_red() const { return r > g + 60 && r > b + 60; }
  bool is_blue() const { return b > r + 40; }
  bool is_pale() const { return std::min({r, g, b}) > 225; }  // the background
};

Pixel pixel_at(const Image& image, double x_share, double y_share) {
  const int x = static_cast<int>(x_share * image.width);
  const int y = static_cast<int>(y_share * image.height);
  const std::size_t at = 3 * static_cast<std::size_t>(y * image.width + x);
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

template <class Predicate>
double share_of_pixels(const Image& image, Predicate predicate) {
  int count = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    count += predicate(Pixel{image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
  return 3.0 * count / static_cast<double>(image.rgb.size());
}

// Small, straight on along +y, without a legend.
PictureOptions front_view() {
  PictureOptions options;
  options.width = 120;
  options.height = 120;
  options.view_direction = {0, 1, 0};
  options.draw_legend = false;
  options.draw_edges = false;
  return options;
}

TEST(Picture, FramesTheMeshOnItsBackground) {
  const Image image = render_hex_mesh(test::box_hex_mesh(4, 4, 4), front_view());
  ASSERT_EQ(image.rgb.size(), 3u * 120 * 120);
  EXPECT_TRUE(pixel_at(image, 0.5, 0.5).is_blue());
  EXPECT_TRUE(pixel_at(image, 0.01, 0.01).is_pale());
  EXPECT_TRUE(pixel_at(image, 0.99, 0.99).is_pale());
  // The front face fills the frame but for the margin of 4 % on every side.
  EXPECT_NEAR(share_of_pixels(image, [](Pixel p) { return p.is_blue(); }), 0.92 * 0.92, 0.03);
}

TEST(Picture, WhatIsInFrontHidesWhatIsBehind) {
  const HexMesh mesh = test::box_hex_mesh(1, 2, 1);  // hex 0 at y < 1, hex 1 behind it
  PictureOptions options = front_view();
  options.values = {0, 1};
  EXPECT_TRUE(pixel_at(render_hex_mesh(mesh, options), 0.5, 0.5).is_red());
  options.view_direction = {0, -1, 0};
  EXPECT_TRUE(pixel_at(render_hex_mesh(mesh, options), 0.5, 0.5).is_blue());
}

TEST(Picture, UpIsUpAndRightIsRight) {
  const HexMesh mesh = test::box_hex_mesh(2, 1, 2);
  PictureOptions options = front_view();
  options.values = {1, 1, 1, 0};  // the last hex: x > 1, z > 1
  const Image image = render_hex_mesh(mesh, options);
  EXPECT_TRUE(pixel_at(image, 0.7, 0.3).is_red());
  EXPECT_TRUE(pixel_at(image, 0.3, 0.3).is_blue());
  EXPECT_TRUE(pixel_at(image, 0.7, 0.7).is_blue());
}

TEST(Picture, ACutShowsTheInside) {
  const HexMesh mesh = test::box_hex_mesh(3, 3, 3);
  PictureOptions options = front_view();
  options.values.assign(27, 1);
  options.values[13] = 0;  // the middle
  const auto is_red = [](Pixel p) { return p.is_red(); };
  EXPECT_EQ(share_of_pixels(render_hex_mesh(mesh, options), is_red), 0);
  options.cut.emplace();  // y < 1.5 goes, but the middle's centre lies on the plane and stays
  const Image image = render_hex_mesh(mesh, options);
  EXPECT_TRUE(pixel_at(image, 0.5, 0.5).is_red());
  EXPECT_TRUE(pixel_at(image, 0.2, 0.5).is_blue());
}

TEST(Picture, ACutFadesTheBoundaryAlone) {
  const HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  PictureOptions options = front_view();
  options.view_direction = {0, 0, -1};  // from above: only boundary faces are seen
  options.cut.emplace();
  options.cut->offset = 0.9;
  const auto is_blue = [](Pixel p) { return p.is_blue(); };
  EXPECT_EQ(share_of_pixels(render_hex_mesh(mesh, options), is_blue), 0);
  options.fade_boundary = false;
  EXPECT_GT(share_of_pixels(render_hex_mesh(mesh, options), is_blue), 0.5);
}

TEST(Picture, EdgesAreDarkLines) {
  PictureOptions options = front_view();
  options.draw_edges = true;
  const auto is_dark = [](Pixel p) { return std::max({p.r, p.g, p.b}) < 110; };
  const HexMesh mesh = test::box_hex_mesh(4, 1, 4);
  const double with_edges = share_of_pixels(render_hex_mesh(mesh, options), is_dark);
  options.draw_edges = false;
  EXPECT_GT(with_edges, share_of_pixels(render_hex_mesh(mesh, options), is_dark) + 0.02);
}

TEST(Picture, IsTheSameForAnyNumberOfThreads) {
  const HexMesh mesh = test::box_hex_mesh(9, 8, 7);
  PictureOptions options;
  options.width = 300;
  options.height = 200;
  options.cut.emplace();
  std::vector<Image> images;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    images.push_back(render_hex_mesh(mesh, options));
  }
  EXPECT_EQ(images[0].rgb, images[1].rgb);
}

TEST(Picture, InvertedAndNonConformingHexesAreDrawn) {
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  std::swap_ranges(mesh.hexes[HexId(0)].begin(), mesh.hexes[HexId(0)].begin() + 4,
                   mesh.hexes[HexId(0)].begin() + 4);  // inside out: the colour of -1
  for (int i = 0; i < 3; ++i) mesh.hexes.push_back(mesh.hexes[HexId(0)]);
  EXPECT_TRUE(pixel_at(render_hex_mesh(mesh, front_view()), 0.5, 0.5).is_red());
}

TEST(Picture, OfNothingIsBackground) {
  PictureOptions options = front_view();
  options.draw_legend = true;
  options.width = 400;
  EXPECT_TRUE(pixel_at(render_hex_mesh(HexMesh{}, options), 0.3, 0.5).is_pale());
}

TEST(Picture, TheLegendHasTheScaleAndItsNumbers) {
  PictureOptions options;
  options.width = 600;
  options.height = 450;
  const Image image = render_hex_mesh(test::box_hex_mesh(2, 2, 2), options);
  Image legend{150, 450, {}};
  for (int y = 0; y < 450; ++y)
    for (int x = 450; x < 600; ++x)
      for (int k = 0; k < 3; ++k)
        legend.rgb.push_back(image.rgb[static_cast<std::size_t>(3 * (y * 600 + x) + k)]);
  EXPECT_GT(share_of_pixels(legend, [](Pixel p) { return p.is_red(); }), 0.003);
  EXPECT_GT(share_of_pixels(legend, [](Pixel p) { return p.is_blue(); }), 0.003);
  EXPECT_GT(share_of_pixels(legend, [](Pixel p) { return p.r < 200 && p.r == p.b; }), 0.0015);
}

TEST(Picture, ByPatchFacesHaveTheColoursOfTheLegend) {
  HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary)
    mesh.labels.quads.push_back({face_verts(mesh, face), PatchId(face.lf)});
  PictureOptions options = front_view();  // sees face 2, -y
  options.colors = PictureColors::Patches;
  const Pixel green = pixel_at(render_hex_mesh(mesh, options), 0.5, 0.5);
  EXPECT_TRUE(green.g > green.r + 20 && green.g > green.b + 20);
  options.draw_legend = true;
  options.width = 400;
  const Image image = render_hex_mesh(mesh, options);
  EXPECT_GT(share_of_pixels(image, [](Pixel p) { return p.r == 102 && p.g == 166; }), 1e-4);
}

TEST(Views, ACutInTheMiddleGivesWayToAFaceThatLiesAlongIt) {
  const HexMesh box = test::box_hex_mesh(40, 4, 4);
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(find_clear_cut(box, axis), 0.5);
  // A step in the middle: the upper half of the box is gone where x > 20.
  HexMesh step = box;
  step.hexes.clear();
  for (const auto& hex : box.hexes) {
    Vec3 center;
    for (VertId v : hex) center += box.positions[v] / 8;
    if (center.x < 20 || center.z < 2) step.hexes.push_back(hex);
  }
  EXPECT_NEAR(std::abs(find_clear_cut(step, 0) - 0.5), 0.04, 1e-12);  // a hex is 0.025 thick
  EXPECT_EQ(find_clear_cut(step, 1), 0.5);
  EXPECT_EQ(find_clear_cut(HexMesh{}, 0), 0.5);
}

TEST(Picture, TheLegendNamesThePatchesThatAreSeen) {
  HexMesh mesh = test::box_hex_mesh(2, 2, 2);
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary)
    mesh.labels.quads.push_back({face_verts(mesh, face), PatchId(face.lf)});
  PictureOptions options = make_cut_view(1, 0.5);  // takes face 2, -y, which is green
  options.width = options.height = 400;
  options.colors = PictureColors::Patches;
  const auto is_green = [](Pixel p) { return p.r == 102 && p.g == 166; };
  EXPECT_EQ(share_of_pixels(render_hex_mesh(mesh, options), is_green), 0);
  options.cut.reset();
  EXPECT_GT(share_of_pixels(render_hex_mesh(mesh, options), is_green), 1e-4);
  options.view_direction = -options.view_direction;
  EXPECT_EQ(share_of_pixels(render_hex_mesh(mesh, options), is_green), 0);
}

TEST(Sheet, HasSixViewsAndALegend) {
  HexMesh mesh = test::box_hex_mesh(6, 5, 4);
  mesh.positions[VertId(7 * 6 * 2 + 7 * 2 + 3)] += Vec3{0.5, 0.4, 0.3};  // one inside is off
  SheetOptions options;
  options.width = 600;
  options.height = 400;
  options.supersample = 1;
  const Image sheet = render_sheet(mesh, options);
  ASSERT_EQ(sheet.rgb.size(), 3U * 600 * 400);
  const ThreadLimit one(1);
  EXPECT_EQ(render_sheet(mesh, options).rgb, sheet.rgb);
  // Something is drawn in the middle of each of the six.
  for (double x : {0.14, 0.42, 0.7})
    for (double y : {0.31, 0.77}) EXPECT_FALSE(pixel_at(sheet, x, y).is_pale()) << x << " " << y;
  EXPECT_THROW(render_sheet(HexMesh{}, options), Error);
  options.width = 100;
  EXPECT_THROW(render_sheet(mesh, options), Error);
}

TEST(Picture, RejectsOptionsOutOfRange) {
  const HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  const auto rejects = [&](auto change) {
    PictureOptions options = front_view();
    change(options);
    EXPECT_THROW(render_hex_mesh(mesh, options), Error);
  };
  rejects([](PictureOptions& o) { o.width = 0; });
  rejects([](PictureOptions& o) { o.height = 1 << 20; });
  rejects([](PictureOptions& o) { o.supersample = 0; });
  rejects([](PictureOptions& o) { o.view_direction = {}; });
  rejects([](PictureOptions& o) { o.values = {1, 1}; });
  rejects([](PictureOptions& o) { o.cut = PictureOptions::Cut{{0, 0, 0}, 0.5}; });
}

TEST(Camera, FramesPointsFromAnyDirection) {
  std::vector<Vec3> points;
  for (int b = 0; b < 8; ++b)
    points.push_back(1e4 * Vec3{double(b & 1), 7 * double(b >> 1 & 1), 3 * double(b >> 2 & 1)});
  const Viewport viewport{10, 20, 300, 200};
  for (const Vec3& direction : {Vec3{-1, 2, -0.8}, {1, 0, 0}, {0, 0, -1}, {0, 0, 1}, {3, 3, 3}}) {
    const Camera camera(points, direction, viewport);
    Box3 frame;
    for (const Vec3& p : points) {
      const ScreenPoint s = camera.project(p);
      frame.extend(Vec3{s.x, s.y, 0});
      EXPECT_GT(s.nearness, 0);
    }
    EXPECT_GE(frame.lo.x, 10 - 1e-9);
    EXPECT_GE(frame.lo.y, 20 - 1e-9);
    EXPECT_LE(frame.hi.x, 310 + 1e-9);
    EXPECT_LE(frame.hi.y, 220 + 1e-9);
    // It touches the frame in one direction.
    EXPECT_NEAR(std::max(frame.extent().x / 300, frame.extent().y / 200), 1, 1e-9);
  }
}

TEST(QualityColor, RunsFromRedToBlueAndClamps) {
  EXPECT_GT(quality_color(0).r, quality_color(0).b + 0.4F);
  EXPECT_GT(quality_color(1).b, quality_color(1).r + 0.4F);
  EXPECT_EQ(quality_color(-3).r, quality_color(0).r);
  EXPECT_EQ(quality_color(3).b, quality_color(1).b);
  EXPECT_EQ(quality_color(std::nan("")).r, 0.5F);
}

TEST(VisibleFaces, AreTheBoundaryOfWhatTheCutLeaves) {
  const HexMesh mesh = test::box_hex_mesh(4, 4, 4);
  EXPECT_EQ(find_visible_faces(mesh, std::nullopt).size(), 96u);
  const auto faces = find_visible_faces(mesh, PictureOptions::Cut{});
  EXPECT_EQ(faces.size(), 2u * (16 + 8 + 8));  // a box of 4 x 2 x 4
  EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [](auto f) { return !f.is_boundary; }), 16);
}

/// A cube whose top bulges.
TEST(Picture, DrawsEdgesOfSecondOrderCurved) {
  HexMesh mesh = test::box_hex_mesh(1, 1, 1);
  mesh.mid_nodes = make_straight_mid_nodes(mesh);
  for (std::size_t le : {4, 6})  // of the top, along x
    mesh.mid_nodes->edges[mesh.mid_nodes->hex_to_edge[HexId(0)][le]].z += 0.4;
  const Image curved = render_hex_mesh(mesh, front_view());
  mesh.mid_nodes.reset();
  const Image straight = render_hex_mesh(mesh, front_view());
  const auto is_seen = [](Pixel p) { return !p.is_pale(); };
  // The frame grows by the bulge: of 1 x 1.4 the shape takes 1 + 2/3 of 0.4.
  EXPECT_NEAR(share_of_pixels(straight, is_seen), 0.92 * 0.92, 0.03);
  EXPECT_NEAR(share_of_pixels(curved, is_seen), 0.92 * 0.92 * (1 + 0.8 / 3) / (1.4 * 1.4), 0.03);
  EXPECT_TRUE(is_seen(pixel_at(curved, 0.5, 0.1)));
  EXPECT_FALSE(is_seen(pixel_at(curved, 0.22, 0.1)));
}

}  // namespace
}  // namespace hexwright
