// Colours with components in [0, 1], and the scale that shows quality.
#pragma once

#include <array>
#include <cstddef>

namespace hexwright {

struct Color {
  float r = 0, g = 0, b = 0;

  friend Color operator*(float s, const Color& c) { return {s * c.r, s * c.g, s * c.b}; }
  friend Color operator+(const Color& c, const Color& d) {
    return {c.r + d.r, c.g + d.g, c.b + d.b};
  }
};

inline Color mix(const Color& first, const Color& second, float share_of_second) {
  return (1 - share_of_second) * first + share_of_second * second;
}

/// For lists of names: neighbours differ much; after fifteen the hues come again, lighter. The page
/// of viewer/ has the same.
Color category_color(std::size_t i);

/// Red at 0 and below, through yellow, to blue at 1 and above; grey when the value is not a number.
Color quality_color(double value);

}  // namespace hexwright
