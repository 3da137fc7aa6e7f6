// Reads Exodus II files: element blocks as regions, side sets as patches, sets of nodes as what
// their nodes form (see LabelCollector). Blocks of shells are patches too, those of bars curves,
// those of spheres corners. Sets without a name are known by their number: "sideset_100".
//
// Based on: Schoof, Yarberry, "EXODUS II: A Finite Element Data Model", SAND92-2137 (updated 2013).
// Differs: elements in three dimensions other than hexes and tets are refused; triangles and
// results are passed over.
#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "hexwright/base/cancel.h"

#include "io/content/foreign_labels.h"
#include "io/content/label_collector.h"
#include "io/content/read_mid_nodes.h"
#include "io/sets/face_table.h"
#include "io/text/file_bytes.h"
#include "io/text/netcdf_file.h"

namespace hexwright::io {
namespace {

/// Our local face of sides 1 to 6 of a HEX (see the writer).
constexpr std::array<int, 6> kFaceOfSide = {2, 1, 3, 0, 4, 5};

/// Ours of each of a HEX27's nodes: middle, then -z +z -x +x -y +y behind those of a HEX20.
constexpr std::array<std::size_t, 7> kInnerOrder = {26, 24, 25, 20, 21, 22, 23};

std::size_t our_node(std::size_t k) { return k < 20 ? kUprightEdgesFirst[k] : kInnerOrder[k - 20]; }

enum class Shape { Hex, Tet, Face, Line, Point, Other };

/// Of an element type such as "HEX8", "hexahedron", "SHELL4", "BAR2", whatever its case.
Shape shape_of(const std::string& type) {
  std::string name;
  for (char c : type) name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  struct Prefix {
    const char* begins;
    Shape shape;
  };
  constexpr Prefix kPrefixes[] = {
      {"HEX", Shape::Hex},   {"TET", Shape::Tet},      {"QUAD", Shape::Face},
      {"TRI", Shape::Face},  {"SHELL", Shape::Face},   {"BAR", Shape::Line},
      {"BEAM", Shape::Line}, {"TRUSS", Shape::Line},   {"ROD", Shape::Line},
      {"EDGE", Shape::Line}, {"SPHERE", Shape::Point}, {"POINT", Shape::Point}};
  for (const Prefix& prefix : kPrefixes)
    if (name.starts_with(prefix.begins)) return prefix.shape;
  return Shape::Other;
}

/// Of an element in the order of the file, by which side sets know it.
struct Element {
  Shape shape;
  std::size_t index;  ///< among the file's hexes or quads
};

/// A list of sets: its length, the stems of the variables of ids and names and of members, and what
/// those without a name are called.
struct ListNames {
  const char *dimension, *prefix, *members, *unnamed;
};
constexpr ListNames kBlocks = {"num_el_blk", "eb", "connect", "block"};
constexpr ListNames kSideSets = {"num_side_sets", "ss", "elem_ss", "sideset"};
constexpr ListNames kNodeSets = {"num_node_sets", "ns", "node_ns", "nodeset"};

class ExodusReader {
 public:
  explicit ExodusReader(const VolumeSource& source)
      : name_(source.name), in_(open_netcdf(source.bytes, source.name)), labels_(file_) {}

  VolumeFile run() {
    if (!in_->dimension("num_nodes"))
      throw bad_file(name_,
                     "this netCDF file holds no Exodus mesh (it has no num_nodes); "
                     "check what was exported");
    read_nodes();
    read_blocks();
    read_side_sets();
    for (const auto& [block, verts] : shells_) labels_.add_quad(block, verts);
    read_node_sets();
    labels_.settle(names_);
    mid_nodes_.settle(file_, name_);
    settle_labels(file_);
    names_.apply(file_);
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& where, const std::string& message) const {
    throw bad_element(name_, where, message + "; the file is damaged, export it again");
  }

