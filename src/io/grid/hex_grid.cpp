// Adaptive grids as hex meshes with hanging nodes, both ways.
//
// Files of other programs do not say where the root cubes lie: the largest cubes that still tile
// the domain are taken, so that an octree in one cube is found to be one.
#include <algorithm>
#include <cmath>

#include "hexwright/base/cancel.h"
#include "hexwright/base/parallel.h"

#include "io/grid/grid_file.h"
#include "io/text/file_bytes.h"

namespace hexwright::io {
namespace {

// Coordinates may be rounded (text files): shares of a cell's edge that still count as equal.
constexpr double kCubeTolerance = 0.01;
constexpr double kLatticeTolerance = 0.05;

/// A cell as an integer cube: low corner and log2 of the edge, in units of the smallest edge.
struct LatticeCube {
  LatticeCoord corner;
  int log_size = 0;
};

class HexGridReader {
 public:
  HexGridReader(const VolumeFile& file, const std::string& name) : file_(file), name_(name) {}

  GridFile run() {
    if (file_.hexes.empty())
      throw bad_file(name_, "the file holds no hexahedron; give a grid of cubes");
    choose_stretch();
    const std::vector<Box3> boxes = find_boxes();
    choose_units(boxes);
    for (std::size_t h = 0; h < boxes.size(); ++h) cubes_.push_back(to_cube(boxes[h], h));
    if (file_.grid_frame.empty()) grow_roots();
    return make_file();
  }

 private:
  [[noreturn]] void fail(std::size_t hex, const std::string& message) const {
    throw bad_element(name_, "hex " + std::to_string(hex), message);
  }

  /// Cells may be shorter along an axis than along another, all in the same ratio: from here on
  /// everything is measured in coordinates in which they are cubes.
  void choose_stretch() {
    if (!file_.grid_stretch.empty()) {
      for (int axis = 0; axis < 3; ++axis)
        stretch_[axis] = file_.grid_stretch[static_cast<std::size_t>(axis)];
      if (!(std::min({stretch_.x, stretch_.y, stretch_.z}) > 0))
        throw bad_file(name_, "'grid_stretch' must be positive; write the grid again");
      return;
    }
    Vec3 sum;  // the mean is known better than one rounded cell
    for (HexId h : file_.hexes.ids()) {
      Box3 box;
      for (VertId v : file_.hexes[h]) box.extend(file_.positions[v]);
      sum += box.extent();
    }
    const double longest = std::max({sum.x, sum.y, sum.z});
    if (!(std::min({sum.x, sum.y, sum.z}) > 0) || !std::isfinite(longest)) return;
    for (int axis = 0; axis < 3; ++axis)
      stretch_[axis] = sum[axis] < (1 - kCubeTolerance) * longest ? sum[axis] / longest : 1;
  }

  Vec3 unstretched(const Vec3& p) const {
    return {p.x / stretch_.x, p.y / stretch_.y, p.z / stretch_.z};
  }

  std::vector<Box3> find_boxes() const {
    std::vector<Box3> boxes;
    CancelCheck check_cancelled;
    for (HexId h : file_.hexes.ids()) {
      check_cancelled();
      Box3 box;
      for (VertId v : file_.hexes[h]) box.extend(unstretched(file_.positions[v]));
      if (!is_cube(h, box))
        fail(h.index(),
             "it is not an axis-aligned cell of the others' proportions; give a grid of cubes");
      boxes.push_back(box);
    }
    return boxes;
  }

