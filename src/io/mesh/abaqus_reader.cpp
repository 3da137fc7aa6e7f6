// Reads Abaqus input files: nodes, solid hexes and tets, shells and lines as sides and edges of
// hexes, sets of elements and nodes and surfaces (see abaqus_sets.cpp).
//
// Of tets, shells and lines of second order the corners are read.
//
// Based on: Dassault Systemes, "Abaqus Keywords Reference Guide": *NODE, *ELEMENT, *ELSET, *NSET,
// *SURFACE, *SOLID SECTION. Differs: one part only; *INCLUDE and node systems are refused.
#include <algorithm>
#include <charconv>
#include <limits>

#include "io/content/foreign_labels.h"
#include "io/content/read_mid_nodes.h"
#include "io/mesh/abaqus_deck.h"
#include "io/surface/polygon_soup.h"
#include "io/text/file_bytes.h"
#include "io/text/text_scanner.h"

namespace hexwright::io {
namespace {

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
      keyword.name = abaqus_key(word.substr(1));
    else if (equals == std::string_view::npos)
      keyword.parameters[abaqus_key(word)];
    else
      keyword.parameters[abaqus_key(word.substr(0, equals))] = trimmed(word.substr(equals + 1));
    is_first = false;
  }
  return keyword;
}

class AbaqusReader {
 public:
  explicit AbaqusReader(const VolumeSource& source)
      : scanner_(source.bytes, source.name), name_(source.name) {}

  VolumeFile run() {
    while (!scanner_.is_at_end()) read_line(scanner_.rest_of_line());
    finish_element();
    settle_abaqus_sets(deck_, names_);
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
    if (name == "SOLIDSECTION") deck_.sections.push_back(abaqus_key(keyword_.get("ELSET")));
    if (name == "ELEMENT") begin_elements();
    if (name == "SURFACE") deck_.surfaces.push_back({keyword_.get("NAME"), {}});
  }

  void read_data(std::string_view line) {
    const std::string& name = keyword_.name;
    if (name == "NODE")
      read_node(line);
    else if (name == "ELEMENT")
      read_element(line);
    else if (name == "ELSET")
      read_set(line, keyword_.get("ELSET"), deck_.element_sets);
    else if (name == "NSET")
      read_set(line, keyword_.get("NSET"), deck_.node_sets);
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
    if (!deck_.node_to_vert.try_emplace(id, VertId(file_.positions.size())).second)
      fail("node " + std::to_string(id) + " comes twice; export the file again");
    file_.positions.push_back(p);
  }

  double coordinate(std::string_view word) {
    scanner_.set_line(scanner_.line() - 1);  // for the message: the scanner is a line ahead
    const double value = scanner_.to_real(word, "a coordinate");
    scanner_.set_line(scanner_.line() + 1);
    return value;
  }

  /// Shells, membranes and plane elements of four sides stand for faces of hexes; trusses and beams
  /// for edges.
  void begin_elements() {
    const std::string type = abaqus_key(keyword_.get("TYPE"));
    struct Kind {
      const char* begins;
      Shape shape;
      std::size_t num_nodes;
    };
    constexpr Kind kKinds[] = {
        {"C3D8", Shape::Hex, 8},     {"C3D20", Shape::Hex, 20}, {"C3D27", Shape::Hex, 27},
        {"C3D4", Shape::Tet, 4},     {"C3D10", Shape::Tet, 10}, {"S4", Shape::Shell, 4},
        {"S8", Shape::Shell, 8},     {"S9", Shape::Shell, 9},   {"M3D4", Shape::Shell, 4},
        {"M3D8", Shape::Shell, 8},   {"M3D9", Shape::Shell, 9}, {"CPS4", Shape::Shell, 4},
        {"CPS8", Shape::Shell, 8},   {"CPE4", Shape::Shell, 4}, {"CPE8", Shape::Shell, 8},
        {"CAX4", Shape::Shell, 4},   {"CAX8", Shape::Shell, 8}, {"SFM3D4", Shape::Shell, 4},
        {"SFM3D8", Shape::Shell, 8}, {"R3D4", Shape::Shell, 4}, {"T3D2", Shape::Line, 2},
        {"T3D3", Shape::Line, 3},    {"B31", Shape::Line, 2},   {"B32", Shape::Line, 3}};
    shape_ = Shape::Other;
    for (const Kind& kind : kKinds)
      if (type.starts_with(kind.begins)) shape_ = kind.shape, num_nodes_ = kind.num_nodes;
  }

