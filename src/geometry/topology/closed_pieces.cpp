// Sides of triangles are paired edge by edge; pieces are what hangs together across pairs, vertices
// of a piece are its fans.
#include "geometry/topology/closed_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/topology/surface_edges.h"
#include "mesh/tri_measures.h"

namespace hexwright {
namespace {

using Side = SurfaceEdges::Side;

/// Triangles around an edge nearer than this, in radians, lie on each other: rounding orders them.
constexpr double kSameAngle = 1e-6;

/// For each side (3 * triangle + k) the side it is paired with, or -1.
class SidePairs {
 public:
  explicit SidePairs(const TriMesh& surface)
      : surface_(surface),
        edges_(compute_surface_edges(surface)),
        partner_(3 * surface.num_tris(), -1) {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto s = edges_.sides_of(e);
      if (s.size() == 2 && s[0].is_forward != s[1].is_forward) pair(s[0], s[1]);
    }
    // First by what hangs together already: each pair that this finds joins parts, which may find
    // the next. Then, where shells share more than that, by the order around the edge.
    while (pair_within_parts() > 0) {
    }
    const std::vector<int> part = connected();
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (edges_.sides_of(e).size() > 2) pair_around(e, part);
  }

  int partner(std::size_t side) const { return partner_[side]; }
  const std::vector<int>& partners() const { return partner_; }

  /// Numbers what hangs together across pairs, per triangle.
  std::vector<int> connected() const {
    UnionFind sets(surface_.num_tris());
    for (std::size_t i = 0; i < partner_.size(); ++i)
      if (partner_[i] >= 0) sets.unite(static_cast<int>(i) / 3, partner_[i] / 3);
    return number_sets(sets, surface_.num_tris());
  }

 private:
  struct Spoke {
    double angle;
    bool opens;  // the solid begins here, for one who goes round by increasing angles
    int part;
    Side side;
  };

  static int number(const Side& s) { return 3 * s.tri.value() + s.k; }
  bool is_paired(const Side& s) const { return partner_[static_cast<std::size_t>(number(s))] >= 0; }
  void pair(const Side& a, const Side& b) {
    partner_[static_cast<std::size_t>(number(a))] = number(b);
    partner_[static_cast<std::size_t>(number(b))] = number(a);
  }

  /// Pairs sides of edges of more than two triangles that are their part's only ones there. Returns
  /// how many pairs it made.
  std::size_t pair_within_parts() {
    const std::vector<int> part = connected();
    const auto is_match = [&](const Side& a, const Side& b) {
      return !is_paired(b) && part[a.tri.index()] == part[b.tri.index()];
    };
    std::size_t count = 0;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto sides = edges_.sides_of(e);
      if (sides.size() == 2) continue;
      for (const Side& a : sides) {
        if (is_paired(a) || !a.is_forward) continue;
        const Side* match = nullptr;
        std::size_t num_same = 0;
        for (const Side& b : sides) {
          num_same += is_match(a, b);
          if (is_match(a, b) && !b.is_forward) match = &b;
        }
        if (!match || num_same != 2) continue;
        pair(a, *match);
        ++count;
      }
    }
    return count;
  }

  /// The triangles around an edge by angle. Of those that lie on each other, the ones that end a
  /// solid come first: two solids that touch do not overlap.
  std::vector<Spoke> sort_spokes(std::size_t e, const std::vector<int>& part) const {
    const Vec3 origin = surface_.positions[edges_.lo(e)];
    const Vec3 axis = normalized(surface_.positions[edges_.hi(e)] - origin);
    Vec3 x, y;
    std::vector<Spoke> spokes;
    for (const Side& s : edges_.sides_of(e)) {
      if (is_paired(s)) continue;
      const VertId third = surface_.tris[s.tri][static_cast<std::size_t>((s.k + 2) % 3)];
      const Vec3 out = surface_.positions[third] - origin;
      if (spokes.empty()) {
        x = normalized(out - axis * dot(out, axis));
        y = cross(axis, x);
      }
      double angle = std::atan2(dot(out, y), dot(out, x));
      if (angle < -kSameAngle) angle += 2 * std::numbers::pi;
      spokes.push_back({angle, !s.is_forward, part[s.tri.index()], s});
    }
    std::stable_sort(spokes.begin(), spokes.end(),
                     [](const Spoke& a, const Spoke& b) { return a.angle < b.angle; });
    for (auto begin = spokes.begin(); begin != spokes.end();) {
      auto end = begin + 1;
      while (end != spokes.end() && end->angle - (end - 1)->angle < kSameAngle) ++end;
      std::stable_partition(begin, end, [](const Spoke& s) { return !s.opens; });
      begin = end;
    }
    return spokes;
  }

