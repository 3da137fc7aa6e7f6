// A Gmsh file as tables: nodes, elements and physical groups.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hexwright/base/ids.h"
#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"

namespace hexwright::io {

/// Gmsh's numbers of element types.
enum GmshType : std::int64_t {
  GmshLine = 1,
  GmshTriangle = 2,
  GmshQuad = 3,
  GmshTetra = 4,
  GmshHexahedron = 5,
  GmshLine3 = 8,
  GmshTriangle6 = 9,
  GmshQuad9 = 10,
  GmshHexahedron27 = 12,
  GmshPoint = 15,
  GmshQuad8 = 16,
  GmshHexahedron20 = 17
};

/// What an element belongs to: its physical group, or its entity where it is in none.
struct GmshGroup {
  std::int64_t tag = 0;
  bool is_physical = false;
};

struct GmshElement {
  std::int64_t type = 0;
  GmshGroup group;
  std::size_t first_node = 0;  ///< in GmshFile::nodes
};

struct GmshFile {
  IdVector<VertId, Vec3> positions;
  std::vector<GmshElement> elements;  ///< of the types above
  std::vector<VertId> nodes;
  std::size_t num_others = 0;                                      ///< elements of other types
  std::array<std::map<std::int64_t, std::string>, 4> group_names;  ///< by dimension and tag

  template <std::size_t N>
  std::array<VertId, N> verts(const GmshElement& element) const {
    std::array<VertId, N> verts;
    for (std::size_t k = 0; k < N; ++k) verts[k] = nodes[element.first_node + k];
    return verts;
  }
};

/// Versions 2.x and 4.1 in text form. The first physical group of each entity counts. Throws
/// Error{BadFile} with the line.
GmshFile parse_gmsh(std::string_view bytes, const std::string& file_name);

}  // namespace hexwright::io