  void read_nodes() {
    if (in_->dimension("num_dim").value_or(3) != 3)
      throw bad_file(name_, "the mesh is not one in three dimensions; export a volume mesh");
    const std::size_t count = *in_->dimension("num_nodes");
    std::array<std::vector<double>, 3> axes;
    if (in_->shape("coord")) {  // as older files have it
      const std::vector<double> all = in_->numbers("coord");
      if (all.size() / 3 != count) fail("variable 'coord'", "it has not three numbers per node");
      for (std::size_t axis = 0; axis < 3; ++axis)
        axes[axis].assign(all.begin() + static_cast<std::ptrdiff_t>(axis * count),
                          all.begin() + static_cast<std::ptrdiff_t>((axis + 1) * count));
    } else {
      for (std::size_t axis = 0; axis < 3; ++axis)
        axes[axis] = in_->numbers(fmt::format("coord{}", "xyz"[axis]));
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (axes[axis].size() != count)
        fail(fmt::format("variable 'coord{}'", "xyz"[axis]),
             fmt::format("it has {} numbers for {} nodes", axes[axis].size(), count));
    for (std::size_t v = 0; v < count; ++v) {
      check_cancelled_();
      file_.positions.push_back({axes[0][v], axes[1][v], axes[2][v]});
    }
  }

  /// What users call each set of a list: its name, or else its id.
  std::vector<std::string> set_names(const ListNames& list) const {
    const std::vector<double> ids = set_ids(list);
    const std::string variable = std::string(list.prefix) + "_names";
    std::string letters;
    std::size_t width = 0;
    if (const auto shape = in_->shape(variable); shape && shape->size() == 2) {
      letters = in_->letters(variable);
      width = (*shape)[1];
    }
    std::vector<std::string> names;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      std::string name = i * width < letters.size() ? letters.substr(i * width, width) : "";
      name = name.substr(0, name.find('\0'));
      names.push_back(name.empty() ? fmt::format("{}_{:.0f}", list.unnamed, ids[i]) : name);
    }
    return names;
  }

  /// Counted from 1 where the file gives none. Not more than the file has variables for: no memory
  /// is reserved on the word of a dimension.
  std::vector<double> set_ids(const ListNames& list) const {
    const std::size_t count = in_->dimension(list.dimension).value_or(0);
    const std::string variable = std::string(list.prefix) + "_prop1";
    std::vector<double> ids;
    if (in_->shape(variable)) ids = in_->numbers(variable);
    if (ids.size() > count) ids.resize(count);
    while (ids.size() < count && in_->shape(fmt::format("{}{}", list.members, ids.size() + 1)))
      ids.push_back(static_cast<double>(ids.size() + 1));
    return ids;
  }

  /// `where` makes the place for messages.
  VertId vert(double number, const auto& where) const {
    if (!(number >= 1) || number > static_cast<double>(file_.positions.size()))
      fail(where(), fmt::format("it names node {} of {}", number, file_.positions.size()));
    return VertId(static_cast<std::size_t>(number) - 1);
  }

  void read_blocks() {
    const std::vector<std::string> names = set_names(kBlocks);
    std::map<std::int64_t, std::string> tags;
    std::vector<std::int64_t> hex_to_tag;
    for (std::size_t b = 0; b < names.size(); ++b) {
      const std::string variable = fmt::format("connect{}", b + 1);
      const auto shape = in_->shape(variable);
      if (!shape) continue;  // a block without elements
      if (shape->size() != 2) fail("variable '" + variable + "'", "it is no table of elements");
      const std::size_t first_hex = file_.hexes.size();
      read_block(variable, (*shape)[1], names[b]);
      if (file_.hexes.size() == first_hex) continue;
      tags[static_cast<std::int64_t>(b) + 1] = names[b];
      hex_to_tag.resize(file_.hexes.size(), static_cast<std::int64_t>(b) + 1);
    }
    const auto numbers = number_tags(SetKind::Region, tags, names_);
    for (const std::int64_t tag : hex_to_tag) file_.region.push_back(numbers.at(tag));
  }

  void read_block(const std::string& variable, std::size_t width, const std::string& block) {
    const std::string type = in_->text_attribute(variable, "elem_type");
    const Shape shape = shape_of(type);
    if (width > 27 || width == 0) fail("variable '" + variable + "'", "no element is so large");
    if (shape == Shape::Other) refuse(block, type, width);
    const std::vector<double> table = in_->numbers(variable);
    for (std::size_t begin = 0; begin + width <= table.size(); begin += width) {
      check_cancelled_();
      std::array<VertId, 27> nodes;
      for (std::size_t k = 0; k < width; ++k)
        nodes[k] =
            vert(table[begin + k], [&] { return fmt::format("element {}", elements_.size() + 1); });
      add_element(shape, std::span(nodes).first(width), block);
    }
  }

