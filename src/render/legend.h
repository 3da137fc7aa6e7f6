// The colour scale beside a picture, with the distribution of the values along it.
#pragma once

#include <string>
#include <vector>

#include "hexwright/render/picture.h"

namespace hexwright {

/// Pixels at the right of the image that draw_legend uses.
int legend_width(const Image& image);

void draw_legend(Image& image, const std::string& title, const std::vector<double>& values);

}  // namespace hexwright
