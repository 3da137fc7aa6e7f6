// Reads OFF surfaces in text form: OFF, COFF, NOFF, STOFF and their mixtures, with or without the
// keyword. Colours, normals and texture coordinates are passed over.
//
// Each vertex and each face starts a line; what follows on the line is passed over.
#include "io/surface/polygon_soup.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

struct OffCounts {
  std::size_t verts = 0;
  std::size_t faces = 0;
};

OffCounts read_off_header(TextScanner& scanner) {
  if (is_off_keyword(scanner.peek_token())) {
    const std::string_view keyword = scanner.token();
    if (keyword.find('4') != std::string_view::npos || keyword.find('n') != std::string_view::npos)
      scanner.fail(in_quotes(keyword) +
                   " has vertices of other than three coordinates; export a plain OFF file");
    if (equals_ignoring_case(scanner.peek_token(), "BINARY"))
      scanner.fail("binary OFF is not supported; export it as text, or as STL or PLY");
  }
  OffCounts counts;
  counts.verts = scanner.count("the number of vertices");
  counts.faces = scanner.count("the number of faces");
  scanner.next_line();  // the number of edges is often 0 or missing
  return counts;
}

void read_off_vertices(TextScanner& scanner, std::size_t count, PolygonSoup& soup) {
  constexpr std::size_t kShortestVertex = 6;  // bytes of "0 0 0\n": the count is not trusted
  soup.positions.reserve(std::min(count, scanner.bytes_left() / kShortestVertex + 1));
  for (std::size_t v = 0; v < count; ++v) {
    if (!scanner.skip_blank())
      scanner.fail_at_end(("vertex " + std::to_string(v) + " of " + std::to_string(count)).c_str());
    soup.positions.push_back(scanner.line_point("a vertex"));
    scanner.next_line();
  }
}

/// False when the "face" has one or two vertices, as some programs write points and lines.
bool read_off_face(TextScanner& scanner, PolygonSoup& soup) {
  const std::size_t size =
      static_cast<std::size_t>(scanner.to_integer(scanner.line_token(), "a face's size"));
  const bool is_polygon = size >= 3;
  if (size > scanner.bytes_left())
    scanner.fail("the file ends inside a face of " + std::to_string(size) +
                 " vertices: it is truncated or damaged; export or download it again");
  for (std::size_t i = 0; i < size; ++i) {
    const auto token = scanner.line_token();
    if (token.empty()) {
      if (scanner.is_at_end()) scanner.fail_at_end("the rest of a face");
      scanner.fail("the face has fewer indices than the " + std::to_string(size) +
                   " it announces; correct the line or export the file again");
    }
    const std::int64_t index = scanner.to_integer(token, "a vertex index");
    if (index < 0 || index >= static_cast<std::int64_t>(soup.positions.size()))
      scanner.fail("the face uses vertex " + std::to_string(index) + ", but vertices are 0 to " +
                   std::to_string(soup.positions.size()) + " - 1; export the file again");
    if (is_polygon) soup.verts.push_back(VertId(index));
  }
  if (is_polygon) soup.end_polygon();
  scanner.next_line();
  return is_polygon;
}

}  // namespace

bool is_off_keyword(std::string_view token) {
  if (!token.ends_with("OFF")) return false;
  token.remove_suffix(3);
  for (std::string_view part : {"ST", "C", "N", "4", "n"})
    if (token.starts_with(part)) token.remove_prefix(part.size());
  return token.empty();
}

/// Colours and normals behind coordinates and faces are left unread on their lines. Counts are not
/// trusted with memory: what is missing is found when the text ends.
PolygonSoup read_off(const SurfaceSource& source) {
  TextScanner scanner(source.bytes, source.name);
  const OffCounts counts = read_off_header(scanner);
  if (counts.verts > kMaxElements || counts.faces > kMaxElements)
    scanner.fail(
        "the counts of vertices and faces exceed 2^31; the file is damaged, export it again");
  PolygonSoup soup;
  read_off_vertices(scanner, counts.verts, soup);
  std::size_t num_left_out = 0;
  for (std::size_t f = 0; f < counts.faces; ++f) {
    if (!scanner.skip_blank())
      scanner.fail_at_end(
          ("face " + std::to_string(f) + " of " + std::to_string(counts.faces)).c_str());
    num_left_out += !read_off_face(scanner, soup);
  }
  if (num_left_out > 0)
    source.warnings.push_back(std::to_string(num_left_out) +
                              " faces with fewer than three vertices are left out");
  if (scanner.skip_blank())
    source.warnings.push_back("line " + std::to_string(scanner.line()) +
                              ": the file goes on after its last face; the rest is left out");
  return soup;
}

}  // namespace hexwright::io