  /// Goes round once, from where the fewest solids are open, and pairs each side that ends a solid
  /// with one that began it: of the same part if there is one, else the first. Where as many begin
  /// as end, all find a partner.
  void pair_around(std::size_t e, const std::vector<int>& part) {
    std::vector<Spoke> spokes = sort_spokes(e, part);
    if (spokes.empty()) return;  // open parts only
    long depth = 0, least = 0;
    std::size_t start = 0;
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      depth += spokes[i].opens ? 1 : -1;
      if (depth >= least) continue;
      least = depth;
      start = i + 1;
    }
    std::rotate(spokes.begin(), spokes.begin() + static_cast<long>(start % spokes.size()),
                spokes.end());
    std::vector<Spoke> open;
    for (const Spoke& s : spokes) {
      if (s.opens) {
        open.push_back(s);
        continue;
      }
      if (open.empty()) continue;
      auto match =
          std::find_if(open.begin(), open.end(), [&](const Spoke& o) { return o.part == s.part; });
      if (match == open.end()) match = open.begin();
      pair(match->side, s.side);
      open.erase(match);
    }
  }

  const TriMesh& surface_;
  SurfaceEdges edges_;
  std::vector<int> partner_;
};

/// Sets of triangle corners (3 * triangle + k) that are one vertex of their piece.
UnionFind find_fans(const TriMesh& surface, const SidePairs& pairs) {
  UnionFind fans(3 * surface.num_tris());
  const auto next = [](int side) { return side - side % 3 + (side + 1) % 3; };
  for (std::size_t i = 0; i < 3 * surface.num_tris(); ++i) {
    const int a = static_cast<int>(i), b = pairs.partner(i);
    if (b < a) continue;  // absent, or seen from the other side
    fans.unite(a, next(b));
    fans.unite(next(a), b);
  }
  return fans;
}

void measure(ClosedPiece& piece) {
  piece.box = bounding_box(piece.mesh);
  piece.volume = enclosed_volume(piece.mesh);
}

}  // namespace

std::vector<ClosedPiece> split_closed_pieces(const TriMesh& surface) {
  const SidePairs pairs(surface);
  const std::vector<int> tri_to_part = pairs.connected();
  const std::size_t num_parts =
      tri_to_part.empty() ? 0
                          : static_cast<std::size_t>(*std::ranges::max_element(tri_to_part)) + 1;
  std::vector<char> is_closed(num_parts, 1);
  for (std::size_t i = 0; i < pairs.partners().size(); ++i)
    if (pairs.partner(i) < 0) is_closed[static_cast<std::size_t>(tri_to_part[i / 3])] = 0;

  UnionFind fans = find_fans(surface, pairs);
  std::vector<VertId> fan_to_vert(3 * surface.num_tris());
  std::vector<ClosedPiece> parts(num_parts);
  for (TriId t : surface.tris.ids()) {
    const auto p = static_cast<std::size_t>(tri_to_part[t.index()]);
    if (!is_closed[p]) continue;
    std::array<VertId, 3> tri;
    for (std::size_t k = 0; k < 3; ++k) {
      VertId& v =
          fan_to_vert[static_cast<std::size_t>(fans.find(static_cast<int>(3 * t.index() + k)))];
      if (!v.is_valid()) {
        v = parts[p].mesh.positions.push_back(surface.positions[surface.tris[t][k]]);
        parts[p].vert_to_surface.push_back(surface.tris[t][k]);
      }
      tri[k] = v;
    }
    parts[p].mesh.tris.push_back(tri);
    parts[p].tri_to_surface.push_back(t);
  }
  std::erase_if(parts, [](const ClosedPiece& piece) { return piece.mesh.num_tris() == 0; });
  for (ClosedPiece& piece : parts) measure(piece);
  return parts;
}

}  // namespace hexwright
