// Splits leaves that are too large, and keeps large leaves away from small ones.
#include "hexwright/grid/size_field.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "hexwright/base/cancel.h"
#include "hexwright/base/error.h"
#include "hexwright/base/function_ref.h"
#include "hexwright/base/parallel.h"

#include "grid/cells/morton.h"

namespace hexwright {

using namespace grids;

namespace {

/// Edges that were scaled to be equal may differ by rounding.
constexpr double kRounding = 1e-9;

double edge_of(const Grid& grid, CellId c) {
  return grid.frame.root_size / static_cast<double>(1 << grid.cells[c].level);
}

/// Marks the leaves to split, for as long as the grid keeps to `max_cells`: asking may be costly.
/// Returns how many are marked.
std::size_t mark_leaves(const Grid& grid, FunctionRef<bool(CellId)> is_marked,
                        std::size_t max_cells, std::vector<char>& marks) {
  constexpr std::size_t kChunk = 4096;
  std::size_t num_marked = 0;
  for (std::size_t begin = 0; begin < marks.size(); begin += kChunk) {
    check_cancelled();
    const std::size_t count = std::min(kChunk, marks.size() - begin);
    parallel_for(
        count,
        [&](std::size_t i) { marks[begin + i] = marks[begin + i] && is_marked(CellId(begin + i)); },
        64);
    const auto first = marks.begin() + static_cast<std::ptrdiff_t>(begin);
    num_marked +=
        static_cast<std::size_t>(std::count(first, first + static_cast<std::ptrdiff_t>(count), 1));
    const std::size_t num_cells = grid.num_cells() + 7 * num_marked;
    if (num_marked > 0 && num_cells > max_cells)
      throw Error(ErrorCode::OutOfResources,
                  fmt::format("the sizes asked for need more than {} cells, the budget is {}; ask "
                              "for larger cells or raise --max-hexes and --max-cells",
                              num_cells, max_cells));
  }
  return num_marked;
}

/// One flag per leaf of the grid after the marked ones were split: whether it is new.
std::vector<char> flag_new(const std::vector<char>& marks) {
  std::vector<char> is_new;
  for (char mark : marks) is_new.insert(is_new.end(), mark ? 8 : 1, mark);
  return is_new;
}

/// Splits cells for as long as there are some that `is_marked` takes. It is asked once for each
/// cell: bounds may be costly.
void split_while(Grid& grid, FunctionRef<bool(CellId)> is_marked, std::size_t max_cells) {
  std::vector<char> marks(grid.num_cells(), 1);
  while (mark_leaves(grid, is_marked, max_cells, marks) > 0) {
    grid = split_cells(grid, marks);
    marks = flag_new(marks);
  }
}

[[noreturn]] void refuse_size() {
  throw Error(ErrorCode::OutOfResources,
              "cells of the size asked for are too small for the surface's size; ask for larger "
              "cells");
}

void split_to_limits(Grid& grid, const SizeField& field, IsNeeded is_needed,
                     std::size_t max_cells) {
  if (field.limits.empty()) return;
  const auto is_too_large = [&](CellId c) {
    const int level = grid.cells[c].level;
    if (level >= field.deepest && field.deepest < kMaxGridLevel) return false;
    const Box3 box = cell_box(grid, c);
    const double edge = edge_of(grid, c);
    if (edge / 2 < field.least_edge * (1 - kRounding)) return false;
    if (edge <= field.limit(box) * (1 + kRounding) || !is_needed(box)) return false;
    if (level >= kMaxGridLevel) refuse_size();
    return true;
  };
  split_while(grid, is_too_large, max_cells);
}

/// Cells of one level's lattice, in order.
using CellSet = std::vector<LatticeCoord>;

void sort_unique(CellSet& cells) {
  parallel_stable_sort(cells.begin(), cells.end(), std::less<>());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
}

/// All cells within `reach` of the set along each axis.
CellSet dilate(CellSet cells, std::int32_t reach) {
  CancelCheck check_cancelled;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    CellSet wider;
    wider.reserve(cells.size() * static_cast<std::size_t>(2 * reach + 1));
    for (LatticeCoord c : cells) {
      check_cancelled();
      c[axis] -= reach;
      for (std::int32_t i = 0; i <= 2 * reach; ++i, ++c[axis]) wider.push_back(c);
    }
    sort_unique(wider);
    cells = std::move(wider);
  }
  return cells;
}

/// The level's lattice cells that leaves of this level and deeper ones lie in.
CellSet cells_as_deep(const Grid& grid, int level, IsNeeded is_needed) {
  const int shift = grid.finest_level - level;
  std::vector<char> counts(grid.num_cells(), 0);
  parallel_for(
      grid.num_cells(),
      [&](std::size_t i) {
        const CellId c(i);
        counts[i] = grid.cells[c].level >= level && is_needed(cell_box(grid, c));
      },
      64);
  CellSet cells;
  for (CellId c : grid.cells.ids()) {
    if (!counts[c.index()]) continue;
    const LatticeCoord& q = grid.cells[c].corner;
    cells.push_back({q[0] >> shift, q[1] >> shift, q[2] >> shift});
  }
  sort_unique(cells);
  return cells;
}

/// Whether the leaf holds a cell of the set, which lies on a finer lattice.
bool holds_any(const Grid& grid, CellId c, const CellSet& cells, int level) {
  const int shift = level - grid.cells[c].level;
  LatticeCoord low = grid.cells[c].corner;
  for (std::int32_t& x : low) x = (x >> (grid.finest_level - grid.cells[c].level)) * (1 << shift);
  const std::int32_t size = 1 << shift;
  for (std::int32_t i = 0; i < size; ++i)
    for (std::int32_t j = 0; j < size; ++j) {
      const LatticeCoord first = {low[0] + i, low[1] + j, low[2]};
      const auto at = std::lower_bound(cells.begin(), cells.end(), first);
      if (at != cells.end() && (*at)[0] == first[0] && (*at)[1] == first[1] &&
          (*at)[2] < low[2] + size)
        return true;
    }
  return false;
}

/// From the finest level up: cells near those of a level are of this level too.
void limit_growth(Grid& grid, const SizeField& field, IsNeeded is_needed, std::size_t max_cells) {
  if (!(field.growth > 1)) return;
  const auto reach = static_cast<std::int32_t>(std::ceil(1 / (field.growth - 1) - kRounding));
  for (int level = grid.finest_level; level > 0; --level) {
    const CellSet near = dilate(cells_as_deep(grid, level, is_needed), reach);
    const auto is_too_large = [&](CellId c) {
      return grid.cells[c].level < level && holds_any(grid, c, near, level) &&
             is_needed(cell_box(grid, c));
    };
    split_while(grid, is_too_large, max_cells);
  }
}

}  // namespace

double SizeField::limit(const Box3& cell) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Limit& limit : limits) least = std::min(least, limit(cell));
  return least;
}

double SizeField::least(const Box3& cell) const {
  if (!is_exact) return least_edge * (1 - kRounding);
  const double bound = limit(cell);
  const double by_bound = std::isfinite(bound) ? bound / 4 * (1 + kRounding) : 0;
  return std::max(least_edge * (1 - kRounding), by_bound);
}

bool may_split(const Grid& grid, CellId leaf, const SizeField& field) {
  return edge_of(grid, leaf) / 2 >= field.least(cell_box(grid, leaf));
}

Grid refine_to_sizes(Grid grid, const SizeField& field, IsNeeded is_needed, std::size_t max_cells) {
  split_to_limits(grid, field, is_needed, max_cells);
  limit_growth(grid, field, is_needed, max_cells);
  return grid;
}

}  // namespace hexwright
