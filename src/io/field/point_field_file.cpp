// Reads point data of VTK's XML images and unstructured grids.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "hexwright/io/point_field.h"

#include "io/field/tet_tree.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"
#include "io/vtk/vtk_grid.h"
#include "io/vtk/vtk_xml_file.h"

namespace hexwright::io {
namespace {

constexpr const char* kUsualName = "size";

/// The array that is meant, of those there are.
std::string choose_array(const std::vector<std::string>& names, const std::string& asked,
                         const std::string& file) {
  const std::string wanted = asked.empty() && names.size() != 1 ? kUsualName : asked;
  if (wanted.empty()) return names.front();
  if (std::find(names.begin(), names.end(), wanted) != names.end()) return wanted;
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  throw bad_file(file, known.empty()
                           ? "there is no point data with one number per point; write the sizes as "
                             "point data"
                           : fmt::format("there is no point data '{}' with one number per point; "
                                         "there is {}",
                                         wanted, known));
}

bool is_scalar(const pugi::xml_node& array) {
  return std::strcmp(array.attribute("type").value(), "String") != 0 &&
         array.attribute("NumberOfComponents").as_uint(1) == 1;
}

class ImageReader {
 public:
  ImageReader(std::string_view bytes, const std::string& name) : xml_(bytes, name) {}

  PointField run(const std::string& array) {
    const auto image = xml_.root().child("ImageData");
    if (!image)
      throw bad_file(xml_.name(), fmt::format("the file holds a '{}', not an ImageData",
                                              xml_.root().attribute("type").value()));
    const auto piece = image.child("Piece");
    if (!piece || piece.next_sibling("Piece"))
      throw bad_file(xml_.name(), "the image has not one piece; write it in one");
    const PointLattice lattice = read_lattice(image, piece);
    const auto data = piece.child("PointData");
    std::vector<std::string> names;
    for (const auto node : data.children("DataArray"))
      if (is_scalar(node)) names.emplace_back(node.attribute("Name").value());
    const std::string name = choose_array(names, array, xml_.name());
    try {
      return make_lattice_field(
          lattice, xml_.values(data.find_child_by_attribute("DataArray", "Name", name.c_str())));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::BadArgument) throw;
      throw bad_file(xml_.name(), error.what());
    }
  }

 private:
  /// `otherwise`: what stands for an attribute that is not there.
  std::vector<double> numbers(const pugi::xml_node& node, const char* name, std::size_t count,
                              const char* otherwise = "") const {
    std::vector<double> values;
    TextScanner scanner(node.attribute(name).as_string(otherwise), xml_.name() + ": " + name);
    for (auto token = scanner.token(); !token.empty(); token = scanner.token())
      values.push_back(scanner.to_real(token, "a number"));
    if (values.size() != count)
      throw bad_file(xml_.name(), fmt::format("'{}' has {} numbers instead of {}; write it again",
                                              name, values.size(), count));
    return values;
  }

  PointLattice read_lattice(const pugi::xml_node& image, const pugi::xml_node& piece) const {
    const auto extent = numbers(piece, "Extent", 6);
    const auto origin = numbers(image, "Origin", 3, "0 0 0");
    const auto spacing = numbers(image, "Spacing", 3, "1 1 1");
    const auto direction = numbers(image, "Direction", 9, "1 0 0 0 1 0 0 0 1");
    PointLattice lattice;
    lattice.origin = {origin[0], origin[1], origin[2]};
    for (std::size_t d = 0; d < 3; ++d) {
      lattice.steps[d] = Vec3{direction[d], direction[3 + d], direction[6 + d]} * spacing[d];
      const double first = extent[2 * d], last = extent[2 * d + 1];
      if (!(last >= first))
        throw bad_file(xml_.name(), "the image's extent ends before it begins; write it again");
      if (last - first >= static_cast<double>(std::size_t{1} << 31))
        throw bad_file(xml_.name(), "the image's extent is too large; write it again");
      lattice.counts[d] = static_cast<std::size_t>(last - first) + 1;
      lattice.origin += lattice.steps[d] * first;
    }
    return lattice;
  }

