// Pictures of hex meshes without a display: a small deterministic software rasteriser, written as
// PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

struct PictureOptions {
  int width = 1200, height = 900;
  int supersample = 3;                  ///< samples per pixel and axis
  Vec3 view_direction = {-1, 2, -0.8};  ///< from the eye into the scene
  /// Hexes whose centre lies on the positive side of this plane are cut away; absent = no cut.
  struct Cut {
    Vec3 normal = {0, -1, 0};
    double offset = 0.5;  ///< position of the plane between the box's extremes along the normal
  };
  std::optional<Cut> cut;
  /// Colour per hex in [0, 1] on the quality scale (red 0 .. blue 1); empty = scaled Jacobian.
  std::vector<double> values;
  bool draw_legend = true;
};

/// RGB image, row by row from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

Image render_hex_mesh(const HexMesh& mesh, const PictureOptions& options);
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace hexwright
