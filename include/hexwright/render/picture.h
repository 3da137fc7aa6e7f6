// Pictures of hex meshes without a display: a small deterministic software rasteriser, written as
// PNG.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

/// What faces are coloured by.
enum class PictureColors {
  Values,  ///< a value per hex, on the quality scale
  Patches  ///< the patch of each boundary face; faces without one are grey
};

struct PictureOptions {
  int width = 1200, height = 900;       ///< pixels, 16 to 16384
  int supersample = 3;                  ///< samples per pixel and axis, 1 to 8
  Vec3 view_direction = {-1, 2, -0.8};  ///< from the eye into the scene; z is up
  /// Hexes whose centre lies on the positive side of this plane are cut away; absent = no cut.
  struct Cut {
    Vec3 normal = {0, -1, 0};
    double offset = 0.5;  ///< position of the plane between the box's extremes along the normal
  };
  std::optional<Cut> cut;
  /// Shows this hex and what is around and behind it alone, its edges marked; the cut is ignored.
  /// Invalid = the whole mesh.
  HexId focus;
  PictureColors colors = PictureColors::Values;
  /// Colour per hex in [0, 1] on the quality scale (red 0 .. blue 1); empty = scaled Jacobian.
  std::vector<double> values;
  std::string legend_title = "scaled Jacobian";
  bool draw_legend = true;
  double letter_size = 0;  ///< pixels; 0 = by the picture's width
  /// Edges of hexes, those of the mesh's own boundary fainter, and bold ones along feature curves
  /// and round what a cut lays open.
  bool draw_edges = true;
  /// With a cut, the mesh's own boundary is drawn pale, so that the inside stands out.
  bool fade_boundary = true;
};

/// A view of the mesh cut open across an axis (0 to 2), at a place between the box's ends. Size and
/// legend are the defaults.
PictureOptions make_cut_view(int axis, double offset);

/// A place from 0.4 to 0.6 for make_cut_view: the nearest to the middle at which hardly any face of
/// the mesh (3% of the box's cross-section) lies along the cut and a hex's thickness or less off
/// it, or else where the least area of them does: next to such a face a cut leaves hexes here and
/// there. 0.5 for a mesh without hexes.
double find_clear_cut(const HexMesh& mesh, int axis);

/// Cut near the middle, clear of faces, across the second longest of the box's sides.
PictureOptions make_default_view(const HexMesh& mesh);

/// RGB image, row by row from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Draws the faces that no other hex covers, each in its hex's colour, with the hexes' edges. Faces
/// are opaque and hide each other by depth, so that non-conforming and inverted hexes are drawn as
/// they are. The camera frames what is drawn. Throws Error{BadArgument} for options
/// out of range, or values whose number is not that of the hexes.
Image render_hex_mesh(const HexMesh& mesh, const PictureOptions& options);

/// Writes 8-bit RGB. Throws Error{CannotOpen} when the file cannot be written whole.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace hexwright
