// The scale is drawn row by row, so that each row's colour is that of the value it stands for; the
// histogram grows from it to the left, longest bar = most frequent value.
#include "render/legend.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/words.h"
#include "render/color.h"
#include "render/font.h"

namespace hexwright {
namespace {

constexpr int kNumBins = 50;
constexpr double kWidth = 11;  // of the legend, in sizes of its letters

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
  double size;  // of letters
  int left, title_y, bar_left, bar_right, top, bottom;

  Layout(const Image& image, double letter_size)
      : size(letter_size),
        left(image.width - legend_width(letter_size)),
        title_y(image.height / 8),
        bar_left(left + to_pixels(5.5)),
        bar_right(bar_left + to_pixels(1.4)),
        top(title_y + to_pixels(2.2)),
        bottom(std::max(top + 10, image.height * 3 / 4)) {}

  /// Of a length in sizes of letters.
  int to_pixels(double sizes) const { return static_cast<int>(std::lround(sizes * size)); }

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
    for (int x = layout.bar_right; x < layout.bar_right + layout.to_pixels(0.4); ++x)
      put(image, x, y, {0.16F, 0.16F, 0.16F});
    draw_text(image, layout.bar_right + 0.7 * layout.size, y - 0.58 * layout.size,
              fmt::format("{:.1f}", value), layout.size);
  }
}

// Bars to the left of the scale, in its colours.
void draw_histogram(Image& image, const Layout& layout, const std::vector<double>& values) {
  const auto bins = count_bins(values);
  const double most = static_cast<double>(*std::max_element(bins.begin(), bins.end()));
  if (most == 0) return;
  const int room = layout.bar_left - layout.left - layout.to_pixels(0.5);
  for (int y = layout.top; y <= layout.bottom; ++y) {
    const double value = layout.value_of(y);
    const auto bin = std::min(static_cast<std::size_t>(value * kNumBins), bins.size() - 1);
    const auto length = static_cast<int>(std::ceil(room * static_cast<double>(bins[bin]) / most));
    const int end = layout.bar_left - layout.to_pixels(0.25);
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
      counted(values.size(), "hex", "hexes"),
      fmt::format("least {:.3f}", *std::min_element(values.begin(), values.end())),
      fmt::format("mean {:.3f}", sum / static_cast<double>(values.size()))};
  double y = layout.bottom + 1.5 * layout.size;
  for (const std::string& line : lines) {
    draw_text(image, layout.left, y, line, layout.size);
    y += line_height(layout.size);
  }
}

}  // namespace

int legend_width(double letter_size) { return static_cast<int>(std::lround(kWidth * letter_size)); }

void draw_legend(Image& image, const std::string& title, const std::vector<double>& values,
                 double letter_size) {
  const Layout layout(image, letter_size);
  draw_text(image, layout.left, layout.title_y,
            shorten_text(title, layout.size, 10.5 * layout.size), layout.size);
  draw_histogram(image, layout, values);
  draw_bar(image, layout);
  draw_numbers(image, layout, values);
}

void draw_names(Image& image, const std::vector<NamedColor>& names, double letter_size) {
  const double left = image.width - legend_width(letter_size), line = 1.5 * letter_size;
  const auto room = static_cast<std::size_t>(std::max(1.0, 0.8 * image.height / line));
  // The last line says how many more there are.
  const std::size_t count = names.size() <= room ? names.size() : room - 1;
  double y = 0.1 * image.height;
  for (std::size_t i = 0; i < count; ++i, y += line) {
    for (int dy = 0; dy < std::lround(letter_size); ++dy)
      for (int dx = 0; dx < std::lround(letter_size); ++dx)
        put(image, static_cast<int>(left) + dx, static_cast<int>(y) + dy, names[i].color);
    draw_text(image, left + 1.5 * letter_size, y - 0.08 * letter_size,
              shorten_text(names[i].name, letter_size, (kWidth - 2) * letter_size), letter_size);
  }
  if (count < names.size())
    draw_text(image, left, y, fmt::format("and {} more", names.size() - count), letter_size);
}

}  // namespace hexwright
