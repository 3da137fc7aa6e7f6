// The strict verifier: everything is re-derived from the hexes' vertices, nothing is taken from the
// code under test.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "dual/dual_helpers.h"

namespace hexwright::test {
namespace {

using Quad = std::array<VertId, 4>;

struct Side {
  HexId hex;
  Quad verts;  // outward
};

std::string name(const char* what, HexId h) {
  return what + (" at hex " + std::to_string(h.value()));
}

class Verifier {
 public:
  Verifier(const HexMesh& mesh, const Grid& grid) : mesh_(mesh), grid_(grid) {}

  std::string run(bool check_shape) {
    if (auto issue = mesh_.find_problem()) return issue->message;
    check_hexes();
    check_faces();
    if (problem_.empty()) check_links();
    if (problem_.empty() && check_shape) check_boundary();
    if (problem_.empty() && check_shape) check_volume();
    return problem_;
  }

 private:
  void fail(const std::string& what) {
    if (problem_.empty()) problem_ = what;
  }

  void check_hexes() {
    std::vector<char> is_used(mesh_.num_verts(), 0);
    for (HexId h : mesh_.hexes.ids()) {
      auto v = mesh_.hexes[h];
      for (VertId x : v) is_used[x.index()] = 1;
      std::sort(v.begin(), v.end());
      if (std::adjacent_find(v.begin(), v.end()) != v.end()) fail(name("repeated vertex", h));
      for (const auto& lf : kHexFaces) {
        Side side{h,
                  {mesh_.hexes[h][lf[0]], mesh_.hexes[h][lf[1]], mesh_.hexes[h][lf[2]],
                   mesh_.hexes[h][lf[3]]}};
        Quad key = side.verts;
        std::sort(key.begin(), key.end());
        faces_[key].push_back(side);
      }
    }
    if (std::count(is_used.begin(), is_used.end(), 0)) fail("unused vertex");
  }

  static bool run_opposite(const Quad& a, const Quad& b) {
    for (int i = 0; i < 4; ++i)
      if (b[i] == a[1] && b[(i + 1) % 4] == a[0]) return b[(i + 2) % 4] == a[3];
    return false;
  }

  void check_faces() {
    std::set<std::pair<HexId, HexId>> neighbors;
    std::map<std::array<VertId, 3>, int> paths;  // two consecutive edges of a quad
    for (const auto& [key, sides] : faces_) {
      if (sides.size() > 2) fail(name("face in three hexes", sides[0].hex));
      if (sides.size() == 2) {
        if (!run_opposite(sides[0].verts, sides[1].verts)) fail(name("orientation", sides[0].hex));
        if (!neighbors.insert(std::minmax(sides[0].hex, sides[1].hex)).second)
          fail(name("doublet", sides[0].hex));
      }
      const Quad& q = sides[0].verts;
      for (int i = 0; i < 4; ++i) {
        const VertId a = q[i], b = q[(i + 1) % 4], c = q[(i + 2) % 4];
        if (++paths[{std::min(a, c), b, std::max(a, c)}] > 1)
          fail(name("two quads share two edges", sides[0].hex));
      }
    }
  }

  // The link of a vertex: one triangle per hex corner, one node per edge. It must be connected,
  // each node's triangles one fan, and its Euler characteristic 2 (sphere) or 1 (disc).
  struct Link {
    std::map<std::pair<VertId, VertId>, std::vector<int>> edges;  // a face at the vertex
    std::map<VertId, int> num_triangles;
    int count = 0;
  };

  void check_links() {
    IdVector<VertId, std::vector<std::pair<HexId, int>>> stars(mesh_.num_verts());
    for (HexId h : mesh_.hexes.ids())
      for (int lv = 0; lv < 8; ++lv) stars[mesh_.hexes[h][lv]].push_back({h, lv});
    for (VertId v : stars.ids()) {
      Link link;
      for (const auto& [h, lv] : stars[v]) {
        const int t = link.count++;
        for (int i = 0; i < 3; ++i) {
          const VertId a = mesh_.hexes[h][kHexCornerNeighbors[lv][i]];
          const VertId b = mesh_.hexes[h][kHexCornerNeighbors[lv][(i + 1) % 3]];
          ++link.num_triangles[a];
          link.edges[std::minmax(a, b)].push_back(t);
        }
      }
      check_link(link, v);
    }
  }

