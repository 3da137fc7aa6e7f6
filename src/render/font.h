// Letters for legends and captions: outlines of DejaVu Sans, filled with exact coverage.
#pragma once

#include <string>
#include <string_view>

#include "hexwright/render/picture.h"

namespace hexwright {

/// Width of a UTF-8 text in pixels; `size` is the letters' em in pixels.
double text_width(std::string_view text, double size);
/// From a line's top to the next one's.
double line_height(double size);

/// Draws dark letters whose line has its top left at (x, y), clipped to the image. Characters that
/// are not Latin-1 are drawn as '?', control characters as nothing.
void draw_text(Image& image, double x, double y, std::string_view text, double size);

/// The text, or as much of its beginning as fits into `width` with an ellipsis behind it.
std::string shorten_text(std::string_view text, double size, double width);

}  // namespace hexwright
