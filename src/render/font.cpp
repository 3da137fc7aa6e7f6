#include "render/font.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

namespace hexwright {
namespace {

struct Glyph {
  std::uint16_t code;         ///< Unicode
  std::int16_t advance;       ///< width with the gap to the next letter
  std::int16_t first, count;  ///< of its curves
};

#include "render/font_outlines.inc"

constexpr double kInk = 40;  // of 255
constexpr std::string_view kEllipsis = "\xe2\x80\xa6";

const Glyph* find_glyph(std::uint32_t code) {
  const auto* found =
      std::lower_bound(std::begin(kGlyphs), std::end(kGlyphs), code,
                       [](const Glyph& glyph, std::uint32_t c) { return glyph.code < c; });
  return found != std::end(kGlyphs) && found->code == code ? found : nullptr;
}

// Takes the first character off a UTF-8 text; 0xfffd for a byte that begins none.
std::uint32_t take_character(std::string_view& text) {
  constexpr std::uint32_t kNone = 0xfffd;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  const std::size_t length = lead < 0x80       ? 1
                             : lead >> 5 == 6  ? 2
                             : lead >> 4 == 14 ? 3
                             : lead >> 3 == 30 ? 4
                                               : 0;
  std::uint32_t code = length == 1 ? lead : lead & (0xffU >> (length + 1));
  bool is_whole = length > 0 && length <= text.size();
  for (std::size_t k = 1; is_whole && k < length; ++k) {
    is_whole = (byte(k) & 0xc0U) == 0x80U;
    code = code << 6 | (byte(k) & 0x3fU);
  }
  text.remove_prefix(is_whole ? length : 1);
  return is_whole ? code : kNone;
}

// The glyphs of a text. Bytes that are no UTF-8 and characters without a glyph become '?'.
std::vector<const Glyph*> find_glyphs(std::string_view text) {
  std::vector<const Glyph*> glyphs;
  while (!text.empty()) {
    const std::uint32_t code = take_character(text);
    if (code < 0x20) continue;
    const Glyph* glyph = find_glyph(code);
    glyphs.push_back(glyph ? glyph : find_glyph('?'));
  }
  return glyphs;
}

struct Point {
  double x = 0, y = 0;
};

// How much of each pixel an outline covers: every edge adds the signed area to its right, so that
// edges on both sides of a stroke leave what is between them.
class Coverage {
 public:
  Coverage(int width, int height)
      : width_(width),
        height_(height),
        area_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0) {}

  void add_curve(const Point& a, const Point& b, const Point& c) {
    constexpr int kPieces = 6;  // a letter's curve spans a few pixels
    Point last = a;
    for (int i = 1; i <= kPieces; ++i) {
      const double t = static_cast<double>(i) / kPieces, s = 1 - t;
      const Point next = {s * s * a.x + 2 * s * t * b.x + t * t * c.x,
                          s * s * a.y + 2 * s * t * b.y + t * t * c.y};
      add_edge(last, next);
      last = next;
    }
  }

  double at(int x, int y) const { return std::min(1.0, std::abs(area_[index(x, y)])); }

 private:
  void add_edge(Point a, Point b) {
    if (a.y == b.y) return;
    const double sign = a.y < b.y ? 1 : -1;
    if (a.y > b.y) std::swap(a, b);
    const double slope = (b.x - a.x) / (b.y - a.y);
    const int last_row = std::min(height_ - 1, static_cast<int>(std::floor(b.y)));
    for (int row = std::max(0, static_cast<int>(std::floor(a.y))); row <= last_row; ++row) {
      const double top = std::max<double>(row, a.y), bottom = std::min<double>(row + 1, b.y);
      if (bottom <= top) continue;
      const double x0 = a.x + (top - a.y) * slope, x1 = a.x + (bottom - a.y) * slope;
      add_row(row, std::min(x0, x1), std::max(x0, x1), sign * (bottom - top));
    }
  }

  // Area to the right of an edge that runs from `low` to `high` while it falls by `height`.
  void add_row(int row, double low, double high, double height) {
    const auto left_of = [&](double x) {  // integral of max(0, x - edge) over the edge
      if (x <= low) return 0.0;
      if (x >= high) return x - (low + high) / 2;
      return (x - low) * (x - low) / (2 * (high - low));
    };
    for (int x = std::max(0, static_cast<int>(std::floor(low))); x < width_; ++x)
      area_[index(x, row)] += height * (left_of(x + 1) - left_of(x));
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_, height_;
  std::vector<double> area_;
};

void blend(Image& image, int x, int y, double share) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height || share <= 0) return;
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x));
  for (std::size_t k = 0; k < 3; ++k)
    image.rgb[at + k] =
        static_cast<std::uint8_t>(std::lround(image.rgb[at + k] * (1 - share) + kInk * share));
}

void draw_glyph(Image& image, const Glyph& glyph, const Point& pen, double scale) {
  // A cell around the glyph that begins at a whole pixel: room for overhangs on all sides.
  const int margin = static_cast<int>(std::ceil(0.3 * scale * kUnitsPerEm)) + 1;
  const int left = static_cast<int>(std::floor(pen.x)) - margin;
  const int top = static_cast<int>(std::floor(pen.y - scale * kAscent)) - margin;
  const int width = static_cast<int>(std::ceil(scale * glyph.advance)) + 2 * margin + 1;
  const int height = static_cast<int>(std::ceil(scale * (kAscent + kDescent))) + 2 * margin + 1;
  Coverage coverage(width, height);
  const auto place = [&](const std::int16_t* units) {
    return Point{pen.x - left + scale * units[0], pen.y - top - scale * units[1]};
  };
  for (int i = glyph.first; i < glyph.first + glyph.count; ++i)
    coverage.add_curve(place(kCurves[i]), place(kCurves[i] + 2), place(kCurves[i] + 4));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) blend(image, left + x, top + y, coverage.at(x, y));
}

}  // namespace

double text_width(std::string_view text, double size) {
  double width = 0;
  for (const Glyph* glyph : find_glyphs(text)) width += glyph->advance;
  return width * size / kUnitsPerEm;
}

double line_height(double size) { return 1.3 * size; }

void draw_text(Image& image, double x, double y, std::string_view text, double size) {
  const double scale = size / kUnitsPerEm;
  // Baselines at whole pixels keep feet and bars of letters crisp.
  Point pen = {x, std::round(y + scale * kAscent)};
  for (const Glyph* glyph : find_glyphs(text)) {
    draw_glyph(image, *glyph, pen, scale);
    pen.x += scale * glyph->advance;
  }
}

std::string shorten_text(std::string_view text, double size, double width) {
  if (text_width(text, size) <= width) return std::string(text);
  while (!text.empty() && text_width(text, size) + text_width(kEllipsis, size) > width) {
    // A whole character: bytes that go on with one begin with the bits 10.
    bool is_inside = true;
    while (is_inside && !text.empty()) {
      is_inside = (static_cast<unsigned char>(text.back()) & 0xc0U) == 0x80U;
      text.remove_suffix(1);
    }
  }
  return std::string(text) + std::string(kEllipsis);
}

}  // namespace hexwright
