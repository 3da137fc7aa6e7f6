// Based on: Barill et al., "Fast Winding Numbers for Soups and Clouds", 2018, for the sign.
// Differs: where the surface is closed and consistently oriented the winding number is constant off
// the surface, so points that the surface cannot separate share one evaluation.
#include "fit/carve/carve_classify.h"

#include <algorithm>

#include "hexwright/base/parallel.h"
#include "hexwright/geometry/surface_topology.h"

#include "base/disjoint_sets.h"

namespace hexwright::fitting {
namespace {

constexpr double kNearRadii = 1.5;  // farther centres (in hex radii) have the whole hex on one side

double filled(double signed_distance_in_edges) {
  return std::clamp(0.5 - signed_distance_in_edges, 0.0, 1.0);
}

struct Classifier {
  const HexMesh& mesh;
  const VertToHex& vert_to_hex;
  const HexNeighbors& neighbors;
  const SurfaceTree& surface;
  IdVector<HexId, double> radius, centre_distance;
  IdVector<HexId, char> touches;           // the surface is within kNearRadii of the centre
  IdVector<HexId, char> is_inside;         // of the centre
  IdVector<VertId, double> vert_distance;  // 0 where not needed; negative inside in the end
  HexFilling result;

  Vec3 centre(HexId h) const {
    Vec3 sum;
    for (const Vec3& p : mesh.corners(h)) sum += p;
    return sum / 8;
  }

  void measure_centres() {
    parallel_for(
        mesh.num_hexes(),
        [&](std::size_t i) {
          const HexId h(i);
          const Vec3 c = centre(h);
          for (const Vec3& p : mesh.corners(h)) radius[h] = std::max(radius[h], distance(p, c));
          result.edge[h] = radius[h] / 0.866;
          ClosestFilter filter;
          filter.max_distance = kNearRadii * radius[h];
          centre_distance[h] = filter.max_distance;
          const auto found = surface.closest(c, filter);
          if (!found) return;
          touches[h] = 1;
          centre_distance[h] = std::sqrt(found->distance_sq);
          result.nearest[h] = found->point;
          result.is_near[h] = centre_distance[h] < 0.5 * result.edge[h];
        },
        64);
  }

  // Unsigned distance of the vertices of hexes that the surface touches, cut off where it no longer
  // matters.
  void measure_verts() {
    parallel_for(
        mesh.num_verts(),
        [&](std::size_t i) {
          const VertId v(i);
          double reach = 0;
          for (const HexCorner& corner : vert_to_hex[v])
            if (touches[corner.hex]) reach = std::max(reach, result.edge[corner.hex]);
          if (reach == 0) return;
          ClosestFilter filter;
          filter.max_distance = reach;
          const auto found = surface.closest(mesh.positions[v], filter);
          vert_distance[v] = found ? std::sqrt(found->distance_sq) : reach;
        },
        64);
  }

  // Points are the hexes' centres, then the vertices. Two points share their sign when the surface
  // is too far from both to cross the segment between them.
  void unite_same_side(DisjointSets& sides) const {
    for (HexId h : mesh.hexes.ids()) {
      const Vec3 c = centre(h);
      for (VertId v : mesh.hexes[h]) {
        const double reach = centre_distance[h] + vert_distance[v];
        if (vert_distance[v] > 0 && reach > distance(c, mesh.positions[v]) * (1 + 1e-9))
          sides.unite(h.index(), mesh.num_hexes() + v.index());
      }
      if (touches[h]) continue;
      for (HexId other : neighbors.neighbor[h])
        if (other.is_valid() && !touches[other]) sides.unite(h.index(), other.index());
    }
  }

  // One winding number for each set of points known to be on one side. Where the surface is open
  // or badly oriented the number changes off the surface, too: then every point has its own.
  void sign_points() {
    const std::size_t num_hexes = mesh.num_hexes();
    DisjointSets sides(num_hexes + mesh.num_verts());
    if (is_oriented_cycle(surface.surface())) unite_same_side(sides);
    std::vector<std::size_t> side(num_hexes + mesh.num_verts());
    for (std::size_t i = 0; i < side.size(); ++i) side[i] = sides.find(i);
    std::vector<char> inside(side.size(), 0);
    parallel_for(
        side.size(),
        [&](std::size_t i) {
          if (side[i] != i) return;
          if (i < num_hexes) {
            inside[i] = surface.is_inside(centre(HexId(i)));
          } else if (vert_distance[VertId(i - num_hexes)] > 0) {
            inside[i] = surface.is_inside(mesh.positions[VertId(i - num_hexes)]);
          }
        },
        64);
    for (HexId h : mesh.hexes.ids()) is_inside[h] = inside[side[h.index()]];
    for (VertId v : mesh.positions.ids())
      if (inside[side[num_hexes + v.index()]]) vert_distance[v] = -vert_distance[v];
  }

  void fill() {
    parallel_for(mesh.num_hexes(), [&](std::size_t i) {
      const HexId h(i);
      const double sign = is_inside[h] ? -1 : 1;
      double f = filled(sign * centre_distance[h] / result.edge[h]);
      if (touches[h]) {
        double sum = 0;
        for (VertId v : mesh.hexes[h]) sum += filled(0.6 * vert_distance[v] / result.edge[h]);
        f = 0.5 * f + sum / 16;
      }
      result.fraction[h] = static_cast<float>(f);
    });
  }
};

}  // namespace

HexFilling classify_hexes(const HexMesh& mesh, const VertToHex& vert_to_hex,
                          const HexNeighbors& neighbors, const SurfaceTree& surface) {
  const std::size_t n = mesh.num_hexes();
  Classifier c{mesh, vert_to_hex, neighbors, surface, {}, {}, {}, {}, {}, {}};
  c.radius.assign(n, 0);
  c.centre_distance.assign(n, 0);
  c.touches.assign(n, 0);
  c.is_inside.assign(n, 0);
  c.vert_distance.assign(mesh.num_verts(), 0);
  c.result.fraction.assign(n, 0);
  c.result.is_near.assign(n, 0);
  c.result.nearest.resize(n);
  c.result.edge.assign(n, 0);
  c.measure_centres();
  c.measure_verts();
  c.sign_points();
  c.fill();
  return std::move(c.result);
}

}  // namespace hexwright::fitting
