// A triangle surface: an indexed face set without any assumption on closedness, manifoldness or
// orientation.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hexwright/base/issue.h"
#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"

namespace hexwright {

struct TriMesh {
  IdVector<VertId, Vec3> positions;
  IdVector<TriId, std::array<VertId, 3>> tris;  ///< counter-clockwise seen from outside
  /// What a file names parts of the surface by (solids of STL, groups of OBJ): per triangle an
  /// index into group_names, -1 for triangles that were added; empty when nothing is named.
  IdVector<TriId, std::int32_t> group;
  std::vector<std::string> group_names;  ///< "" is the group of all that the file names not

  std::size_t num_verts() const { return positions.size(); }
  std::size_t num_tris() const { return tris.size(); }
  std::array<Vec3, 3> corners(TriId t) const {
    const auto& v = tris[t];
    return {positions[v[0]], positions[v[1]], positions[v[2]]};
  }

  /// First index out of range, array of a wrong length or coordinate that is not finite.
  std::optional<Issue> find_problem() const;
};

/// Box of the vertices that triangles use (stray vertices do not count).
Box3 bounding_box(const TriMesh& surface);

}  // namespace hexwright
