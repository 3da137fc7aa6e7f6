// Darkens corners and steps, so that the eye sees depth in a picture without shadows.
#pragma once

#include "render/rasterizer.h"

namespace hexwright {

/// `focal_length` as of the camera that made the raster.
void apply_ambient_occlusion(Raster& raster, double focal_length);

}  // namespace hexwright
