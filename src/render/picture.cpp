// From a hex mesh to an image: camera, faces, light, z-buffer, ambient occlusion, legend.
#include "hexwright/render/picture.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"
#include "hexwright/io/set_table.h"
#include "hexwright/quality/hex_quality.h"

#include "mesh/quad.h"
#include "render/ambient_occlusion.h"
#include "render/camera.h"
#include "render/creases.h"
#include "render/curved_faces.h"
#include "render/face_patches.h"
#include "render/legend.h"
#include "render/rasterizer.h"
#include "render/visible_faces.h"

namespace hexwright {
namespace {

constexpr Color kFocusColor = {0.88F, 0.0F, 0.66F};
constexpr Color kNoPatchColor = {0.78F, 0.8F, 0.83F};

void check_options(const HexMesh& mesh, const PictureOptions& options) {
  const auto require = [](bool holds, const char* message) {
    if (!holds) throw Error(ErrorCode::BadArgument, message);
  };
  const auto is_size = [](int pixels) { return pixels >= 16 && pixels <= 16384; };
  require(is_size(options.width) && is_size(options.height),
          "a picture's width and height must be 16 to 16384 pixels");
  require(options.supersample >= 1 && options.supersample <= 8,
          "a picture needs 1 to 8 samples per pixel and axis");
  require(is_finite(options.view_direction) && norm(options.view_direction) > 0,
          "the view direction must not be zero");
  require(!options.cut || (is_finite(options.cut->normal) && norm(options.cut->normal) > 0),
          "the normal of the cut must not be zero");
  require(options.values.empty() || options.values.size() == mesh.num_hexes(),
          "a picture needs one value per hex, or none");
  require(options.focus.value() < static_cast<std::int64_t>(mesh.num_hexes()),
          "the hex that a picture is about is not in the mesh");
  require(options.letter_size >= 0 && options.letter_size <= 1000,
          "letters must be of 0 to 1000 pixels");
  if (const auto issue = mesh.find_problem()) require(false, issue->message.c_str());
}

// Vertices of the faces, each once.
std::vector<Vec3> visible_positions(const HexMesh& mesh, const std::vector<VisibleFace>& faces) {
  IdVector<VertId, char> is_visible(mesh.num_verts(), 0);
  CancelCheck check_cancelled;
  for (const VisibleFace& visible : faces) {
    check_cancelled();
    for (VertId v : face_verts(mesh, visible.face)) is_visible[v] = 1;
  }
  std::vector<Vec3> points;
  for (VertId v : mesh.positions.ids())
    if (is_visible[v]) points.push_back(mesh.positions[v]);
  if (!mesh.mid_nodes) return points;
  for (const VisibleFace& visible : faces) {
    const QuadraticQuad quad =
        quadratic_face(quadratic_hex(mesh, visible.face.hex), visible.face.lf);
    points.insert(points.end(), quad.begin() + 4, quad.end());
  }
  return points;
}

// The legend takes its strip at the right; the mesh is framed in what is left.
Viewport place_viewport(const Image& image, int legend) {
  const double margin = 0.04 * std::min(image.width, image.height);
  const double right = legend > 0 ? legend + margin : margin;
  return {margin, margin, std::max(1.0, image.width - margin - right), image.height - 2 * margin};
}

// Fainter on the boundary: there the lines of many small quads would hide the shape.
float line_share_of(const VisibleFace& visible) { return visible.is_boundary ? 0.5F : 0.85F; }

// Edges fade where the faces become so small that lines would cover them.
float line_share(const std::array<ScreenPoint, 4>& c) {
  double perimeter = 0;
  for (std::size_t k = 0; k < 4; ++k)
    perimeter += norm(Vec3{c[(k + 1) % 4].x - c[k].x, c[(k + 1) % 4].y - c[k].y, 0});
  return static_cast<float>(std::clamp((perimeter / 4 - 1.5) / 6, 0.0, 1.0));
}

ShadedQuad shade(const HexMesh& mesh, const VisibleFace& visible, const Camera& camera,
                 const Color& color) {
  const auto verts = face_verts(mesh, visible.face);
  std::array<Vec3, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.positions[verts[k]];
  ShadedQuad quad;
  quad.base_color = color;
  light_quad(p, camera, quad);
  quad.line_share = line_share_of(visible) * line_share(quad.corners);
  quad.bold_sides = visible.bold_sides;
  if (visible.is_focus) {
    quad.bold_sides = 0xf;
    quad.line_color = kFocusColor;
  }
  return quad;
}

std::vector<Color> color_faces(const HexMesh& mesh, const std::vector<VisibleFace>& faces,
                               const std::vector<double>& values, const PictureOptions& options) {
  const bool by_patch = options.colors == PictureColors::Patches;
  const bool is_faded =
      !by_patch && options.fade_boundary && (options.cut || options.focus.is_valid());
  const auto patches = by_patch ? find_face_patches(mesh) : std::vector<PatchId>();
  std::vector<Color> colors;
  colors.reserve(faces.size());
  for (const VisibleFace& visible : faces) {
    Color color = by_patch ? kNoPatchColor : quality_color(values[visible.face.hex.index()]);
    if (is_faded && visible.is_boundary && !visible.is_focus)
      color = mix(color, {0.97F, 0.96F, 0.94F}, 0.85F);
    if (!patches.empty() && patches[face_slot(visible.face)].is_valid())
      color = category_color(patches[face_slot(visible.face)].index());
    colors.push_back(color);
  }
  return colors;
}

std::vector<ShadedQuad> shade_faces(const HexMesh& mesh, const std::vector<VisibleFace>& faces,
                                    const std::vector<Color>& colors, const Camera& camera,
                                    const PictureOptions& options) {
  std::vector<ShadedQuad> quads(faces.size());
  parallel_for(faces.size(), [&](std::size_t i) {
    quads[i] = shade(mesh, faces[i], camera, colors[i]);
    if (options.draw_edges) return;
    quads[i].line_share = 0;
    quads[i].bold_sides = 0;
  });
  return mesh.mid_nodes ? divide_curved(mesh, faces, quads, camera) : quads;
}

// Letters grow with the picture.
double letter_size(const PictureOptions& options) {
  return options.letter_size > 0 ? options.letter_size : std::max(8.0, options.width / 80.0);
}

bool is_turned_away(const HexMesh& mesh, const HexFace& face, const Vec3& view_direction) {
  return dot(quad_normal(mesh.positions, face_verts(mesh, face)), view_direction) > 0;
}

// Those with faces towards the eye, largest first: a legend may have room for a few only.
std::vector<NamedColor> list_patches(const HexMesh& mesh, const std::vector<VisibleFace>& faces,
                                     const Vec3& view_direction) {
  const auto patch_of = find_face_patches(mesh);
  std::vector<std::pair<std::size_t, std::size_t>> patches;  // quads, patch
  for (const VisibleFace& visible : faces) {
    const PatchId patch = patch_of.empty() ? PatchId() : patch_of[face_slot(visible.face)];
    if (!patch.is_valid() || is_turned_away(mesh, visible.face, view_direction)) continue;
    while (patches.size() <= patch.index()) patches.emplace_back(0, patches.size());
    ++patches[patch.index()].first;
  }
  std::stable_sort(patches.begin(), patches.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<NamedColor> names;
  for (const auto& [num_quads, patch] : patches)
    if (num_quads > 0)
      names.push_back(
          {set_name(mesh, SetKind::Patch, PatchId(patch).value()), category_color(patch)});
  return names;
}

void copy_pixels(const Raster& raster, Image& image) {
  const auto to_byte = [](float component) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(component, 0.0F, 1.0F)));
  };
  image.rgb.clear();
  image.rgb.reserve(3 * raster.color.size());
  for (const Color& c : raster.color)
    for (float component : {c.r, c.g, c.b}) image.rgb.push_back(to_byte(component));
}

}  // namespace

