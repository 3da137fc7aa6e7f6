// Every vertex of the lattice mesh goes the way of what it lies on: inside through a tet, on a face
// through a facet of that face, on an edge of the polycube along its chain of mesh edges, on a
// corner to the corner. So faces, edges and corners of the polycube become those of the object
// exactly, and neighbouring facets meet in the same points.
//
// Based on: Pitzalis et al. 2021, section 6.2 (vertices by barycentric coordinates in tets).
// Differs: boundary vertices do not go through tets, which are often flat at the boundary.
#include "polycube/map/map_back.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "hexwright/base/parallel.h"
#include "hexwright/mesh/hex_adjacency.h"

#include "polycube/map/boundary_map.h"

namespace hexwright::polycube {
namespace {

// A boundary edge or vertex of the polycube that separates charts.
struct Crease {
  std::array<VertId, 2> verts;
  std::array<int, 2> directions;  // of the two charts, ascending
};

std::vector<Crease> find_creases(const Lattice& lattice, const BoundaryMap& boundary) {
  std::map<std::array<VertId, 2>, std::vector<TriId>> by_edge;
  for (TriId f : lattice.facets.ids())
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<VertId, 2> edge = {lattice.facets[f][k], lattice.facets[f][(k + 1) % 3]};
      if (edge[1] < edge[0]) std::swap(edge[0], edge[1]);
      by_edge[edge].push_back(f);
    }
  std::vector<Crease> creases;
  for (const auto& [edge, facets] : by_edge) {
    if (facets.size() != 2) continue;
    std::array<int, 2> d = {boundary.direction_of(facets[0]), boundary.direction_of(facets[1])};
    if (lattice.facet_to_chart[facets[0]] == lattice.facet_to_chart[facets[1]]) continue;
    if (d[1] < d[0]) std::swap(d[0], d[1]);
    creases.push_back({edge, d});
  }
  return creases;
}

// Lattice planes are integers; vertices of the dual mesh that lie on them were put there exactly.
bool is_on_lattice_plane(double x) { return std::abs(x - std::round(x)) < 1e-9; }

// The directions (bit per 2 * axis + up) of the boundary quads at each vertex; 0 inside.
IdVector<VertId, int> boundary_directions(const HexMesh& mesh) {
  IdVector<VertId, int> directions(mesh.num_verts(), 0);
  for (const HexFace& face : compute_hex_neighbors(mesh).boundary) {
    const auto q = face_verts(mesh, face);
    const Vec3 n = cross(mesh.positions[q[2]] - mesh.positions[q[0]],
                         mesh.positions[q[3]] - mesh.positions[q[1]]);
    int axis = 0;
    for (int a = 1; a < 3; ++a)
      if (std::abs(n[a]) > std::abs(n[axis])) axis = a;
    // Vertices that the dual stage slid off their planes (chamfered corners) are mapped like
    // interior ones.
    for (VertId v : q)
      if (is_on_lattice_plane(mesh.positions[v][axis]))
        directions[v] |= 1 << (2 * axis + (n[axis] > 0 ? 1 : 0));
  }
  return directions;
}

// The crease between two directions nearest to p, and the place on it.
struct CreasePoint {
  std::array<VertId, 2> verts;
  double t = 0;
};
CreasePoint closest_crease(const Lattice& lattice, const std::vector<Crease>& creases,
                           int directions, const Vec3& p) {
  double best = std::numeric_limits<double>::infinity();
  CreasePoint nearest;
  for (const Crease& crease : creases) {
    if (((1 << crease.directions[0]) | (1 << crease.directions[1])) != directions) continue;
    const Vec3 &a = lattice.tets.positions[crease.verts[0]],
               &b = lattice.tets.positions[crease.verts[1]];
    const double length_sq = norm_sq(b - a);
    const double t = length_sq > 0 ? std::clamp(dot(p - a, b - a) / length_sq, 0.0, 1.0) : 0;
    const double d = norm_sq(a + (b - a) * t - p);
    if (d >= best) continue;
    best = d;
    nearest = {crease.verts, t};
  }
  return nearest;
}

// Polycube vertices where charts of three or more directions meet, with those directions.
std::map<VertId, int> find_corner_directions(const std::vector<Crease>& creases) {
  std::map<VertId, int> directions, num_creases;
  for (const Crease& crease : creases)
    for (VertId v : crease.verts) {
      directions[v] |= 1 << crease.directions[0] | 1 << crease.directions[1];
      ++num_creases[v];
    }
  for (const auto& [v, count] : num_creases)
    if (count == 2) directions.erase(v);
  return directions;
}

VertId closest_corner(const Lattice& lattice, const std::map<VertId, int>& corner_to_directions,
                      int directions, const Vec3& p) {
  double best = std::numeric_limits<double>::infinity();
  VertId nearest;
  for (const auto& [v, has] : corner_to_directions) {
    const double mismatch = has == directions ? 0 : 1;  // another kind of corner is a last resort
    const double d = norm_sq(lattice.tets.positions[v] - p) + mismatch;
    if (d < best) {
      best = d;
      nearest = v;
    }
  }
  return nearest;
}

// Everything a single vertex needs to be carried over.
class Mapper {
 public:
  Mapper(const TetMesh& object, const Lattice& lattice, const TetLocator& locator)
      : object_(object),
        lattice_(lattice),
        locator_(locator),
        boundary_(lattice),
        creases_(find_creases(lattice, boundary_)),
        corners_(find_corner_directions(creases_)) {}

