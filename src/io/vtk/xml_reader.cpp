// Reads VTK's XML files of unstructured grids (.vtu) and polygons (.vtp): text, inline base64,
// appended raw or base64; zlib or not; 32- or 64-bit headers; either byte order; several pieces.
#include <cstring>

#include "hexwright/base/cancel.h"

#include "io/text/file_bytes.h"
#include "io/vtk/vtk_grid.h"
#include "io/vtk/vtk_xml_file.h"

namespace hexwright::io {
namespace {

class VtkXmlReader {
 public:
  VtkXmlReader(std::string_view bytes, const std::string& name, bool wants_points)
      : file_(bytes, name), wants_points_(wants_points) {}

  VtkGrid run() {
    grid_.is_polygons = !file_.root().child("PolyData").empty();
    const auto grid = file_.root().child(grid_.is_polygons ? "PolyData" : "UnstructuredGrid");
    if (!grid)
      throw bad_file(file_.name(), std::string("the file holds a '") +
                                       file_.root().attribute("type").value() +
                                       "', not an UnstructuredGrid or PolyData; export it as one");
    read_data(grid.child("FieldData"), grid_.field_data, 0, true);
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
    CancelCheck check_cancelled;
    for (std::size_t i = 0; i < points.size(); i += 3) {
      check_cancelled();
      const Vec3 p = {points[i], points[i + 1], points[i + 2]};
      if (!is_finite(p))
        throw bad_element(file_.name(), "point " + std::to_string(i / 3),
                          "a coordinate is not finite; export the file again");
      grid_.positions.push_back(p);
    }
    if (wants_points_)
      read_data(piece.child("PointData"), grid_.point_data, static_cast<std::size_t>(first_vert),
                false);
    const std::size_t num_cells_before = grid_.ends.size();
    grid_.is_polygons ? read_polygons(piece, first_vert)
                      : read_cells(piece.child("Cells"), first_vert);
    read_data(piece.child("CellData"), grid_.cell_data, num_cells_before, false);
  }

  /// Vertices, lines, polygons and strips, each of which may be missing.
  void read_polygons(const pugi::xml_node& piece, std::int64_t first_vert) {
    struct Kind {
      const char* name;
      std::int32_t type;
    };
    constexpr Kind kKinds[] = {{"Verts", VtkPolyVertex},
                               {"Lines", VtkPolyLine},
                               {"Polys", VtkPolygon},
                               {"Strips", VtkTriangleStrip}};
    for (const Kind& kind : kKinds) {
      const auto cells = piece.child(kind.name);
      if (!cells.find_child_by_attribute("DataArray", "Name", "connectivity")) continue;
      read_connectivity(cells, first_vert);
      grid_.types.resize(grid_.ends.size(), kind.type);
    }
  }

  void read_cells(const pugi::xml_node& cells, std::int64_t first_vert) {
    read_connectivity(cells, first_vert);
    CancelCheck check_cancelled;
    for (double type : named(cells, "types")) {
      check_cancelled();
      grid_.types.push_back(static_cast<std::int32_t>(to_index(type)));
    }
  }

  void read_connectivity(const pugi::xml_node& cells, std::int64_t first_vert) {
    const auto first_entry = static_cast<std::int64_t>(grid_.connectivity.size());
    CancelCheck check_cancelled;
    for (double v : named(cells, "connectivity")) {
      check_cancelled();
      grid_.connectivity.push_back(to_index(v) + first_vert);
    }
    for (double end : named(cells, "offsets")) {
      check_cancelled();
      grid_.ends.push_back(to_index(end) + first_entry);
    }
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
  /// Labels and sizes have one component; other arrays of cells and points are passed over, so that
  /// no number of components that a file claims is ever multiplied by a number of cells. Field data
  /// have rows, of several.
  void read_data(const pugi::xml_node& parent, VtkArrays& out, std::size_t num_before,
                 bool with_rows) {
    for (const auto node : parent.children("DataArray")) {
      if (std::strcmp(node.attribute("type").value(), "String") == 0) continue;
      const std::size_t num_components = node.attribute("NumberOfComponents").as_uint(1);
      if (!with_rows && num_components != 1) continue;
      VtkArray& array = out[node.attribute("Name").value()];
      array.num_components = num_components;
      array.values.resize(num_before * array.num_components);
      const auto values = file_.values(node);
      array.values.insert(array.values.end(), values.begin(), values.end());
    }
  }

  VtkXmlFile file_;
  bool wants_points_;
  VtkGrid grid_;
};

}  // namespace

VtkGrid parse_vtk_xml(std::string_view bytes, const std::string& file_name) {
  return VtkXmlReader(bytes, file_name, false).run();
}

VtkGrid parse_vtk_xml_points(std::string_view bytes, const std::string& file_name) {
  return VtkXmlReader(bytes, file_name, true).run();
}

}  // namespace hexwright::io
