// Which quad is seen at each sample of an image, by z-buffer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexwright/base/vec3.h"

#include "render/camera.h"
#include "render/color.h"

namespace hexwright {

inline constexpr Color kLineColor = {0.10F, 0.11F, 0.14F};

struct ShadedQuad {
  std::array<ScreenPoint, 4> corners;
  Color color;           ///< lit
  Vec3 normal;           ///< towards the eye, in the camera's frame
  float line_share = 0;  ///< how dark its edges are drawn
  bool is_back = false;  ///< seen from inside its hex; loses against a front face at equal depth
  std::uint8_t bold_sides = 0;  ///< bits of sides (k to k + 1) drawn wider and fully
  Color line_color = kLineColor;
  std::uint8_t line_sides = 0xf;  ///< bits of sides that are edges, and not the border of a part
  Color base_color = {};          ///< without light
};

/// Colours with the depth and normal of what is seen at each pixel's middle.
struct Raster {
  int width = 0, height = 0;
  std::vector<Color> color;
  std::vector<float> nearness;  ///< 0 where nothing is seen
  std::vector<Vec3> normal;

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

struct RasterOptions {
  int width = 0, height = 0;
  int supersample = 1;
  double line_width = 1;  ///< pixels
  double bold_width = 2;  ///< pixels
};

/// Draws over a pale background. The same image for any number of threads.
Raster rasterize(const std::vector<ShadedQuad>& quads, const RasterOptions& options);

/// The background at a row.
Color background(int y, int height);

}  // namespace hexwright
