// Passes: fill, keep, repair, drop crumbs, count. See docs/algorithms/fit.md, "Carve".
#include "hexwright/fit/carve.h"

#include <algorithm>

#include "hexwright/mesh/hex_adjacency.h"

#include "fit/carve_classify.h"
#include "fit/carve_repair.h"

namespace hexwright {
namespace {

using fitting::HexFilling;

// Drops face-connected components of the set with less than `share` of the largest one's volume;
// returns how many remain.
std::size_t drop_small_components(const HexMesh& mesh, const HexNeighbors& neighbors,
                                  const HexFilling& filling, double share,
                                  std::vector<char>& is_kept) {
  std::vector<int> component(mesh.num_hexes(), -1);
  std::vector<double> volume;
  std::vector<HexId> stack;
  for (HexId seed : mesh.hexes.ids()) {
    if (!is_kept[seed.index()] || component[seed.index()] >= 0) continue;
    const int c = static_cast<int>(volume.size());
    volume.push_back(0);
    component[seed.index()] = c;
    stack.push_back(seed);
    while (!stack.empty()) {
      const HexId h = stack.back();
      stack.pop_back();
      const double e = filling.edge[h];
      volume.back() += e * e * e;
      for (HexId other : neighbors.neighbor[h]) {
        if (!other.is_valid() || !is_kept[other.index()] || component[other.index()] >= 0) continue;
        component[other.index()] = c;
        stack.push_back(other);
      }
    }
  }
  if (volume.empty()) return 0;
  const double least = share * *std::max_element(volume.begin(), volume.end());
  for (std::size_t h = 0; h < is_kept.size(); ++h)
    if (is_kept[h] && volume[static_cast<std::size_t>(component[h])] < least) is_kept[h] = 0;
  return static_cast<std::size_t>(
      std::count_if(volume.begin(), volume.end(), [&](double x) { return x >= least; }));
}

// V - E + F of the kept set's boundary; on a manifold quad mesh E = 2 F.
long boundary_euler_characteristic(const HexMesh& mesh, const HexNeighbors& neighbors,
                                   const std::vector<char>& is_kept) {
  IdVector<VertId, char> on_boundary(mesh.num_verts(), 0);
  long num_quads = 0;
  for (HexId h : mesh.hexes.ids()) {
    if (!is_kept[h.index()]) continue;
    for (int lf = 0; lf < 6; ++lf) {
      const HexId other = neighbors.neighbor[h][static_cast<std::size_t>(lf)];
      if (other.is_valid() && is_kept[other.index()]) continue;
      ++num_quads;
      for (VertId v : face_verts(mesh, {h, lf})) on_boundary[v] = 1;
    }
  }
  return std::count(on_boundary.begin(), on_boundary.end(), 1) - num_quads;
}

// A hex with the surface near its centre but no boundary of the kept set at any vertex: the part or
// gap there is thinner than the grid.
std::vector<Vec3> find_lost_places(const HexMesh& mesh, const HexFilling& filling,
                                   const std::vector<char>& is_kept) {
  IdVector<VertId, char> sides(mesh.num_verts(),
                               0);  // bit 0: a dropped hex here, bit 1: a kept one
  for (HexId h : mesh.hexes.ids())
    for (VertId v : mesh.hexes[h])
      sides[v] = static_cast<char>(sides[v] | (is_kept[h.index()] ? 2 : 1));
  std::vector<Vec3> lost;
  for (HexId h : mesh.hexes.ids()) {
    if (!filling.is_near[h]) continue;
    const auto& verts = mesh.hexes[h];
    const bool at_boundary =
        std::any_of(verts.begin(), verts.end(), [&](VertId v) { return sides[v] == 3; });
    if (!at_boundary) lost.push_back(filling.nearest[h]);
  }
  return lost;
}

void require_positive(double keep_fraction) {
  if (!(keep_fraction > 0 && keep_fraction < 1))
    throw Error(ErrorCode::BadArgument,
                "keep_fraction must lie between 0 and 1; the default is 0.5");
}

}  // namespace

CarveResult carve(const HexMesh& background, const SurfaceTree& surface,
                  const CarveOptions& options, const Context& context) {
  require_positive(options.keep_fraction);
  context.progress("carve", 0);
  const VertToHex vert_to_hex(background);
  const HexNeighbors neighbors = compute_hex_neighbors(background);
  const HexFilling filling = fitting::classify_hexes(background, vert_to_hex, neighbors, surface);
  context.check_cancelled();
  context.progress("carve", 0.5);

  CarveResult result;
  result.is_kept.resize(background.num_hexes());
  for (HexId h : background.hexes.ids())
    result.is_kept[h.index()] = filling.fraction[h] > options.keep_fraction;
  const auto repair = fitting::repair_set(background, vert_to_hex, neighbors, filling,
                                          options.visible_normal, result.is_kept);
  result.num_flips = repair.num_flips;
  result.num_bad_verts = repair.num_bad_verts;
  result.num_components = drop_small_components(background, neighbors, filling,
                                                options.min_component_share, result.is_kept);
  result.lost = find_lost_places(background, filling, result.is_kept);

  result.euler_characteristic =
      boundary_euler_characteristic(background, neighbors, result.is_kept);
  context.progress("carve", 1);
  return result;
}

HexMesh extract_hexes(const HexMesh& mesh, const std::vector<char>& is_kept) {
  HexMesh part;
  IdVector<VertId, VertId> old_to_new(mesh.num_verts());
  for (HexId h : mesh.hexes.ids()) {
    if (!is_kept[h.index()]) continue;
    auto hex = mesh.hexes[h];
    for (VertId& v : hex) {
      if (!old_to_new[v].is_valid()) old_to_new[v] = part.positions.push_back(mesh.positions[v]);
      v = old_to_new[v];
    }
    part.hexes.push_back(hex);
    if (!mesh.region.empty()) part.region.push_back(mesh.region[h]);
  }
  return part;
}

}  // namespace hexwright
