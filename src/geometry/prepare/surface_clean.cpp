// Degenerate and duplicate triangles.
#include "geometry/prepare/surface_clean.h"

#include <algorithm>
#include <array>

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

/// A flip can make a neighbour flat in turn; chains longer than this are not worth the passes.
constexpr int kFlipPasses = 10;

bool repeats_vertex(const std::array<VertId, 3>& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

std::size_t at3(int k) { return static_cast<std::size_t>(k % 3); }

int longest_side(const std::array<Vec3, 3>& c) {
  int longest = 0;
  for (int k = 1; k < 3; ++k)
    if (distance(c[at3(k)], c[at3(k + 1)]) > distance(c[at3(longest)], c[at3(longest + 1)]))
      longest = k;
  return longest;
}

/// The height over the longest side is within the rounding of positions in the unit frame.
bool has_no_area(const std::array<Vec3, 3>& c) {
  constexpr double kRounding = 4e-16;
  const int k = longest_side(c);
  const double longest = distance(c[at3(k)], c[at3(k + 1)]);
  return norm(cross(c[1] - c[0], c[2] - c[0])) <= kRounding * longest;
}

/// Replaces caps (the middle vertex lies on the longest side) by splitting the neighbour there.
class CapFlipper {
 public:
  explicit CapFlipper(WorkingSurface& surface)
      : surface_(surface),
        edges_(compute_surface_edges(surface.mesh)),
        is_touched_(surface.mesh.num_tris(), 0) {}

  std::size_t run() {
    std::size_t count = 0;
    for (TriId t : surface_.mesh.tris.ids())
      if (!is_touched_[t] && has_no_area(surface_.mesh.corners(t))) count += flip(t);
    return count;
  }

 private:
  /// Cap a-b-c with b on ac, and the triangle p-q-d on the other side of ac: the edge ac becomes
  /// bd. The surface keeps its shape, since b lies on ac. Refused where bd exists already.
  bool flip(TriId cap) {
    auto& tris = surface_.mesh.tris;
    const int k = longest_side(surface_.mesh.corners(cap));
    const VertId a = tris[cap][at3(k)], c = tris[cap][at3(k + 1)], b = tris[cap][at3(k + 2)];
    const auto& x = surface_.mesh.positions;
    if (x[b] == x[a] || x[b] == x[c]) return false;  // a needle: its vertices coincide
    const auto sides = edges_.sides_of(static_cast<std::size_t>(edges_.find(a, c)));
    if (sides.size() != 2) return false;
    const auto& other = sides[0].tri == cap ? sides[1] : sides[0];
    if (other.tri == cap || is_touched_[other.tri]) return false;
    const VertId p = tris[other.tri][at3(other.k)], q = tris[other.tri][at3(other.k + 1)];
    const VertId d = tris[other.tri][at3(other.k + 2)];
    const std::uint64_t new_key = edge_key(b, d);
    if (d == b || edges_.find(b, d) >= 0 ||
        std::find(new_keys_.begin(), new_keys_.end(), new_key) != new_keys_.end())
      return false;
    tris[other.tri] = {p, b, d};
    tris[cap] = {b, q, d};
    surface_.source[cap] = surface_.source[other.tri];
    is_touched_[cap] = is_touched_[other.tri] = 1;
    new_keys_.push_back(new_key);
    return true;
  }

  WorkingSurface& surface_;
  SurfaceEdges edges_;
  IdVector<TriId, char> is_touched_;
  std::vector<std::uint64_t> new_keys_;
};

std::size_t drop_repeating(WorkingSurface& surface) {
  std::vector<char> is_kept;
  for (const auto& t : surface.mesh.tris) is_kept.push_back(!repeats_vertex(t));
  const auto count = static_cast<std::size_t>(std::count(is_kept.begin(), is_kept.end(), 0));
  if (count > 0) surface.keep(is_kept);
  return count;
}

/// Triangles without area that have an open side may go: what they covered was nothing.
void drop_open_degenerate(WorkingSurface& surface, std::size_t& num_kept) {
  const SurfaceEdges edges = compute_surface_edges(surface.mesh);
  IdVector<TriId, int> num_open(surface.mesh.num_tris(), 0);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges.sides_of(e).size() == 1) ++num_open[edges.sides_of(e)[0].tri];
  std::vector<char> is_kept(surface.mesh.num_tris(), 1);
  num_kept = 0;
  for (TriId t : surface.mesh.tris.ids()) {
    if (!has_no_area(surface.mesh.corners(t))) continue;
    is_kept[t.index()] = num_open[t] == 0;
    num_kept += num_open[t] == 0;
  }
  surface.keep(is_kept);
}

}  // namespace

void WorkingSurface::keep(const std::vector<char>& is_kept) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < is_kept.size(); ++i) {
    if (!is_kept[i]) continue;
    mesh.tris[TriId(next)] = mesh.tris[TriId(i)];
    source[TriId(next)] = source[TriId(i)];
    ++next;
  }
  mesh.tris.resize(next);
  source.resize(next);
}

std::size_t remove_degenerate_tris(WorkingSurface& surface, std::size_t& num_kept) {
  num_kept = 0;
  std::size_t count = drop_repeating(surface);
  std::size_t num_flat = 0;
  for (TriId t : surface.mesh.tris.ids()) num_flat += has_no_area(surface.mesh.corners(t));
  if (num_flat == 0) return count;
  for (int pass = 0; pass < kFlipPasses && CapFlipper(surface).run() > 0; ++pass) {
  }
  drop_open_degenerate(surface, num_kept);
  return count + num_flat;
}

