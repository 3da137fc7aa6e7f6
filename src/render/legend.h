// The colour scale beside a picture, with the distribution of the values along it.
#pragma once

#include <string>
#include <vector>

#include "hexwright/render/picture.h"

#include "render/color.h"

namespace hexwright {

/// Pixels at the right of an image that a legend with letters of this size uses.
int legend_width(double letter_size);

void draw_legend(Image& image, const std::string& title, const std::vector<double>& values,
                 double letter_size);

struct NamedColor {
  std::string name;
  Color color;
};

/// A list of names with their colours at the right, as many as there is room for, and how many more
/// there are.
void draw_names(Image& image, const std::vector<NamedColor>& names, double letter_size);

}  // namespace hexwright
