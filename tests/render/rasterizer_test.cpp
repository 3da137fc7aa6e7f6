// The z-buffer against brute force: coverage without gaps, depth, supersampling; and the shading of
// corners.
#include "render/rasterizer.h"

#include <random>

#include <gtest/gtest.h>

#include "hexwright/base/parallel.h"

#include "render/ambient_occlusion.h"

namespace hexwright {
namespace {

constexpr Color kRed = {1, 0, 0};

ShadedQuad flat_quad(const std::array<ScreenPoint, 4>& corners, const Color& color) {
  return {corners, color, {0, 0, 1}, 0, false};
}

/// A rectangle in two quads with a common side from (split_lo, y0) to (split_hi, y1).
std::vector<ShadedQuad> split_rectangle(double x0, double y0, double x1, double y1, double split_lo,
                                        double split_hi) {
  return {flat_quad({{{x0, y0, 1}, {split_lo, y0, 1}, {split_hi, y1, 1}, {x0, y1, 1}}}, kRed),
          flat_quad({{{split_lo, y0, 1}, {x1, y0, 1}, {x1, y1, 1}, {split_hi, y1, 1}}}, kRed)};
}

double random_unit(std::mt19937_64& random) { return double(random() >> 11) / double(1ull << 53); }

// Every sample strictly inside is covered, every one strictly outside is not, wherever the common
// side runs. Sides through the middles of pixels are the hard case: rounding must not put such a
// sample outside of both quads.
TEST(Rasterizer, CoversASquareWithoutGapsAlongSharedSides) {
  std::mt19937_64 random(7);
  const int n = 64;
  for (int round = 0; round < 60; ++round) {
    const bool is_on_middles = round % 2 == 0;
    const auto pick = [&] {
      return is_on_middles ? double(random() % n) + 0.5 : n * random_unit(random);
    };
    double split_lo = pick(), split_hi = pick();
    const auto quads = split_rectangle(-0.3, -0.7, n + 0.2, n + 0.9, split_lo, split_hi);
    const Raster raster = rasterize(quads, {n, n, 1, 1});
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        ASSERT_EQ(raster.nearness[raster.at(x, y)], 1)
            << x << " " << y << " with a side from " << split_lo << " to " << split_hi;
  }
}

// A plane cut into triangular fans about a random point, the sides all through pixel middles.
TEST(Rasterizer, FansAboutAPointLeaveNoPinholes) {
  std::mt19937_64 random(8);
  const int n = 48;
  for (int round = 0; round < 40; ++round) {
    const ScreenPoint hub = {double(random() % n) + 0.5, double(random() % n) + 0.5, 1};
    std::vector<ScreenPoint> rim;
    for (int i = 0; i <= n; i += 3) rim.push_back({double(i), 0, 1});
    for (int i = 3; i <= n; i += 3) rim.push_back({double(n), double(i), 1});
    for (int i = 3; i <= n; i += 3) rim.push_back({double(n - i), double(n), 1});
    for (int i = 3; i < n; i += 3) rim.push_back({0, double(n - i), 1});
    std::vector<ShadedQuad> quads;
    for (std::size_t i = 0; i + 1 < rim.size() + 1; i += 2)
      quads.push_back(
          flat_quad({hub, rim[i], rim[(i + 1) % rim.size()], rim[(i + 2) % rim.size()]}, kRed));
    const Raster raster = rasterize(quads, {n, n, 1, 1});
    int num_missed = 0;
    for (float nearness : raster.nearness) num_missed += nearness == 0;
    EXPECT_EQ(num_missed, 0) << "hub at " << hub.x << " " << hub.y;
  }
}

TEST(Rasterizer, DrawsNothingOutsideOfAQuad) {
  std::mt19937_64 random(9);
  const int n = 50;
  for (int round = 0; round < 50; ++round) {
    const double x0 = n * random_unit(random), y0 = n * random_unit(random);
    const double x1 = x0 + 10 * random_unit(random), y1 = y0 + 10 * random_unit(random);
    const Raster raster = rasterize(
        {flat_quad({{{x0, y0, 1}, {x1, y0, 1}, {x1, y1, 1}, {x0, y1, 1}}}, kRed)}, {n, n, 1, 1});
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const bool is_inside = x + 0.5 > x0 && x + 0.5 < x1 && y + 0.5 > y0 && y + 0.5 < y1;
        EXPECT_EQ(raster.nearness[raster.at(x, y)] > 0, is_inside) << x << " " << y;
      }
  }
}

// Random triangles in depth, against the nearest by a plain loop over all of them per pixel.
TEST(Rasterizer, ShowsTheNearestOfAllTriangles) {
  std::mt19937_64 random(10);
  const int n = 40;
  std::vector<ShadedQuad> quads;
  for (int i = 0; i < 60; ++i) {
    std::array<ScreenPoint, 4> c;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = {n * random_unit(random), n * random_unit(random), 0.1 + random_unit(random)};
    c[3] = c[2];  // a quad without a second triangle
    quads.push_back(flat_quad(c, {float(i) / 60, 0, 0}));
  }
  const Raster raster = rasterize(quads, {n, n, 1, 1});
  int num_covered = 0;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      double nearest = 0;
      for (const ShadedQuad& quad : quads) {
        const auto& [p, q, r, unused] = quad.corners;
        const double px = x + 0.5, py = y + 0.5;
        const auto area = [](double ax, double ay, double bx, double by) {
          return ax * by - ay * bx;
        };
        const double whole = area(q.x - p.x, q.y - p.y, r.x - p.x, r.y - p.y);
        const double a = area(q.x - px, q.y - py, r.x - px, r.y - py) / whole;
        const double b = area(r.x - px, r.y - py, p.x - px, p.y - py) / whole;
        if (a < 0 || b < 0 || a + b > 1) continue;
        nearest = std::max(nearest, a * p.nearness + b * q.nearness + (1 - a - b) * r.nearness);
      }
      num_covered += nearest > 0;
      EXPECT_NEAR(static_cast<double>(raster.nearness[raster.at(x, y)]), nearest, 1e-5);
    }
  EXPECT_GT(num_covered, n * n / 2);
}

