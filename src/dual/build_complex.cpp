// The topology of the dual mesh: core planes, base mesh, pillows.
#include "dual/build_complex.h"

#include <algorithm>
#include <cmath>

#include "dual/complex/base_mesh.h"
#include "dual/complex/double_links.h"
#include "dual/domain/core_planes.h"
#include "dual/domain/crossed_cells.h"
#include "dual/pillows/pillow_stack.h"

namespace hexwright::dual {

namespace {

void reject_unpaired(std::size_t depth, std::size_t num_partners) {
  throw Error(ErrorCode::BadArgument,
              "the grid is not paired at depth " + std::to_string(depth) + ": " +
                  std::to_string(num_partners) +
                  " cells are missing from its 2x2x2 blocks; run complete() with pairing blocks "
                  "or octree first, or use the mode sheets");
}

// From the coarsest depth on, as cells split here are parents at the next one. Core planes keep
// clear of twisted corners, in blocks mode too: caps of several depths that start there cannot be
// untangled, while around a corner in the middle of a node's siblings the mesh is a regular one.
void choose_all_core_planes(std::vector<SplitNodes>& split, const Domain& domain, DualMode mode) {
  constexpr int kMaxRounds = 10;
  const auto twisted = domain.find_chiral_corners();
  for (std::size_t depth = 0; depth < split.size(); ++depth) {
    const int d = static_cast<int>(depth);
    auto report = choose_core_planes(split[depth], d, domain, {});
    if (mode == DualMode::Blocks && report.num_partners > 0)
      reject_unpaired(depth, report.num_partners);
    if (!twisted.empty()) report = choose_core_planes(split[depth], d, domain, twisted);
    const SplitNodes* above = depth > 0 ? &split[depth - 1] : nullptr;
    for (int round = 0; round < kMaxRounds && report.num_partners > 0; ++round) {
      if (split_crossed_cells(split[depth], above, d, domain) == 0) break;
      report = choose_core_planes(split[depth], d, domain, twisted);
    }
  }
}

BaseStatus stack_pillows(const Domain& domain, const std::vector<SplitNodes>& split,
                         const Context& context, HexComplex& complex) {
  const std::size_t capacity = complex.verts.raw().capacity();
  complex = {};
  complex.reserve(capacity);
  const BaseStatus status = build_base_mesh(domain, complex);
  if (status == BaseStatus::Ok) PillowStack(complex, domain, split).run(context);
  return status;
}

// Splits the leaf that holds the point; false when it is one of the finest.
bool split_leaf_at(const Vec3& point, std::vector<SplitNodes>& split, const Domain& domain) {
  for (std::size_t depth = 0; depth < split.size(); ++depth) {
    const double edge = domain.root_edge() >> depth;
    LatticeCoord node;
    for (int a = 0; a < 3; ++a) node[a] = static_cast<std::int32_t>(std::floor(point[a] / edge));
    if (split[depth].contains(node)) continue;
    if (!domain.contains_node(node, static_cast<int>(depth))) return false;
    split[depth].insert(node);
    return true;
  }
  return false;
}

// These vertices and all others of their hexes, in order.
std::vector<VertId> with_neighbors(const HexComplex& complex, const std::vector<VertId>& verts) {
  std::vector<VertId> all;
  for (const auto& hex : complex.verts)
    for (VertId v : hex)
      if (std::binary_search(verts.begin(), verts.end(), v))
        all.insert(all.end(), hex.begin(), hex.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// What to do about quads that share two edges.
enum class Repair { NotNeeded, Split, Impossible };

// Splits the leaves in which they lie or, where those are of the finest level, the leaves around
// them.
Repair repair(const HexComplex& complex, const Domain& domain, std::vector<SplitNodes>& split) {
  const auto doubled = find_double_links(complex);
  if (doubled.empty()) return Repair::NotNeeded;
  const auto split_at = [&](const std::vector<VertId>& verts) {
    bool has_split = false;
    for (const Vec3& point : mean_places(complex, verts))
      has_split |= split_leaf_at(point, split, domain);
    return has_split;
  };
  const bool has_split = split_at(doubled) || split_at(with_neighbors(complex, doubled));
  return has_split ? Repair::Split : Repair::Impossible;
}

// Paired grids of boxes never need a repair; in sheets mode one random grid in a thousand does.
// False when these roots cannot carry a valid mesh.
bool try_build(const Grid& grid, DualMode mode, const Context& context, HexComplex& complex) {
  constexpr int kMaxRepairs = 20;
  const Domain domain(grid);
  auto split = collect_split_nodes(grid);
  complex.reserve(2 * grid.num_cells());
  choose_all_core_planes(split, domain, mode);
  for (int round = 0; round < kMaxRepairs; ++round) {
    if (stack_pillows(domain, split, context, complex) != BaseStatus::Ok) return false;
    if (mode == DualMode::Blocks && domain.is_box()) return true;
    const Repair result = repair(complex, domain, split);
    if (result != Repair::Split) return result == Repair::NotNeeded;
    choose_all_core_planes(split, domain, DualMode::Sheets);
  }
  return false;
}

}  // namespace

Grid split_roots(const Grid& grid) {
  std::vector<char> is_root_leaf(grid.num_cells());
  for (CellId c : grid.cells.ids()) is_root_leaf[c.index()] = grid.cells[c].level == 0;
  const Grid split = split_cells(grid, is_root_leaf);
  std::vector<LatticeCoord> roots;
  for (const LatticeCoord& r : split.roots)
    for (int q = 0; q < 8; ++q)
      roots.push_back({2 * r[0] + (q & 1), 2 * r[1] + (q >> 1 & 1), 2 * r[2] + (q >> 2)});
  std::vector<CellSpec> cells;
  for (CellId c : split.cells.ids()) {
    CellSpec cell{split.cells[c].level - 1, split.cells[c].corner};
    for (auto& x : cell.index) x /= split.cell_size(c);
    cells.push_back(cell);
  }
  return make_grid({grid.frame.origin, grid.frame.root_size / 2, grid.frame.stretch}, roots, cells);
}

// Domains one root thick, and the rare refined corners that nothing else repairs, are meshed on the
// lattice of half their roots; on the finest lattice at last, which always works.
HexComplex build_complex(const Grid& grid, DualMode mode, const Context& context, Grid& used_grid) {
  if (grid.roots.empty()) throw Error(ErrorCode::BadGeometry, "the grid has no root cubes");
  HexComplex complex;
  const Domain domain(grid);
  // The base mesh of a refined thin domain may exist and yet lack hexes that its pillows need.
  const bool is_refined_and_thin = grid.finest_level > 0 && !domain.is_box() && domain.is_thin();
  used_grid = is_refined_and_thin ? split_roots(grid) : grid;
  for (int halvings = 0; !try_build(used_grid, mode, context, complex); ++halvings) {
    if (halvings > grid.finest_level)
      throw Error(ErrorCode::BadGeometry, "the domain's boundary is not a manifold");
    used_grid = split_roots(used_grid);
  }
  return complex;
}

}  // namespace hexwright::dual
