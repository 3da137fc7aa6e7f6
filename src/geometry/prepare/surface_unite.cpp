// Solids that overlap or touch become the surface of their union: hidden walls are no surface of
// the object, and the curves in which parts meet are its edges.
#include <algorithm>

#include "geometry/prepare/narrow_gaps.h"
#include "geometry/prepare/surface_clean.h"
#include "geometry/prepare/unite_solids.h"
#include "geometry/topology/bodies.h"
#include "geometry/tree/triangle_contacts.h"
#include "geometry/tree/triangle_math.h"
#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

/// Nearer than this, in the unit frame, parts touch: files in single precision leave 1e-7.
constexpr double kContact = 1e-6;
/// Edges shorter than this may be collapsed in a union.
constexpr double kTolerance = 1e-9;
/// Share of a union's area above which the walls of slits in it are no accident of shape.
constexpr double kManySlits = 0.002;

/// All bodies as one surface, and the body of each triangle.
struct Assembly {
  TriMesh mesh;
  IdVector<TriId, int> tri_to_body;
};

Assembly assemble(const std::vector<ClosedPiece>& bodies) {
  Assembly all;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    append(all.mesh, bodies[b].mesh);
    all.tri_to_body.resize(all.mesh.num_tris(), static_cast<int>(b));
  }
  return all;
}

/// Bodies by cluster: those that overlap (or touch, unless `overlaps_only`), directly or by others.
/// Clusters of one are left out.
std::vector<std::vector<std::size_t>> find_clusters(const std::vector<ClosedPiece>& bodies,
                                                    bool overlaps_only) {
  const Assembly all = assemble(bodies);
  const auto meet = [&](TriId a, TriId b) {
    if (all.tri_to_body[a] == all.tri_to_body[b]) return false;
    const auto ca = all.mesh.corners(a), cb = all.mesh.corners(b);
    return overlaps_only ? find_crossing(ca, cb, kContact).has_value()
                         : are_within(ca, cb, kContact);
  };
  UnionFind sets(bodies.size());
  for (const TriPair& pair : find_near_pairs(all.mesh, kContact, meet))
    sets.unite(all.tri_to_body[pair.a], all.tri_to_body[pair.b]);
  std::vector<std::vector<std::size_t>> clusters(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    clusters[static_cast<std::size_t>(sets.find(static_cast<int>(b)))].push_back(b);
  std::erase_if(clusters, [](const auto& cluster) { return cluster.size() < 2; });
  return clusters;
}

/// Plane pieces of a body's surface that have one name, each numbered by one of its triangles.
IdVector<TriId, TriId> find_faces(const ClosedPiece& body, const WorkingSurface& surface,
                                  const IdVector<TriId, std::int32_t>& groups) {
  const auto group_of = [&](TriId t) {
    const TriId source = surface.source[body.tri_to_surface[t.index()]];
    return groups.empty() || !source.is_valid() ? -1 : groups[source];
  };
  const SurfaceEdges edges = compute_surface_edges(body.mesh);
  UnionFind faces(body.mesh.num_tris());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides_of(e);
    if (sides.size() != 2) continue;
    const auto& [a, b] = std::array{sides[0].tri, sides[1].tri};
    const auto corners = body.mesh.corners(a);
    const Vec3 normal = unit_normal(corners);
    const bool is_plane = std::ranges::all_of(body.mesh.corners(b), [&](const Vec3& p) {
      return std::abs(dot(normal, p - corners[0])) < kTolerance;
    });
    if (is_plane && normal != Vec3{} && group_of(a) == group_of(b))
      faces.unite(a.value(), b.value());
  }
  IdVector<TriId, TriId> tri_to_face;
  for (TriId t : body.mesh.tris.ids()) tri_to_face.push_back(TriId(faces.find(t.value())));
  return tri_to_face;
}

/// Vertices of a union in the surface's numbers: those of the bodies keep theirs, others are added.
/// Where bodies meet in a point without joining, the second one there gets a vertex of its own.
class VertNumbers {
 public:
  VertNumbers(const std::vector<ClosedPiece>& bodies, const std::vector<std::size_t>& cluster) {
    for (std::size_t b : cluster)
      for (VertId v : bodies[b].mesh.positions.ids())
        known_.push_back({bodies[b].mesh.positions[v], bodies[b].vert_to_surface[v.index()]});
    std::sort(known_.begin(), known_.end(), [](const Known& a, const Known& b) {
      return key(a.position) != key(b.position) ? key(a.position) < key(b.position)
                                                : a.vert < b.vert;
    });
  }

