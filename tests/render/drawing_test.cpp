// Camera, colours, letters, the legend, what a cut leaves, and images read back.
#include <algorithm>
#include <bit>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <zlib.h>

#include "helpers.h"
#include "io/temp_folder.h"
#include "render/camera.h"
#include "render/color.h"
#include "render/creases.h"
#include "render/font.h"
#include "render/legend.h"
#include "render/visible_faces.h"

namespace hexwright {
namespace {

Vec3 random_vec(std::mt19937_64& random) {
  const auto one = [&] { return 2 * double(random() >> 11) / double(1ull << 53) - 1; };
  const double x = one(), y = one(), z = one();
  return {x, y, z};
}

std::vector<Vec3> random_points(std::size_t count, std::mt19937_64& random) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(random_vec(random));
  return points;
}

// The rasteriser interpolates nearness linearly on the screen, which is right for a camera whose
// straight lines stay straight and whose nearness is 1 / depth.
TEST(Camera, StraightLinesStayStraightAndNearnessIsLinearAlongThem) {
  std::mt19937_64 random(21);
  const auto points = random_points(20, random);
  const Camera camera(points, {-1, 2, -0.8}, {0, 0, 640, 480});
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = random_vec(random), b = random_vec(random);
    const double t = 0.05 + 0.9 * std::abs(random_vec(random).x);
    const ScreenPoint p = camera.project(a), q = camera.project(b);
    const ScreenPoint m = camera.project(a * (1 - t) + b * t);
    const double cross2 = (q.x - p.x) * (m.y - p.y) - (q.y - p.y) * (m.x - p.x);
    EXPECT_NEAR(cross2 / std::hypot(q.x - p.x, q.y - p.y), 0, 1e-9);
    const bool by_x = std::abs(q.x - p.x) > std::abs(q.y - p.y);
    const double s = by_x ? (m.x - p.x) / (q.x - p.x) : (m.y - p.y) / (q.y - p.y);
    EXPECT_NEAR(m.nearness, p.nearness + s * (q.nearness - p.nearness), 1e-12);
    EXPECT_TRUE(s > 0 && s < 1);
  }
}

// Nearness is one over the distance along the view, in diagonals; the eye stands 3.5 of them from
// the box's centre, which is straight ahead.
TEST(Camera, NearnessIsTheInverseDistanceAlongTheView) {
  std::mt19937_64 random(27);
  for (int round = 0; round < 20; ++round) {
    const auto points = random_points(10, random);
    Box3 box;
    for (const Vec3& p : points) box.extend(p);
    const Vec3 forward = normalized(random_vec(random));
    const Vec3 side = normalized(cross(forward, random_vec(random)));
    const Camera camera(points, forward, {0, 0, 100, 100});
    const ScreenPoint middle = camera.project(box.center());
    EXPECT_NEAR(middle.nearness, 1 / 3.5, 1e-12);
    for (double depth : {-0.5, 0.25, 2.0}) {
      const Vec3 p = box.center() + forward * (depth * box.diagonal());
      EXPECT_NEAR(camera.project(p).nearness, 1 / (3.5 + depth), 1e-12);
      EXPECT_NEAR(camera.project(p).x, middle.x, 1e-9);  // on the optical axis
      EXPECT_NEAR(camera.project(p).y, middle.y, 1e-9);
      const ScreenPoint beside = camera.project(p + side * box.diagonal());
      EXPECT_NEAR(beside.nearness, 1 / (3.5 + depth), 1e-12);
      EXPECT_NEAR(std::hypot(beside.x - middle.x, beside.y - middle.y),
                  camera.focal_length() / (3.5 + depth), 1e-9);
    }
  }
}