  VtkXmlFile xml_;
};

/// Corners of tets, as indices into an element's corners. Neighbours may be cut along different
/// diagonals: then the field between them jumps by what it bends in one element.
struct Cut {
  std::int32_t type;
  std::size_t num_corners;
  std::vector<std::array<std::size_t, 4>> tets;
};
const std::vector<Cut>& cuts() {
  static const std::vector<Cut> kCuts = {
      {VtkTetra, 4, {{0, 1, 2, 3}}},
      {VtkPyramid, 5, {{0, 1, 2, 4}, {0, 2, 3, 4}}},
      {VtkWedge, 6, {{0, 1, 2, 3}, {1, 2, 3, 4}, {2, 3, 4, 5}}},
      {VtkVoxel,
       8,
       {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}},
      {VtkHexahedron,
       8,
       {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}}};
  return kCuts;
}

TetMesh cut_into_tets(const VtkGrid& grid, const std::string& file) {
  TetMesh mesh;
  mesh.positions = grid.positions;
  for_each_cell(grid, file, [&](std::size_t c, std::span<const std::int64_t> cell) {
    const auto cut = std::find_if(cuts().begin(), cuts().end(),
                                  [&](const Cut& k) { return k.type == grid.types[c]; });
    if (cut == cuts().end() || cell.size() != cut->num_corners) return;
    for (const auto& corners : cut->tets) {
      std::array<VertId, 4> tet;
      for (std::size_t k = 0; k < 4; ++k) {
        tet[k] = VertId(cell[corners[k]]);
        if (!tet[k].is_valid() || tet[k].index() >= mesh.num_verts())
          throw bad_element(file, fmt::format("cell {}", c), "a corner is out of range");
      }
      mesh.tets.push_back(tet);
    }
  });
  if (mesh.tets.empty())
    throw bad_file(file, "there is no tet, hex, wedge or pyramid; give a grid of volume cells");
  return mesh;
}

/// Linear in the tet that holds the place. What rounding gives beyond its corners' values, or a
/// corner that has no part, does not count.
double number_at(const TetTree& tree, const std::vector<double>& values, const Vec3& place) {
  const auto at = tree.locate(place);
  if (!at) return std::numeric_limits<double>::infinity();
  double sum = 0, least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t k = 0; k < 4; ++k) {
    const double value = values[tree.mesh().tets[at->tet][k].index()];
    least = std::min(least, value);
    most = std::max(most, value);
    if (at->weights[k] > 0) sum += at->weights[k] * value;
  }
  return std::clamp(sum, least, most);
}

PointField read_grid_field(std::string_view bytes, const std::string& file,
                           const std::string& array) {
  VtkGrid grid = parse_vtk_xml_points(bytes, file);
  std::vector<std::string> names;
  for (const auto& [name, data] : grid.point_data)
    if (data.num_components == 1) names.push_back(name);
  auto& values = grid.point_data.find(choose_array(names, array, file))->second.values;
  if (values.size() != grid.positions.size())
    throw bad_file(file, "the numbers of points and of their values differ; write it again");
  PointField field;
  field.points = grid.positions.raw();
  field.values = values;
  const auto tree = std::make_shared<const TetTree>(cut_into_tets(grid, file));
  field.between = [tree, values = field.values](std::span<const Vec3> places,
                                                std::span<double> numbers) {
    std::transform(places.begin(), places.end(), numbers.begin(),
                   [&](const Vec3& p) { return number_at(*tree, values, p); });
  };
  return field;
}

}  // namespace
}  // namespace hexwright::io

namespace hexwright {

PointField read_point_field(const std::filesystem::path& path, const std::string& array) {
  const std::string extension = io::inner_extension(path);
  if (extension != ".vti" && extension != ".vtu")
    throw Error(ErrorCode::BadArgument,
                "fields are read from .vti and .vtu files, not from '" + path.string() + "'");
  const io::FileBytes file = io::read_file(path);
  return extension == ".vti" ? io::ImageReader(file.bytes, file.name).run(array)
                             : io::read_grid_field(file.bytes, file.name, array);
}

}  // namespace hexwright
