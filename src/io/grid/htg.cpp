// VTK HyperTreeGrid files (.htg), version 2.0 of the XML format as VTK 9 writes it.
//
// One tree per root cube. Per tree and breadth first: NumberOfVerticesPerDepth counts the nodes of
// each depth; Descriptors holds one bit per node, 1 = split, without those of the deepest level.
// Children are in order of the bits x, y, z.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "hexwright/base/cancel.h"

#include "io/grid/grid_file.h"
#include "io/mesh/vtk_xml.h"
#include "io/surface/polygon_soup.h"
#include "io/text/file_bytes.h"
#include "io/vtk/vtk_xml_file.h"

namespace hexwright::io {
namespace {

constexpr double kSpacingTolerance = 1e-6;  // relative to a root cube's edge

class HtgReader {
 public:
  explicit HtgReader(const VolumeSource& source) : xml_(source.bytes, source.name) {}

  GridFile run() {
    grid_ = xml_.root().child("HyperTreeGrid");
    if (!grid_) fail("there is no HyperTreeGrid element; give a .htg file of VTK 9");
    if (std::string_view(xml_.root().attribute("version").value()) < "2")
      fail("this is version " + std::string(xml_.root().attribute("version").value()) +
           " of the format; write it again with VTK 9.1 or newer");
    if (grid_.attribute("BranchFactor").as_int() != 2)
      fail(
          "the branch factor is not 2: cells must be split into eight; write the grid as an "
          "octree");
    read_frame();
    read_trees();
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw bad_file(xml_.name(), message); }

  std::vector<double> named(const char* parent, const char* name, bool is_needed) const {
    const auto array = grid_.child(parent).find_child_by_attribute("DataArray", "Name", name);
    if (array) return xml_.values(array);
    if (is_needed) fail(std::string("there is no DataArray '") + name + "'; write the file again");
    return {};
  }

  /// One edge of roots per axis, the longest of which is the size of a root; coordinates of files
  /// are rounded, so edges are compared with a tolerance.
  void read_frame() {
    constexpr const char* kNames[] = {"XCoordinates", "YCoordinates", "ZCoordinates"};
    Vec3 edge;
    for (int axis = 0; axis < 3; ++axis) {
      const auto coords = named("Grid", kNames[axis], true);
      if (coords.size() < 2) fail("the grid is not three-dimensional; give a grid of volume cells");
      const double size = coords[1] - coords[0];
      if (!(size > 0) || !std::isfinite(size))
        fail("the coordinates of the root cubes do not increase; write the file again");
      for (std::size_t i = 0; i + 1 < coords.size(); ++i)
        if (!(std::abs(coords[i + 1] - coords[i] - size) <= kSpacingTolerance * size))
          fail(std::string(kNames[axis]) +
               ": root cells are not of one size; give a grid of equal root cells");
      edge[axis] = size;
      file_.frame.origin[axis] = coords[0];
      num_roots_[axis] = static_cast<std::int64_t>(coords.size()) - 1;
    }
    // With one edge for all axes it is that of the first, bit for bit.
    const double longest = std::max({edge.x, edge.y, edge.z});
    const auto is_full = [&](double e) { return e >= (1 - kSpacingTolerance) * longest; };
    file_.frame.root_size = is_full(edge.x) ? edge.x : longest;
    for (int axis = 0; axis < 3; ++axis)
      file_.frame.stretch[axis] = is_full(edge[axis]) ? 1 : edge[axis] / file_.frame.root_size;
  }

  /// Trees are numbered x fastest, or z fastest when transposed.
  LatticeCoord root_of(double tree_id) const {
    const std::int64_t total = num_roots_[0] * num_roots_[1] * num_roots_[2];
    if (!(tree_id >= 0 && tree_id < static_cast<double>(total)))
      fail("a tree id is out of range; write the file again");
    auto id = static_cast<std::int64_t>(tree_id);
    LatticeCoord root;
    const bool is_transposed = grid_.attribute("TransposedRootIndexing").as_int() != 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t axis = is_transposed ? 2 - k : k;
      root[axis] = static_cast<std::int32_t>(id % num_roots_[axis]);
      id /= num_roots_[axis];
    }
    return root;
  }