// The picture does not change with the model's units or place.
TEST(Camera, FollowsScaleAndPosition) {
  std::mt19937_64 random(22);
  const auto points = random_points(15, random);
  const Viewport viewport = {5, 7, 300, 200};
  const Camera reference(points, {1, 2, -1}, viewport);
  for (double scale : {1e-100, 1e-6, 25.4, 1e9, 1e100}) {
    std::vector<Vec3> moved;
    for (const Vec3& p : points) moved.push_back((p + Vec3{10, -20, 5}) * scale);
    const Camera camera(moved, {1, 2, -1}, viewport);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const ScreenPoint a = reference.project(points[i]), b = camera.project(moved[i]);
      EXPECT_NEAR(a.x, b.x, 1e-9) << scale;
      EXPECT_NEAR(a.y, b.y, 1e-9) << scale;
      EXPECT_NEAR(a.nearness, b.nearness, 1e-12) << scale;
    }
  }
}

TEST(Camera, ItsFrameIsRightHandedWithUpTowardsZ) {
  std::mt19937_64 random(23);
  const auto points = random_points(10, random);
  std::vector<Vec3> directions = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}};
  for (int i = 0; i < 50; ++i) directions.push_back(random_vec(random));
  for (const Vec3& direction : directions) {
    const Camera camera(points, direction, {0, 0, 100, 100});
    const Vec3 x = camera.to_view({1, 0, 0}), y = camera.to_view({0, 1, 0}),
               z = camera.to_view({0, 0, 1});
    EXPECT_NEAR(det(x, y, z), 1, 1e-12);
    EXPECT_GE(z.y, -1e-12);     // z never points down on the screen
    EXPECT_NEAR(z.x, 0, 1e-9);  // nor sideways
    EXPECT_NEAR(camera.to_view(normalized(direction)).z, -1, 1e-12);
  }
}

double color_distance(const Color& a, const Color& b) {
  return static_cast<double>(
      std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}));
}

// A scale is readable when small steps look alike and large ones never do.
TEST(QualityColor, IsContinuousAndTellsDistantValuesApart) {
  const int n = 500;
  for (int i = 0; i < n; ++i) {
    const Color c = quality_color(double(i) / n);
    for (float part : {c.r, c.g, c.b}) EXPECT_TRUE(part >= 0 && part <= 1);
    EXPECT_LT(color_distance(c, quality_color((i + 1.0) / n)), 0.02);
    for (int j = i + n / 8; j < n; j += 7)
      EXPECT_GT(color_distance(c, quality_color(double(j) / n)), 0.1) << i << " and " << j;
  }
}

TEST(QualityColor, BlueGainsOnRedFromOrangeOnwards) {
  const auto blueness = [](double value) {
    const Color c = quality_color(value);
    return c.b - c.r;
  };
  for (double value = 0.25; value < 1; value += 0.01)
    EXPECT_LT(blueness(value), blueness(value + 0.01)) << value;
}

Image white_image(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(std::size_t(3 * width * height), 255)};
}

/// The dark pixels of an image, as (x, y).
std::set<std::pair<int, int>> dark_pixels(const Image& image) {
  std::set<std::pair<int, int>> dark;
  for (int i = 0; i < image.width * image.height; ++i)
    if (image.rgb[std::size_t(3 * i)] < 128) dark.insert({i % image.width, i / image.width});
  return dark;
}

TEST(Font, EveryCharacterHasAShapeOfItsOwnOnItsLine) {
  std::map<std::set<std::pair<int, int>>, int> seen;
  for (int letter = 0x21; letter < 0x7f; ++letter) {
    Image image = white_image(60, 60);
    draw_text(image, 10, 8, std::string(1, static_cast<char>(letter)), 32);
    const auto pixels = dark_pixels(image);
    EXPECT_FALSE(pixels.empty()) << letter;
    EXPECT_TRUE(seen.emplace(pixels, letter).second) << letter << " looks like " << seen[pixels];
    for (const auto& [x, y] : pixels)
      EXPECT_TRUE(x >= 8 && x < 46 && y >= 8 && y < 8 + line_height(32)) << letter;
  }
  Image blank = white_image(12, 12);
  draw_text(blank, 2, 2, " \t\x01", 10);
  EXPECT_TRUE(dark_pixels(blank).empty());
}

