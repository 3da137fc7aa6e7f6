// Reads legacy VTK files (.vtk): unstructured grids and polygons in text and binary form, versions
// 2 to 5.1.
//
// Based on: Kitware, "VTK File Formats" (the VTK User's Guide), section "Simple Legacy Formats";
// version 5.1 as the library writes it. Binary data is big-endian whatever the machine.
// Differs: sections may come in any order, as the library's own reader accepts them.
#include <algorithm>
#include <array>
#include <limits>

#include "hexwright/base/cancel.h"

#include "io/text/byte_reader.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"
#include "io/vtk/vtk_grid.h"

namespace hexwright::io {
namespace {

/// Number types of the format; `read` is for binary data, which is big-endian.
struct VtkNumberType {
  std::string_view name;
  std::size_t size;
  double (*read)(const char*);
};

template <class T>
double load_as_double(const char* at) {
  return static_cast<double>(load<T>(at, ByteOrder::Big));
}

/// `long` has eight bytes as on the systems that write such files today; `vtkIdType` is what
/// version 4 files call their 32-bit ids.
constexpr VtkNumberType kNumberTypes[] = {
    {"char", 1, load_as_double<std::int8_t>},
    {"signed_char", 1, load_as_double<std::int8_t>},
    {"unsigned_char", 1, load_as_double<std::uint8_t>},
    {"short", 2, load_as_double<std::int16_t>},
    {"unsigned_short", 2, load_as_double<std::uint16_t>},
    {"int", 4, load_as_double<std::int32_t>},
    {"unsigned_int", 4, load_as_double<std::uint32_t>},
    {"long", 8, load_as_double<std::int64_t>},
    {"unsigned_long", 8, load_as_double<std::uint64_t>},
    {"vtktypeint64", 8, load_as_double<std::int64_t>},
    {"vtktypeuint64", 8, load_as_double<std::uint64_t>},
    {"vtkidtype", 4, load_as_double<std::int32_t>},
    {"float", 4, load_as_double<float>},
    {"double", 8, load_as_double<double>},
};

/// The sections of a POLYDATA, in the order in which data of cells counts them.
constexpr std::array<std::string_view, 4> kPolyKinds = {"VERTICES", "LINES", "POLYGONS",
                                                        "TRIANGLE_STRIPS"};
constexpr std::array<std::int32_t, 4> kPolyTypes = {VtkPolyVertex, VtkPolyLine, VtkPolygon,
                                                    VtkTriangleStrip};

class VtkLegacyReader {
 public:
  VtkLegacyReader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), name_(name), scanner_(bytes, name) {}

  VtkGrid run() {
    read_header();
    while (true) {
      const std::string keyword = upper(scanner_.token());
      if (keyword.empty()) break;
      read_section(keyword);
    }
    put_polygons();
    return std::move(grid_);
  }

 private:
  static std::string upper(std::string_view token) {
    std::string result(token);
    for (char& c : result)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return result;
  }

  void read_header() {
    const std::string_view first = scanner_.rest_of_line();
    constexpr std::string_view kMark = "# vtk DataFile Version ";
    if (!first.starts_with(kMark))
      TextScanner::fail_at(
          name_, 1,
          "the file does not begin with '# vtk DataFile Version'; give a legacy VTK "
          "file or name it by its own format");
    is_version_5_ = first.size() > kMark.size() && first[kMark.size()] >= '5';
    scanner_.rest_of_line();  // title
    const std::string mode = upper(scanner_.line_token());
    if (mode != "ASCII" && mode != "BINARY")
      scanner_.fail("expected ASCII or BINARY, found " + in_quotes(mode) +
                    "; export the file again");
    is_binary_ = mode == "BINARY";
    scanner_.next_line();
  }

  void read_section(const std::string& keyword) {
    if (keyword == "DATASET") {
      const std::string kind = upper(scanner_.token());
      if (kind != "UNSTRUCTURED_GRID" && kind != "POLYDATA")
        scanner_.fail("the data set is no UNSTRUCTURED_GRID and no POLYDATA; export it as one");
      grid_.is_polygons = kind == "POLYDATA";
    } else if (keyword == "POINTS") {
      read_points();
    } else if (keyword == "CELLS") {
      is_version_5_ ? read_cells_5() : read_cells();
    } else if (const auto kind = std::find(kPolyKinds.begin(), kPolyKinds.end(), keyword);
               kind != kPolyKinds.end()) {
      read_polygons(static_cast<std::size_t>(kind - kPolyKinds.begin()));
    } else if (keyword == "CELL_TYPES") {
      // What is beyond a byte is none of VTK's types.
      for (std::int64_t type : integers("int", scanner_.count("the number of cell types")))
        grid_.types.push_back(static_cast<std::int32_t>(std::clamp<std::int64_t>(type, -1, 255)));
    } else if (keyword == "CELL_DATA" || keyword == "POINT_DATA") {
      is_cell_data_ = keyword == "CELL_DATA";
      is_point_data_ = !is_cell_data_;
      num_data_ = scanner_.count("the number of values");
    } else if (keyword == "METADATA") {
      scanner_.next_line();  // ends at an empty line
      while (scanner_.bytes_left() > 0 && !is_empty(scanner_.rest_of_line())) {
      }
    } else {
      read_attribute(keyword);
    }
  }

