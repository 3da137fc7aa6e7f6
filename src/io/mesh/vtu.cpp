// VTK's XML unstructured grids (.vtu).
#include "io/mesh/vtk_cells.h"
#include "io/mesh/vtk_xml.h"

namespace hexwright::io {

VolumeFile read_vtu(const VolumeSource& source) {
  return to_volume_file(parse_vtk_xml(source.bytes, source.name), source.name);
}

std::string vtu_bytes(const NodeTable& nodes, const SetTable& table,
                      const WriteHexOptions& options) {
  return vtu_bytes(nodes.positions(), make_vtk_output(nodes, table, options));
}

std::string vtu_bytes(const IdVector<VertId, Vec3>& positions, const VtkOutput& data) {
  VtkXmlWriter xml("UnstructuredGrid");
  xml.open("UnstructuredGrid");
  xml.open("FieldData");
  for (const VtkOutArray& array : data.field_data) xml.array(array, VtkXmlWriter::Kind::Field);
  xml.close("FieldData");
  xml.open("Piece NumberOfPoints=\"" + std::to_string(positions.size()) + "\" NumberOfCells=\"" +
           std::to_string(data.types.size()) + "\"");
  xml.open("PointData");
  for (const VtkOutArray& array : data.point_data) xml.array(array, VtkXmlWriter::Kind::Data);
  xml.close("PointData");
  xml.open("CellData");
  for (const VtkOutArray& array : data.cell_data) xml.array(array, VtkXmlWriter::Kind::Data);
  xml.close("CellData");
  xml.open("Points");
  xml.array<Vec3>("Points", "Float64", 3, positions.raw());
  xml.close("Points");
  xml.open("Cells");
  xml.array<std::int32_t>("connectivity", "Int32", 1, data.connectivity);
  xml.array<std::int32_t>("offsets", "Int32", 1, data.ends);
  xml.array<std::uint8_t>("types", "UInt8", 1, data.types);
  xml.close("Cells");
  xml.close("Piece");
  xml.close("UnstructuredGrid");
  return xml.take();
}

}  // namespace hexwright::io
