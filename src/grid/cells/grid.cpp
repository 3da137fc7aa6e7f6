// The grid container: building from cells, splitting, and the check that the leaves tile the roots.
//
// The leaves of one root, in Morton order, cover its finest-lattice keys 0 .. 8^finest_level one
// after the other; every check is a walk along that sequence.
#include "hexwright/grid/grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

#include "grid/cells/morton.h"

namespace hexwright {

using namespace grids;

namespace {

constexpr std::int32_t kMaxRootCoord = 1 << 10;

std::string name_of(int level, const LatticeCoord& index) {
  return fmt::format("cell (level {}, index {} {} {})", level, index[0], index[1], index[2]);
}

LatticeCoord index_of(const Grid& grid, const GridCell& cell) {
  const int shift = grid.finest_level - cell.level;
  return {cell.corner[0] >> shift, cell.corner[1] >> shift, cell.corner[2] >> shift};
}

std::string name_of(const Grid& grid, const GridCell& cell) {
  return name_of(cell.level, index_of(grid, cell));
}

/// Position of a finest-lattice point in the order of leaves: root number and key inside it.
struct TilingPosition {
  std::size_t root = 0;
  MortonKey key = 0;
  friend bool operator==(const TilingPosition&, const TilingPosition&) = default;
  friend auto operator<=>(const TilingPosition&, const TilingPosition&) = default;
};

constexpr std::size_t kNoRoot = std::numeric_limits<std::size_t>::max();

TilingPosition position_of(const std::vector<LatticeCoord>& roots, const LatticeCoord& corner,
                           int finest_level) {
  const LatticeCoord root = {corner[0] >> finest_level, corner[1] >> finest_level,
                             corner[2] >> finest_level};
  const auto found = std::lower_bound(roots.begin(), roots.end(), root, root_less);
  if (found == roots.end() || !is_same_coord(*found, root)) return {kNoRoot, 0};
  const std::int32_t mask = (1 << finest_level) - 1;
  return {static_cast<std::size_t>(found - roots.begin()),
          morton_encode(corner[0] & mask, corner[1] & mask, corner[2] & mask)};
}

/// The cell of the finest lattice at a position, as text.
std::string name_of_gap(const Grid& grid, const TilingPosition& at) {
  const LatticeCoord& root = grid.roots[at.root];
  LatticeCoord index = morton_decode(at.key);
  for (int a = 0; a < 3; ++a) index[a] += root[a] * (1 << grid.finest_level);
  return name_of(grid.finest_level, index);
}

std::optional<Issue> find_root_problem(const std::vector<LatticeCoord>& roots) {
  if (roots.empty()) return Issue{"the grid has no root cube"};
  for (std::size_t r = 0; r < roots.size(); ++r) {
    const LatticeCoord& q = roots[r];
    for (int a = 0; a < 3; ++a)
      if (q[a] < -kMaxRootCoord || q[a] >= kMaxRootCoord)
        return Issue{fmt::format("root ({} {} {}) lies outside -{} .. {}", q[0], q[1], q[2],
                                 kMaxRootCoord, kMaxRootCoord - 1)};
    if (r > 0 && !root_less(roots[r - 1], q))
      return Issue{
          fmt::format("root ({} {} {}) is repeated or out of (z, y, x) order", q[0], q[1], q[2])};
  }
  return std::nullopt;
}

/// Whether the level exists and the corner is a multiple of the cell's size.
bool is_on_own_lattice(const Grid& grid, const GridCell& cell) {
  if (cell.level < 0 || cell.level > grid.finest_level) return false;
  const std::int32_t mask = (1 << (grid.finest_level - cell.level)) - 1;
  return ((cell.corner[0] | cell.corner[1] | cell.corner[2]) & mask) == 0;
}

std::optional<Issue> find_cell_problem(const Grid& grid, const GridCell& cell) {
  if (cell.level < 0 || cell.level > grid.finest_level)
    return Issue{fmt::format("a cell at finest-lattice corner {} {} {} has level {}, outside 0..{}",
                             cell.corner[0], cell.corner[1], cell.corner[2], int(cell.level),
                             grid.finest_level)};
  if (!is_on_own_lattice(grid, cell))
    return Issue{fmt::format("{}: its corner {} {} {} is not on the lattice of its level",
                             name_of(grid, cell), cell.corner[0], cell.corner[1], cell.corner[2])};
  return std::nullopt;
}

/// Checks one cell against the position where the one before it ended.
std::optional<Issue> find_step_problem(const Grid& grid, const GridCell& cell,
                                       const TilingPosition& expected) {
  if (auto issue = find_cell_problem(grid, cell)) return issue;
  const TilingPosition at = position_of(grid.roots, cell.corner, grid.finest_level);
  if (at.root == kNoRoot)
    return Issue{fmt::format("{} lies outside the root cubes", name_of(grid, cell))};
  if (at < expected)
    return Issue{
        fmt::format("{} overlaps an earlier cell or is out of order", name_of(grid, cell))};
  if (at != expected)
    return Issue{fmt::format("{}: no cell covers {} before it", name_of(grid, cell),
                             name_of_gap(grid, expected))};
  return std::nullopt;
}

/// The corner at which the next leaf must begin, found from the leaf before it by carrying bits
/// instead of computing Morton keys, which takes half the time.
class LeafWalk {
 public:
  /// Before the first leaf.
  explicit LeafWalk(const Grid& grid) : grid_(&grid) { enter_root(0); }
  /// After a leaf that lies in the given root.
  LeafWalk(const Grid& grid, const GridCell& leaf, std::size_t root) : grid_(&grid), root_(root) {
    pass(leaf);
  }