  void read_trees() {
    const auto tree_ids = named("Trees", "TreeIds", true);
    const auto depths = named("Trees", "DepthPerTree", true);
    counts_ = named("Trees", "NumberOfVerticesPerDepth", true);
    bits_ = named("Trees", "Descriptors", false);  // absent when nothing is split
    mask_ = named("Trees", "Mask", false);
    if (depths.size() != tree_ids.size())
      fail("the numbers of trees and of depths differ; write the file again");
    for (std::size_t t = 0; t < tree_ids.size(); ++t) read_tree(root_of(tree_ids[t]), depths[t]);
    if (file_.cells.empty()) fail("the file holds no cell; write the file again");
    file_.roots = find_roots(file_.cells);
  }

  /// Level by level as the file has them. The counts repeat what the descriptors say; a
  /// disagreement is damage. A masked node is a hole: allowed as a whole root, which is how VTK
  /// cuts domains out.
  void read_tree(const LatticeCoord& root, double depth) {
    if (!(depth >= 1 && depth <= kMaxGridLevel + 1))
      fail("a tree's depth is not within 1 to 21; coarsen the grid or write it again");
    std::vector<LatticeCoord> nodes = {root};
    for (int level = 0; level < depth; ++level) {
      if (next_count_ >= counts_.size() ||
          counts_[next_count_++] != static_cast<double>(nodes.size()))
        fail(
            "the numbers of cells per depth and the descriptors differ; the file is damaged, "
            "write it again");
      std::vector<LatticeCoord> children;
      CancelCheck check_cancelled;
      for (const LatticeCoord& node : nodes) {
        check_cancelled();
        const bool is_hidden = next_node_ < mask_.size() && mask_[next_node_] != 0;
        ++next_node_;
        const bool is_split = level + 1 < depth && next_bit() && !is_hidden;
        if (is_split)
          add_children(node, children);
        else if (!is_hidden)
          file_.cells.push_back({level, node});
        else if (level > 0)
          fail("a masked cell inside a root cube; give the grid with all its cells");
      }
      nodes = std::move(children);
    }
    if (!nodes.empty())
      fail("a tree's depth and its descriptors differ; the file is damaged, write it again");
  }

  bool next_bit() {
    if (next_bit_ >= bits_.size())
      fail("the descriptors end too early: the file is truncated; write it again");
    return bits_[next_bit_++] != 0;
  }

  static void add_children(const LatticeCoord& node, std::vector<LatticeCoord>& out) {
    for (int child = 0; child < 8; ++child)
      out.push_back({2 * node[0] + (child & 1), 2 * node[1] + (child >> 1 & 1),
                     2 * node[2] + (child >> 2 & 1)});
  }

  VtkXmlFile xml_;
  pugi::xml_node grid_;
  GridFile file_;
  std::int64_t num_roots_[3] = {0, 0, 0};
  std::vector<double> counts_, bits_, mask_;
  std::size_t next_count_ = 0, next_bit_ = 0, next_node_ = 0;
};

/// The trees of a grid, breadth first.
struct HtgTrees {
  std::vector<std::uint8_t> descriptors;
  std::vector<std::int64_t> counts;  ///< nodes per depth, tree after tree
  std::vector<std::int64_t> ids;
  std::vector<std::uint32_t> depths;
  std::vector<std::int32_t> levels;  ///< one per node
};

class HtgTreeBuilder {
 public:
  explicit HtgTreeBuilder(const Grid& grid) : grid_(grid) {}

  HtgTrees run() {
    LatticeCoord lo = grid_.roots[0], hi = lo;
    for (const LatticeCoord& root : grid_.roots)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lo[axis] = std::min(lo[axis], root[axis]);
        hi[axis] = std::max(hi[axis], root[axis]);
      }
    low_root = lo;
    for (std::size_t axis = 0; axis < 3; ++axis) num_roots[axis] = hi[axis] - lo[axis] + 1;
    for (const LatticeCoord& root : grid_.roots) add_tree(root);
    return std::move(trees_);
  }

  LatticeCoord low_root = {0, 0, 0};
  std::array<std::int64_t, 3> num_roots = {1, 1, 1};