  [[noreturn]] void refuse(const std::string& block, const std::string& type,
                           std::size_t width) const {
    throw bad_element(name_, "block '" + block + "'",
                      fmt::format("it holds elements '{}' of {} nodes, which are neither hexes nor "
                                  "tets; export blocks of hexes",
                                  type, width));
  }

  void add_element(Shape shape, std::span<const VertId> nodes, const std::string& block) {
    const std::size_t size = nodes.size();
    if (shape == Shape::Hex && (size == 8 || size == 20 || size == 27)) {
      elements_.push_back({shape, file_.hexes.size()});
      return add_hex(nodes);
    }
    if (shape == Shape::Hex) refuse(block, "HEX", size);
    elements_.push_back({shape, shells_.size()});
    if (shape == Shape::Tet && size >= 4)
      file_.tets.push_back({nodes[0], nodes[1], nodes[2], nodes[3]});
    else if (shape == Shape::Face && (size == 4 || size == 8 || size == 9))
      shells_.emplace_back(block, std::array{nodes[0], nodes[1], nodes[2], nodes[3]});
    else if (shape == Shape::Line && size >= 2)
      labels_.add_edge(block, {nodes[0], nodes[1]});
    else if (shape == Shape::Point && size == 1)
      labels_.add_corner(nodes[0]);
    else
      elements_.back().shape = Shape::Other, ++file_.num_others;
  }

  void add_hex(std::span<const VertId> in_file) {
    std::array<VertId, 27> nodes;
    for (std::size_t k = 0; k < in_file.size(); ++k) nodes[our_node(k)] = in_file[k];
    std::array<VertId, 8> corners;
    std::copy(nodes.begin(), nodes.begin() + 8, corners.begin());
    file_.hexes.push_back(corners);
    if (in_file.size() > 8) mid_nodes_.add(file_, std::span(nodes).first(in_file.size()));
  }

  void read_side_sets() {
    const std::vector<std::string> names = set_names(kSideSets);
    for (std::size_t s = 0; s < names.size(); ++s) {
      const std::string variable = fmt::format("elem_ss{}", s + 1);
      if (!in_->shape(variable)) continue;  // a set without sides
      const std::vector<double> elements = in_->numbers(variable);
      const std::vector<double> sides = in_->numbers(fmt::format("side_ss{}", s + 1));
      if (sides.size() != elements.size())
        fail("side set '" + names[s] + "'", "it has not one side per element");
      for (std::size_t i = 0; i < sides.size(); ++i) add_side(names[s], elements[i], sides[i]);
    }
  }

  void add_side(const std::string& set, double element, double side) {
    if (!(element >= 1) || element > static_cast<double>(elements_.size()))
      fail("side set '" + set + "'",
           fmt::format("it names element {} of {}", element, elements_.size()));
    const Element& found = elements_[static_cast<std::size_t>(element) - 1];
    if (!(side >= 1 && side <= 6) || side != static_cast<int>(side))
      fail("side set '" + set + "'", fmt::format("there is no side {}", side));
    if (found.shape == Shape::Hex) {
      const int lf = kFaceOfSide[static_cast<std::size_t>(side) - 1];
      labels_.add_quad(set, face_verts(file_.hexes, {HexId(found.index), lf}));
    } else if (found.shape == Shape::Face && side <= 2) {  // front and back of a shell
      labels_.add_quad(set, shells_[found.index].second);
    } else {
      ++file_.num_others;
    }
  }

  void read_node_sets() {
    const std::vector<std::string> names = set_names(kNodeSets);
    for (std::size_t s = 0; s < names.size(); ++s) {
      const std::string variable = fmt::format("node_ns{}", s + 1);
      if (!in_->shape(variable)) continue;
      std::vector<VertId> verts;
      for (const double number : in_->numbers(variable))
        verts.push_back(vert(number, [&] { return "node set '" + names[s] + "'"; }));
      labels_.add_node_set(names[s], std::move(verts));
    }
  }

  const std::string& name_;
  std::unique_ptr<NetcdfFile> in_;
  VolumeFile file_;
  LabelCollector labels_;
  MidNodeReader mid_nodes_;
  SetNames names_;
  CancelCheck check_cancelled_;
  std::vector<Element> elements_;
  std::vector<std::pair<std::string, std::array<VertId, 4>>> shells_;  // with their blocks
};

}  // namespace

VolumeFile read_exodus(const VolumeSource& source) { return ExodusReader(source).run(); }

}  // namespace hexwright::io