  Vec3 map(const Vec3& p, int directions, BoundaryPlace& place, char& is_bridged) const {
    const auto bits = static_cast<unsigned>(directions);
    switch (std::popcount(bits)) {
      case 0: {
        const TetPoint at = locator_.locate(p);
        is_bridged = at.is_bridged;
        return interpolate(object_, at);
      }
      // One direction: inside a face.
      case 1: {
        const auto hit = boundary_.closest(p, std::countr_zero(bits));
        place.facet = hit.facet;
        return boundary_.carry(object_, hit);
      }
      // Two: on an edge between faces of these directions. Where the lattice merged the one chart
      // away there is no such edge, and the vertex stays on a face.
      case 2: {
        const CreasePoint at = closest_crease(lattice_, creases_, directions, p);
        if (!at.verts[0].is_valid()) return map(p, 1 << std::countr_zero(bits), place, is_bridged);
        place.crease = at.verts;
        return object_.positions[at.verts[0]] * (1 - at.t) + object_.positions[at.verts[1]] * at.t;
      }
      // Three or more: a corner.
      default:
        place.corner = closest_corner(lattice_, corners_, directions, p);
        return object_.positions[place.corner];
    }
  }

 private:
  const TetMesh& object_;
  const Lattice& lattice_;
  const TetLocator& locator_;
  BoundaryMap boundary_;
  std::vector<Crease> creases_;
  std::map<VertId, int> corners_;
};

}  // namespace

ObjectFeatures object_features(const TetMesh& object, const Lattice& lattice) {
  ObjectFeatures features;
  features.surface.positions = object.positions;
  features.surface.tris = lattice.facets;
  for (const Crease& crease : find_creases(lattice, BoundaryMap(lattice)))
    features.chart_edges.push_back(crease.verts);
  return features;
}

MappedMesh map_back(const HexMesh& hexes, const TetMesh& object, const Lattice& lattice,
                    const TetLocator& locator) {
  const Mapper mapper(object, lattice, locator);
  const auto directions = boundary_directions(hexes);
  MappedMesh result{hexes, IdVector<VertId, BoundaryPlace>(hexes.num_verts()), 0};
  std::vector<char> is_bridged(hexes.num_verts(), 0);
  parallel_for(
      hexes.num_verts(),
      [&](std::size_t i) {
        const VertId v(i);
        result.mesh.positions[v] =
            mapper.map(hexes.positions[v], directions[v], result.place[v], is_bridged[i]);
      },
      64);
  result.num_bridged =
      static_cast<std::size_t>(std::count(is_bridged.begin(), is_bridged.end(), 1));
  return result;
}

}  // namespace hexwright::polycube