double ink(const Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) sum += (255 - image.rgb[i]) / 215.0;
  return sum;
}

// The ink of a letter is its outline's area, wherever it falls between pixels and at any size.
TEST(Font, InkIsTheAreaOfTheOutline) {
  Image large = white_image(800, 900);
  draw_text(large, 20, 20, "g", 600);
  const double area = ink(large) / (600.0 * 600.0);
  for (double size : {9.0, 13.7, 40.0})
    for (double shift : {0.0, 0.31, 0.77}) {
      Image image = white_image(100, 100);
      draw_text(image, 20 + shift, 20, "g", size);
      EXPECT_NEAR(ink(image) / (size * size), area, 0.03 * area) << size << " " << shift;
    }
  // A vertical bar's counters and holes stay empty: an O has a hole.
  Image hole = white_image(200, 200);
  draw_text(hole, 20, 20, "O", 120);
  const int middle = 20 + static_cast<int>(text_width("O", 120) / 2);
  EXPECT_EQ(hole.rgb[std::size_t(3 * (90 * 200 + middle))], 255);
}

TEST(Font, IsClippedAtEveryBorder) {
  Image whole = white_image(180, 60);
  draw_text(whole, 9, 12, "Qa7)", 30);
  const auto expected = dark_pixels(whole);
  EXPECT_NEAR(text_width("Qa7)", 30), 3 * text_width("Qa7)", 10), 1e-9);
  // A window over the text: what is outside vanishes, what is inside stays.
  for (const auto& [dx, dy] : {std::pair{-20, -10}, {-200, 0}, {170, 50}, {-5, 30}}) {
    Image clipped = white_image(180, 60);
    draw_text(clipped, 9 + dx, 12 + dy, "Qa7)", 30);
    std::set<std::pair<int, int>> window;
    for (const auto& [x, y] : expected)
      if (x + dx >= 0 && x + dx < 180 && y + dy >= 0 && y + dy < 60)
        window.insert({x + dx, y + dy});
    EXPECT_EQ(dark_pixels(clipped), window);
  }
}

TEST(Font, NamesAreUtf8AndShortenedByWholeCharacters) {
  EXPECT_GT(text_width("\xc3\xa4", 20), 5);                        // a with two dots
  EXPECT_EQ(text_width("\xe4\xb8\xad", 20), text_width("?", 20));  // no glyph
  // A name in Latin-1: its bytes are no characters, but what stands behind them is.
  EXPECT_EQ(text_width("Gr\xfc\xdf!", 20), text_width("Gr?"
                                                      "?!",
                                                      20));
  EXPECT_EQ(text_width("a\x80xy\xe4", 20), text_width("a?xy?", 20));
  EXPECT_EQ(shorten_text("inlet", 20, 500), "inlet");
  const std::string name =
      "K\xc3\xbchlmantel au\xc3\x9f"
      "en";
  for (double width = 0; width < text_width(name, 20); width += 3) {
    const std::string shorter = shorten_text(name, 20, width);
    EXPECT_TRUE(shorter.ends_with("\xe2\x80\xa6"));
    EXPECT_LE(text_width(shorter, 20), std::max(width, text_width("\xe2\x80\xa6", 20)));
    const std::string kept = shorter.substr(0, shorter.size() - 3);
    EXPECT_TRUE(name.starts_with(kept));
    EXPECT_TRUE(kept.empty() || static_cast<unsigned char>(kept.back()) != 0xc3) << "half a letter";
  }
}

