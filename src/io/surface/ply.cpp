// Reads PLY surfaces: text, binary little endian, binary big endian.
//
// Vertices are the properties x, y, z of any number type; polygons are the lists vertex_indices (or
// vertex_index) of element face, or triangle strips (element tristrips). An integer property patch,
// label, group or material of the faces, the first of them that there is, names their group
// ("patch_3"); lines "comment group 3 NAME" give the names themselves. The rest is passed over.
//
// Based on: Turk, "The PLY Polygon File Format", 1994.
// Differs: number types go by their old and new names, strips are read, and lists may come
// anywhere.
#include <charconv>
#include <map>
#include <optional>

#include "hexwright/base/cancel.h"

#include "io/surface/polygon_soup.h"
#include "io/text/byte_reader.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

/// Number types in an order that is relied on: all from Float32 on are no integers.
enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

/// Bytes of each type, by its number.
constexpr std::size_t kTypeSize[] = {1, 1, 2, 2, 4, 4, 4, 8};

/// Each type goes by an old and a new name; both are in use.
struct PlyTypeName {
  std::string_view name;
  PlyType type;
};
constexpr PlyTypeName kTypeNames[] = {
    {"char", PlyType::Int8},      {"int8", PlyType::Int8},       {"uchar", PlyType::UInt8},
    {"uint8", PlyType::UInt8},    {"short", PlyType::Int16},     {"int16", PlyType::Int16},
    {"ushort", PlyType::UInt16},  {"uint16", PlyType::UInt16},   {"int", PlyType::Int32},
    {"int32", PlyType::Int32},    {"uint", PlyType::UInt32},     {"uint32", PlyType::UInt32},
    {"float", PlyType::Float32},  {"float32", PlyType::Float32}, {"double", PlyType::Float64},
    {"float64", PlyType::Float64}};

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;
  std::optional<PlyType> list_count;  ///< set for lists
};

/// A run of rows of the same properties; which ones there are is the file's choice.
struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool is_ascii = true;
  ByteOrder order = ByteOrder::Little;
  std::vector<PlyElement> elements;
  std::map<std::int64_t, std::string> names;  ///< of groups, by number
};

PlyType to_ply_type(const TextScanner& scanner, std::string_view token) {
  for (const auto& [name, type] : kTypeNames)
    if (token == name) return type;
  scanner.fail("unknown number type " + in_quotes(token) + " in the header; export the file again");
}

void read_format(TextScanner& scanner, PlyHeader& header) {
  const auto format = scanner.line_token();
  header.is_ascii = format == "ascii";
  if (format == "binary_big_endian") header.order = ByteOrder::Big;
  if (!header.is_ascii && format != "binary_big_endian" && format != "binary_little_endian")
    scanner.fail("unknown format " + in_quotes(format) +
                 "; expected ascii, binary_little_endian or binary_big_endian");
  const auto version = scanner.line_token();
  if (version != "1.0")
    scanner.fail("unknown version " + in_quotes(version) + "; expected 1.0, export the file again");
}

void read_property(TextScanner& scanner, PlyHeader& header) {
  if (header.elements.empty())
    scanner.fail("a property before any element; the header is damaged, export the file again");
  PlyProperty property;
  auto token = scanner.line_token();
  if (token == "list") {
    property.list_count = to_ply_type(scanner, scanner.line_token());
    if (*property.list_count >= PlyType::Float32)
      scanner.fail("a list whose length is no integer; export the file again");
    token = scanner.line_token();
  }
  property.type = to_ply_type(scanner, token);
  property.name = scanner.line_token();
  header.elements.back().properties.push_back(std::move(property));
}

