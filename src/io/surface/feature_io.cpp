// Feature edges: polylines of an OBJ file, or pairs of vertex numbers.
#include "hexwright/io/feature_io.h"

#include <string>

#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright {
namespace io {
namespace {

using Segments = std::vector<std::array<Vec3, 2>>;

/// One pass over the lines. The first line that belongs to one of the two forms decides between
/// them.
class FeatureReader {
 public:
  FeatureReader(const FileBytes& file, const TriMesh& surface)
      : file_(file), surface_(surface), scanner_(file.bytes, file.name) {}

  Segments run() {
    while (scanner_.skip_blank()) {
      const std::string_view first = scanner_.line_token();
      if (first == "v") {
        points_.push_back(scanner_.line_point("a vertex"));
        is_obj_ = true;
      } else if (first == "l") {
        read_polyline();
      } else if (!is_obj_ && is_number(first)) {
        read_pair(first);
      } else if (!is_known_obj_word(first)) {
        scanner_.fail("expected two vertex numbers, or a 'v' or 'l' line of an OBJ file, found " +
                      in_quotes(first));
      }
      scanner_.next_line();
    }
    if (segments_.empty())
      throw bad_file(file_.name,
                     "the file holds no feature edges; give lines of two vertex numbers, or an OBJ "
                     "file with 'l' lines");
    return std::move(segments_);
  }

 private:
  static bool is_number(std::string_view token) {
    return token.find_first_not_of("+-0123456789") == std::string_view::npos;
  }

  /// Other lines of OBJ files are passed over; the first of them tells the form.
  bool is_known_obj_word(std::string_view token) {
    for (std::string_view known : {"f", "vt", "vn", "vp", "p", "o", "g", "s", "mtllib", "usemtl"})
      if (token == known) return is_obj_ = true;
    return is_obj_;
  }

  void read_pair(std::string_view first) {
    const auto vert = [&](std::string_view token) {
      const std::int64_t index = scanner_.to_integer(token, "a vertex number");
      if (index < 0 || index >= static_cast<std::int64_t>(surface_.num_verts()))
        scanner_.fail("vertex " + std::to_string(index) + " is none of the surface's " +
                      std::to_string(surface_.num_verts()) + "; they count from 0");
      return surface_.positions[VertId(index)];
    };
    const Vec3 a = vert(first);
    const std::string_view second = scanner_.line_token();
    if (second.empty()) scanner_.fail("one vertex number only; an edge needs two");
    segments_.push_back({a, vert(second)});
    if (!scanner_.line_token().empty())
      scanner_.fail("more than two vertex numbers; write one edge per line");
  }

  /// "l 1 2 3" or "l 1/1 2/2": numbers from 1, or backwards from -1.
  void read_polyline() {
    is_obj_ = true;
    const Vec3* before = nullptr;
    for (auto token = scanner_.line_token(); !token.empty(); token = scanner_.line_token()) {
      const Vec3& here = point(scanner_.to_integer(token.substr(0, token.find('/')), "a vertex"));
      if (before) segments_.push_back({*before, here});
      before = &here;
    }
  }

  const Vec3& point(std::int64_t index) const {
    const auto count = static_cast<std::int64_t>(points_.size());
    const std::int64_t i = index > 0 ? index - 1 : count + index;
    if (index == 0 || i < 0 || i >= count)
      scanner_.fail("the polyline uses vertex " + std::to_string(index) + ", but " +
                    std::to_string(count) + " stand above it; put the 'v' lines first");
    return points_[static_cast<std::size_t>(i)];
  }

  const FileBytes& file_;
  const TriMesh& surface_;
  TextScanner scanner_;
  std::vector<Vec3> points_;  // of `v` lines
  Segments segments_;
  bool is_obj_ = false;
};

}  // namespace
}  // namespace io

std::vector<std::array<Vec3, 2>> read_feature_edges(const std::filesystem::path& path,
                                                    const TriMesh& surface) {
  const io::FileBytes file = io::read_file(path);
  return io::FeatureReader(file, surface).run();
}

}  // namespace hexwright