// The more samples, the nearer a pixel's colour comes to the share that is covered.
TEST(Rasterizer, SupersamplingMeasuresTheCoveredShare) {
  const double edge = 2.3, top = 1.15;
  for (int samples : {1, 2, 4, 8}) {
    const Raster raster = rasterize(
        {flat_quad({{{0, 0, 1}, {edge, 0, 1}, {edge, 4 - top, 1}, {0, 4 - top, 1}}}, {0, 0, 0})},
        {4, 4, samples, 1});
    const auto shade_at = [&](int x, int y) {
      const float white = background(y, 4).r;
      return 1 - static_cast<double>(raster.color[raster.at(x, y)].r / white);
    };
    EXPECT_NEAR(shade_at(0, 0), 1, 1e-6);
    EXPECT_NEAR(shade_at(3, 0), 0, 1e-6);
    EXPECT_NEAR(shade_at(2, 0), 0.3, 0.5 / samples + 1e-6);
    EXPECT_NEAR(shade_at(0, 2), 0.85, 0.5 / samples + 1e-6);
    EXPECT_NEAR(shade_at(2, 2), 0.3 * 0.85, 1.0 / samples + 1e-6);
  }
}

TEST(Rasterizer, AFrontFaceHidesABackFaceOfEqualDepthInEitherOrder) {
  const std::array<ScreenPoint, 4> square = {{{0, 0, 1}, {8, 0, 1}, {8, 8, 1}, {0, 8, 1}}};
  ShadedQuad front = flat_quad(square, {0, 1, 0}), back = flat_quad(square, kRed);
  back.is_back = true;
  for (const auto& order : {std::vector{front, back}, std::vector{back, front}}) {
    const Raster raster = rasterize(order, {8, 8, 1, 1});
    for (const Color& c : raster.color) EXPECT_EQ(c.g, 1);
  }
}

// What makes the image a function of the quads' order alone, whatever the bands and threads.
TEST(Rasterizer, OfEquallyNearQuadsTheFirstIsSeen) {
  const std::array<ScreenPoint, 4> square = {{{0, 0, 1}, {9, 0, 1}, {9, 40, 1}, {0, 40, 1}}};
  const Raster raster =
      rasterize({flat_quad(square, {0, 1, 0}), flat_quad(square, kRed)}, {9, 40, 1, 1});
  for (const Color& c : raster.color) EXPECT_EQ(c.g, 1);
}