namespace {

struct SortedTri {
  std::array<VertId, 3> key;  // increasing
  bool is_even;               // whether the triangle is an even permutation of the key
  TriId tri;
};

/// The parity of the permutation that sorts the vertices tells the two orientations apart.
SortedTri sorted(const TriMesh& mesh, TriId t) {
  auto v = mesh.tris[t];
  bool is_even = true;
  for (const auto& [i, j] : {std::pair{0u, 1u}, {1u, 2u}, {0u, 1u}})
    if (v[j] < v[i]) {
      std::swap(v[i], v[j]);
      is_even = !is_even;
    }
  return {v, is_even, t};
}

/// Keep flags when each group of duplicates becomes one; when `cancel`, groups with as many of one
/// orientation as of the other become none. What is `shared` stays.
std::vector<char> reduce_groups(const std::vector<SortedTri>& tris,
                                const std::vector<char>& is_shared, bool cancel) {
  std::vector<char> is_kept(tris.size(), 1);
  for (std::size_t i = 0, j = 0; i < tris.size(); i = j) {
    long balance = 0;
    for (j = i; j < tris.size() && tris[j].key == tris[i].key; ++j)
      balance += tris[j].is_even ? 1 : -1;
    if (j - i == 1 || is_shared[tris[i].tri.index()]) continue;
    const bool want_even = balance != 0 ? balance > 0 : tris[i].is_even;
    bool is_done = cancel && balance == 0;
    for (std::size_t k = i; k < j; ++k) {
      const bool keeps = !is_done && tris[k].is_even == want_even;
      is_kept[tris[k].tri.index()] = keeps;
      is_done = is_done || keeps;
    }
  }
  return is_kept;
}

/// Triangles that are there once for each of several shells that lie on each other in part: every
/// edge of such a patch is run through as often one way as the other, and its border leads on to
/// triangles that differ. To drop one of several copies would open a shell. Walls between solids
/// that touch, which are there in both orientations, are taken in when `walls`.
std::vector<char> find_shared(const TriMesh& mesh, const std::vector<SortedTri>& tris, bool walls) {
  std::vector<char> is_copy(mesh.num_tris(), 0);
  for (std::size_t i = 0, j = 0; i < tris.size(); i = j) {
    bool is_alike = true;
    for (j = i; j < tris.size() && tris[j].key == tris[i].key; ++j)
      is_alike = is_alike && tris[j].is_even == tris[i].is_even;
    for (std::size_t k = i; k < j; ++k)
      is_copy[tris[k].tri.index()] = (is_alike || walls) && j - i > 1;
  }
  const SurfaceEdges edges = compute_surface_edges(mesh);
  UnionFind patches(mesh.num_tris());
  std::vector<char> is_balanced(mesh.num_tris(), 1), has_border(mesh.num_tris(), 0);
  const auto visit_edges = [&](auto visit) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto sides = edges.sides_of(e);
      const auto first = std::ranges::find_if(
          sides, [&](const SurfaceEdges::Side& s) { return is_copy[s.tri.index()] != 0; });
      if (first != sides.end()) visit(sides, *first);
    }
  };
  visit_edges([&](auto sides, const SurfaceEdges::Side& first) {
    for (const SurfaceEdges::Side& s : sides)
      if (is_copy[s.tri.index()]) patches.unite(first.tri.value(), s.tri.value());
  });
  visit_edges([&](auto sides, const SurfaceEdges::Side& first) {
    const auto patch = static_cast<std::size_t>(patches.find(first.tri.value()));
    long balance = 0;
    for (const SurfaceEdges::Side& s : sides) {
      balance += s.is_forward ? 1 : -1;
      if (!is_copy[s.tri.index()]) has_border[patch] = 1;
    }
    if (balance != 0) is_balanced[patch] = 0;
  });
  for (std::size_t t = 0; t < is_copy.size(); ++t) {
    const auto patch = static_cast<std::size_t>(patches.find(static_cast<int>(t)));
    is_copy[t] = is_copy[t] && is_balanced[patch] && has_border[patch];
  }
  return is_copy;
}

/// What keeping these triangles would leave open.
std::size_t odd_edges_with(const WorkingSurface& surface, const std::vector<char>& is_kept) {
  WorkingSurface reduced = surface;
  reduced.keep(is_kept);
  return count_odd_edges(compute_surface_edges(reduced.mesh));
}

}  // namespace

std::size_t remove_duplicate_tris(WorkingSurface& surface, bool keep_walls) {
  std::vector<SortedTri> tris;
  for (TriId t : surface.mesh.tris.ids()) tris.push_back(sorted(surface.mesh, t));
  parallel_stable_sort(tris.begin(), tris.end(), [](const SortedTri& a, const SortedTri& b) {
    return a.key != b.key ? a.key < b.key : a.tri < b.tri;
  });
  const bool has_duplicates =
      std::adjacent_find(tris.begin(), tris.end(),
                         [](const auto& a, const auto& b) { return a.key == b.key; }) != tris.end();
  if (!has_duplicates) return 0;
  // A wall between two touching solids cancels; both sides of a doubled surface must not.
  const std::vector<char> is_shared = find_shared(surface.mesh, tris, keep_walls);
  std::vector<char> is_kept = reduce_groups(tris, is_shared, true);
  const std::vector<char> one_each = reduce_groups(tris, is_shared, false);
  const bool is_empty = std::count(is_kept.begin(), is_kept.end(), 1) == 0;
  if (is_empty || odd_edges_with(surface, is_kept) > odd_edges_with(surface, one_each))
    is_kept = one_each;
  surface.keep(is_kept);
  return static_cast<std::size_t>(std::count(is_kept.begin(), is_kept.end(), 0));
}

}  // namespace hexwright
