// Random adaptive grids over domains of several shapes, and plain (slow) readings of grids.
#pragma once

#include <random>
#include <set>
#include <vector>

#include "hexwright/grid/grid.h"

namespace hexwright::test {

using Roots = std::vector<LatticeCoord>;

/// Domains by name of their shape: one cube, a bar, an L, a ring, cubes touching at an edge or a
/// corner, and separate components.
inline const std::vector<Roots>& sample_domains() {
  static const std::vector<Roots> domains = {
      {{0, 0, 0}},
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
      {{-1, -1, 0},
       {0, -1, 0},
       {1, -1, 0},
       {-1, 0, 0},
       {1, 0, 0},
       {-1, 1, 0},
       {0, 1, 0},
       {1, 1, 0}},
      {{0, 0, 0}, {1, 1, 0}},
      {{0, 0, 0}, {1, 1, 1}},
      {{-3, 0, 5}, {0, 0, 0}, {0, 0, 1}},
  };
  return domains;
}

inline Grid unsplit_grid(const Roots& roots) {
  std::vector<CellSpec> specs;
  for (const LatticeCoord& root : roots) specs.push_back({0, root});
  return make_grid({}, roots, specs);
}

/// Splits random leaves `rounds` times, preferably the deepest ones, so that levels jump.
inline Grid random_grid(std::mt19937& rng, const Roots& roots, int rounds, double share = 0.2) {
  Grid grid = unsplit_grid(roots);
  std::uniform_real_distribution<> uniform(0, 1);
  for (int k = 0; k < rounds; ++k) {
    std::vector<char> marks(grid.num_cells(), 0);
    for (const CellId c : grid.cells.ids())
      marks[c.index()] = uniform(rng) < (grid.cells[c].level == k ? share : share / 8);
    marks[rng() % marks.size()] = 1;
    grid = split_cells(grid, marks);
  }
  return grid;
}

inline std::vector<CellSpec> specs_of(const Grid& grid) {
  std::vector<CellSpec> specs;
  for (const GridCell& cell : grid.cells) {
    const int shift = grid.finest_level - cell.level;
    specs.push_back(
        {cell.level, {cell.corner[0] >> shift, cell.corner[1] >> shift, cell.corner[2] >> shift}});
  }
  return specs;
}

/// Per depth: the split nodes, on their own depth's lattice.
using PlainSets = std::vector<std::set<LatticeCoord>>;

inline PlainSets plain_split_sets(const Grid& grid) {
  PlainSets sets(static_cast<std::size_t>(grid.finest_level));
  for (CellSpec spec : specs_of(grid))
    while (spec.level > 0) {
      --spec.level;
      for (std::int32_t& x : spec.index) x >>= 1;
      if (!sets[static_cast<std::size_t>(spec.level)].insert(spec.index).second) break;
    }
  return sets;
}

/// The grid with these split nodes; ancestors must be split too.
inline Grid grid_of_plain_sets(const Roots& roots, const PlainSets& sets) {
  Grid grid = unsplit_grid(roots);
  for (std::size_t d = 0; d < sets.size(); ++d) {
    std::vector<char> marks;
    for (const CellSpec& spec : specs_of(grid))
      marks.push_back(spec.level == static_cast<int>(d) && sets[d].count(spec.index) != 0);
    grid = split_cells(grid, marks);
  }
  return grid;
}

}  // namespace hexwright::test
