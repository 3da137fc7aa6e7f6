// Reads Wavefront OBJ surfaces: v and f lines, and the names of groups; everything else is passed
// over.
//
// Names are of three kinds: g, usemtl and o. The first of them that tells faces apart is taken;
// when none does, the first that there is.
//
// Based on: Wavefront, "Advanced Visualizer Manual", appendix B1 (object files).
// Differs: curves and free-form surfaces are passed over, with a warning for words that are not
// even of the format.
#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include "io/surface/polygon_soup.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

// Keywords of the format that carry no surface. Others are passed over too, with a warning.
constexpr std::array<std::string_view, 21> kOtherKeywords = {
    "vt",     "vn",   "vp",    "s",      "mg",        "l",          "p",
    "mtllib", "lod",  "bevel", "maplib", "usemap",    "shadow_obj", "cstype",
    "deg",    "step", "curv",  "curv2",  "trace_obj", "c_interp",   "d_interp"};

// Keywords that name what follows, the most telling first.
constexpr std::array<std::string_view, 3> kNamingKeywords = {"g", "usemtl", "o"};

/// One kind of names: which each face is under.
struct ObjNames {
  std::vector<std::string> names = {""};
  std::map<std::string, std::size_t> name_to_number = {{"", 0}};
  std::vector<std::size_t> face_to_name;  ///< shorter than the faces until the kind is used
  std::size_t current = 0;

  void begin(std::string&& name, std::size_t num_faces) {
    face_to_name.resize(num_faces, current);
    const auto [at, is_new] = name_to_number.try_emplace(name, names.size());
    current = at->second;
    if (is_new) names.push_back(std::move(name));
  }
  void end(std::size_t num_faces) { face_to_name.resize(num_faces, current); }
  bool tells_apart() const {
    return std::adjacent_find(face_to_name.begin(), face_to_name.end(), std::not_equal_to<>()) !=
           face_to_name.end();
  }
  bool has_name() const { return !face_to_name.empty() && face_to_name[0] != 0; }
};

class ObjReader {
 public:
  explicit ObjReader(const SurfaceSource& source)
      : source_(source), scanner_(source.bytes, source.name) {}

  PolygonSoup run() {
    while (scanner_.skip_blank()) {
      const std::string_view keyword = scanner_.line_token();
      if (keyword == "v")
        soup_.positions.push_back(scanner_.line_point("a vertex"));
      else if (keyword == "f" || keyword == "fo")
        read_face();
      else if (!read_name(keyword))
        note_other(keyword);
      scanner_.next_line();
    }
    check_forward_references();
    take_names();
    return std::move(soup_);
  }

 private:
  /// "g inlet", "usemtl steel": all words after the keyword are the name.
  bool read_name(std::string_view keyword) {
    const auto kind = std::find(kNamingKeywords.begin(), kNamingKeywords.end(), keyword);
    if (kind == kNamingKeywords.end()) return false;
    std::string name;
    for (auto word = scanner_.line_token(); !word.empty(); word = scanner_.line_token()) {
      if (!name.empty()) name += ' ';
      name += word;
    }
    names_[static_cast<std::size_t>(kind - kNamingKeywords.begin())].begin(std::move(name),
                                                                           soup_.ends.size());
    return true;
  }

  void take_names() {
    for (ObjNames& kind : names_) kind.end(soup_.ends.size());
    auto chosen = std::find_if(names_.begin(), names_.end(),
                               [](const ObjNames& kind) { return kind.tells_apart(); });
    if (chosen == names_.end())
      chosen = std::find_if(names_.begin(), names_.end(),
                            [](const ObjNames& kind) { return kind.has_name(); });
    if (chosen == names_.end()) return;
    std::vector<std::int32_t> name_to_group(chosen->names.size(), -1);
    for (const std::size_t name : chosen->face_to_name) {
      if (name_to_group[name] < 0) name_to_group[name] = soup_.add_group(chosen->names[name]);
      soup_.group.push_back(name_to_group[name]);
    }
  }

  void read_face() {
    for (auto token = scanner_.line_token(); !token.empty(); token = scanner_.line_token())
      soup_.verts.push_back(to_vert(token));
    if (const auto n = soup_.num_open_verts(); n < 3)
      scanner_.fail("a face with " + std::to_string(n) +
                    " vertices; every face needs three or more: the line is cut short or wrong");
    soup_.end_polygon();
  }

  /// "7", "7/1", "7//3", "7/1/3", "-1": only the first index counts. Negative ones count backwards.
  VertId to_vert(std::string_view token) {
    const std::int64_t index =
        scanner_.to_integer(token.substr(0, token.find('/')), "a vertex index");
    const auto num_verts = static_cast<std::int64_t>(soup_.positions.size());
    if (index == 0)
      scanner_.fail("vertex index 0; indices of this format start at 1, correct the line");
    if (index < -num_verts || index > static_cast<std::int64_t>(kMaxElements)) fail_range(index);
    if (index > largest_index_) {
      largest_index_ = index;
      largest_line_ = scanner_.line();
    }
    return VertId(index > 0 ? index - 1 : num_verts + index);
  }

  // A face may come before its vertices, so that the range is known at the end only.
  void check_forward_references() {
    if (largest_index_ > static_cast<std::int64_t>(soup_.positions.size()))
      TextScanner::fail_at(source_.name, largest_line_, range_message(largest_index_));
  }

  void fail_range(std::int64_t index) { scanner_.fail(range_message(index)); }
  std::string range_message(std::int64_t index) const {
    return "the face uses vertex " + std::to_string(index) + ", but the file has " +
           std::to_string(soup_.positions.size()) +
           " vertices; the file is truncated or damaged, export it again";
  }

  void note_other(std::string_view keyword) {
    for (std::string_view known : kOtherKeywords)
      if (keyword == known) return;
    for (char c : keyword)
      if (c < 32 || c > 126)
        scanner_.fail(
            "this is no text line of an OBJ file; check that it is one, or export it again");
    if (has_warned_) return;
    has_warned_ = true;
    source_.warnings.push_back("line " + std::to_string(scanner_.line()) + ": keyword " +
                               in_quotes(keyword) + " is unknown; such lines are left out");
  }

  const SurfaceSource& source_;
  TextScanner scanner_;
  PolygonSoup soup_;
  std::array<ObjNames, kNamingKeywords.size()> names_;
  std::int64_t largest_index_ = 0;
  std::size_t largest_line_ = 0;
  bool has_warned_ = false;
};

}  // namespace

PolygonSoup read_obj(const SurfaceSource& source) { return ObjReader(source).run(); }

}  // namespace hexwright::io