  /// Whatever the numbering of its vertices, even inverted: every corner of the box is one of them.
  bool is_cube(HexId h, const Box3& box) const {
    const Vec3 size = box.extent();
    const double edge = std::max({size.x, size.y, size.z});
    const double tolerance = kCubeTolerance * edge;
    if (!(std::min({size.x, size.y, size.z}) > edge - tolerance) || !(edge > 0)) return false;
    unsigned corners_seen = 0;
    for (VertId v : file_.hexes[h]) {
      const Vec3 p = unstretched(file_.positions[v]) - box.lo;
      unsigned bits = 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] > edge / 2) bits |= 1u << axis;
        if (std::min(p[axis], size[axis] - p[axis]) > tolerance) return false;
      }
      corners_seen |= 1u << bits;
    }
    return corners_seen == 0xff;
  }

  /// Sets origin_, unit_ (the smallest edge) and log_root_ (of a root cube's edge in units).
  void choose_units(const std::vector<Box3>& boxes) {
    double smallest = boxes[0].extent().x, largest = smallest;
    std::size_t smallest_hex = 0;
    Box3 all;
    for (std::size_t h = 0; h < boxes.size(); ++h) {
      const double edge = boxes[h].extent().x;
      if (edge < smallest) smallest_hex = h;
      smallest = std::min(smallest, edge);
      largest = std::max(largest, edge);
      all.extend(boxes[h]);
    }
    const bool has_frame = !file_.grid_frame.empty();
    const double root = has_frame ? file_.grid_frame[3] : largest;
    log_root_ = static_cast<int>(std::lround(std::log2(root / smallest)));
    if (!(root > 0) || !std::isfinite(root) || log_root_ < 0 || log_root_ > kMaxGridLevel)
      fail(smallest_hex, "its size is not within 1 to 2^-20 of a root cube's; give a coarser grid");
    unit_ = std::ldexp(root, -log_root_);
    const auto& frame = file_.grid_frame;
    origin_ = has_frame ? unstretched({frame[0], frame[1], frame[2]}) : all.lo;
    const Vec3 reach = max(all.hi - origin_, origin_ - all.lo);
    // Room for the root coordinates that a grid allows.
    if (!(std::max({reach.x, reach.y, reach.z}) <= std::ldexp(root, 10)))
      throw bad_file(name_, "the grid is more than 1024 root cubes wide; use larger cells");
    extent_ = all.hi - origin_;
  }

  /// A cell of edge 2^k units starts at a multiple of 2^k units, or it is no cell of an octree.
  LatticeCube to_cube(const Box3& box, std::size_t hex) const {
    const double edge = box.extent().x / unit_;
    LatticeCube cube;
    cube.log_size = static_cast<int>(std::lround(std::log2(edge)));
    const double exact = std::ldexp(1.0, cube.log_size);
    if (std::abs(edge - exact) > kCubeTolerance * exact || cube.log_size > log_root_)
      fail(hex, "its edge is no power of two times that of the smallest cell; give an octree");
    for (int axis = 0; axis < 3; ++axis) {
      const double x = (box.lo[axis] - origin_[axis]) / unit_;
      const double rounded = std::round(x);
      cube.corner[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(rounded);
      const auto size = static_cast<std::int32_t>(exact);
      if (std::abs(x - rounded) > kLatticeTolerance ||
          cube.corner[static_cast<std::size_t>(axis)] % size != 0)
        fail(hex, "it does not lie on the lattice of its size; give an octree");
    }
    return cube;
  }

  /// Doubles the root cubes while larger ones are still filled exactly.
  void grow_roots() {
    const double widest = std::max({extent_.x, extent_.y, extent_.z}) / unit_;
    while (log_root_ < kMaxGridLevel && std::ldexp(1.0, log_root_ + 1) < widest * 1.5 &&
           fills_roots(log_root_ + 1))
      ++log_root_;
  }

  /// Sorts the cells into candidate root cubes and compares volumes: cells that are disjoint and
  /// lie on the lattice fill a cube exactly when their volumes sum to its. (Overlaps are found
  /// later.)
  bool fills_roots(int log_root) const {
    struct Part {
      LatticeCoord root;
      std::uint64_t volume;
    };
    std::vector<Part> parts;
    for (const LatticeCube& cube : cubes_) {
      const auto& c = cube.corner;
      parts.push_back({{c[0] >> log_root, c[1] >> log_root, c[2] >> log_root},
                       std::uint64_t{1} << 3 * cube.log_size});
    }
    std::sort(parts.begin(), parts.end(),
              [](const Part& a, const Part& b) { return a.root < b.root; });
    for (std::size_t i = 0; i < parts.size();) {
      std::uint64_t volume = 0;
      std::size_t j = i;
      for (; j < parts.size() && parts[j].root == parts[i].root; ++j) volume += parts[j].volume;
      if (volume != std::uint64_t{1} << 3 * log_root) return false;
      i = j;
    }
    return true;
  }

  GridFile make_file() const {
    GridFile result;
    result.frame.origin = {origin_.x * stretch_.x, origin_.y * stretch_.y, origin_.z * stretch_.z};
    result.frame.root_size = std::ldexp(unit_, log_root_);
    result.frame.stretch = stretch_;
    for (const LatticeCube& cube : cubes_) {
      CellSpec cell;
      cell.level = log_root_ - cube.log_size;
      for (std::size_t axis = 0; axis < 3; ++axis)
        cell.index[axis] = cube.corner[axis] >> cube.log_size;
      result.cells.push_back(cell);
    }
    result.roots = find_roots(result.cells);
    return result;
  }

  const VolumeFile& file_;
  const std::string& name_;
  Vec3 stretch_ = {1, 1, 1};
  Vec3 origin_, extent_;  // unstretched
  double unit_ = 1;
  int log_root_ = 0;
  std::vector<LatticeCube> cubes_;
};