  /// An element may take several lines: it ends when it has all its nodes.
  void read_element(std::string_view line) {
    if (shape_ == Shape::Other) {
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
      const auto found = deck_.node_to_vert.find(element_[k + 1]);
      if (found == deck_.node_to_vert.end())
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
    switch (shape_) {
      case Shape::Hex:
        add_hex();
        break;
      case Shape::Tet:
        file_.tets.push_back(first_verts<4>());
        break;
      case Shape::Shell:
        number(deck_.element_to_shell, deck_.shells.size());
        deck_.shells.push_back(first_verts<4>());
        break;
      case Shape::Line:
        number(deck_.element_to_line, deck_.lines.size());
        deck_.lines.push_back(num_nodes_ == 2 ? first_verts<2>() : ends_of(first_verts<3>()));
        break;
      case Shape::Other:
        break;
    }
    if (const std::string set = keyword_.get("ELSET"); !set.empty()) {
      deck_.element_sets.at(set).ids.push_back(element_[0]);
      deck_.element_sets.at(set).is_of_lines = true;
    }
    element_.clear();
  }

  void number(ElementIndex& kind, std::size_t index) {
    if (!kind.try_emplace(element_[0], index).second)
      fail("element " + std::to_string(element_[0]) + " comes twice; export the file again");
  }

  /// Programs do not agree on which of three nodes is in the middle: it is the nearest to there.
  std::array<VertId, 2> ends_of(const std::array<VertId, 3>& nodes) const {
    std::size_t middle = 0;
    double least = std::numeric_limits<double>::max();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = file_.positions[nodes[(k + 1) % 3]], &b = file_.positions[nodes[(k + 2) % 3]];
      const double off = distance(file_.positions[nodes[k]], 0.5 * a + 0.5 * b);
      if (off < least) least = off, middle = k;
    }
    return {nodes[(middle + 1) % 3], nodes[(middle + 2) % 3]};
  }

  /// Of 27 nodes, those of faces and middle follow from the edges.
  void add_hex() {
    number(deck_.element_to_hex, file_.hexes.size());
    file_.hexes.push_back(first_verts<8>());
    if (num_nodes_ >= 20) mid_nodes_.add(file_, first_verts<20>());
  }

  /// Ids, names of other sets, or "first, last, step".
  void read_set(std::string_view line, const std::string& name, AbaqusSets& sets) {
    AbaqusSet& set = sets.at(name);
    std::vector<std::int64_t> ids;
    for (std::string_view word : split(line)) {
      if (is_abaqus_number(word))
        ids.push_back(integer(word, "a member of the set"));
      else if (!word.empty())
        set.others.push_back(abaqus_key(word));
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
    std::size_t num_known = deck_.node_to_vert.size();
    const auto elements = {&deck_.element_to_hex, &deck_.element_to_shell, &deck_.element_to_line};
    for (const ElementIndex* kind : elements) num_known += kind->size();
    std::vector<std::int64_t> ids;
    if ((last - first) / step <= static_cast<std::int64_t>(num_known)) {
      for (std::int64_t k = 0; k <= (last - first) / step; ++k) ids.push_back(first + k * step);
      return ids;
    }
    const auto add = [&](std::int64_t id) {
      if (id >= first && id <= last && (id - first) % step == 0) ids.push_back(id);
    };
    for (const auto& [id, vert] : deck_.node_to_vert) add(id);
    for (const ElementIndex* kind : elements)
      for (const auto& [id, index] : *kind) add(id);
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  }

  /// "17, S3", "top_elements, S3", or "shells"; of nodes, a node or a set of them.
  void read_surface_line(std::string_view line) {
    const std::string type = abaqus_key(keyword_.get("TYPE"));
    const auto words = split(line);
    if (type == "NODE") return read_set(words[0], keyword_.get("NAME"), deck_.node_sets);
    if (!type.empty() && type != "ELEMENT") return;
    deck_.surfaces.back().sides.emplace_back(abaqus_key(words[0]),
                                             words.size() > 1 ? abaqus_key(words[1]) : "");
  }

  TextScanner scanner_;
  const std::string& name_;
  AbaqusDeck deck_;
  VolumeFile& file_ = deck_.file;
  MidNodeReader mid_nodes_;
  SetNames names_;
  Keyword keyword_;
  int num_parts_ = 0;
  enum class Shape { Hex, Tet, Shell, Line, Other };  // others are left out
  Shape shape_ = Shape::Other;
  std::size_t num_nodes_ = 0;          // of the elements being read
  std::vector<std::int64_t> element_;  // number and nodes so far
};

}  // namespace

VolumeFile read_abaqus(const VolumeSource& source) { return AbaqusReader(source).run(); }

}  // namespace hexwright::io
