// The scale is drawn row by row, so that each row's colour is that of the value it stands for; the
// histogram grows from it to the left, longest bar = most frequent value.
#include "render/legend.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/color.h"
#include "render/font.h"

namespace hexwright {
namespace {

constexpr int kNumBins = 50;
constexpr int kTitleLetters = 17;  // room for the title

// Letters grow with the picture, in whole pixels: they stay crisp.
int text_scale(const Image& image) { return std::max(1, image.width / 600); }

// Clipped: small images have less room than the legend would like.
void put(Image& image, int x, int y, const Color& color) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(x));
  const float components[] = {color.r, color.g, color.b};
  for (std::size_t k = 0; k < 3; ++k)
    image.rgb[at + k] = static_cast<std::uint8_t>(std::lround(255 * components[k]));
}

// Where the parts of the legend are, in pixels.
struct Layout {
  int scale, left, title_y, bar_left, bar_right, top, bottom;

  explicit Layout(const Image& image)
      : scale(text_scale(image)),
        left(image.width - legend_width(image)),
        title_y(image.height / 8),
        bar_left(left + 9 * 6 * scale),
        bar_right(bar_left + 12 * scale),
        top(title_y + 2 * text_height(scale)),
        bottom(std::max(top + 10, image.height * 3 / 4)) {}

  int y_of(double value) const {
    return bottom - static_cast<int>(std::lround(value * (bottom - top)));
  }
  double value_of(int y) const {
    return static_cast<double>(bottom - y) / static_cast<double>(bottom - top);
  }
};

// Values beyond the scale belong to its ends (inverted hexes to the lowest bin); NaN to none.
std::vector<std::size_t> count_bins(const std::vector<double>& values) {
  std::vector<std::size_t> bins(kNumBins, 0);
  for (double value : values) {
    if (std::isnan(value)) continue;
    const double bin = std::clamp(std::floor(value * kNumBins), 0.0, kNumBins - 1.0);
    ++bins[static_cast<std::size_t>(bin)];
  }
  return bins;
}

void draw_bar(Image& image, const Layout& layout) {
  for (int y = layout.top; y <= layout.bottom; ++y)
    for (int x = layout.bar_left; x < layout.bar_right; ++x)
      put(image, x, y, quality_color(layout.value_of(y)));
  for (int tick = 0; tick <= 5; ++tick) {
    const double value = tick / 5.0;
    const int y = layout.y_of(value);
    for (int x = layout.bar_right; x < layout.bar_right + 3 * layout.scale; ++x)
      put(image, x, y, {0.16F, 0.16F, 0.16F});
    draw_text(image, layout.bar_right + 5 * layout.scale, y - 3 * layout.scale,
              fmt::format("{:.1f}", value), layout.scale);
  }
}

// Bars to the left of the scale, in its colours.
void draw_histogram(Image& image, const Layout& layout, const std::vector<double>& values) {
  const auto bins = count_bins(values);
  const double most = static_cast<double>(*std::max_element(bins.begin(), bins.end()));
  if (most == 0) return;
  const int room = layout.bar_left - layout.left - 4 * layout.scale;
  for (int y = layout.top; y <= layout.bottom; ++y) {
    const double value = layout.value_of(y);
    const auto bin = std::min(static_cast<std::size_t>(value * kNumBins), bins.size() - 1);
    const auto length = static_cast<int>(std::ceil(room * static_cast<double>(bins[bin]) / most));
    const int end = layout.bar_left - 2 * layout.scale;
    for (int x = end - length; x < end; ++x)
      put(image, x, y,
          mix(quality_color((static_cast<double>(bin) + 0.5) / kNumBins), {0.5F, 0.5F, 0.5F},
              0.15F));
  }
}

void draw_numbers(Image& image, const Layout& layout, const std::vector<double>& values) {
  if (values.empty()) return;
  double sum = 0;
  for (double value : values) sum += value;
  const std::string lines[] = {
      fmt::format("{} hexes", values.size()),
      fmt::format("least  {:.3f}", *std::min_element(values.begin(), values.end())),
      fmt::format("mean   {:.3f}", sum / static_cast<double>(values.size()))};
  int y = layout.bottom + 2 * text_height(layout.scale);
  for (const std::string& line : lines) {
    draw_text(image, layout.left, y, line, layout.scale);
    y += text_height(layout.scale) + 2 * layout.scale;
  }
}

}  // namespace

int legend_width(const Image& image) {
  return text_width(std::string(kTitleLetters, ' '), text_scale(image));
}

void draw_legend(Image& image, const std::string& title, const std::vector<double>& values) {
  const Layout layout(image);
  draw_text(image, layout.left, layout.title_y, title, layout.scale);
  draw_histogram(image, layout, values);
  draw_bar(image, layout);
  draw_numbers(image, layout, values);
}

}  // namespace hexwright
