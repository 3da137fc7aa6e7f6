// Reads surfaces of VTK's files: polygons (.vtp, legacy .vtk) and the polygons of unstructured
// grids, of second order by their corners. A whole number per cell names its group.
//
// Which array that is: the first that is there of kGroupArrays. A number is called by the array of
// the field data that holds it and the dimension 2 (as in meshes of ours and of meshio), else by
// the array: "patch_3".
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "io/surface/polygon_soup.h"
#include "io/vtk/vtk_grid.h"

namespace hexwright::io {
namespace {

/// Ours first, then those of Gmsh, of meshio, of VTK's filters and of blood vessel modellers.
constexpr std::array<const char*, 12> kGroupArrays = {
    "patch",       "label",         "group",    "material", "region",      "CellEntityIds",
    "PhysicalIds", "gmsh:physical", "GroupIds", "RegionId", "ModelFaceID", "medit:ref"};

class VtkSurface {
 public:
  VtkSurface(VtkGrid&& grid, const SurfaceSource& source)
      : grid_(std::move(grid)), source_(source) {}

  PolygonSoup run() {
    soup_.positions = std::move(grid_.positions);
    find_groups();
    for_each_cell(grid_, source_.name, [&](std::size_t index, std::span<const std::int64_t> cell) {
      cell_ = index;
      add_cell(cell);
    });
    if (num_others_ > 0)
      source_.warnings.push_back(fmt::format(
          "{} cells are no polygons (vertices, lines or solids) and are left out", num_others_));
    return std::move(soup_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw bad_element(source_.name, "cell " + std::to_string(cell_),
                      message + "; the file is damaged, export it again");
  }

  void find_groups() {
    for (const char* name : kGroupArrays) {
      const auto found = grid_.cell_data.find(name);
      if (found == grid_.cell_data.end() || found->second.num_components != 1 ||
          found->second.values.size() != grid_.ends.size())
        continue;
      groups_ = &found->second;
      array_ = name;
      break;
    }
    for (const auto& [name, array] : grid_.field_data)
      if (array.values.size() == 2 && array.values[1] == 2) names_[array.values[0]] = name;
  }

  void begin_group() {
    if (!groups_) return;
    const double number = groups_->values[cell_];
    if (!std::isfinite(number) || number != std::floor(number)) return soup_.begin_group("");
    const auto name = names_.find(number);
    soup_.begin_group(name != names_.end() ? name->second
                                           : fmt::format("{}_{:.0f}", array_, number));
  }

  VertId vert(std::int64_t index) const {
    if (index < 0 || index >= static_cast<std::int64_t>(soup_.positions.size()))
      fail(fmt::format("it uses vertex {} of {}", index, soup_.positions.size()));
    return VertId(index);
  }

  void add_polygon(std::span<const std::int64_t> cell) {
    begin_group();
    if (cell.size() < 3) fail(fmt::format("it has {} vertices", cell.size()));
    for (const std::int64_t index : cell) soup_.verts.push_back(vert(index));
    soup_.end_polygon();
  }

  /// Of a cell of second order.
  void add_corners(std::span<const std::int64_t> cell, std::size_t num_corners,
                   std::size_t num_nodes) {
    if (cell.size() != num_nodes)
      fail(fmt::format("it has {} vertices instead of {}", cell.size(), num_nodes));
    add_polygon(cell.first(num_corners));
  }

  /// Every second triangle of a strip runs the other way.
  void add_strip(std::span<const std::int64_t> cell) {
    for (std::size_t k = 2; k < cell.size(); ++k)
      add_polygon(k % 2 == 0 ? std::array{cell[k - 2], cell[k - 1], cell[k]}
                             : std::array{cell[k - 1], cell[k - 2], cell[k]});
  }

  void add_cell(std::span<const std::int64_t> cell) {
    switch (grid_.types[cell_]) {
      case VtkTriangle:
      case VtkPolygon:
      case VtkQuad:
        return add_polygon(cell);
      case VtkQuadraticTriangle:
        return add_corners(cell, 3, 6);
      case VtkQuadraticQuad:
        return add_corners(cell, 4, 8);
      case VtkBiquadraticQuad:
        return add_corners(cell, 4, 9);
      case VtkTriangleStrip:
        return add_strip(cell);
      case VtkPixel:
        if (cell.size() != 4) fail("a pixel has four vertices");
        return add_polygon(std::array{cell[0], cell[1], cell[3], cell[2]});
      default:
        ++num_others_;
    }
  }

  VtkGrid grid_;
  const SurfaceSource& source_;
  PolygonSoup soup_;
  const VtkArray* groups_ = nullptr;
  std::string array_;
  std::map<double, std::string> names_;
  std::size_t cell_ = 0, num_others_ = 0;
};

}  // namespace

PolygonSoup read_vtk_legacy_surface(const SurfaceSource& source) {
  return VtkSurface(parse_vtk_legacy(source.bytes, source.name), source).run();
}

PolygonSoup read_vtk_xml_surface(const SurfaceSource& source) {
  return VtkSurface(parse_vtk_xml(source.bytes, source.name), source).run();
}

}  // namespace hexwright::io
