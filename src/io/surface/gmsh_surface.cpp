// Reads surfaces of Gmsh files: triangles and quads, of second order by their corners, with their
// physical groups, or their elementary surfaces where there are no groups.
#include <fmt/format.h>

#include "io/surface/polygon_soup.h"
#include "io/text/gmsh_file.h"

namespace hexwright::io {
namespace {

/// Of triangles and quads; 0 of all else.
std::size_t num_corners(std::int64_t type) {
  switch (type) {
    case GmshTriangle:
    case GmshTriangle6:
      return 3;
    case GmshQuad:
    case GmshQuad8:
    case GmshQuad9:
      return 4;
    default:
      return 0;
  }
}

/// Curves and corners of the geometry, which Gmsh writes with its surfaces.
bool is_line_or_point(std::int64_t type) {
  return type == GmshLine || type == GmshLine3 || type == GmshPoint;
}

/// "" for elements without a group among others that have one.
std::string group_name(const GmshFile& file, const GmshGroup& group, bool has_physical) {
  if (group.is_physical != has_physical) return {};
  if (!has_physical) return fmt::format("surface_{}", group.tag);
  const auto named = file.group_names[2].find(group.tag);
  return named != file.group_names[2].end() ? named->second : fmt::format("physical_{}", group.tag);
}

}  // namespace

PolygonSoup read_gmsh_surface(const SurfaceSource& source) {
  GmshFile file = parse_gmsh(source.bytes, source.name);
  std::size_t num_left_out = file.num_others;
  bool has_physical = false;
  for (const GmshElement& element : file.elements)
    if (num_corners(element.type) > 0) has_physical = has_physical || element.group.is_physical;
  PolygonSoup soup;
  soup.positions = std::move(file.positions);
  for (const GmshElement& element : file.elements) {
    const std::size_t corners = num_corners(element.type);
    if (corners == 0) {
      num_left_out += !is_line_or_point(element.type);
      continue;
    }
    soup.begin_group(group_name(file, element.group, has_physical));
    for (std::size_t k = 0; k < corners; ++k)
      soup.verts.push_back(file.nodes[element.first_node + k]);
    soup.end_polygon();
  }
  if (num_left_out > 0)
    source.warnings.push_back(
        fmt::format("{} elements are no triangles or quads and are left out", num_left_out));
  return soup;
}

}  // namespace hexwright::io