  void check_link(const Link& link, VertId v) {
    const std::string where = " at vertex " + std::to_string(v.value());
    std::vector<int> part(static_cast<std::size_t>(link.count));
    for (int t = 0; t < link.count; ++t) part[t] = t;
    const auto root = [&](int t) {
      while (part[t] != t) t = part[t];
      return t;
    };
    int num_border = 0, num_parts = link.count;
    std::map<VertId, std::pair<int, int>> degree;  // edges, border edges
    for (const auto& [ends, triangles] : link.edges) {
      if (triangles.size() > 2) return fail("link edge in three triangles" + where);
      num_border += triangles.size() == 1;
      for (VertId e : {ends.first, ends.second}) {
        ++degree[e].first;
        degree[e].second += triangles.size() == 1;
      }
      if (triangles.size() == 2 && root(triangles[0]) != root(triangles[1])) {
        part[root(triangles[0])] = root(triangles[1]);
        --num_parts;
      }
    }
    if (num_parts != 1) return fail("link in several parts" + where);
    const int euler = static_cast<int>(link.num_triangles.size()) -
                      static_cast<int>(link.edges.size()) + link.count;
    if (euler != (num_border ? 1 : 2)) return fail("link is neither sphere nor disc" + where);
    for (const auto& [e, count] : link.num_triangles) {
      const auto [num_edges, num_borders] = degree[e];
      if (num_borders ? num_borders != 2 || num_edges != count + 1 : num_edges != count)
        return fail("link node is not one fan" + where);
    }
  }

  // Every boundary quad lies in a plane of root faces, between a root inside and one outside.
  void check_boundary() {
    const std::set<LatticeCoord> roots(grid_.roots.begin(), grid_.roots.end());
    for (const auto& [key, sides] : faces_) {
      if (sides.size() != 1) continue;
      Vec3 center;
      for (VertId v : sides[0].verts) center += 0.25 * in_roots(v);
      bool is_on_boundary = false;
      for (int a = 0; a < 3; ++a) {
        const double plane = std::round(center[a]);
        bool is_flat = true;
        for (VertId v : sides[0].verts) is_flat &= std::abs(in_roots(v)[a] - plane) < 1e-9;
        if (!is_flat) continue;
        LatticeCoord below, above;
        for (int b = 0; b < 3; ++b) below[b] = above[b] = static_cast<int>(std::floor(center[b]));
        above[a] = static_cast<int>(plane);
        below[a] = above[a] - 1;
        is_on_boundary |= roots.count(below) != roots.count(above);
      }
      if (!is_on_boundary) fail(name("boundary quad inside the domain", sides[0].hex));
    }
  }

  Vec3 in_roots(VertId v) const {
    return (mesh_.positions[v] - grid_.frame.origin) / grid_.frame.root_size;
  }

  void check_volume() {
    double volume = 0;
    for (const auto& [key, sides] : faces_) {
      if (sides.size() != 1) continue;
      Vec3 p[4];
      for (int k = 0; k < 4; ++k) p[k] = in_roots(sides[0].verts[k]);
      volume += (det(p[0], p[1], p[2]) + det(p[0], p[2], p[3])) / 6;
    }
    if (std::abs(volume - static_cast<double>(grid_.roots.size())) > 1e-6 * volume)
      fail("volume is " + std::to_string(volume) + " roots");
  }

  const HexMesh& mesh_;
  const Grid& grid_;
  std::map<Quad, std::vector<Side>> faces_;
  std::string problem_;
};

}  // namespace

std::string find_mesh_problem(const HexMesh& mesh, const Grid& grid, bool check_shape) {
  return Verifier(mesh, grid).run(check_shape);
}

}  // namespace hexwright::test
