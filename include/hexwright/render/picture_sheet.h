// Several views of a hex mesh in one picture.
#pragma once

#include <string>

#include "hexwright/render/picture.h"

namespace hexwright {

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