  bool is_at(const LatticeCoord& corner) const {
    return root_ < grid_->roots.size() && is_same_coord(corner, corner_);
  }
  TilingPosition position() const {
    return root_ < grid_->roots.size() ? position_of(grid_->roots, corner_, grid_->finest_level)
                                       : TilingPosition{root_, 0};
  }

  /// Steps over a sound leaf. Inside its root the leaf's key is the number whose octal digits are
  /// the child numbers from the root down; adding one at the leaf's own digit carries over the
  /// digits 7, where all three coordinates have a one.
  void pass(const GridCell& leaf) {
    const int own = grid_->finest_level - leaf.level;
    LatticeCoord at = leaf.corner;
    const auto sevens = static_cast<std::uint32_t>(at[0] & at[1] & at[2]) >> own;
    const int digit = own + std::countr_one(sevens);
    if (digit >= grid_->finest_level) return enter_root(root_ + 1);
    const std::int32_t one = std::int32_t{1} << digit;
    for (std::int32_t& x : at) x &= ~(one - 1);
    at[2] ^= at[0] & at[1] & one;
    at[1] ^= at[0] & one;
    at[0] ^= one;
    corner_ = at;
  }

 private:
  void enter_root(std::size_t root) {
    root_ = root;
    if (root == grid_->roots.size()) return;
    for (int a = 0; a < 3; ++a)
      corner_[a] = grid_->roots[root][a] * (std::int32_t{1} << grid_->finest_level);
  }

  const Grid* grid_;
  std::size_t root_ = 0;
  LatticeCoord corner_ = {0, 0, 0};
};

/// First problem among the cells [begin, end), which follow a cell already known to be sound.
std::optional<Issue> find_chunk_problem(const Grid& grid, std::size_t begin, std::size_t end) {
  const std::vector<GridCell>& cells = grid.cells.raw();
  LeafWalk expected(grid);
  if (begin > 0) {
    const GridCell& last = cells[begin - 1];
    if (find_cell_problem(grid, last)) return std::nullopt;  // the chunk before reports it
    const TilingPosition at = position_of(grid.roots, last.corner, grid.finest_level);
    if (at.root == kNoRoot) return std::nullopt;
    expected = LeafWalk(grid, last, at.root);
  }
  for (std::size_t i = begin; i < end; ++i) {
    if (!expected.is_at(cells[i].corner) || !is_on_own_lattice(grid, cells[i]))
      return find_step_problem(grid, cells[i], expected.position());
    expected.pass(cells[i]);
  }
  if (end < cells.size() || expected.position().root == grid.roots.size()) return std::nullopt;
  return Issue{fmt::format("no cell covers {}", name_of_gap(grid, expected.position()))};
}

std::optional<Issue> find_tiling_problem(const Grid& grid) {
  if (grid.cells.empty()) return Issue{"the grid has no cells"};
  constexpr std::size_t kCellsPerChunk = 1 << 16;
  const auto first = parallel_reduce(
      grid.num_cells(), std::optional<Issue>(),
      [&](std::size_t begin, std::size_t end) { return find_chunk_problem(grid, begin, end); },
      [](const auto& a, const auto& b) { return a ? a : b; }, kCellsPerChunk);
  if (first) return first;
  const int deepest = parallel_reduce(
      grid.num_cells(), 0,
      [&](std::size_t begin, std::size_t end) {
        int level = 0;
        for (std::size_t i = begin; i < end; ++i)
          level = std::max<int>(level, grid.cells.raw()[i].level);
        return level;
      },
      [](int a, int b) { return std::max(a, b); }, kCellsPerChunk);
  if (deepest != grid.finest_level)
    return Issue{fmt::format("finest_level is {} but the deepest cell has level {}",
                             grid.finest_level, deepest)};
  return std::nullopt;
}

void check_specs(const std::vector<LatticeCoord>& roots, const std::vector<CellSpec>& cells) {
  for (const CellSpec& spec : cells) {
    if (spec.level < 0 || spec.level > kMaxGridLevel)
      throw Error(ErrorCode::BadFile, fmt::format("its level must be within 0..{}", kMaxGridLevel),
                  name_of(spec.level, spec.index));
    if (position_of(roots, spec.index, spec.level).root == kNoRoot)
      throw Error(ErrorCode::BadFile,
                  "it lies outside the root cubes; list its root cube or remove it",
                  name_of(spec.level, spec.index));
  }
}

/// Puts the cells into the order of leaves.
void sort_cells(Grid& grid) {
  struct Entry {
    TilingPosition at;
    GridCell cell;
  };
  std::vector<Entry> entries(grid.num_cells());
  parallel_for(entries.size(), [&](std::size_t i) {
    const GridCell& cell = grid.cells.raw()[i];
    entries[i] = {position_of(grid.roots, cell.corner, grid.finest_level), cell};
  });
  parallel_stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.at != b.at ? a.at < b.at : a.cell.level < b.cell.level;
  });
  for (std::size_t i = 0; i < entries.size(); ++i) grid.cells.raw()[i] = entries[i].cell;
}

}  // namespace

