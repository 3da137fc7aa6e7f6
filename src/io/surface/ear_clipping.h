// Triangles of one polygon.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "hexwright/base/ids.h"
#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"

namespace hexwright::io {

/// Appends the n-2 triangles of a polygon of three or more vertices to `out`, by cutting off ears
/// in its mean plane: concave polygons keep their shape, holes may be bridged. A fan of what
/// remains where there is no ear (self-crossing polygons). About n log n steps for simple polygons.
void clip_ears(const IdVector<VertId, Vec3>& positions, std::span<const VertId> polygon,
               std::vector<std::array<VertId, 3>>& out);

/// Newell's normal: right for any simple polygon, planar or not; its length is twice the area.
Vec3 newell_normal(const IdVector<VertId, Vec3>& positions, std::span<const VertId> polygon);

}  // namespace hexwright::io
