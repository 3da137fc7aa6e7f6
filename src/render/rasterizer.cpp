// Bands of rows are drawn independently, each by one task that takes the quads in their order, so
// that threads never change the image. Edges are drawn as part of their quad, where a sample is
// near its border: what hides the quad hides its edges.
//
// Based on: Pineda, "A parallel algorithm for polygon rasterization", SIGGRAPH 1988 (barycentric
// half-plane tests per sample).
// Differs: a sample on the side of two triangles counts for both; the z-buffer keeps one, so shared
// sides neither leave gaps nor need a fill rule.
#include "render/rasterizer.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

// Bands of this height are a task each: enough for many threads, and a band's samples stay in
// cache.
constexpr int kBandHeight = 16;  // pixels
// Both sides of a face between a hex kept and one cut away lie at the same depth: the front one
// must win whatever the order.
constexpr float kBackFacePenalty = 1e-4F;  // of the nearness

// What a sample sees: its quad (-1: nothing), and how much of the edge colour.
struct Sample {
  float nearness = 0;
  std::int32_t quad = -1;
  float line = 0;
};

// A line in screen space; value() is the signed distance to it.
struct ScreenLine {
  double a = 0, b = 0, c = 0;
  ScreenLine() = default;
  ScreenLine(const ScreenPoint& p, const ScreenPoint& q) {
    const double length = norm({q.x - p.x, q.y - p.y, 0});
    if (length == 0) return;
    a = -(q.y - p.y) / length;
    b = (q.x - p.x) / length;
    c = -(a * p.x + b * p.y);
  }
  double value(double x, double y) const { return a * x + b * y + c; }
};

class Band {
 public:
  Band(const RasterOptions& options, int first_row)
      : options_(options),
        first_row_(first_row),
        num_rows_(std::min(kBandHeight, options.height - first_row)),
        columns_(options.width * options.supersample),
        rows_(num_rows_ * options.supersample),
        samples_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  // A bent quad is drawn as the two triangles about its first diagonal.
  void draw(const ShadedQuad& quad, std::int32_t index) {
    draw_triangle(quad, {0, 1, 2}, index);
    draw_triangle(quad, {0, 2, 3}, index);
  }

  void resolve(const std::vector<ShadedQuad>& quads, Raster& raster) const {
    for (int row = 0; row < num_rows_; ++row)
      for (int x = 0; x < options_.width; ++x) resolve_pixel(quads, x, row, raster);
  }

 private:
  // Position in pixels of a sample's middle, and the sample whose middle is not before a position.
  double position(int sample) const { return (sample + 0.5) / options_.supersample; }
  int first_sample(double pos) const {
    return static_cast<int>(std::ceil(pos * options_.supersample - 0.5));
  }

  void draw_triangle(const ShadedQuad& quad, const std::array<std::size_t, 3>& k,
                     std::int32_t index) {
    const ScreenPoint& p = quad.corners[k[0]];
    const ScreenPoint& q = quad.corners[k[1]];
    const ScreenPoint& r = quad.corners[k[2]];
    const double area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    if (area == 0) return;
    // Barycentric coordinates and nearness are linear on the screen: value + dx * x + dy * y.
    const double qx = (r.y - p.y) / area, qy = -(r.x - p.x) / area;
    const double rx = -(q.y - p.y) / area, ry = (q.x - p.x) / area;
    const int row_begin = std::max(0, first_sample(std::min({p.y, q.y, r.y}) - first_row_));
    const int row_end = std::min(rows_, first_sample(std::max({p.y, q.y, r.y}) - first_row_) + 1);
    const int x_begin = std::max(0, first_sample(std::min({p.x, q.x, r.x})));
    const int x_end = std::min(columns_, first_sample(std::max({p.x, q.x, r.x})) + 1);
    for (int row = row_begin; row < row_end; ++row) {
      const double y = first_row_ + position(row);
      for (int column = x_begin; column < x_end; ++column) {
        const double x = position(column);
        const double s = qx * (x - p.x) + qy * (y - p.y);
        const double t = rx * (x - p.x) + ry * (y - p.y);
        if (s < 0 || t < 0 || s + t > 1) continue;
        const double nearness =
            p.nearness + s * (q.nearness - p.nearness) + t * (r.nearness - p.nearness);
        put(quad, index, row, column, static_cast<float>(nearness));
      }
    }
  }