TEST(Legend, StaysInItsStripAndFollowsTheValues) {
  Image low = white_image(600, 450), high = low;
  draw_legend(low, "x", std::vector<double>(100, 0.05), 8);
  draw_legend(high, "x", std::vector<double>(100, 0.95), 8);
  const int strip = 600 - legend_width(8);
  int sum_low = 0, num_low = 0, sum_high = 0, num_high = 0;
  for (int y = 0; y < 450; ++y)
    for (int x = 0; x < 600; ++x) {
      const auto at = std::size_t(3 * (y * 600 + x));
      const bool differs = low.rgb[at] != high.rgb[at] || low.rgb[at + 2] != high.rgb[at + 2];
      if (x < strip) {
        ASSERT_EQ(low.rgb[at], 255) << x << " " << y;
        ASSERT_EQ(high.rgb[at], 255) << x << " " << y;
      }
      if (!differs || y > 340) continue;  // the numbers stand below
      (low.rgb[at] != 255 ? sum_low : sum_high) += y;
      ++(low.rgb[at] != 255 ? num_low : num_high);
    }
  ASSERT_GT(num_low, 0);
  ASSERT_GT(num_high, 0);
  // The bar of the low values lies farther down than that of the high ones.
  EXPECT_GT(sum_low / num_low, sum_high / num_high + 150);
}

TEST(Legend, BarsAreAsLongAsTheirShare) {
  const auto bar_length = [](const std::vector<double>& values, double value) {
    Image image = white_image(600, 450), empty = image;
    draw_legend(image, "", values, 8);
    draw_legend(empty, "", {}, 8);
    // The row of the value: the scale runs from three quarters of the height upwards.
    const int top = 450 / 8 + int(std::lround(2.2 * 8)), bottom = 450 * 3 / 4;
    const int y = bottom - int(std::lround(value * (bottom - top)));
    int length = 0;
    for (int x = 0; x < 600; ++x) {
      const auto at = std::size_t(3 * (y * 600 + x));
      length += !std::equal(&image.rgb[at], &image.rgb[at] + 3, &empty.rgb[at]);
    }
    return length;
  };
  std::vector<double> values(100, 0.25);
  values.insert(values.end(), 50, 0.75);
  values.insert(values.end(), 10, std::nan(""));
  const int whole = bar_length(values, 0.25);
  EXPECT_GT(whole, 20);
  EXPECT_NEAR(bar_length(values, 0.75), whole / 2.0, 1);
  EXPECT_EQ(bar_length(values, 0.5), 0);
  // Values beyond the scale's ends belong to its ends.
  EXPECT_EQ(bar_length({-7, -1, 0.001}, 0.01), bar_length({0, 0, 0}, 0.01));
  EXPECT_EQ(bar_length({5, 1.5, 1}, 0.99), bar_length({1, 1, 1}, 0.99));
}

TEST(Legend, FitsOrIsClippedInImagesOfAnySize) {
  std::mt19937_64 random(24);
  for (int width : {16, 17, 100, 5000})
    for (int height : {16, 31, 200}) {
      Image image = white_image(width, height);
      draw_legend(image, "scaled Jacobian", {0.1, 0.5, std::nan("")}, std::max(8.0, width / 80.0));
      EXPECT_EQ(image.rgb.size(), std::size_t(3 * width * height));
      if (width >= 100) {
        EXPECT_GT(ink(image), 0);
      }
    }
}

