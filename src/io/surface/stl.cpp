// Reads STL surfaces, text and binary. Each facet brings its own three vertices.
//
// Based on: 3D Systems, "StereoLithography Interface Specification", 1988 (text: solid, facet,
// outer loop, vertex; binary: 80 bytes of header, a count, 50 bytes per facet).
// Differs: normals are recomputed, loops may have more than three vertices, several solids may
// follow each other, and the count field is checked against the file's size.
#include "hexwright/base/cancel.h"

#include "io/surface/polygon_soup.h"
#include "io/text/byte_reader.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

/// Bytes: free text, text and count, and a facet (12 floats and an attribute that nothing reads).
constexpr std::size_t kBinaryHeader = 80, kBinaryPrefix = 84, kBinaryFacet = 50;

std::size_t binary_count_field(std::string_view bytes) {
  return load<std::uint32_t>(bytes.data() + kBinaryHeader, ByteOrder::Little);
}

/// How many facets to read. The count field is often wrong, so the file's size is the judge.
std::size_t count_binary_facets(const SurfaceSource& source) {
  const std::size_t size = source.bytes.size();
  if (size < kBinaryPrefix)
    throw bad_file(source.name, "the file has " + std::to_string(size) +
                                    " bytes, less than the 84 of a binary STL's header, and is no "
                                    "text STL either; export it again");
  const std::size_t announced = binary_count_field(source.bytes);
  const std::size_t held = (size - kBinaryPrefix) / kBinaryFacet;
  const bool is_whole = (size - kBinaryPrefix) % kBinaryFacet == 0;
  if (announced == held && is_whole) return held;
  if (is_whole) {
    source.warnings.push_back("the count field says " + std::to_string(announced) +
                              " facets, the file holds " + std::to_string(held) +
                              "; all that it holds are read");
    return held;
  }
  if (announced > 0 && announced <= held) {
    source.warnings.push_back(std::to_string(size - kBinaryPrefix - announced * kBinaryFacet) +
                              " bytes after the last facet are left out");
    return announced;
  }
  throw bad_element(source.name, "facet " + std::to_string(held),
                    "the file ends inside this facet (" + std::to_string(announced) +
                        " are announced): it is truncated; export or download it again");
}

class StlTextReader {
 public:
  explicit StlTextReader(const SurfaceSource& source) : scanner_(source.bytes, source.name) {}

  PolygonSoup run() {
    while (scanner_.skip_blank()) {
      expect("solid");
      soup_.begin_group(scanner_.rest_of_line());
      while (read_facet()) {
      }
      scanner_.next_line();
    }
    return std::move(soup_);
  }

 private:
  /// False at "endsolid".
  bool read_facet() {
    const auto keyword = scanner_.token();
    if (equals_ignoring_case(keyword, "endsolid")) return false;
    if (!equals_ignoring_case(keyword, "facet")) fail_keyword(keyword, "'facet' or 'endsolid'");
    scanner_.next_line();  // the normal: recomputed from the vertices, and often not a number
    expect("outer");
    expect("loop");
    std::string_view word = scanner_.token();
    for (; equals_ignoring_case(word, "vertex"); word = scanner_.token()) {
      soup_.verts.push_back(VertId(soup_.positions.size()));
      soup_.positions.push_back(scanner_.line_point("a vertex"));
    }
    if (!equals_ignoring_case(word, "endloop")) fail_keyword(word, "'vertex' or 'endloop'");
    if (soup_.num_open_verts() < 3)
      scanner_.fail("the facet has fewer than three vertices; export the file again");
    soup_.end_polygon();
    expect("endfacet");
    return true;
  }

  void expect(const char* keyword) {
    const auto token = scanner_.token();
    if (!equals_ignoring_case(token, keyword)) fail_keyword(token, in_quotes(keyword));
  }

  void fail_keyword(std::string_view found, const std::string& expected) {
    if (found.empty()) scanner_.fail_at_end(expected.c_str());
    scanner_.fail("expected " + expected + ", found " + in_quotes(found) +
                  "; correct this line or export the file again");
  }

  TextScanner scanner_;
  PolygonSoup soup_;
};

}  // namespace

/// Binary files may begin with "solid" like text ones; their size gives them away.
bool is_exact_binary_stl(std::string_view bytes) {
  return bytes.size() > kBinaryPrefix &&
         bytes.size() == kBinaryPrefix + kBinaryFacet * binary_count_field(bytes);
}

PolygonSoup read_stl_binary(const SurfaceSource& source) {
  const std::size_t count = count_binary_facets(source);
  if (count > kMaxElements / 3)
    throw bad_file(source.name, "more than 7e8 facets; simplify the surface first");
  PolygonSoup soup;
  soup.positions.reserve(3 * count);
  soup.verts.reserve(3 * count);
  soup.ends.reserve(count);
  CancelCheck check_cancelled;
  for (std::size_t f = 0; f < count; ++f) {
    check_cancelled();
    const char* facet = source.bytes.data() + kBinaryPrefix + f * kBinaryFacet;
    for (int v = 0; v < 3; ++v) {
      Vec3 p;
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = load<float>(facet + 4 * (3 + 3 * v + axis), ByteOrder::Little);
      if (!is_finite(p))
        throw bad_element(source.name, "facet " + std::to_string(f),
                          "a vertex has a coordinate that is not finite; remove the facet or "
                          "export the file again");
      soup.verts.push_back(soup.positions.push_back(p));
    }
    soup.end_polygon();
  }
  return soup;
}

PolygonSoup read_stl_ascii(const SurfaceSource& source) { return StlTextReader(source).run(); }

}  // namespace hexwright::io