Image render_hex_mesh(const HexMesh& mesh, const PictureOptions& options) {
  check_options(mesh, options);
  Image image{options.width, options.height, {}};
  const auto values =
      options.values.empty() ? compute_scaled_jacobians(mesh).raw() : options.values;
  auto faces = options.focus.is_valid()
                   ? find_faces_about(mesh, options.focus, options.view_direction)
                   : find_visible_faces(mesh, options.cut);
  if (options.draw_edges) mark_creases(mesh, faces);
  const double letters = letter_size(options);
  const Camera camera(visible_positions(mesh, faces), options.view_direction,
                      place_viewport(image, options.draw_legend ? legend_width(letters) : 0));
  RasterOptions raster_options{options.width, options.height, options.supersample, 1};
  raster_options.line_width = std::max(0.7, options.width / 1100.0);
  raster_options.bold_width = (options.focus.is_valid() ? 4 : 2.2) * raster_options.line_width;
  const auto colors = color_faces(mesh, faces, values, options);
  Raster raster = rasterize(shade_faces(mesh, faces, colors, camera, options), raster_options);
  apply_ambient_occlusion(raster, camera.focal_length());
  copy_pixels(raster, image);
  if (!options.draw_legend) return image;
  if (options.colors == PictureColors::Patches)
    draw_names(image, list_patches(mesh, faces, options.view_direction), letters);
  else
    draw_legend(image, options.legend_title, values, letters);
  return image;
}

}  // namespace hexwright
