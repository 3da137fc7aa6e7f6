// Driver of the dual stage: topology, positions, optimisation.
#include "hexwright/dual/dual_mesh.h"

#include "hexwright/base/parallel.h"

#include "dual/build_complex.h"
#include "dual/complex/positions.h"
#include "dual/optimize.h"
#include "dual/quality_of_hex.h"

namespace hexwright {

namespace {

using namespace dual;

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
    const Vec3& stretch = grid.frame.stretch;
    p = grid.frame.origin +
        Vec3{p.x * unit * stretch.x, p.y * unit * stretch.y, p.z * unit * stretch.z};
  });
}

// The mesh over the grid's own roots, or over smaller ones where those carry none: `used_grid`.
DualResult build_once(const Grid& grid, const DualOptions& options, const Context& context,
                      Grid& used_grid) {
  DualResult result;
  HexMesh& mesh = result.mesh;
  VertToHex vert_to_hex;
  FixedAxes fixed_axes;
  {
    HexComplex complex = build_complex(grid, options.mode, context, used_grid);
    for (const HexPlace& p : complex.places) result.report.num_cap_hexes += !p.is_lattice();
    mesh.positions.resize(static_cast<std::size_t>(complex.num_verts));
    mesh.hexes = std::move(complex.verts);
    vert_to_hex = VertToHex(mesh);
    fixed_axes = place_verts(Domain(used_grid), complex, vert_to_hex, mesh);
    if (options.inset) drop_border_hexes(complex, mesh, vert_to_hex, fixed_axes);
  }
  const MeshQuality raw = measure_quality(mesh);
  if (options.optimize)
    result.report.num_freed_verts =
        optimize_positions(mesh, std::move(vert_to_hex), fixed_axes, context);
  const MeshQuality final = options.optimize ? measure_quality(mesh) : raw;
  to_world(used_grid, mesh);
  result.report.num_hexes = mesh.num_hexes();
  result.report.num_inverted_raw = raw.num_inverted;
  result.report.min_scaled_jacobian_raw = raw.min;
  result.report.min_scaled_jacobian = final.min;
  result.report.avg_scaled_jacobian = final.avg;
  return result;
}

}  // namespace

std::size_t count_dual_hexes(const Grid& grid, DualMode mode, const Context& context) {
  const auto watch = context.watch();
  Grid used_grid;
  return build_complex(grid, mode, context, used_grid).num_hexes();
}

// Twisted corners of the domain so close together that core planes cannot keep clear of all of them
// are the one case known that leaves inverted elements. Over roots of half the edge all corners
// have even coordinates, and one parity avoids them all.
DualResult build_dual(const Grid& grid, const DualOptions& options, const Context& context) {
  const auto watch = context.watch();
  Grid used_grid;
  DualResult result = build_once(grid, options, context, used_grid);
  for (int halvings = 0; options.optimize && result.report.min_scaled_jacobian <= 0 &&
                         halvings < grid.finest_level && !Domain(used_grid).is_box();
       ++halvings)
    result = build_once(split_roots(used_grid), options, context, used_grid);
  return result;
}

}  // namespace hexwright
