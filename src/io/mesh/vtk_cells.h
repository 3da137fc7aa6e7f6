// An unstructured grid in VTK's terms, shared by the legacy and the XML format.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/mesh/volume_file.h"

namespace hexwright::io {

/// Numbers of VTK's cell types.
enum VtkCellType : std::int32_t {
  VtkVertex = 1,
  VtkLine = 3,
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
};

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
