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

constexpr std::array<std::array<int, 3>, 15> kCategories = {{
    {86, 133, 186},
    {232, 150, 62},
    {102, 166, 92},
    {214, 99, 96},
    {150, 117, 180},
    {158, 124, 96},
    {222, 136, 186},
    {130, 138, 146},
    {190, 184, 70},
    {82, 181, 190},
    {62, 96, 150},
    {190, 106, 40},
    {60, 120, 66},
    {160, 60, 70},
    {104, 78, 140},
}};

Color to_color(const std::array<int, 3>& c) {
  return {static_cast<float>(c[0]) / 255, static_cast<float>(c[1]) / 255,
          static_cast<float>(c[2]) / 255};
}

}  // namespace

Color category_color(std::size_t i) {
  const std::size_t round = i / kCategories.size();
  return mix(to_color(kCategories[i % kCategories.size()]), {1, 1, 1},
             0.28F * static_cast<float>(round % 3));
}

Color quality_color(double value) {
  if (std::isnan(value)) return {0.5F, 0.5F, 0.5F};
  const double at = std::clamp(value, 0.0, 1.0) * (kScale.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kScale.size() - 2);
  return mix(to_color(kScale[i]), to_color(kScale[i + 1]),
             static_cast<float>(at - static_cast<double>(i)));
}

}  // namespace hexwright
