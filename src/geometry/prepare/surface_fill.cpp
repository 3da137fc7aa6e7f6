// Closes the holes of an open surface, so that every later stage has a surface to go by there.
//
// Without a patch over a hole the solid still ends there (where the winding number falls to one
// half), but the fit has nothing to land on and the distance nothing to be measured to.
//
// Based on: Barequet, Sharir, "Filling gaps in the boundary of a polyhedron", Computer Aided
// Geometric Design 12(2), 1995 (triangulation of least area by dynamic programming).
// Differs: borders too long for the cubic cost are closed piece by piece; no vertices are added.
#include <algorithm>
#include <limits>

#include "geometry/prepare/surface_clean.h"

namespace hexwright {
namespace {

/// Borders up to this length are triangulated at once: a few million evaluations.
constexpr std::size_t kMaxAtOnce = 200;

using Loop = std::vector<VertId>;

/// Open edges, each in the direction in which a patch runs through it (against its triangle), by
/// start vertex.
std::vector<std::array<VertId, 2>> find_open_edges(const SurfaceEdges& edges) {
  std::vector<std::array<VertId, 2>> open;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto sides = edges.sides_of(e);
    if (sides.size() != 1) continue;
    const bool forward = sides[0].is_forward;
    open.push_back({forward ? edges.hi(e) : edges.lo(e), forward ? edges.lo(e) : edges.hi(e)});
  }
  std::sort(open.begin(), open.end());
  return open;
}

/// Walks along open edges and cuts off a loop whenever a vertex comes again, so that holes that
/// meet in a vertex come apart. Chains that lead nowhere, as around a fin, give no loop.
std::vector<Loop> trace_loops(const SurfaceEdges& edges, std::size_t num_verts) {
  const auto open = find_open_edges(edges);
  std::vector<char> is_used(open.size(), 0);
  std::vector<Loop> loops;
  IdVector<VertId, int> place(num_verts, -1);  // in the walk, -1 = not on it
  for (std::size_t first = 0; first < open.size(); ++first) {
    if (is_used[first]) continue;
    Loop walk{open[first][0]};
    place[walk[0]] = 0;
    while (!walk.empty()) {
      auto next = std::lower_bound(open.begin(), open.end(), std::array{walk.back(), VertId()});
      const auto index = [&] { return static_cast<std::size_t>(next - open.begin()); };
      while (next != open.end() && (*next)[0] == walk.back() && is_used[index()]) ++next;
      if (next == open.end() || (*next)[0] != walk.back()) break;
      is_used[index()] = 1;
      const VertId v = (*next)[1];
      if (place[v] < 0) {
        place[v] = static_cast<int>(walk.size());
        walk.push_back(v);
        continue;
      }
      const auto begin = walk.begin() + place[v];
      loops.emplace_back(begin, walk.end());
      for (auto it = begin + 1; it != walk.end(); ++it) place[*it] = -1;
      walk.erase(begin + 1, walk.end());
    }
    for (VertId v : walk) place[v] = -1;
  }
  return loops;
}

/// Area, and a little for length: in a plane all triangulations have the same area, and those with
/// slivers or triangles on a line must not win.
double cost(const TriMesh& mesh, VertId a, VertId b, VertId c) {
  constexpr double kLength = 0.01;
  const Vec3 ab = mesh.positions[b] - mesh.positions[a], ac = mesh.positions[c] - mesh.positions[a];
  return norm(cross(ab, ac)) + kLength * (norm_sq(ab) + norm_sq(ac) + norm_sq(ac - ab));
}

/// Added for a diagonal that is an edge of the surface already, which would get four triangles. In
/// the unit frame more than any patch.
constexpr double kTaken = 1e6;

/// The cheapest triangulation of one loop, appended to `tris`.
void fill_at_once(const TriMesh& mesh, const SurfaceEdges& edges, const Loop& loop,
                  std::vector<std::array<VertId, 3>>& tris) {
  const std::size_t n = loop.size();
  if (n < 3) return;
  // least[i * n + j]: of the polygon i, i+1 .. j; apex: the corner of the triangle on its edge ij.
  std::vector<double> least(n * n, 0);
  std::vector<std::size_t> apex(n * n, 0);
  for (std::size_t span = 2; span < n; ++span)
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t j = i + span;
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t k = i + 1; k < j; ++k) {
        const double total =
            least[i * n + k] + least[k * n + j] + cost(mesh, loop[i], loop[k], loop[j]);
        if (total >= best) continue;
        best = total;
        apex[i * n + j] = k;
      }
      const bool is_taken = span + 1 < n && edges.find(loop[i], loop[j]) >= 0;
      least[i * n + j] = best + (is_taken ? kTaken : 0);
    }
  std::vector<std::array<std::size_t, 2>> todo{{0, n - 1}};
  while (!todo.empty()) {
    const auto [i, j] = todo.back();
    todo.pop_back();
    if (j - i < 2) continue;
    const std::size_t k = apex[i * n + j];
    tris.push_back({loop[i], loop[k], loop[j]});
    todo.push_back({i, k});
    todo.push_back({k, j});
  }
}

/// Long loops: pieces of the border are closed along their chords, then the loop of the chords.
void fill_loop(const TriMesh& mesh, const SurfaceEdges& edges, const Loop& loop,
               std::vector<std::array<VertId, 3>>& tris) {
  if (loop.size() <= kMaxAtOnce) return fill_at_once(mesh, edges, loop, tris);
  const std::size_t num_pieces = std::max<std::size_t>(3, loop.size() / (kMaxAtOnce / 2));
  Loop chords;
  for (std::size_t p = 0; p < num_pieces; ++p) {
    const std::size_t begin = p * loop.size() / num_pieces;
    const std::size_t end = (p + 1) * loop.size() / num_pieces;
    chords.push_back(loop[begin]);
    Loop piece(loop.begin() + static_cast<long>(begin), loop.begin() + static_cast<long>(end));
    piece.push_back(loop[end % loop.size()]);
    fill_at_once(mesh, edges, piece, tris);
  }
  fill_loop(mesh, edges, chords, tris);
}

}  // namespace

std::size_t fill_holes(WorkingSurface& surface) {
  const SurfaceEdges edges = compute_surface_edges(surface.mesh);
  const std::vector<Loop> loops = trace_loops(edges, surface.mesh.num_verts());
  std::vector<std::array<VertId, 3>> tris;
  std::size_t num_filled = 0;
  for (const Loop& loop : loops) {
    if (loop.size() < 3) continue;
    fill_loop(surface.mesh, edges, loop, tris);
    ++num_filled;
  }
  for (const auto& tri : tris) {
    surface.mesh.tris.push_back(tri);
    surface.source.push_back(TriId());
  }
  return num_filled;
}

}  // namespace hexwright