/// Lattice coordinates of a hex's local vertex.
LatticeCoord corner_of(const Grid& grid, CellId c, int lv) {
  const int bits = kHexBitsOfVertex[static_cast<std::size_t>(lv)];
  LatticeCoord p = grid.cells[c].corner;
  for (int axis = 0; axis < 3; ++axis)
    if (bits >> axis & 1) p[static_cast<std::size_t>(axis)] += grid.cell_size(c);
  return p;
}

}  // namespace

std::vector<LatticeCoord> find_roots(std::span<const CellSpec> cells) {
  std::vector<LatticeCoord> roots;
  for (const CellSpec& cell : cells) {
    const LatticeCoord root = {cell.index[0] >> cell.level, cell.index[1] >> cell.level,
                               cell.index[2] >> cell.level};
    if (roots.empty() || roots.back() != root) roots.push_back(root);  // neighbours share roots
  }
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  return roots;
}

GridFile hexes_to_grid(const VolumeFile& file, const std::string& name) {
  return HexGridReader(file, name).run();
}

/// Vertices are numbered by place (z, y, x), hexes as the cells: the mesh is a function of the
/// grid.
HexMesh grid_to_hexes(const Grid& grid) {
  // All corners of all cells, sorted by place: equal ones become one vertex.
  struct Corner {
    std::uint64_t zy;
    std::uint32_t x;
    std::uint32_t index;  // 8 * cell + lv
    bool is_at(const Corner& other) const { return zy == other.zy && x == other.x; }
  };
  constexpr std::uint32_t kOffset = 1u << 30;  // corners lie within +-2^30: none is negative then
  const auto shifted = [](std::int32_t x) { return static_cast<std::uint32_t>(x) + kOffset; };
  std::vector<Corner> corners(8 * grid.num_cells());
  parallel_for(corners.size(), [&](std::size_t i) {
    const LatticeCoord p = corner_of(grid, CellId(i / 8), static_cast<int>(i % 8));
    corners[i] = {std::uint64_t{shifted(p[2])} << 32 | shifted(p[1]), shifted(p[0]),
                  static_cast<std::uint32_t>(i)};
  });
  parallel_stable_sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return a.zy != b.zy ? a.zy < b.zy : a.x < b.x;
  });

  HexMesh mesh;
  mesh.hexes.resize(grid.num_cells());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const CellId cell(corners[i].index / 8);
    const int lv = static_cast<int>(corners[i].index % 8);
    if (i == 0 || !corners[i].is_at(corners[i - 1]))
      mesh.positions.push_back(lattice_to_world(grid, corner_of(grid, cell, lv)));
    mesh.hexes[HexId(cell.value())][static_cast<std::size_t>(lv)] = VertId(mesh.num_verts() - 1);
  }
  for (const GridCell& cell : grid.cells) mesh.region.push_back(cell.level);
  return mesh;
}

}  // namespace hexwright::io