 private:
  void add_tree(const LatticeCoord& root) {
    by_level_.assign(static_cast<std::size_t>(grid_.finest_level) + 1, {});
    descend(0);
    std::size_t depth = by_level_.size();
    while (by_level_[depth - 1].empty()) --depth;
    for (std::size_t level = 0; level < depth; ++level) {
      const auto& bits = by_level_[level];
      trees_.counts.push_back(static_cast<std::int64_t>(bits.size()));
      trees_.levels.insert(trees_.levels.end(), bits.size(), static_cast<std::int32_t>(level));
      if (level + 1 < depth)
        trees_.descriptors.insert(trees_.descriptors.end(), bits.begin(), bits.end());
    }
    trees_.depths.push_back(static_cast<std::uint32_t>(depth));
    trees_.ids.push_back((root[0] - low_root[0]) +
                         num_roots[0] *
                             ((root[1] - low_root[1]) + num_roots[1] * (root[2] - low_root[2])));
  }

  /// Consumes the leaves below one node of the given level; they are in Morton order.
  /// The recursion mirrors Morton order: the next leaf of the grid is always in the subtree at
  /// hand.
  void descend(int level) {
    const bool is_leaf = grid_.cells[CellId(next_leaf_)].level == level;
    by_level_[static_cast<std::size_t>(level)].push_back(is_leaf ? 0 : 1);
    if (is_leaf)
      ++next_leaf_;
    else
      for (int child = 0; child < 8; ++child) descend(level + 1);
  }

  const Grid& grid_;
  HtgTrees trees_;
  std::vector<std::vector<std::uint8_t>> by_level_;
  std::size_t next_leaf_ = 0;
};

/// Bits to bytes, highest first.
std::vector<std::uint8_t> pack_bits(const std::vector<std::uint8_t>& bits) {
  std::vector<std::uint8_t> bytes((bits.size() + 7) / 8, 0);
  for (std::size_t i = 0; i < bits.size(); ++i)
    bytes[i / 8] = static_cast<std::uint8_t>(bytes[i / 8] | bits[i] << (7 - i % 8));
  return bytes;
}

std::string tuples(std::size_t count) { return fmt::format(" NumberOfTuples=\"{}\"", count); }

void write_root_coordinates(const Grid& grid, const HtgTreeBuilder& builder, VtkXmlWriter& xml) {
  xml.open("Grid");
  constexpr const char* kNames[] = {"XCoordinates", "YCoordinates", "ZCoordinates"};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> coords;
    const auto a = static_cast<std::size_t>(axis);
    for (std::int64_t i = 0; i <= builder.num_roots[a]; ++i)
      coords.push_back(grid.frame.origin[axis] +
                       grid.frame.root_edge(axis) * static_cast<double>(builder.low_root[a] + i));
    xml.array<double>(kNames[axis], "Float64", 1, coords, tuples(coords.size()));
  }
  xml.close("Grid");
}

}  // namespace

GridFile read_htg(const VolumeSource& source) { return HtgReader(source).run(); }

std::string htg_bytes(const Grid& grid) {
  HtgTreeBuilder builder(grid);
  const HtgTrees trees = builder.run();
  VtkXmlWriter xml("HyperTreeGrid", "2.0");
  const auto& n = builder.num_roots;
  xml.open(
      fmt::format("HyperTreeGrid BranchFactor=\"2\" TransposedRootIndexing=\"0\" "
                  "Dimensions=\"{} {} {}\"",
                  n[0] + 1, n[1] + 1, n[2] + 1));
  write_root_coordinates(grid, builder, xml);
  xml.open("Trees");
  xml.array<std::uint8_t>("Descriptors", "Bit", 1, pack_bits(trees.descriptors),
                          tuples(trees.descriptors.size()));
  xml.array<std::int64_t>("NumberOfVerticesPerDepth", "Int64", 1, trees.counts,
                          tuples(trees.counts.size()));
  xml.array<std::int64_t>("TreeIds", "Int64", 1, trees.ids, tuples(trees.ids.size()));
  xml.array<std::uint32_t>("DepthPerTree", "UInt32", 1, trees.depths, tuples(trees.depths.size()));
  xml.close("Trees");
  xml.open("CellData");
  xml.array<std::int32_t>("level", "Int32", 1, trees.levels, tuples(trees.levels.size()));
  xml.close("CellData");
  xml.close("HyperTreeGrid");
  return xml.take();
}

}  // namespace hexwright::io
