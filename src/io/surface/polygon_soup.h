// What surface readers collect: points and polygons, triangulated when the file has been read.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "hexwright/io/surface_io.h"

#include "io/text/file_bytes.h"

namespace hexwright::io {

/// Polygons in compressed rows. Indices are checked by the readers, which know the line.
struct PolygonSoup {
  IdVector<VertId, Vec3> positions;
  std::vector<VertId> verts;
  std::vector<std::size_t> ends;         ///< ends[p]: one past polygon p's last entry in `verts`
  std::vector<std::int32_t> group;       ///< per polygon, or empty while nothing has a name
  std::vector<std::string> group_names;  ///< as in TriMesh

  /// Closes the polygon whose vertices were appended to `verts` since the last call.
  void end_polygon() {
    ends.push_back(verts.size());
    if (!group_names.empty()) group.push_back(current_group);
  }
  /// Polygons closed from now on belong to this group; "" is the group without a name.
  void begin_group(std::string_view name);
  /// The group of this name, made when there is none yet.
  std::int32_t add_group(std::string_view name);
  std::size_t num_open_verts() const {
    return verts.size() - (ends.empty() ? std::size_t{0} : ends.back());
  }

  std::int32_t current_group = -1;
  std::map<std::string, std::int32_t, std::less<>> name_to_group;
};

/// A name as it is kept in memory: trimmed, at most 200 bytes, control characters and bytes that
/// are no UTF-8 replaced by '_'.
std::string clean_name(std::string_view name);

/// Triangles as they are; quads along the diagonal that folds less; larger polygons by ear clipping
/// in their mean plane, so that concave ones keep their shape. n-2 triangles each, in file order,
/// in their polygon's group; groups that say nothing (one without a name) are left out.
TriMesh triangulate(PolygonSoup&& soup);

/// Readers of one format each: `text`/`bytes` is the whole file, `warnings` may be appended to.
struct SurfaceSource {
  std::string_view bytes;
  const std::string& name;
  std::vector<std::string>& warnings;
};
PolygonSoup read_obj(const SurfaceSource& source);
PolygonSoup read_off(const SurfaceSource& source);
PolygonSoup read_stl_ascii(const SurfaceSource& source);
PolygonSoup read_stl_binary(const SurfaceSource& source);
PolygonSoup read_ply(const SurfaceSource& source);
PolygonSoup read_vtk_legacy_surface(const SurfaceSource& source);
PolygonSoup read_vtk_xml_surface(const SurfaceSource& source);
PolygonSoup read_gmsh_surface(const SurfaceSource& source);
PolygonSoup read_nastran_surface(const SurfaceSource& source);
PolygonSoup read_3mf(const SurfaceSource& source);

/// True for the first token of an OFF file: OFF, COFF, NOFF, STCNOFF ...
bool is_off_keyword(std::string_view token);
/// True when the size is exactly what the count field of a binary STL says.
bool is_exact_binary_stl(std::string_view bytes);

}  // namespace hexwright::io