  static bool is_empty(std::string_view line) {
    return line.find_first_not_of(" \t\r") == line.npos;
  }

  /// Attributes nobody needs are read over: their sizes follow from their kind, and nothing else
  /// tells where the next section begins in binary files.
  void read_attribute(const std::string& keyword) {
    if (keyword == "FIELD") return read_field();
    std::size_t components = 0;
    const std::string name(scanner_.line_token());
    if (keyword == "SCALARS") return read_scalars(name);
    if (keyword == "VECTORS" || keyword == "NORMALS") components = 3;
    if (keyword == "TENSORS") components = 9;
    if (keyword == "TENSORS6") components = 6;
    if (keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS") components = 1;
    if (keyword == "TEXTURE_COORDINATES") components = scanner_.count("the number of components");
    if (components > 0) {
      const std::string type(scanner_.line_token());
      return keep(name, components, values(type, product(num_data_, components)));
    }
    if (keyword == "COLOR_SCALARS") {
      components = scanner_.count("the number of components");
      values(is_binary_ ? "unsigned_char" : "float", product(num_data_, components));
    } else if (keyword == "LOOKUP_TABLE") {
      const std::size_t size = scanner_.count("the size of a lookup table");
      values(is_binary_ ? "unsigned_char" : "float", product(size, 4));
    } else {
      scanner_.fail("unknown section " + in_quotes(keyword) +
                    "; a count above is wrong, or the file is damaged: export it again");
    }
  }

  /// A lookup table's name may follow; the table itself is a section of its own.
  void read_scalars(const std::string& name) {
    const std::string type(scanner_.line_token());
    const auto token = scanner_.line_token();
    const std::size_t components =
        token.empty() ? 1 : static_cast<std::size_t>(scanner_.to_integer(token, "a count"));
    if (components < 1 || components > 4)
      scanner_.fail("scalars have one to four components; export the file again");
    if (upper(scanner_.peek_token()) == "LOOKUP_TABLE") {
      scanner_.token();
      scanner_.line_token();
    }
    keep(name, components, values(type, product(num_data_, components)));
  }

  /// Arrays of any shape. Strings are kept as lines, and passed over.
  void read_field() {
    scanner_.line_token();  // the field's name
    const std::size_t num_arrays = scanner_.count("the number of arrays");
    for (std::size_t a = 0; a < num_arrays; ++a) {
      std::string name(scanner_.token());
      if (upper(name) == "METADATA") {  // belongs to the array before
        read_section("METADATA");
        name = scanner_.token();
      }
      if (name.empty()) scanner_.fail_at_end("an array of the field");
      const std::size_t components = scanner_.count("the number of components");
      const std::size_t tuples = scanner_.count("the number of tuples");
      const std::string type(scanner_.line_token());
      if (type == "string") {
        for (std::size_t i = 0; i < tuples && !scanner_.is_at_end(); ++i) scanner_.next_line();
        continue;
      }
      keep(name, components, values(type, product(components, tuples)));
    }
  }

  /// By name; a name that comes again replaces what it meant before. Data of points has no use
  /// here.
  void keep(const std::string& name, std::size_t components, std::vector<double> data) {
    if (is_point_data_) return;
    (is_cell_data_ ? grid_.cell_data : grid_.field_data)[name] = {components, std::move(data)};
  }

  /// Every value takes at least a byte of the file, so a product beyond its size is damage. Divides
  /// first: the product itself could wrap around.
  std::size_t product(std::size_t a, std::size_t b) const {
    if (b != 0 && a > bytes_.size() / b) fail_size();
    return a * b;
  }
  [[noreturn]] void fail_size() const {
    scanner_.fail(
        "more values are announced than the file holds; it is truncated or damaged, "
        "export it again");
  }

  /// The next `count` numbers, of the given type when binary.
  std::vector<double> values(std::string_view type_name, std::size_t count) {
    std::vector<double> result;
    if (!is_binary_) {
      if (count > scanner_.bytes_left() / 2 + 1) fail_size();
      result.reserve(count);
      for (std::size_t i = 0; i < count; ++i) {
        const auto token = scanner_.token();
        if (token.empty()) scanner_.fail_at_end("a value");
        // Data may hold it; points and indices are checked by those who read them.
        result.push_back(equals_ignoring_case(token, "nan")
                             ? std::numeric_limits<double>::quiet_NaN()
                             : scanner_.to_real(token, "a value"));
      }
      return result;
    }
    scanner_.next_line();
    if (equals_ignoring_case(type_name, "bit")) {
      take_bytes((count + 7) / 8);
      return std::vector<double>(count);
    }
    for (const VtkNumberType& type : kNumberTypes) {
      if (!equals_ignoring_case(type.name, type_name)) continue;
      const std::string_view bytes = take_bytes(product(count, type.size));
      result.reserve(count);
      CancelCheck check_cancelled;
      for (std::size_t i = 0; i < count; ++i) {
        check_cancelled();
        result.push_back(type.read(bytes.data() + i * type.size));
      }
      return result;
    }
    scanner_.fail("unknown number type " + in_quotes(type_name) + "; export the file again");
  }

  std::string_view take_bytes(std::size_t count) {
    if (count > scanner_.bytes_left()) fail_size();
    return scanner_.take(count);
  }

  /// Indices and counts. Doubles hold integers up to 2^53 exactly, far more than ids can have.
  std::vector<std::int64_t> integers(std::string_view type_name, std::size_t count) {
    std::vector<std::int64_t> result;
    if (!is_binary_) {  // token by token, so that an error has its own line
      if (count > scanner_.bytes_left() / 2 + 1) fail_size();
      result.reserve(count);
      for (std::size_t i = 0; i < count; ++i) result.push_back(scanner_.integer("an index"));
      return result;
    }
    constexpr double kLargestExact = 9007199254740992.0;
    CancelCheck check_cancelled;
    for (double value : values(type_name, count)) {
      check_cancelled();
      if (!(value >= -kLargestExact && value <= kLargestExact))
        scanner_.fail("an index is out of range; the file is damaged, export it again");
      result.push_back(static_cast<std::int64_t>(value));
    }
    return result;
  }

  void read_points() {
    const std::size_t count = scanner_.count("the number of points");
    const std::string type(scanner_.line_token());
    const auto data = values(type, product(count, 3));
    if (count > kMaxElements) fail_size();
    grid_.positions.resize(count);
    for (std::size_t v = 0; v < count; ++v) {
      const Vec3 p = {data[3 * v], data[3 * v + 1], data[3 * v + 2]};
      if (!is_finite(p))
        throw bad_element(name_, "point " + std::to_string(v),
                          "a coordinate is not finite; export the file again");
      grid_.positions[VertId(v)] = p;
    }
  }

  /// Up to version 4: per cell its size and its vertices.
  void read_cells() {
    const std::size_t num_cells = scanner_.count("the number of cells");
    const auto data = integers("int", scanner_.count("the size of the cell list"));
    std::size_t at = 0;
    for (std::size_t c = 0; c < num_cells; ++c) {
      if (at >= data.size() || data[at] < 0 ||
          static_cast<std::size_t>(data[at]) > data.size() - at - 1)
        throw bad_element(name_, "cell " + std::to_string(c),
                          "it does not fit in the cell list; the file is damaged, export it again");
      const auto size = static_cast<std::size_t>(data[at]);
      const auto first = data.begin() + static_cast<std::ptrdiff_t>(at + 1);
      grid_.connectivity.insert(grid_.connectivity.end(), first,
                                first + static_cast<std::ptrdiff_t>(size));
      grid_.ends.push_back(static_cast<std::int64_t>(grid_.connectivity.size()));
      at += size + 1;
    }
  }

  /// Version 5: offsets (with a leading 0) and connectivity.
  void read_cells_5() {
    const std::size_t num_offsets = scanner_.count("the number of offsets");
    const std::size_t num_indices = scanner_.count("the size of the connectivity");
    expect("OFFSETS");
    grid_.ends = integers(std::string(scanner_.line_token()), num_offsets);
    expect("CONNECTIVITY");
    grid_.connectivity = integers(std::string(scanner_.line_token()), num_indices);
    if (!grid_.ends.empty()) grid_.ends.erase(grid_.ends.begin());
  }

  /// Cells of one kind of a POLYDATA; the offsets of version 5 count from 0.
  void read_polygons(std::size_t kind) {
    std::swap(grid_, polygons_[kind]);
    is_version_5_ ? read_cells_5() : read_cells();
    std::swap(grid_, polygons_[kind]);
  }

  /// Data of cells counts them by kind, whatever the order of the sections.
  void put_polygons() {
    for (std::size_t kind = 0; kind < kPolyKinds.size(); ++kind) {
      const auto first = static_cast<std::int64_t>(grid_.connectivity.size());
      const VtkGrid& cells = polygons_[kind];
      grid_.connectivity.insert(grid_.connectivity.end(), cells.connectivity.begin(),
                                cells.connectivity.end());
      for (const std::int64_t end : cells.ends) grid_.ends.push_back(first + end);
      grid_.types.resize(grid_.types.size() + cells.ends.size(), kPolyTypes[kind]);
    }
  }

  void expect(const char* keyword) {
    const auto token = scanner_.token();
    if (!equals_ignoring_case(token, keyword))
      scanner_.fail(std::string("expected ") + keyword + ", found " + in_quotes(token) +
                    "; export the file again");
  }

  std::string_view bytes_;
  const std::string& name_;
  TextScanner scanner_;
  VtkGrid grid_;
  std::array<VtkGrid, 4> polygons_;  // cells alone, by kind
  bool is_version_5_ = false;
  bool is_binary_ = false;
  bool is_cell_data_ = false;
  bool is_point_data_ = false;
  std::size_t num_data_ = 0;
};

}  // namespace

VtkGrid parse_vtk_legacy(std::string_view bytes, const std::string& file_name) {
  return VtkLegacyReader(bytes, file_name).run();
}

}  // namespace hexwright::io