  VertId find(WorkingSurface& surface, const Vec3& p) {
    const auto it = std::lower_bound(
        known_.begin(), known_.end(), p,
        [](const Known& a, const Vec3& position) { return key(a.position) < key(position); });
    const bool is_known = it != known_.end() && key(it->position) == key(p);
    if (is_known && !it->is_taken) {
      it->is_taken = true;
      return it->vert;
    }
    surface.added_from.push_back(is_known ? it->vert : VertId());
    return surface.mesh.positions.push_back(p);
  }

 private:
  struct Known {
    Vec3 position;
    VertId vert;
    bool is_taken = false;
  };
  static std::array<double, 3> key(const Vec3& p) { return {p.x, p.y, p.z}; }
  std::vector<Known> known_;
};

/// Puts the union's triangles in place of those of its bodies, which `is_kept` loses.
void replace(WorkingSurface& surface, const std::vector<ClosedPiece>& bodies,
             const std::vector<std::size_t>& cluster, const UnitedSurface& united,
             std::vector<char>& is_kept) {
  for (std::size_t b : cluster)
    for (TriId t : bodies[b].tri_to_surface) is_kept[t.index()] = 0;
  VertNumbers numbers(bodies, cluster);
  IdVector<VertId, VertId> verts;
  for (const Vec3& p : united.mesh.positions) verts.push_back(numbers.find(surface, p));
  for (TriId t : united.mesh.tris.ids()) {
    const auto& tri = united.mesh.tris[t];
    const ClosedPiece& body =
        bodies[cluster[static_cast<std::size_t>(united.tri_to_solid[t.index()])]];
    const TriId in_surface = body.tri_to_surface[united.tri_to_face[t.index()].index()];
    surface.mesh.tris.push_back({verts[tri[0]], verts[tri[1]], verts[tri[2]]});
    surface.source.push_back(TriId(surface.source[in_surface]));
    is_kept.push_back(1);
  }
}

/// A union, and whether gaps in it were closed.
struct Union {
  UnitedSurface surface;
  bool has_closed_gaps = false;
};

Union unite(const std::vector<Solid>& solids, double min_gap) {
  Union result = {unite_solids(solids, kTolerance)};
  if (result.surface.mesh.num_tris() == 0 || !(min_gap > 0)) return result;
  const double slits = measure_slits(result.surface.mesh, min_gap);
  if (slits < kManySlits) return result;
  UnitedSurface closed = unite_closing_gaps(solids, min_gap);
  if (closed.mesh.num_tris() == 0 || measure_slits(closed.mesh, min_gap) >= slits / 2)
    return result;
  return {std::move(closed), true};
}

}  // namespace

UniteReport unite_parts(WorkingSurface& surface, Parts parts, double min_gap,
                        const IdVector<TriId, std::int32_t>& groups) {
  UniteReport report;
  if (parts == Parts::AsIs) return report;
  const std::vector<ClosedPiece> bodies = find_bodies(surface.mesh);
  std::vector<char> is_kept(surface.mesh.num_tris(), 1);
  for (const auto& cluster : find_clusters(bodies, parts == Parts::Separate)) {
    std::vector<Solid> solids;
    for (std::size_t b : cluster)
      solids.push_back({bodies[b].mesh, find_faces(bodies[b], surface, groups)});
    const auto [united, has_closed_gaps] = unite(solids, min_gap);
    if (united.mesh.num_tris() == 0) {
      report.num_failed += cluster.size();
      continue;
    }
    replace(surface, bodies, cluster, united, is_kept);
    std::size_t num_results = 0;
    for (const ClosedPiece& piece : split_closed_pieces(united.mesh))
      num_results += piece.volume > 0;
    if (num_results >= cluster.size()) {
      report.num_apart += cluster.size();
      continue;
    }
    report.num_parts += cluster.size();
    report.num_closed += has_closed_gaps;
    report.num_results += num_results;
  }
  if (report.num_parts + report.num_apart > 0) surface.keep(is_kept);
  return report;
}

}  // namespace hexwright