/// The rest of a comment line: "group 3 NAME" is ours, anything else is free text.
void read_comment(std::string_view comment, PlyHeader& header) {
  constexpr std::string_view kGroup = " group ";
  if (!comment.starts_with(kGroup)) return;
  comment.remove_prefix(kGroup.size());
  std::int32_t group = 0;
  const char* end = comment.data() + comment.size();
  const auto number = std::from_chars(comment.data(), end, group);
  if (number.ec == std::errc() && number.ptr != end && *number.ptr == ' ')
    header.names[group] = clean_name({number.ptr, end});
}

/// Lines up to end_header. The body begins right behind that line's end, which matters in binary
/// files, where a body may begin with any byte.
PlyHeader read_ply_header(TextScanner& scanner) {
  PlyHeader header;
  bool has_format = false;
  scanner.next_line();  // "ply"
  while (true) {
    if (scanner.is_at_end())
      scanner.fail("the header has no end_header line; the file is damaged, export it again");
    const auto keyword = scanner.line_token();
    if (keyword == "format") {
      read_format(scanner, header);
      has_format = true;
    } else if (keyword == "element") {
      PlyElement element;
      element.name = scanner.line_token();
      const auto count = scanner.to_integer(scanner.line_token(), "the element's count");
      if (count < 0 || count > static_cast<std::int64_t>(kMaxElements))
        scanner.fail("the count of element " + in_quotes(element.name) +
                     " is out of range; the file is damaged, export it again");
      element.count = static_cast<std::size_t>(count);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      read_property(scanner, header);
    } else if (keyword == "end_header") {
      break;
    } else if (keyword == "comment") {
      read_comment(scanner.rest_of_line(), header);
      continue;  // the line is behind
    } else if (!keyword.empty() && keyword != "obj_info") {
      scanner.fail("unexpected " + in_quotes(keyword) +
                   " in the header, or no end_header line; export the file again");
    }
    scanner.next_line();
  }
  scanner.next_line();
  if (!has_format) scanner.fail("the header has no format line; export the file again");
  return header;
}

/// The numbers after the header, from text.
class PlyTextBody {
 public:
  explicit PlyTextBody(TextScanner& scanner) : scanner_(scanner) {}
  void begin(const PlyElement&, std::size_t) {}
  double real(PlyType) {
    const auto token = scanner_.token();
    if (token.empty()) scanner_.fail_at_end("a value");
    return scanner_.to_real(token, "a value");
  }
  /// A value nobody uses: it need not be finite.
  void skip(PlyType) {
    if (scanner_.token().empty()) scanner_.fail_at_end("a value");
  }
  std::int64_t integer(PlyType) { return scanner_.integer("an index or a list's length"); }
  std::size_t bytes_left() const { return scanner_.bytes_left(); }
  [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message); }

 private:
  TextScanner& scanner_;
};

/// The numbers after the header, from bytes.
class PlyBinaryBody {
 public:
  PlyBinaryBody(const SurfaceSource& source, std::size_t offset, ByteOrder order)
      : name_(source.name), left_(source.bytes.substr(offset)), order_(order) {}
  void begin(const PlyElement& element, std::size_t index) {
    element_ = &element;
    index_ = index;
  }
  double real(PlyType type) {
    const char* at = take(type);
    switch (type) {
      case PlyType::Float32:
        return load<float>(at, order_);
      case PlyType::Float64:
        return load<double>(at, order_);
      default:
        return static_cast<double>(to_integer(at, type));
    }
  }
  void skip(PlyType type) { take(type); }
  std::int64_t integer(PlyType type) {
    if (type >= PlyType::Float32) fail("an index is no integer; export the file again");
    return to_integer(take(type), type);
  }
  std::size_t bytes_left() const { return left_.size(); }
  [[noreturn]] void fail(const std::string& message) const {
    throw bad_element(name_, element_->name + " " + std::to_string(index_), message);
  }

