// Views that show the inside of any mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/render/picture.h"

#include "mesh/quad.h"

namespace hexwright {
namespace {

// A quad of the boundary that lies along a cut.
struct AlongQuad {
  double place;      ///< as a cut's
  double thickness;  ///< of its hex, as a share of the box
  double area;
};

std::vector<AlongQuad> find_along_quads(const HexMesh& mesh, int axis, const Box3& box) {
  constexpr double kAlong = 0.8;  // cosine
  const double extent = box.extent()[axis];
  std::vector<AlongQuad> quads;
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary) {
    const auto verts = face_verts(mesh, face);
    if (std::abs(quad_normal(mesh.positions, verts)[axis]) <= kAlong) continue;
    const double area = quad_area(mesh.positions, verts);
    double low = box.hi[axis], high = box.lo[axis];
    for (const Vec3& corner : mesh.corners(face.hex)) {
      low = std::min(low, corner[axis]);
      high = std::max(high, corner[axis]);
    }
    double middle = 0;
    for (VertId v : verts) middle += mesh.positions[v][axis] / 4;
    quads.push_back({(box.hi[axis] - middle) / extent, (high - low) / extent, area});
  }
  return quads;
}

double area_near(const std::vector<AlongQuad>& quads, double place) {
  double area = 0;
  for (const AlongQuad& quad : quads)
    if (std::abs(quad.place - place) <= quad.thickness) area += quad.area;
  return area;
}

}  // namespace

PictureOptions make_cut_view(int axis, double offset) {
  PictureOptions options;
  // The eye stands on the cut-away side (negative along the axis) and a little beside and above.
  Vec3 direction{-0.5, -0.35, -0.45};
  direction[axis] = 1;
  options.view_direction = direction;
  PictureOptions::Cut cut;
  cut.normal = {0, 0, 0};
  cut.normal[axis] = -1;
  cut.offset = offset;
  options.cut = cut;
  return options;
}

double find_clear_cut(const HexMesh& mesh, int axis) {
  constexpr double kMiddle = 0.5, kStep = 0.02;
  constexpr double kNegligible = 0.03;  // share of the box's cross-section
  const Box3 box = bounding_box(mesh);
  if (mesh.num_hexes() == 0 || mesh.find_problem() || !(box.extent()[axis] > 0)) return kMiddle;
  const auto quads = find_along_quads(mesh, axis, box);
  const Vec3 extent = box.extent();
  double best = kMiddle, least = area_near(quads, kMiddle);
  const double enough = kNegligible * extent[(axis + 1) % 3] * extent[(axis + 2) % 3];
  for (int step = 1; step <= 5 && least > enough; ++step)
    for (const double place : {kMiddle - step * kStep, kMiddle + step * kStep}) {
      const double area = area_near(quads, place);
      if (area >= least) continue;
      least = area;
      best = place;
    }
  return best;
}

/// Cut across the middle one of the box's sides: across the longest the cut face would be the
/// smallest, across the shortest hardly any depth would be left behind it.
PictureOptions make_default_view(const HexMesh& mesh) {
  const Vec3 extent = bounding_box(mesh).extent();
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return extent[a] < extent[b]; });
  return make_cut_view(axes[1], find_clear_cut(mesh, axes[1]));
}

}  // namespace hexwright
