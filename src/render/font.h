// Letters of 5 x 7 pixels for legends.
#pragma once

#include <string_view>

#include "hexwright/render/picture.h"

namespace hexwright {

/// Width of a text in pixels at a scale; letters are 5 pixels wide with a gap of one.
int text_width(std::string_view text, int scale);
/// Height of a line in pixels, with a gap below.
int text_height(int scale);

/// Draws dark letters with their top left at (x, y), clipped to the image. Characters without a
/// glyph stay blank.
void draw_text(Image& image, int x, int y, std::string_view text, int scale);

}  // namespace hexwright
