// The files of VTK as tables, before anything is checked but their form: unstructured grids and
// polygons, as a legacy or an XML file has them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hexwright/base/ids.h"
#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"

#include "io/vtk/vtk_types.h"

namespace hexwright::io {

/// Every number type of the formats fits a double but for huge integers, which no index needs.
struct VtkArray {
  std::size_t num_components = 1;
  std::vector<double> values;
};
using VtkArrays = std::map<std::string, VtkArray, std::less<>>;

/// Read from a file, before anything is checked.
struct VtkGrid {
  IdVector<VertId, Vec3> positions;
  std::vector<std::int64_t> connectivity;
  std::vector<std::int64_t> ends;  ///< per cell: one past its last entry in connectivity
  std::vector<std::int32_t> types;
  VtkArrays point_data;  ///< where it was asked for
  VtkArrays cell_data;
  VtkArrays field_data;
  bool is_polygons = false;  ///< PolyData, not an unstructured grid
};

/// Of an unstructured grid, or of polygons: their vertices, lines, polygons and strips are cells in
/// this order. Throws Error{BadFile} naming the line or the array.
VtkGrid parse_vtk_legacy(std::string_view bytes, const std::string& file_name);
VtkGrid parse_vtk_xml(std::string_view bytes, const std::string& file_name);

/// parse_vtk_xml() with the point data of one component.
VtkGrid parse_vtk_xml_points(std::string_view bytes, const std::string& file_name);

}  // namespace hexwright::io
