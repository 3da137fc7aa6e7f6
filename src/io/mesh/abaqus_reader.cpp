// Reads Abaqus input files: nodes, solid hexes and tets, element sets as regions, element-face
// surfaces as patches, the node set CORNERS as corners.
//
// Regions are the sets that *ELEMENT lines name; where these name none, the sets of *SOLID SECTION.
// A face is of the first surface that lists it. Of tets of second order the corners are read.
//
// Based on: Dassault Systemes, "Abaqus Keywords Reference Guide": *NODE, *ELEMENT, *ELSET, *NSET,
// *SURFACE, *SOLID SECTION. Differs: one part only; *INCLUDE and node systems are refused.
#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <unordered_map>

#include "io/mesh/foreign_labels.h"
#include "io/mesh/read_mid_nodes.h"
#include "io/mesh/set_names.h"
#include "io/sets/face_table.h"
#include "io/surface/polygon_soup.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

/// Local faces S1 to S6 in our numbering (see the writer).
constexpr std::array<int, 6> kFaceOfSide = {4, 5, 2, 1, 3, 0};

std::string upper(std::string_view text) {
  std::string result;
  for (char c : text)
    if (c != ' ' && c != '\t' && c != '\r')
      result += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return result;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    words.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return words;
}

/// "*ELEMENT, TYPE=C3D8, ELSET=body": the keyword and its parameters, names in capitals.
struct Keyword {
  std::string name;
  std::map<std::string, std::string> parameters;
  std::string get(const std::string& parameter) const {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? "" : found->second;
  }
};

Keyword parse_keyword(std::string_view line) {
  Keyword keyword;
  bool is_first = true;
  for (std::string_view word : split(line)) {
    const auto equals = word.find('=');
    if (is_first)
      keyword.name = upper(word.substr(1));
    else if (equals == std::string_view::npos)
      keyword.parameters[upper(word)];
    else
      keyword.parameters[upper(word.substr(0, equals))] = trimmed(word.substr(equals + 1));
    is_first = false;
  }
  return keyword;
}

/// A set as it is spelled, with what it holds, in the order of the file: numbers, and the names of
/// other sets in capitals.
struct AbaqusSet {
  std::string name;
  std::vector<std::int64_t> ids;
  std::vector<std::string> others;
};
using AbaqusSets = std::map<std::string, AbaqusSet>;  // by the name in capitals

/// All that a set holds, itself and through the sets that it names, each of these once: sets that
/// name each other do not multiply.
std::vector<std::int64_t> ids_of(const AbaqusSets& sets, const std::string& key) {
  std::vector<std::int64_t> ids;
  std::vector<std::string> keys = {key};
  std::set<std::string> seen = {key};
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const auto set = sets.find(keys[k]);
    if (set == sets.end()) continue;
    ids.insert(ids.end(), set->second.ids.begin(), set->second.ids.end());
    for (const std::string& other : set->second.others)
      if (seen.insert(other).second) keys.push_back(other);
  }
  return ids;
}