// Whatever a cut leaves is bounded by closed quads: their area vectors cancel.
TEST(VisibleFaces, CloseTheKeptPartAndAgreeWithBruteForce) {
  std::mt19937_64 random(25);
  const HexMesh mesh = test::box_hex_mesh(5, 4, 3);
  for (int round = 0; round < 50; ++round) {
    PictureOptions::Cut cut{random_vec(random), 0.2 + 0.15 * double(random() % 5)};
    const auto faces = find_visible_faces(mesh, cut);
    // Centres against the plane, by the definition.
    const Vec3 n = normalized(cut.normal);
    double lo = 1e9, hi = -1e9;
    for (const Vec3& p : mesh.positions) {
      lo = std::min(lo, dot(p, n));
      hi = std::max(hi, dot(p, n));
    }
    const double plane = lo + (cut.offset + 0.003) * (hi - lo);
    const auto is_kept = [&](const Vec3& center) {
      return Box3{{0, 0, 0}, {5, 4, 3}}.contains(center) && dot(center, n) <= plane;
    };
    std::size_t expected = 0;
    for (HexId h : mesh.hexes.ids()) {
      const Vec3 center = mesh.corners(h)[0] + Vec3{0.5, 0.5, 0.5};
      if (!is_kept(center)) continue;
      for (int axis = 0; axis < 3; ++axis)
        for (double side : {-1.0, 1.0}) {
          Vec3 beyond = center;
          beyond[axis] += side;
          expected += !is_kept(beyond);
        }
    }
    EXPECT_EQ(faces.size(), expected);
    Vec3 sum;
    for (const VisibleFace& f : faces) {
      const auto q = face_verts(mesh, f.face);
      const Vec3 normal = cross(mesh.positions[q[2]] - mesh.positions[q[0]],
                                mesh.positions[q[3]] - mesh.positions[q[1]]) *
                          0.5;
      sum += normal;
      Vec3 middle;
      for (VertId v : q) middle += mesh.positions[v] * 0.25;
      EXPECT_GT(dot(normal, middle - mesh.corners(f.face.hex)[0] - Vec3{0.5, 0.5, 0.5}), 0);
      bool on_box = false;
      for (int axis = 0; axis < 3; ++axis)
        on_box |= middle[axis] == 0 || middle[axis] == bounding_box(mesh).hi[axis];
      EXPECT_EQ(f.is_boundary, on_box);
    }
    EXPECT_NEAR(norm(sum), 0, 1e-12);
  }
}

// A slab of one hex that a plane shaves off the top of a block hangs in the air; what is thicker,
// or a whole part of the mesh, stays.
TEST(VisibleFaces, CrumbsThatACutLeavesAreRemoved) {
  HexMesh mesh = test::box_hex_mesh(8, 8, 4);
  // A part of its own beside it, as thin as a crumb.
  const auto add_block = [&](double x, double y, int ny) {
    const HexMesh block = test::box_hex_mesh(2, ny, 2);
    const auto first = mesh.num_verts();
    for (const Vec3& p : block.positions) mesh.positions.push_back(p + Vec3{x, y, 1});
    for (auto hex : block.hexes) {
      for (VertId& v : hex) v = VertId(first + v.index());
      mesh.hexes.push_back(hex);
    }
  };
  add_block(20, 7, 1);
  const auto count = [&](double y) {
    // Keeps y above the plane: 0 to 8 is the extent.
    const PictureOptions::Cut cut{{0, -1, 0}, 1 - (y + 0.003) / 8 - 0.003};
    std::set<HexId> hexes;
    for (const VisibleFace& f : find_visible_faces(mesh, cut)) hexes.insert(f.face.hex);
    return hexes.size();
  };
  EXPECT_EQ(count(7.0), 8U * 4 + 4);  // one layer is all there is: kept
  // Bend a ridge of the block's top so that a plane across z leaves it alone in the air.
  HexMesh ridge = test::box_hex_mesh(30, 5, 4);
  for (VertId v : ridge.positions.ids()) {
    Vec3& p = ridge.positions[v];
    if (p.z == 4 && p.x >= 20 && p.x <= 21) p.z = 8;  // a spike, one hex wide
    if (p.x > 10) continue;
    p.z += 10;  // and a plateau
  }
  const PictureOptions::Cut above{{0, 0, -1}, 1 - 5.0 / 14};
  for (const VisibleFace& f : find_visible_faces(ridge, above))
    EXPECT_LT(ridge.corners(f.face.hex)[0].x, 12);
}

