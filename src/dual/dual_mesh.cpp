// Driver of the dual stage: core planes, base mesh, pillows, positions.
#include "hexwright/dual/dual_mesh.h"

#include "hexwright/base/parallel.h"

#include "dual/base_mesh.h"
#include "dual/core_planes.h"
#include "dual/crossed_cells.h"
#include "dual/optimize.h"
#include "dual/pillow_stack.h"
#include "dual/positions.h"
#include "dual/quality_of_hex.h"

namespace hexwright {

namespace {

using namespace dual;

void reject_unpaired(std::size_t depth, std::size_t num_partners) {
  throw Error(ErrorCode::BadArgument,
              "the grid is not paired at depth " + std::to_string(depth) + ": " +
                  std::to_string(num_partners) +
                  " cells are missing from its 2x2x2 blocks; run complete() with pairing blocks "
                  "or octree first, or use the mode sheets");
}

// From the coarsest depth on, as cells split here are parents at the next one.
void choose_all_core_planes(std::vector<SplitNodes>& split, const Domain& domain, DualMode mode) {
  constexpr int kMaxRounds = 10;
  for (std::size_t depth = 0; depth < split.size(); ++depth) {
    const int d = static_cast<int>(depth);
    auto report = choose_core_planes(split[depth], d, domain);
    if (mode == DualMode::Blocks && report.num_partners > 0)
      reject_unpaired(depth, report.num_partners);
    const SplitNodes* above = depth > 0 ? &split[depth - 1] : nullptr;
    for (int round = 0; round < kMaxRounds && report.num_partners > 0; ++round) {
      if (split_crossed_cells(split[depth], above, d, domain) == 0) break;
      report = choose_core_planes(split[depth], d, domain);
    }
  }
}

// The same cells over roots of half the edge; root cubes that are leaves are split.
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
  return make_grid({grid.frame.origin, grid.frame.root_size / 2}, roots, cells);
}

BaseStatus build_complex(const Grid& grid, const DualOptions& options, const Context& context,
                         HexComplex& complex) {
  const Domain domain(grid);
  auto split = collect_split_nodes(grid);
  choose_all_core_planes(split, domain, options.mode);
  complex = {};
  complex.reserve(2 * grid.num_cells());
  const BaseStatus status = build_base_mesh(domain, complex);
  if (status == BaseStatus::Ok) PillowStack(complex, domain, split).run(context);
  return status;
}

// Domains one root thick are meshed on the lattice of half their roots: there a root can meet the
// boundary around two of its corners, and the pillows of a split root could not tell them apart.
// Boxes have no such corners at any thickness.
HexComplex build_complex_of_any(const Grid& grid, const DualOptions& options,
                                const Context& context, Grid& used_grid) {
  if (grid.roots.empty()) throw Error(ErrorCode::BadGeometry, "the grid has no root cubes");
  HexComplex complex;
  used_grid = grid;
  const Domain domain(grid);
  const bool is_refined_and_thin = grid.finest_level > 0 && !domain.is_box() && domain.is_thin();
  if (!is_refined_and_thin && build_complex(grid, options, context, complex) == BaseStatus::Ok)
    return complex;
  used_grid = split_roots(grid);
  if (build_complex(used_grid, options, context, complex) == BaseStatus::TooThin)
    throw Error(ErrorCode::BadGeometry, "the domain's boundary is not a manifold");
  return complex;
}

// Half cells at the border have a face on it. What is left ends at cell centres, which stay.
void drop_border_hexes(const HexComplex& complex, HexMesh& mesh, VertToHex& vert_to_hex,
                       FixedAxes& fixed_axes) {
  IdVector<HexId, std::array<VertId, 8>> kept;
  std::vector<char> is_dropped_vert(mesh.num_verts(), 0);
  for (HexId h : mesh.hexes.ids()) {
    bool is_border = false;
    for (const FaceLink& link : complex.links[h]) is_border |= link.is_plane();
    if (!is_border) kept.push_back(mesh.hexes[h]);
    for (VertId v : mesh.hexes[h]) is_dropped_vert[v.index()] |= static_cast<char>(is_border);
  }
  mesh.hexes = std::move(kept);
  std::vector<char> is_used(mesh.num_verts(), 0);
  for (const auto& hex : mesh.hexes)
    for (VertId v : hex) is_used[v.index()] = 1;
  fixed_axes.clear();
  for (std::size_t v = 0; v < is_used.size(); ++v)
    if (is_used[v]) fixed_axes.push_back(is_dropped_vert[v] ? 7 : 0);
  remove_unused_verts(mesh);
  vert_to_hex = VertToHex(mesh);
}

void to_world(const Grid& grid, HexMesh& mesh) {
  const double unit = grid.frame.root_size / static_cast<double>(1 << grid.finest_level);
  parallel_for(mesh.num_verts(), [&](std::size_t v) {
    Vec3& p = mesh.positions[VertId(v)];
    p = grid.frame.origin + p * unit;
  });
}

}  // namespace

DualResult build_dual(const Grid& grid, const DualOptions& options, const Context& context) {
  DualResult result;
  HexMesh& mesh = result.mesh;
  Grid used_grid;
  VertToHex vert_to_hex;
  FixedAxes fixed_axes;
  {
    HexComplex complex = build_complex_of_any(grid, options, context, used_grid);
    for (const HexPlace& p : complex.places) result.report.num_cap_hexes += !p.is_lattice();
    mesh.positions.resize(static_cast<std::size_t>(complex.num_verts));
    mesh.hexes = std::move(complex.verts);
    vert_to_hex = VertToHex(mesh);
    fixed_axes = place_verts(Domain(used_grid), complex, vert_to_hex, mesh);
    if (options.inset) drop_border_hexes(complex, mesh, vert_to_hex, fixed_axes);
  }
  const MeshQuality raw = measure_quality(mesh);
  if (options.optimize) optimize_positions(mesh, vert_to_hex, fixed_axes, context);
  const MeshQuality final = options.optimize ? measure_quality(mesh) : raw;
  to_world(used_grid, mesh);
  result.report.num_hexes = mesh.num_hexes();
  result.report.num_inverted_raw = raw.num_inverted;
  result.report.min_scaled_jacobian_raw = raw.min;
  result.report.min_scaled_jacobian = final.min;
  result.report.avg_scaled_jacobian = final.avg;
  return result;
}

}  // namespace hexwright
