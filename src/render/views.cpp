// Views that show the inside of any mesh.
#include <algorithm>
#include <array>

#include "hexwright/render/picture.h"

namespace hexwright {

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

/// Cut across the middle one of the box's sides: across the longest the cut face would be the
/// smallest, across the shortest hardly any depth would be left behind it.
PictureOptions make_default_view(const HexMesh& mesh) {
  const Vec3 extent = bounding_box(mesh).extent();
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return extent[a] < extent[b]; });
  return make_cut_view(axes[1], 0.5);
}

}  // namespace hexwright