TEST(Creases, RunWhereBoundaryFacesMeetAtAnAngleAndRoundCuts) {
  const HexMesh mesh = test::box_hex_mesh(3, 3, 3);
  auto faces = find_visible_faces(mesh, {});
  mark_creases(mesh, faces);
  int sides = 0;
  for (const VisibleFace& f : faces) sides += std::popcount(f.bold_sides);
  EXPECT_EQ(sides, 12 * 3 * 2);  // the edges of a cube, from both faces
  HexMesh labeled = mesh;
  labeled.labels.edges.push_back({{VertId(0), VertId(1)}, CurveId(0)});
  faces = find_visible_faces(labeled, {});
  mark_creases(labeled, faces);
  sides = 0;
  for (const VisibleFace& f : faces) sides += std::popcount(f.bold_sides);
  EXPECT_EQ(sides, 2);  // its labels say what is sharp
  faces = find_visible_faces(labeled, PictureOptions::Cut{{1, 0, 0}, 0.6});
  mark_creases(labeled, faces);
  sides = 0;
  for (const VisibleFace& f : faces) sides += std::popcount(f.bold_sides);
  EXPECT_EQ(sides, 2 + 12 * 2);
}

TEST(VisibleFaces, AboutAHexHaveItInFrontAndMarked) {
  const HexMesh mesh = test::box_hex_mesh(12, 12, 12);
  const HexId focus(6 * 144 + 6 * 12 + 6);
  const auto faces = find_faces_about(mesh, focus, {1, 0, 0});
  int marked = 0;
  for (const VisibleFace& f : faces) {
    const Vec3 low = mesh.corners(f.face.hex)[0];
    EXPECT_TRUE(low.x >= 6 && low.x <= 9 && low.y >= 3 && low.y <= 9);  // behind it, three steps
    marked += f.is_focus;
    EXPECT_EQ(f.is_focus, f.face.hex == focus);
  }
  EXPECT_EQ(marked, 1);  // what is seen of it from there
}

/// Decodes what write_png makes: one deflated stream, RGB, any of PNG's first three row filters.
Image decode_png(const std::string& png) {
  const auto u32 = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | std::uint8_t(png[at + k]);
    return value;
  };
  Image image{int(u32(16)), int(u32(20)), {}};
  std::string packed;
  for (std::size_t at = 8; at + 12 <= png.size(); at += u32(at) + 12)
    if (png.substr(at + 4, 4) == "IDAT") packed += png.substr(at + 8, u32(at));
  const std::size_t stride = 3 * std::size_t(image.width);
  std::vector<std::uint8_t> rows((stride + 1) * std::size_t(image.height));
  uLongf size = rows.size();
  EXPECT_EQ(
      uncompress(rows.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
      Z_OK);
  EXPECT_EQ(size, rows.size());
  for (std::size_t y = 0; y < std::size_t(image.height); ++y) {
    const std::uint8_t filter = rows[y * (stride + 1)];
    EXPECT_LE(filter, 2);
    for (std::size_t x = 0; x < stride; ++x) {
      int value = rows[y * (stride + 1) + 1 + x];
      if (filter == 1 && x >= 3) value += image.rgb[image.rgb.size() - 3];
      if (filter == 2 && y > 0) value += image.rgb[image.rgb.size() - stride];
      image.rgb.push_back(std::uint8_t(value));
    }
  }
  return image;
}

TEST(Png, ImagesOfAnyShapeAndContentComeBack) {
  const test::TempFolder folder;
  std::mt19937_64 random(26);
  for (const auto& [width, height] :
       {std::pair{1, 1}, {1, 50}, {50, 1}, {3, 7}, {257, 129}, {700, 500}}) {
    Image image = white_image(width, height);
    if (width != 700)  // that one stays white: rows that compress to next to nothing
      for (auto& byte : image.rgb) byte = std::uint8_t(random());
    write_png(folder / "a.png", image);
    const Image back = decode_png(test::slurp(folder / "a.png"));
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.rgb, image.rgb);
  }
}

}  // namespace
}  // namespace hexwright
