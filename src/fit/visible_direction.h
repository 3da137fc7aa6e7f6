// A direction that sees a set of faces from in front, as squarely as possible.
#pragma once

#include <span>

#include "hexwright/base/vec3.h"

namespace hexwright::fitting {

struct SheetDirection {
  Vec3 direction;     ///< unit
  double cosine = 0;  ///< least n . direction over the normals; not positive: none sees all
};

/// Maximises the least n . d over unit normals n, to the accuracy of 40 steps.
SheetDirection find_sheet_direction(std::span<const Vec3> normals);

}  // namespace hexwright::fitting