 private:
  const char* take(PlyType type) {
    const std::size_t size = kTypeSize[static_cast<std::size_t>(type)];
    if (left_.size() < size)
      fail("the file ends inside this element (" + std::to_string(element_->count) +
           " are announced): it is truncated; export or download it again");
    const char* at = left_.data();
    left_.remove_prefix(size);
    return at;
  }
  std::int64_t to_integer(const char* at, PlyType type) const {
    switch (type) {
      case PlyType::Int8:
        return load<std::int8_t>(at, order_);
      case PlyType::UInt8:
        return load<std::uint8_t>(at, order_);
      case PlyType::Int16:
        return load<std::int16_t>(at, order_);
      case PlyType::UInt16:
        return load<std::uint16_t>(at, order_);
      case PlyType::Int32:
        return load<std::int32_t>(at, order_);
      default:
        return load<std::uint32_t>(at, order_);
    }
  }

  const std::string& name_;
  std::string_view left_;
  ByteOrder order_;
  const PlyElement* element_ = nullptr;
  std::size_t index_ = 0;
};

/// The property of the faces that names their group, or null.
const PlyProperty* find_group_property(const PlyElement& element) {
  for (std::string_view name : {"patch", "label", "group", "material"})
    for (const PlyProperty& property : element.properties)
      if (property.name == name && !property.list_count && property.type < PlyType::Float32)
        return &property;
  return nullptr;
}

/// Walks through the elements in the order of the header. The body is text or bytes; both offer the
/// same few functions, so that the rules about elements are written once.
template <class Body>
class PlyReader {
 public:
  PlyReader(const PlyHeader& header, Body body) : header_(header), body_(std::move(body)) {}

