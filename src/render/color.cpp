// Based on: Harrower, Brewer, "ColorBrewer.org", The Cartographic Journal 40(1), 2003: the
// diverging scheme from red through yellow to blue, which colour-blind readers can tell apart too.
#include "render/color.h"

#include <algorithm>
#include <cmath>

namespace hexwright {
namespace {

// Sampled from the published scheme, its blues made lighter so that dark edges stay visible on
// the best hexes, which are most of a picture.
constexpr std::array<std::array<int, 3>, 10> kScale = {{
    {165, 0, 38},
    {215, 48, 39},
    {244, 109, 67},
    {253, 174, 97},
    {254, 224, 144},
    {224, 243, 248},
    {171, 217, 233},
    {126, 180, 219},
    {92, 145, 204},
    {62, 104, 186},
}};

Color scale_color(std::size_t i) {
  const auto& c = kScale[i];
  return {static_cast<float>(c[0]) / 255, static_cast<float>(c[1]) / 255,
          static_cast<float>(c[2]) / 255};
}

}  // namespace

Color quality_color(double value) {
  if (std::isnan(value)) return {0.5F, 0.5F, 0.5F};
  const double at = std::clamp(value, 0.0, 1.0) * (kScale.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kScale.size() - 2);
  return mix(scale_color(i), scale_color(i + 1), static_cast<float>(at - static_cast<double>(i)));
}

}  // namespace hexwright
