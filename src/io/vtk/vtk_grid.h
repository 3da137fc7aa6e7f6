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

namespace hexwright::io {

/// Numbers of VTK's cell types.
enum VtkCellType : std::int32_t {
  VtkVertex = 1,
  VtkPolyVertex = 2,
  VtkLine = 3,
  VtkPolyLine = 4,
  VtkTriangle = 5,
  VtkTriangleStrip = 6,
  VtkPolygon = 7,
  VtkPixel = 8,
  VtkQuad = 9,
  VtkTetra = 10,
  VtkVoxel = 11,
  VtkHexahedron = 12,
  VtkQuadraticEdge = 21,
  VtkQuadraticQuad = 23,
  VtkQuadraticHexahedron = 25,
  VtkBiquadraticQuad = 28,
  VtkTriquadraticHexahedron = 29
};

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
  VtkArrays cell_data;
  VtkArrays field_data;
  bool is_polygons = false;  ///< PolyData, not an unstructured grid
};

/// Of an unstructured grid, or of polygons: their vertices, lines, polygons and strips are cells in
/// this order. Throws Error{BadFile} naming the line or the array.
VtkGrid parse_vtk_legacy(std::string_view bytes, const std::string& file_name);
VtkGrid parse_vtk_xml(std::string_view bytes, const std::string& file_name);

}  // namespace hexwright::io