  PolygonSoup run() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;  // holds no data, whatever its count says
      const PlyProperty* group = element.name == "face" ? find_group_property(element) : nullptr;
      if (group) group_property_ = group->name;
      for (std::size_t i = 0; i < element.count; ++i) {
        check_cancelled_();
        body_.begin(element, i);
        read_element(element, group);
      }
    }
    check_indices();
    name_groups();
    return std::move(soup_);
  }

 private:
  void read_element(const PlyElement& element, const PlyProperty* group) {
    if (element.name == "vertex") return read_vertex(element);
    const bool is_face = element.name == "face";
    const bool is_strips = element.name == "tristrips";
    std::int64_t number = -1;
    if (group) face_to_number_.resize(soup_.ends.size(), -1);
    for (const PlyProperty& property : element.properties) {
      const bool is_polygon = property.list_count && (property.name == "vertex_indices" ||
                                                      property.name == "vertex_index");
      if (is_polygon && is_face)
        read_polygon(property);
      else if (is_polygon && is_strips)
        read_strips(property);
      else if (&property == group)
        number = body_.integer(property.type);
      else
        skip(property);
    }
    if (group) face_to_number_.resize(soup_.ends.size(), number);
  }

  /// Names are given when all faces are known. Those without a number, or with a negative one, have
  /// none.
  void name_groups() {
    if (face_to_number_.empty()) return;
    face_to_number_.resize(soup_.ends.size(), -1);
    std::map<std::int64_t, std::int32_t> number_to_group;
    for (const std::int64_t number : face_to_number_) {
      const auto [at, is_new] = number_to_group.try_emplace(number, 0);
      if (is_new) at->second = soup_.add_group(name_of(number));
      soup_.group.push_back(at->second);
    }
  }

  std::string name_of(std::int64_t number) const {
    if (number < 0) return "";
    const auto named = header_.names.find(number);
    return named != header_.names.end() ? named->second
                                        : group_property_ + "_" + std::to_string(number);
  }

  void read_vertex(const PlyElement& element) {
    Vec3 p;
    unsigned found = 0;
    for (const PlyProperty& property : element.properties) {
      const bool is_axis = !property.list_count && property.name.size() == 1 &&
                           property.name[0] >= 'x' && property.name[0] <= 'z';
      if (!is_axis) {
        skip(property);
        continue;
      }
      const int axis = property.name[0] - 'x';
      p[axis] = body_.real(property.type);
      found |= 1u << axis;
    }
    if (found != 7) body_.fail("vertices lack x, y or z in the header; export the file again");
    if (!is_finite(p))
      body_.fail("a coordinate is not finite; remove the vertex or give it a finite value");
    soup_.positions.push_back(p);
  }

  /// An entry takes at least a byte, so a list longer than the rest of the file is damage: no
  /// memory is reserved on its word.
  std::size_t read_list_size(const PlyProperty& property) {
    const std::int64_t size = body_.integer(*property.list_count);
    if (size < 0 || static_cast<std::size_t>(size) > body_.bytes_left())
      body_.fail("a list of " + std::to_string(size) +
                 " entries does not fit in the file; it is truncated or damaged, export it again");
    return static_cast<std::size_t>(size);
  }

  void skip(const PlyProperty& property) {
    const std::size_t count = property.list_count ? read_list_size(property) : 1;
    for (std::size_t i = 0; i < count; ++i) body_.skip(property.type);
  }

  /// Checks what an id can hold; whether the vertex exists is known at the end only.
  VertId to_vert(std::int64_t index) {
    if (index < 0 || index > static_cast<std::int64_t>(kMaxElements))
      body_.fail("the face uses vertex " + std::to_string(index) +
                 ", which does not exist; export the file again");
    return VertId(index);
  }

  void read_polygon(const PlyProperty& property) {
    const std::size_t size = read_list_size(property);
    if (size < 3)
      body_.fail("a face with " + std::to_string(size) +
                 " vertices; every face needs three or more: remove it or export the file again");
    for (std::size_t i = 0; i < size; ++i)
      soup_.verts.push_back(to_vert(body_.integer(property.type)));
    soup_.end_polygon();
  }

  /// Triangle strips, separated by -1; every second triangle is turned over.
  void read_strips(const PlyProperty& property) {
    std::vector<VertId> strip;
    const std::size_t size = read_list_size(property);
    for (std::size_t i = 0; i < size; ++i) {
      const std::int64_t index = body_.integer(property.type);
      if (index == -1) {
        strip.clear();
        continue;
      }
      strip.push_back(to_vert(index));
      const std::size_t n = strip.size();
      if (n < 3) continue;
      const bool is_odd = n % 2 == 0;
      soup_.verts.insert(soup_.verts.end(),
                         {strip[n - (is_odd ? 2 : 3)], strip[n - (is_odd ? 3 : 2)], strip[n - 1]});
      soup_.end_polygon();
    }
  }

  // Faces may come before the vertices, so that the range is known at the end only.
  void check_indices() {
    std::size_t begin = 0;
    for (std::size_t f = 0; f < soup_.ends.size(); ++f) {
      for (; begin < soup_.ends[f]; ++begin)
        if (soup_.verts[begin].index() >= soup_.positions.size()) fail_range(f, begin);
    }
  }

  void fail_range(std::size_t face, std::size_t entry) {
    static const PlyElement kFace{"face", 0, {}};
    body_.begin(kFace, face);
    body_.fail("face " + std::to_string(face) + " uses vertex " +
               std::to_string(soup_.verts[entry].value()) + ", but the file has " +
               std::to_string(soup_.positions.size()) + " vertices; export it again");
  }

  const PlyHeader& header_;
  Body body_;
  CancelCheck check_cancelled_;
  PolygonSoup soup_;
  std::string group_property_;
  std::vector<std::int64_t> face_to_number_;  // empty when faces have no groups
};

}  // namespace

PolygonSoup read_ply(const SurfaceSource& source) {
  TextScanner scanner(source.bytes, source.name);
  const PlyHeader header = read_ply_header(scanner);
  if (header.is_ascii) return PlyReader(header, PlyTextBody(scanner)).run();
  return PlyReader(header, PlyBinaryBody(source, scanner.offset(), header.order)).run();
}

}  // namespace hexwright::io