  // Equal nearness does not replace: the lower quad wins, in any number of bands.
  void put(const ShadedQuad& quad, std::int32_t index, int row, int column, float nearness) {
    if (quad.is_back) nearness *= 1 - kBackFacePenalty;
    Sample& sample = samples_[index_of(row, column)];
    if (nearness <= sample.nearness) return;
    sample = {nearness, index, 0};
    if (quad.line_share <= 0 && quad.bold_sides == 0) return;
    const double x = position(column), y = first_row_ + position(row);
    for (std::size_t k = 0; k < 4; ++k) {
      if ((quad.line_sides >> k & 1) == 0) continue;
      const ScreenLine side(quad.corners[k], quad.corners[(k + 1) % 4]);
      const bool is_bold = (quad.bold_sides >> k & 1) != 0;
      const double width = is_bold ? options_.bold_width : options_.line_width;
      if (std::abs(side.value(x, y)) <= width / 2)
        sample.line = std::max(sample.line, is_bold ? 1.0F : quad.line_share);
    }
  }

  // Mean colour of the pixel's samples; depth and normal of the middle one, since means of those
  // across an edge belong to no surface.
  void resolve_pixel(const std::vector<ShadedQuad>& quads, int x, int row, Raster& raster) const {
    const int n = options_.supersample;
    Color sum;
    for (int sy = 0; sy < n; ++sy)
      for (int sx = 0; sx < n; ++sx) {
        const Sample& s = samples_[index_of(row * n + sy, x * n + sx)];
        sum = sum + (s.quad < 0 ? background(first_row_ + row, options_.height)
                                : line_over(quads[static_cast<std::size_t>(s.quad)], s.line));
      }
    const std::size_t pixel = raster.at(x, first_row_ + row);
    raster.color[pixel] = (1.0F / static_cast<float>(n * n)) * sum;
    const Sample& middle = samples_[index_of(row * n + n / 2, x * n + n / 2)];
    raster.nearness[pixel] = middle.nearness;
    if (middle.quad >= 0)
      raster.normal[pixel] = quads[static_cast<std::size_t>(middle.quad)].normal;
  }

  static Color line_over(const ShadedQuad& quad, float share) {
    return mix(quad.color, quad.line_color, share);
  }

  std::size_t index_of(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  const RasterOptions& options_;
  int first_row_, num_rows_;  // pixels
  int columns_, rows_;        // samples
  std::vector<Sample> samples_;
};

// Quads that may appear in each band, in their order.
std::vector<std::vector<std::int32_t>> sort_into_bands(const std::vector<ShadedQuad>& quads,
                                                       int num_bands) {
  std::vector<std::vector<std::int32_t>> bands(static_cast<std::size_t>(num_bands));
  for (std::size_t i = 0; i < quads.size(); ++i) {
    const auto by_y = [](const ScreenPoint& a, const ScreenPoint& b) { return a.y < b.y; };
    const auto& c = quads[i].corners;
    const auto [low, high] = std::minmax_element(c.begin(), c.end(), by_y);
    const int first = std::clamp(static_cast<int>(low->y / kBandHeight), 0, num_bands - 1);
    const int last = std::clamp(static_cast<int>(high->y / kBandHeight), 0, num_bands - 1);
    for (int band = first; band <= last; ++band)
      bands[static_cast<std::size_t>(band)].push_back(static_cast<std::int32_t>(i));
  }
  return bands;
}

}  // namespace

Color background(int y, int height) {
  const float t = static_cast<float>(y) / static_cast<float>(height);
  return mix({1.0F, 1.0F, 1.0F}, {0.93F, 0.945F, 0.96F}, t);
}

Raster rasterize(const std::vector<ShadedQuad>& quads, const RasterOptions& options) {
  Raster raster{options.width, options.height, {}, {}, {}};
  const std::size_t num_pixels =
      static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  raster.color.resize(num_pixels);
  raster.nearness.resize(num_pixels, 0);
  raster.normal.resize(num_pixels);
  const int num_bands = (options.height + kBandHeight - 1) / kBandHeight;
  const auto bands = sort_into_bands(quads, num_bands);
  parallel_for(
      bands.size(),
      [&](std::size_t b) {
        Band band(options, static_cast<int>(b) * kBandHeight);
        for (std::int32_t i : bands[b]) band.draw(quads[static_cast<std::size_t>(i)], i);
        band.resolve(quads, raster);
      },
      1);
  return raster;
}

}  // namespace hexwright
