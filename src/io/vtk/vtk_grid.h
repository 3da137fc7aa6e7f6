// The files of VTK as tables, before anything is checked but their form: unstructured grids and
// polygons, as a legacy or an XML file has them.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hexwright/base/cancel.h"
#include "hexwright/base/ids.h"
#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"

#include "io/text/file_bytes.h"
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

/// Calls `visit(index, vertices)` for every cell in order; vertices are a std::span of the
/// connectivity, whose indices are not checked. Throws Error{BadFile} naming the cell when its
/// entries lie outside, or the numbers of cells and types differ.
template <class Visit>
void for_each_cell(const VtkGrid& grid, const std::string& file_name, Visit&& visit) {
  if (grid.types.size() != grid.ends.size())
    throw bad_file(file_name, std::to_string(grid.ends.size()) + " cells but " +
                                  std::to_string(grid.types.size()) +
                                  " cell types; the file is damaged, export it again");
  const std::span<const std::int64_t> connectivity(grid.connectivity);
  std::size_t begin = 0;
  CancelCheck check_cancelled;
  for (std::size_t cell = 0; cell < grid.ends.size(); ++cell) {
    check_cancelled();
    const auto end = static_cast<std::size_t>(grid.ends[cell]);  // a negative one is too large
    if (end < begin || end > connectivity.size())
      throw bad_element(file_name, "cell " + std::to_string(cell),
                        "its vertices lie outside the connectivity array; the file is damaged, "
                        "export it again");
    visit(cell, connectivity.subspan(begin, end - begin));
    begin = end;
  }
}

}  // namespace hexwright::io
