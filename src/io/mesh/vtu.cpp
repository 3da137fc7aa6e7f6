// Reads VTK's XML unstructured grids (.vtu): text, inline base64, appended raw or base64; zlib or
// not; 32- or 64-bit headers; either byte order; several pieces.
#include <cstring>

#include <pugixml.hpp>

#include "io/mesh/vtk_cells.h"
#include "io/mesh/vtk_xml.h"
#include "io/surface/polygon_soup.h"
#include "io/text/encoded_stream.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

class VtuReader {
 public:
  explicit VtuReader(const VolumeSource& source) : file_(source) {}

  VtkGrid run() {
    const auto grid = file_.root().child("UnstructuredGrid");
    if (!grid)
      throw bad_file(file_.name(), std::string("the file holds a '") +
                                       file_.root().attribute("type").value() +
                                       "', not an UnstructuredGrid; export it as one");
    read_data(grid.child("FieldData"), grid_.field_data, 0);
    for (const auto piece : grid.children("Piece")) read_piece(piece);
    return std::move(grid_);
  }

 private:
  /// Pieces are put one behind the other; their indices count from their own first vertex.
  void read_piece(const pugi::xml_node& piece) {
    const auto points = file_.values(piece.child("Points").child("DataArray"));
    if (points.size() % 3 != 0)
      throw bad_element(file_.name(), "Points",
                        "the number of coordinates is no multiple of 3; export the file again");
    const auto first_vert = static_cast<std::int64_t>(grid_.positions.size());
    for (std::size_t i = 0; i < points.size(); i += 3) {
      const Vec3 p = {points[i], points[i + 1], points[i + 2]};
      if (!is_finite(p))
        throw bad_element(file_.name(), "point " + std::to_string(i / 3),
                          "a coordinate is not finite; export the file again");
      grid_.positions.push_back(p);
    }
    const std::size_t num_cells_before = grid_.ends.size();
    read_cells(piece.child("Cells"), first_vert);
    read_data(piece.child("CellData"), grid_.cell_data, num_cells_before);
  }

  void read_cells(const pugi::xml_node& cells, std::int64_t first_vert) {
    const auto first_entry = static_cast<std::int64_t>(grid_.connectivity.size());
    for (double v : named(cells, "connectivity"))
      grid_.connectivity.push_back(to_index(v) + first_vert);
    for (double end : named(cells, "offsets")) grid_.ends.push_back(to_index(end) + first_entry);
    for (double type : named(cells, "types"))
      grid_.types.push_back(static_cast<std::int32_t>(to_index(type)));
  }

  /// Also refuses NaN, for which neither comparison holds.
  std::int64_t to_index(double value) const {
    if (!(value >= 0 && value <= static_cast<double>(kMaxElements)))
      throw bad_element(file_.name(), "Cells",
                        "an index is out of range; the file is damaged, export it again");
    return static_cast<std::int64_t>(value);
  }

  std::vector<double> named(const pugi::xml_node& parent, const char* name) const {
    const auto array = parent.find_child_by_attribute("DataArray", "Name", name);
    if (!array)
      throw bad_element(file_.name(), "Cells",
                        std::string("there is no DataArray '") + name + "'; export the file again");
    return file_.values(array);
  }

  /// Values are appended behind `num_before` entries of earlier pieces (0 where those had none).
  /// Labels have one component; other arrays of cells are passed over, so that no number of
  /// components that a file claims is ever multiplied by a number of cells.
  void read_data(const pugi::xml_node& parent, VtkArrays& out, std::size_t num_before) {
    for (const auto node : parent.children("DataArray")) {
      if (std::strcmp(node.attribute("type").value(), "String") == 0) continue;
      const std::size_t num_components = node.attribute("NumberOfComponents").as_uint(1);
      if (num_before > 0 && num_components != 1) continue;
      VtkArray& array = out[node.attribute("Name").value()];
      array.num_components = num_components;
      array.values.resize(num_before * array.num_components);
      const auto values = file_.values(node);
      array.values.insert(array.values.end(), values.begin(), values.end());
    }
  }

  VtkXmlFile file_;
  VtkGrid grid_;
};

}  // namespace

VolumeFile read_vtu(const VolumeSource& source) {
  return to_volume_file(VtuReader(source).run(), source.name);
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