// Lines lie within half their width of the quad's sides, and nowhere else.
TEST(Rasterizer, EdgesAreAsWideAsAsked) {
  for (double width : {1.0, 3.0, 6.0}) {
    ShadedQuad quad = flat_quad({{{0, 0, 1}, {40, 0, 1}, {40, 40, 1}, {0, 40, 1}}}, {1, 1, 1});
    quad.line_share = 1;
    const Raster raster = rasterize({quad}, {40, 40, 1, width});
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x) {
        const double to_side = std::min({x + 0.5, y + 0.5, 40 - (x + 0.5), 40 - (y + 0.5)});
        EXPECT_EQ(raster.color[raster.at(x, y)].r < 0.5F, to_side <= width / 2) << x << " " << y;
      }
  }
}

TEST(Rasterizer, PartsOutsideOfTheImageAreClipped) {
  const Raster raster = rasterize(
      {flat_quad({{{-1e6, -1e6, 1}, {1e6, -1e6, 1}, {1e6, 1e6, 1}, {-1e6, 1e6, 1}}}, kRed)},
      {33, 17, 2, 1});
  for (const Color& c : raster.color) EXPECT_EQ(c.r, 1);
  const Raster none = rasterize(
      {flat_quad({{{-9, -9, 1}, {-1, -9, 1}, {-1, -1, 1}, {-9, -1, 1}}}, kRed)}, {33, 17, 2, 1});
  for (float nearness : none.nearness) EXPECT_EQ(nearness, 0);
}

/// A raster that sees a surface of the given nearness and normal per pixel.
template <class Nearness, class Normal>
Raster make_raster(int n, Nearness nearness, Normal normal) {
  Raster raster{n, n, {}, {}, {}};
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      raster.color.push_back({1, 1, 1});
      raster.nearness.push_back(static_cast<float>(nearness(x)));
      raster.normal.push_back(normal(x));
    }
  return raster;
}

TEST(AmbientOcclusion, APlaneKeepsItsLightAndAValleyLosesSome) {
  const int n = 100;
  const double focal = 300;
  Raster plane = make_raster(
      n, [](int) { return 0.3; },
      [](int) {
        return Vec3{0, 0, 1};
      });
  apply_ambient_occlusion(plane, focal);
  for (const Color& c : plane.color) EXPECT_NEAR(c.r, 1, 1e-3);

  // Two planes at 45 degrees to the view that meet farthest away, in the middle column. On a plane
  // the nearness is linear on the screen: z = d + x and x = (column - n/2) z / focal.
  const auto valley = [&](int x) { return (1 + std::abs(x - n / 2) / focal) * 0.3; };
  const auto normal = [&](int x) { return normalized(Vec3{x < n / 2 ? 1.0 : -1.0, 0, 1}); };
  Raster bent = make_raster(n, valley, normal);
  apply_ambient_occlusion(bent, focal);
  const auto light = [&](int x) { return bent.color[bent.at(x, n / 2)].r; };
  EXPECT_LT(light(n / 2 + 1), 0.9F);
  EXPECT_LT(light(n / 2 - 2), 0.9F);
  EXPECT_GT(light(n - 10), light(n / 2 + 1) + 0.05F);  // far from the crease there is more light

  // The same two planes seen from the other side are a ridge: nothing stands in its light.
  const auto ridge = [&](int x) { return (1 - std::abs(x - n / 2) / focal) * 0.3; };
  const auto turned = [&](int x) { return normalized(Vec3{x < n / 2 ? -1.0 : 1.0, 0, 1}); };
  Raster convex = make_raster(n, ridge, turned);
  apply_ambient_occlusion(convex, focal);
  for (int x = 5; x < n - 5; ++x) EXPECT_GT(convex.color[convex.at(x, n / 2)].r, 0.97F) << x;
}

TEST(AmbientOcclusion, NeverLightensNorTouchesTheBackground) {
  std::mt19937_64 random(11);
  Raster raster = make_raster(
      60, [&](int) { return random() % 3 == 0 ? 0 : 0.2 + 0.2 * random_unit(random); },
      [&](int) {
        return normalized(Vec3{random_unit(random) - 0.5, random_unit(random) - 0.5, 1});
      });
  const Raster before = raster;
  apply_ambient_occlusion(raster, 200);
  const ThreadLimit one(1);
  Raster single = before;
  apply_ambient_occlusion(single, 200);
  for (std::size_t i = 0; i < raster.color.size(); ++i) {
    EXPECT_LE(raster.color[i].r, before.color[i].r);
    EXPECT_GE(raster.color[i].r, 0);
    const bool is_background = before.nearness[i] == 0;
    EXPECT_TRUE(!is_background || raster.color[i].r == before.color[i].r);
    EXPECT_EQ(raster.color[i].r, single.color[i].r);
  }
}

}  // namespace
}  // namespace hexwright
