#include "hexwright/render/picture_sheet.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/quality/hex_quality.h"

#include "render/face_patches.h"
#include "render/font.h"
#include "render/legend.h"

namespace hexwright {
namespace {

struct View {
  std::string caption;
  PictureOptions options;
};

std::vector<View> choose_views(const HexMesh& mesh, const std::vector<double>& values) {
  PictureOptions outside;
  outside.draw_legend = false;
  std::vector<View> views = {{"outside", outside}};
  for (int axis = 0; axis < 3; ++axis) {
    views.push_back({fmt::format("cut across {}", "xyz"[axis]),
                     make_cut_view(axis, find_clear_cut(mesh, axis))});
    views.back().options.draw_legend = false;
  }
  View worst{"", outside};
  const auto least = std::min_element(values.begin(), values.end());
  worst.options.focus = HexId(least - values.begin());
  worst.caption =
      fmt::format("worst hex: {}, scaled Jacobian {:.4f}", worst.options.focus.value(), *least);
  views.push_back(worst);
  View patches{"outside, from behind", outside};
  patches.options.view_direction = {1, -2, -0.8};
  if (!find_face_patches(mesh).empty()) {
    patches = {"patches", outside};
    patches.options.colors = PictureColors::Patches;
    patches.options.draw_legend = true;
  }
  views.push_back(patches);
  return views;
}

// Where the views and what is written about them stand, in pixels.
struct Layout {
  double letters;
  int margin, head, legend, panel_width, panel_height;

  explicit Layout(const SheetOptions& options)
      : letters(std::max(8.0, options.width / 120.0)),
        margin(static_cast<int>(letters)),
        head(static_cast<int>(3 * letters)),
        legend(legend_width(letters)),
        panel_width((options.width - legend - 2 * margin) / 3),
        panel_height((options.height - head) / 2) {}
  int left(std::size_t i) const { return margin + static_cast<int>(i % 3) * panel_width; }
  int top(std::size_t i) const { return head + static_cast<int>(i / 3) * panel_height; }
};

Image white_image(int width, int height) {
  const std::size_t size = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return {width, height, std::vector<std::uint8_t>(size, 255)};
}

void paste(const Image& part, int left, int top, Image& image) {
  for (int y = 0; y < part.height; ++y) {
    const auto from = part.rgb.begin() + std::ptrdiff_t{3} * y * part.width;
    const auto to = std::ptrdiff_t{3} * ((top + std::ptrdiff_t{y}) * image.width + left);
    std::copy(from, from + std::ptrdiff_t{3} * part.width, image.rgb.begin() + to);
  }
}

void check_options(const HexMesh& mesh, const SheetOptions& options) {
  const auto is_size = [](int pixels) { return pixels >= 400 && pixels <= 16384; };
  if (!is_size(options.width) || !is_size(options.height))
    throw Error(ErrorCode::BadArgument, "a sheet's width and height must be 400 to 16384 pixels");
  if (mesh.num_hexes() == 0)
    throw Error(ErrorCode::BadArgument, "the mesh has no hexes: there is nothing to draw");
  if (const auto issue = mesh.find_problem()) throw Error(ErrorCode::BadArgument, issue->message);
}

}  // namespace

Image render_sheet(const HexMesh& mesh, const SheetOptions& options) {
  check_options(mesh, options);
  const Layout layout(options);
  const std::vector<double> values = compute_scaled_jacobians(mesh).raw();
  Image sheet = white_image(options.width, options.height);
  const auto views = choose_views(mesh, values);
  for (std::size_t i = 0; i < views.size(); ++i) {
    PictureOptions view = views[i].options;
    view.values = values;
    view.width = layout.panel_width;
    view.height = layout.panel_height;
    view.supersample = options.supersample;
    view.letter_size = layout.letters;
    paste(render_hex_mesh(mesh, view), layout.left(i), layout.top(i), sheet);
    draw_text(sheet, layout.left(i) + layout.margin, layout.top(i) + 0.4 * layout.letters,
              views[i].caption, layout.letters);
  }
  draw_text(sheet, layout.margin, 0.6 * layout.letters,
            shorten_text(options.title, 1.3 * layout.letters, options.width - 2 * layout.margin),
            1.3 * layout.letters);
  draw_legend(sheet, "scaled Jacobian", values, layout.letters);
  return sheet;
}

}  // namespace hexwright
