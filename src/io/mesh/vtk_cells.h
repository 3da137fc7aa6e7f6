// An unstructured grid in VTK's terms, shared by the legacy and the XML format.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/content/volume_file.h"
#include "io/vtk/vtk_grid.h"

namespace hexwright::io {

/// Sorts cells by kind and checks every index. Throws Error{BadFile} naming the cell.
VolumeFile to_volume_file(VtkGrid&& grid, const std::string& file_name);

/// One array to be written.
struct VtkOutArray {
  std::string name;
  std::size_t num_components = 1;
  std::vector<double> reals;       ///< used when not empty or when ints are empty
  std::vector<std::int32_t> ints;  ///< used when is_int
  bool is_int = false;
};

/// A hex mesh as the VTK formats write it.
struct VtkOutput {
  std::vector<std::int32_t> connectivity;
  std::vector<std::int32_t> ends;
  std::vector<std::uint8_t> types;
  std::vector<VtkOutArray> cell_data;
  std::vector<VtkOutArray> point_data;
  std::vector<VtkOutArray> field_data;
};
VtkOutput make_vtk_output(const NodeTable& nodes, const SetTable& table,
                          const WriteHexOptions& options);
std::string vtu_bytes(const IdVector<VertId, Vec3>& positions, const VtkOutput& data);

}  // namespace hexwright::io