bool is_number(std::string_view word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

struct AbaqusSurface {
  std::string name;
  std::vector<std::pair<std::string, int>> sides;  ///< element or element set, and local face
};

class AbaqusReader {
 public:
  explicit AbaqusReader(const VolumeSource& source)
      : scanner_(source.bytes, source.name), name_(source.name) {}

  VolumeFile run() {
    while (!scanner_.is_at_end()) read_line(scanner_.rest_of_line());
    finish_element();
    set_regions();
    set_patches();
    set_corners();
    mid_nodes_.settle(file_, name_);
    settle_labels(file_);
    names_.apply(file_);
    return std::move(file_);
  }

 private:
  /// Errors name the line behind, where the scanner is: one is taken off.
  [[noreturn]] void fail(const std::string& message) {
    scanner_.set_line(scanner_.line() - 1);
    scanner_.fail(message);
  }

  void read_line(std::string_view line) {
    if (line.starts_with("**") || trimmed(line).empty()) return;
    if (line.front() != '*') return read_data(line);
    finish_element();
    keyword_ = parse_keyword(line);
    const std::string& name = keyword_.name;
    if (name == "INCLUDE") fail("included files are not read; put their lines in their place");
    if (name == "SYSTEM") fail("nodes in a system of their own are not read; export global ones");
    if (name == "PART" && ++num_parts_ > 1)
      fail("the file has several parts; export them merged or one by one");
    if (name == "SOLIDSECTION") sections_.push_back(upper(keyword_.get("ELSET")));
    if (name == "ELEMENT") begin_elements();
    if (name == "SURFACE") surfaces_.push_back({keyword_.get("NAME"), {}});
  }

  void read_data(std::string_view line) {
    const std::string& name = keyword_.name;
    if (name == "NODE")
      read_node(line);
    else if (name == "ELEMENT")
      read_element(line);
    else if (name == "ELSET")
      read_set(line, keyword_.get("ELSET"), element_sets_);
    else if (name == "NSET")
      read_set(line, keyword_.get("NSET"), node_sets_);
    else if (name == "SURFACE")
      read_surface_line(line);
  }

  /// Numbers of nodes and elements: positive, and small enough for sums.
  std::int64_t integer(std::string_view word, const char* what) {
    std::int64_t value = -1;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value);
    constexpr std::int64_t kLargest = std::int64_t{1} << 53;
    if (parsed.ec != std::errc() || parsed.ptr != word.data() + word.size() || value < 0 ||
        value > kLargest)
      fail(std::string("expected an integer for ") + what + ", found " + in_quotes(word) +
           "; correct this line or export the file again");
    return value;
  }

  void read_node(std::string_view line) {
    const auto words = split(line);
    if (words.size() < 2) fail("a node without coordinates; export the file again");
    const std::int64_t id = integer(words[0], "a node");
    Vec3 p;
    for (std::size_t axis = 0; axis < 3 && axis + 1 < words.size(); ++axis)
      if (!words[axis + 1].empty()) p[static_cast<int>(axis)] = coordinate(words[axis + 1]);
    if (!node_to_vert_.try_emplace(id, VertId(file_.positions.size())).second)
      fail("node " + std::to_string(id) + " comes twice; export the file again");
    file_.positions.push_back(p);
  }

  double coordinate(std::string_view word) {
    scanner_.set_line(scanner_.line() - 1);  // for the message: the scanner is a line ahead
    const double value = scanner_.to_real(word, "a coordinate");
    scanner_.set_line(scanner_.line() + 1);
    return value;
  }

  void begin_elements() {
    const std::string type = upper(keyword_.get("TYPE"));
    num_nodes_ = num_kept_ = 0;
    if (type.starts_with("C3D8")) num_nodes_ = num_kept_ = 8;
    if (type.starts_with("C3D20")) num_nodes_ = 20, num_kept_ = 8;
    if (type.starts_with("C3D4")) num_nodes_ = num_kept_ = 4;
    if (type.starts_with("C3D10")) num_nodes_ = 10, num_kept_ = 4;
  }

  /// An element may take several lines: it ends when it has all its nodes.
  void read_element(std::string_view line) {
    if (num_nodes_ == 0) {
      ++file_.num_others;
      return;
    }
    for (std::string_view word : split(line)) {
      if (word.empty()) continue;
      element_.push_back(integer(word, "a node of the element"));
      if (element_.size() == num_nodes_ + 1) finish_element();
    }
  }

  template <std::size_t N>
  std::array<VertId, N> first_verts() {
    std::array<VertId, N> verts;
    for (std::size_t k = 0; k < N; ++k) {
      const auto found = node_to_vert_.find(element_[k + 1]);
      if (found == node_to_vert_.end())
        fail("the element uses node " + std::to_string(element_[k + 1]) +
             ", which does not stand above it; export the file again");
      verts[k] = found->second;
    }
    return verts;
  }

  void finish_element() {
    if (element_.empty()) return;
    if (element_.size() != num_nodes_ + 1)
      fail("element " + std::to_string(element_[0]) + " has " +
           std::to_string(element_.size() - 1) + " nodes instead of " + std::to_string(num_nodes_) +
           "; export the file again");
    if (num_kept_ == 4) {
      file_.tets.push_back(first_verts<4>());
    } else {
      if (!element_to_hex_.try_emplace(element_[0], HexId(file_.hexes.size())).second)
        fail("element " + std::to_string(element_[0]) + " comes twice; export the file again");
      file_.hexes.push_back(first_verts<8>());
      if (num_nodes_ == 20) mid_nodes_.add(file_, first_verts<20>());
      if (const std::string set = keyword_.get("ELSET"); !set.empty()) {
        set_of(set, element_sets_).ids.push_back(element_[0]);
        named_by_element_.insert(upper(set));
      }
    }
    element_.clear();
  }

  static AbaqusSet& set_of(const std::string& name, AbaqusSets& sets) {
    AbaqusSet& set = sets[upper(name)];
    if (set.name.empty()) set.name = name;
    return set;
  }

  /// Ids, names of other sets, or "first, last, step".
  void read_set(std::string_view line, const std::string& name, AbaqusSets& sets) {
    AbaqusSet& set = set_of(name, sets);
    std::vector<std::int64_t> ids;
    for (std::string_view word : split(line)) {
      if (is_number(word))
        ids.push_back(integer(word, "a member of the set"));
      else if (!word.empty())
        set.others.push_back(upper(word));
    }
    if (keyword_.parameters.contains("GENERATE")) ids = generate(ids);
    set.ids.insert(set.ids.end(), ids.begin(), ids.end());
  }

  /// Of the numbers that exist; a short line must not make a long loop.
  std::vector<std::int64_t> generate(const std::vector<std::int64_t>& range) {
    if (range.size() < 2 || range.size() > 3)
      fail("a range has a first, a last and a step; correct this line");
    const std::int64_t first = range[0], last = range[1], step = range.size() == 3 ? range[2] : 1;
    if (step < 1 || last < first) fail("the range is not one; correct this line");
    const auto num_known = static_cast<std::int64_t>(node_to_vert_.size() + element_to_hex_.size());
    std::vector<std::int64_t> ids;
    if ((last - first) / step <= num_known) {
      for (std::int64_t k = 0; k <= (last - first) / step; ++k) ids.push_back(first + k * step);
      return ids;
    }
    const auto add = [&](std::int64_t id) {
      if (id >= first && id <= last && (id - first) % step == 0) ids.push_back(id);
    };
    for (const auto& [id, vert] : node_to_vert_) add(id);
    for (const auto& [id, hex] : element_to_hex_) add(id);
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  /// "17, S3" or "top_elements, S3"; surfaces of nodes are passed over.
  void read_surface_line(std::string_view line) {
    const std::string type = upper(keyword_.get("TYPE"));
    const auto words = split(line);
    if ((!type.empty() && type != "ELEMENT") || words.size() < 2) return;
    const std::string side = upper(words[1]);
    if (side.size() != 2 || side[0] != 'S' || side[1] < '1' || side[1] > '6') return;
    surfaces_.back().sides.emplace_back(upper(words[0]), side[1] - '1');
  }

  void set_regions() {
    std::map<std::int64_t, std::string> tags;
    std::map<std::string, std::int64_t> set_to_tag;
    std::vector<std::int64_t> hex_to_tag(file_.hexes.size(), 0);
    const auto add = [&](const std::string& key) {
      const auto set = element_sets_.find(key);
      if (set == element_sets_.end() || set_to_tag.contains(key)) return;
      const auto tag = static_cast<std::int64_t>(set_to_tag.size()) + 1;
      set_to_tag[key] = tag;
      tags[tag] = set->second.name;
      for (std::int64_t id : ids_of(element_sets_, key))
        if (const auto hex = element_to_hex_.find(id); hex != element_to_hex_.end())
          if (hex_to_tag[hex->second.index()] == 0) hex_to_tag[hex->second.index()] = tag;
    };
    for (const std::string& section : sections_)
      if (named_by_element_.empty()) add(section);
    for (const auto& key : named_by_element_) add(key);
    if (tags.empty()) return;
    const auto numbers = number_tags(SetKind::Region, tags, names_);
    std::int32_t without = 0;  // a number that no set has
    for (const auto& [tag, number] : numbers) without = std::max(without, number + 1);
    for (std::int64_t tag : hex_to_tag)
      file_.region.push_back(tag == 0 ? without : numbers.at(tag));
  }

  std::vector<HexId> hexes_of(const std::string& element_or_set) const {
    std::vector<HexId> hexes;
    const auto add = [&](std::int64_t id) {
      if (const auto hex = element_to_hex_.find(id); hex != element_to_hex_.end())
        hexes.push_back(hex->second);
    };
    if (is_number(element_or_set) && element_or_set.size() < 18)
      add(std::stoll(element_or_set));
    else
      for (std::int64_t id : ids_of(element_sets_, element_or_set)) add(id);
    return hexes;
  }

  void set_patches() {
    std::map<std::int64_t, std::string> tags;
    std::set<std::pair<HexId, int>> seen;
    std::vector<std::int64_t> quad_to_tag;
    for (std::size_t s = 0; s < surfaces_.size(); ++s)
      for (const auto& [elements, side] : surfaces_[s].sides)
        for (HexId h : hexes_of(elements)) {
          const int lf = kFaceOfSide[static_cast<std::size_t>(side)];
          if (!seen.emplace(h, lf).second) continue;
          file_.labels.quads.push_back({face_verts(file_.hexes, {h, lf}), {}});
          quad_to_tag.push_back(static_cast<std::int64_t>(s) + 1);
          tags[quad_to_tag.back()] = surfaces_[s].name;
        }
    const auto numbers = number_tags(SetKind::Patch, tags, names_);
    for (std::size_t q = 0; q < quad_to_tag.size(); ++q)
      file_.labels.quads[q].patch = PatchId(numbers.at(quad_to_tag[q]));
  }

  void set_corners() {
    for (std::int64_t id : ids_of(node_sets_, "CORNERS"))
      if (const auto vert = node_to_vert_.find(id); vert != node_to_vert_.end())
        file_.labels.corners.push_back(vert->second);
  }

  TextScanner scanner_;
  const std::string& name_;
  VolumeFile file_;
  MidNodeReader mid_nodes_;
  SetNames names_;
  Keyword keyword_;
  int num_parts_ = 0;
  std::size_t num_nodes_ = 0, num_kept_ = 0;  // of the elements being read; 0: left out
  std::vector<std::int64_t> element_;         // number and nodes so far
  std::unordered_map<std::int64_t, VertId> node_to_vert_;
  std::unordered_map<std::int64_t, HexId> element_to_hex_;
  AbaqusSets element_sets_, node_sets_;
  std::set<std::string> named_by_element_;
  std::vector<std::string> sections_;
  std::vector<AbaqusSurface> surfaces_;
};

}  // namespace

VolumeFile read_abaqus(const VolumeSource& source) { return AbaqusReader(source).run(); }

}  // namespace hexwright::io
