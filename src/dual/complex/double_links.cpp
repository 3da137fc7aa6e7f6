// In the link of a vertex every quad at it is an edge between the ends of two mesh edges. Two quads
// that share two edges are two link edges with the same ends: a face between two hexes is seen from
// both, so more than two sightings of one pair of ends give it away.
#include "dual/complex/double_links.h"

#include <algorithm>

#include "hexwright/base/cancel.h"
#include "hexwright/base/parallel.h"

#include "dual/complex/positions.h"

namespace hexwright::dual {

namespace {

// Corners (8 * hex + local vertex) around each vertex, in compressed rows.
struct CornerRows {
  std::vector<std::uint32_t> offset, corners;
  explicit CornerRows(const HexComplex& complex)
      : offset(static_cast<std::size_t>(complex.num_verts) + 1, 0),
        corners(8 * complex.num_hexes()) {
    for (const auto& hex : complex.verts)
      for (VertId v : hex) ++offset[v.index() + 1];
    for (std::size_t v = 1; v < offset.size(); ++v) offset[v] += offset[v - 1];
    auto next = offset;
    CancelCheck check_cancelled;
    for (HexId h : complex.verts.ids()) {
      check_cancelled();
      for (std::uint32_t lv = 0; lv < 8; ++lv)
        corners[next[complex.verts[h][lv].index()]++] =
            8 * static_cast<std::uint32_t>(h.value()) + lv;
    }
  }
};

// A quad's two edges at the vertex, by their other ends.
struct Wedge {
  VertId a, b;
  int num_sides;  // a face between two hexes is seen twice, one on the boundary once for both
  friend bool operator<(const Wedge& x, const Wedge& y) {
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  }
};

// The face of a hex that holds the k-th and (k+1)-th edge at a local vertex.
int face_between(int lv, int k) {
  const int a = kHexCornerNeighbors[lv][k], b = kHexCornerNeighbors[lv][(k + 1) % 3];
  for (int lf : kFacesOfVertex[lv]) {
    bool has_a = false, has_b = false;
    for (int other : kHexFaces[lf]) {
      has_a |= other == a;
      has_b |= other == b;
    }
    if (has_a && has_b) return lf;
  }
  return 0;
}

void collect_wedges(const HexComplex& complex, std::uint32_t corner, std::vector<Wedge>& wedges) {
  const HexId h(corner >> 3);
  const int lv = static_cast<int>(corner & 7);
  for (int k = 0; k < 3; ++k) {
    const VertId a = complex.verts[h][kHexCornerNeighbors[lv][k]];
    const VertId b = complex.verts[h][kHexCornerNeighbors[lv][(k + 1) % 3]];
    const bool is_boundary = complex.links[h][face_between(lv, k)].is_plane();
    wedges.push_back({std::min(a, b), std::max(a, b), is_boundary ? 2 : 1});
  }
}

// More than two sightings of one pair of ends: two quads share both edges.
bool is_doubled(std::vector<Wedge>& wedges) {
  std::sort(wedges.begin(), wedges.end());
  int sides = 0;
  for (std::size_t i = 0; i < wedges.size(); ++i) {
    const bool is_same = i > 0 && !(wedges[i - 1] < wedges[i]);
    sides = (is_same ? sides : 0) + wedges[i].num_sides;
    if (sides > 2) return true;
  }
  return false;
}

}  // namespace

// Lattice hexes alone form regular neighbourhoods, so only vertices of a cap are looked at closely.
std::vector<VertId> find_double_links(const HexComplex& complex) {
  const CornerRows rows(complex);
  const auto num_verts = static_cast<std::size_t>(complex.num_verts);
  std::vector<char> has_double(num_verts, 0);
  parallel_chunks(num_verts, 4096, [&](std::size_t begin, std::size_t end) {
    std::vector<Wedge> wedges;
    for (std::size_t v = begin; v < end; ++v) {
      wedges.clear();
      bool has_cap = false;
      for (std::uint32_t i = rows.offset[v]; i < rows.offset[v + 1]; ++i) {
        has_cap |= !complex.places[HexId(rows.corners[i] >> 3)].is_lattice();
        collect_wedges(complex, rows.corners[i], wedges);
      }
      has_double[v] = has_cap && is_doubled(wedges);
    }
  });
  std::vector<VertId> found;
  for (std::size_t v = 0; v < num_verts; ++v)
    if (has_double[v]) found.push_back(VertId(v));
  return found;
}

// `verts` must be sorted. The mean place of a vertex's hexes lies in the leaf it belongs to, which
// is what the repair needs; positions do not exist yet at that time.
std::vector<Vec3> mean_places(const HexComplex& complex, const std::vector<VertId>& verts) {
  const auto places = compute_places(complex);
  std::vector<Vec3> means(verts.size());
  std::vector<int> count(verts.size(), 0);
  for (HexId h : complex.verts.ids())
    for (VertId v : complex.verts[h]) {
      const auto at = std::lower_bound(verts.begin(), verts.end(), v);
      if (at == verts.end() || *at != v) continue;
      const auto i = static_cast<std::size_t>(at - verts.begin());
      means[i] += places[h];
      ++count[i];
    }
  for (std::size_t i = 0; i < verts.size(); ++i) means[i] = means[i] / std::max(1, count[i]);
  return means;
}

}  // namespace hexwright::dual