std::optional<Issue> Grid::find_problem() const {
  if (!is_finite(frame.origin) || !std::isfinite(frame.root_size) || frame.root_size <= 0)
    return Issue{"the frame's origin must be finite and its root size positive"};
  for (int a = 0; a < 3; ++a)
    if (!(frame.stretch[a] > 0 && frame.stretch[a] <= 1))
      return Issue{"the frame's stretch must be above 0, at most 1"};
  if (finest_level < 0 || finest_level > kMaxGridLevel)
    return Issue{fmt::format("finest_level {} is outside 0..{}", finest_level, kMaxGridLevel)};
  if (auto issue = find_root_problem(roots)) return issue;
  return find_tiling_problem(*this);
}

Grid make_root_grid(const GridFrame& frame) {
  Grid grid;
  grid.frame = frame;
  grid.roots = {{0, 0, 0}};
  grid.cells.push_back({});
  return grid;
}

Grid make_grid(const GridFrame& frame, std::vector<LatticeCoord> roots,
               const std::vector<CellSpec>& cells) {
  Grid grid;
  grid.frame = frame;
  grid.roots = std::move(roots);
  std::sort(grid.roots.begin(), grid.roots.end(), root_less);
  if (const auto issue = find_root_problem(grid.roots))
    throw Error(ErrorCode::BadFile, issue->message);
  check_specs(grid.roots, cells);
  for (const CellSpec& spec : cells) grid.finest_level = std::max(grid.finest_level, spec.level);
  grid.cells.resize(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::int32_t size = 1 << (grid.finest_level - cells[i].level);
    const LatticeCoord& q = cells[i].index;
    grid.cells.raw()[i].corner = {q[0] * size, q[1] * size, q[2] * size};
    grid.cells.raw()[i].level = static_cast<std::int8_t>(cells[i].level);
  }
  sort_cells(grid);
  if (const auto issue = grid.find_problem()) throw Error(ErrorCode::BadFile, issue->message);
  return grid;
}

Grid split_cells(const Grid& grid, const std::vector<char>& is_marked) {
  if (is_marked.size() != grid.num_cells())
    throw Error(ErrorCode::BadArgument, fmt::format("split_cells: {} marks for {} cells",
                                                    is_marked.size(), grid.num_cells()));
  Grid out;
  out.frame = grid.frame;
  out.roots = grid.roots;
  out.finest_level = grid.finest_level;
  std::size_t num_marked = 0;
  for (const CellId c : grid.cells.ids())
    if (is_marked[c.index()]) {
      ++num_marked;
      out.finest_level = std::max(out.finest_level, grid.cells[c].level + 1);
    }
  if (out.finest_level > kMaxGridLevel)
    throw Error(ErrorCode::OutOfResources,
                fmt::format("split_cells: cells would exceed level {}", kMaxGridLevel));
  const std::int32_t scale = 1 << (out.finest_level - grid.finest_level);
  out.cells.reserve(grid.num_cells() + 7 * num_marked);
  for (const CellId c : grid.cells.ids()) {
    GridCell cell = grid.cells[c];
    for (std::int32_t& x : cell.corner) x *= scale;
    if (!is_marked[c.index()]) {
      out.cells.push_back(cell);
      continue;
    }
    ++cell.level;
    const std::int32_t half = 1 << (out.finest_level - cell.level);
    for (int child = 0; child < 8; ++child) {
      GridCell sub = cell;
      for (int a = 0; a < 3; ++a) sub.corner[a] += (child >> a & 1) * half;
      out.cells.push_back(sub);
    }
  }
  return out;
}

std::vector<std::size_t> count_cells_per_level(const Grid& grid) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(grid.finest_level) + 1, 0);
  for (const GridCell& cell : grid.cells) ++counts[static_cast<std::size_t>(cell.level)];
  return counts;
}

}  // namespace hexwright
