// Driver of the dual stage: core planes, base mesh, pillows, positions.
#include "hexwright/dual/dual_mesh.h"

#include "dual/base_mesh.h"
#include "dual/core_planes.h"
#include "dual/pillow_stack.h"
#include "dual/positions.h"
#include "dual/quality_of_hex.h"

namespace hexwright {

namespace {

using namespace dual;

void choose_all_core_planes(std::vector<SplitNodes>& split, const Domain& domain, DualMode mode) {
  for (std::size_t depth = 0; depth < split.size(); ++depth) {
    const auto report = choose_core_planes(split[depth], static_cast<int>(depth), domain);
    if (mode == DualMode::Blocks && report.num_partners > 0)
      throw Error(ErrorCode::BadArgument,
                  "the grid is not paired at depth " + std::to_string(depth) + ": " +
                      std::to_string(report.num_partners) +
                      " cells are missing from its 2x2x2 blocks; run complete() with pairing "
                      "blocks or octree first, or use the mode sheets");
  }
}

HexComplex build_complex(const Grid& grid, const DualOptions& options, const Context& context) {
  if (grid.roots.empty()) throw Error(ErrorCode::BadGeometry, "the grid has no root cubes");
  const Domain domain(grid);
  auto split = collect_split_nodes(grid);
  choose_all_core_planes(split, domain, options.mode);
  HexComplex complex;
  complex.reserve(2 * grid.num_cells());
  build_base_mesh(domain, complex);
  PillowStack(complex, domain, split).run(context);
  return complex;
}

void measure_raw(const HexMesh& mesh, DualReport& report) {
  const auto quality = measure_quality(mesh);
  report.num_inverted_raw = quality.num_inverted;
  report.min_scaled_jacobian_raw = report.min_scaled_jacobian = quality.min;
  report.avg_scaled_jacobian = quality.avg;
}

}  // namespace

DualResult build_dual(const Grid& grid, const DualOptions& options, const Context& context) {
  HexComplex complex = build_complex(grid, options, context);
  DualResult result;
  HexMesh& mesh = result.mesh;
  for (const HexPlace& place : complex.places) result.report.num_cap_hexes += !place.is_lattice();
  result.report.num_hexes = complex.num_hexes();
  mesh.positions = compute_positions(complex);
  mesh.hexes = std::move(complex.verts);

  measure_raw(mesh, result.report);
  const double unit = grid.frame.root_size / static_cast<double>(1 << grid.finest_level);
  for (Vec3& p : mesh.positions) p = grid.frame.origin + p * unit;
  return result;
}

}  // namespace hexwright
