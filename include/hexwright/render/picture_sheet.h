// Several views of a hex mesh in one picture.
#pragma once

#include <string>

#include "hexwright/render/picture.h"

namespace hexwright {

/// Looks at the face of a cut across an axis (0 = x), from the side cut away and a little from
/// beside and above; `offset` is the cut's place in [0, 1].
PictureOptions make_cut_view(int axis, double offset);

/// Cuts at the middle, across the box's second longest axis: across the longest the cut face would
/// be the smallest, across the shortest hardly any depth would be left behind it.
PictureOptions make_default_view(const HexMesh& mesh);

struct SheetOptions {
  int width = 1800, height = 1160;  ///< pixels, 400 to 16384
  int supersample = 3;              ///< samples per pixel and axis, 1 to 8
  std::string title = "mesh";
};

/// The outside, a cut across each axis, the worst hex with its surroundings, and the patches with
/// their names (without any, the outside from behind), with a legend of the scaled Jacobian. Throws
/// Error{BadArgument} for options out of range and for a mesh without hexes.
Image render_sheet(const HexMesh& mesh, const SheetOptions& options);

}  // namespace hexwright
