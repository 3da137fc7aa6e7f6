// Welding that cannot spoil a good surface: only vertices on open edges are candidates, and a
// tolerance is accepted only when it leaves fewer open edges and collapses nothing.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "hexwright/base/parallel.h"

#include "geometry/prepare/surface_clean.h"

namespace hexwright {
namespace {

/// Tried in turn, relative to the unit frame (the longest side of the box is 1 to 2).
constexpr double kTolerances[] = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5};
/// No tolerance reaches farther than this share of the shortest edge at the vertex.
constexpr double kShareOfEdge = 0.1;

std::vector<VertId> verts_on_open_edges(const TriMesh& mesh, const SurfaceEdges& edges) {
  IdVector<VertId, char> is_open(mesh.num_verts(), 0);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges.sides_of(e).size() % 2 == 1) is_open[edges.lo(e)] = is_open[edges.hi(e)] = 1;
  std::vector<VertId> verts;
  for (VertId v : mesh.positions.ids())
    if (is_open[v]) verts.push_back(v);
  return verts;
}

/// Renames vertices to the least of their set; returns how many vanish.
std::size_t rename(TriMesh& mesh, UnionFind& sets, const std::vector<VertId>& candidates) {
  for (auto& tri : mesh.tris)
    for (VertId& v : tri) v = VertId(sets.find(v.value()));
  std::size_t count = 0;
  for (VertId v : candidates) count += sets.find(v.value()) != v.value();
  return count;
}

/// Equal positions, by sorting.
std::size_t weld_equal(TriMesh& mesh, std::vector<VertId> candidates) {
  const auto key = [&](VertId v) {
    const Vec3& p = mesh.positions[v];
    return std::array<double, 3>{p.x + 0.0, p.y + 0.0, p.z + 0.0};  // -0 becomes 0
  };
  parallel_stable_sort(candidates.begin(), candidates.end(), [&](VertId a, VertId b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  UnionFind sets(mesh.num_verts());
  for (std::size_t i = 1; i < candidates.size(); ++i)
    if (key(candidates[i - 1]) == key(candidates[i]))
      sets.unite(candidates[i - 1].value(), candidates[i].value());
  return rename(mesh, sets, candidates);
}

/// Per vertex: the tolerance, or less where edges are short.
IdVector<VertId, double> reaches(const TriMesh& mesh, double tolerance) {
  IdVector<VertId, double> reach(mesh.num_verts(), tolerance);
  for (const auto& tri : mesh.tris)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertId a = tri[k], b = tri[(k + 1) % 3];
      const double length = kShareOfEdge * distance(mesh.positions[a], mesh.positions[b]);
      if (a == b || length == 0) continue;
      reach[a] = std::min(reach[a], length);
      reach[b] = std::min(reach[b], length);
    }
  return reach;
}

/// Candidates in a hash-free grid: sorted by the cell of size `tolerance` they lie in.
class CellList {
 public:
  CellList(const TriMesh& mesh, const std::vector<VertId>& verts, double size) : size_(size) {
    for (VertId v : verts) entries_.push_back({cell_of(mesh.positions[v]), v});
    parallel_stable_sort(entries_.begin(), entries_.end());
  }

  template <class Visit>
  void visit_near(const Vec3& p, Visit visit) const {
    const Cell c = cell_of(p);
    for (std::int64_t x = c[0] - 1; x <= c[0] + 1; ++x)
      for (std::int64_t y = c[1] - 1; y <= c[1] + 1; ++y) {
        const Entry from{{x, y, c[2] - 1}, VertId()};
        auto it = std::lower_bound(entries_.begin(), entries_.end(), from);
        for (; it != entries_.end() && it->first <= Cell{x, y, c[2] + 1}; ++it) visit(it->second);
      }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  using Entry = std::pair<Cell, VertId>;
  Cell cell_of(const Vec3& p) const {
    return {static_cast<std::int64_t>(std::floor(p.x / size_)),
            static_cast<std::int64_t>(std::floor(p.y / size_)),
            static_cast<std::int64_t>(std::floor(p.z / size_))};
  }
  double size_;
  std::vector<Entry> entries_;
};

/// Pairs are united when they lie within reach of both. Chains may grow longer than the tolerance;
/// the caller throws the trial away when that collapses a triangle.
std::size_t weld_near(TriMesh& mesh, const std::vector<VertId>& candidates, double tolerance) {
  const auto reach = reaches(mesh, tolerance);
  const CellList cells(mesh, candidates, tolerance);
  UnionFind sets(mesh.num_verts());
  for (VertId v : candidates)
    cells.visit_near(mesh.positions[v], [&](VertId w) {
      if (v < w && distance(mesh.positions[v], mesh.positions[w]) <= std::min(reach[v], reach[w]))
        sets.unite(v.value(), w.value());
    });
  return rename(mesh, sets, candidates);
}

std::size_t count_collapsed(const TriMesh& mesh) {
  std::size_t count = 0;
  for (const auto& t : mesh.tris) count += t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  return count;
}

}  // namespace

std::size_t count_odd_edges(const SurfaceEdges& edges) {
  std::size_t count = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) count += edges.sides_of(e).size() % 2;
  return count;
}

/// From the finest tolerance up: each is tried on a copy and kept when fewer edges are open
/// afterwards. Triangles that collapse, or no gain, mean that the vertices were meant to be apart.
std::size_t weld_open_edges(TriMesh& mesh) {
  SurfaceEdges edges = compute_surface_edges(mesh);
  if (count_odd_edges(edges) == 0) return 0;
  std::size_t num_welded = weld_equal(mesh, verts_on_open_edges(mesh, edges));
  for (double tolerance : kTolerances) {
    edges = compute_surface_edges(mesh);
    const std::size_t num_odd = count_odd_edges(edges);
    if (num_odd == 0) break;
    TriMesh trial = mesh;
    const std::size_t count = weld_near(trial, verts_on_open_edges(mesh, edges), tolerance);
    if (count == 0 || count_collapsed(trial) > count_collapsed(mesh) ||
        count_odd_edges(compute_surface_edges(trial)) >= num_odd)
      continue;
    mesh = std::move(trial);
    num_welded += count;
  }
  return num_welded;
}

}  // namespace hexwright
