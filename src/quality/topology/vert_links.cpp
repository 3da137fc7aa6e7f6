// A connected link whose edges have one or two triangles is a sphere when closed with Euler
// characteristic 2, and a disc when its border is not empty and the characteristic is 1.
#include "quality/topology/vert_links.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

namespace hexwright {
namespace {

// The other ends of the edges at a vertex, three per hex corner.
struct Link {
  std::vector<std::array<VertId, 3>> triangles;
  std::vector<VertId> verts;     // distinct, sorted
  std::vector<std::size_t> set;  // union-find over verts

  std::size_t index_of(VertId v) const {
    return static_cast<std::size_t>(std::lower_bound(verts.begin(), verts.end(), v) -
                                    verts.begin());
  }
  std::size_t find(std::size_t i) const {
    while (set[i] != i) i = set[i];
    return i;
  }
};

void collect_link(const HexMesh& mesh, std::span<const HexCorner> corners, Link& link) {
  link.triangles.clear();
  link.verts.clear();
  for (const HexCorner& corner : corners) {
    const auto& n = kHexCornerNeighbors[static_cast<std::size_t>(corner.lv)];
    const auto& hex = mesh.hexes[corner.hex];
    link.triangles.push_back({hex[n[0]], hex[n[1]], hex[n[2]]});
    for (VertId v : link.triangles.back()) link.verts.push_back(v);
  }
  std::sort(link.verts.begin(), link.verts.end());
  link.verts.erase(std::unique(link.verts.begin(), link.verts.end()), link.verts.end());
}

bool is_connected(Link& link) {
  link.set.resize(link.verts.size());
  for (std::size_t i = 0; i < link.set.size(); ++i) link.set[i] = i;
  std::size_t num_sets = link.set.size();
  for (const auto& triangle : link.triangles) {
    const std::size_t a = link.find(link.index_of(triangle[0]));
    for (std::size_t k = 1; k < 3; ++k) {
      const std::size_t b = link.find(link.index_of(triangle[k]));
      if (link.find(a) != b) {
        link.set[std::max(link.find(a), b)] = std::min(link.find(a), b);
        --num_sets;
      }
    }
  }
  return num_sets == 1;
}

// Euler characteristic of the link: every triangle has three edges, shared by two triangles but for
// those on the border.
long euler_characteristic(const Link& link, std::size_t num_border_edges) {
  const std::size_t num_edges = (3 * link.triangles.size() + num_border_edges) / 2;
  return static_cast<long>(link.verts.size()) - static_cast<long>(num_edges) +
         static_cast<long>(link.triangles.size());
}

}  // namespace

std::vector<VertId> find_singular_verts(const HexMesh& mesh, const BoundarySurface& boundary) {
  const VertToHex vert_to_hex(mesh);
  IdVector<VertId, std::uint32_t> num_border_edges(mesh.num_verts(), 0);
  for (const auto& quad : boundary.quads)
    for (VertId v : quad) ++num_border_edges[v];
  std::vector<char> is_singular(mesh.num_verts(), 0);
  parallel_chunks(mesh.num_verts(), 1024, [&](std::size_t begin, std::size_t end) {
    Link link;
    for (std::size_t i = begin; i < end; ++i) {
      const VertId v(i);
      if (vert_to_hex[v].empty()) continue;
      collect_link(mesh, vert_to_hex[v], link);
      const long expected = num_border_edges[v] > 0 ? 1 : 2;
      is_singular[i] =
          euler_characteristic(link, num_border_edges[v]) != expected || !is_connected(link);
    }
  });
  std::vector<VertId> singular;
  for (std::size_t i = 0; i < is_singular.size(); ++i)
    if (is_singular[i]) singular.push_back(VertId(i));
  return singular;
}

}  // namespace hexwright
