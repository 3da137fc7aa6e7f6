#include "quality/topology/boundary_surface.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

#include "base/disjoint_sets.h"

namespace hexwright {
namespace {

// A side of a quad: quad corners are numbered 4 * quad + k, side k runs from corner k to k + 1.
struct Side {
  std::array<VertId, 2> verts;         // increasing
  std::array<std::size_t, 2> corners;  // the quad's corners at these vertices
};

std::vector<Side> sorted_sides(const std::vector<std::array<VertId, 4>>& quads) {
  std::vector<Side> sides(4 * quads.size());
  parallel_for(quads.size(), [&](std::size_t q) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t next = (k + 1) % 4;
      Side side{{quads[q][k], quads[q][next]}, {4 * q + k, 4 * q + next}};
      if (side.verts[1] < side.verts[0]) {
        std::swap(side.verts[0], side.verts[1]);
        std::swap(side.corners[0], side.corners[1]);
      }
      sides[4 * q + k] = side;
    }
  });
  parallel_stable_sort(sides.begin(), sides.end(),
                       [](const Side& a, const Side& b) { return a.verts < b.verts; });
  return sides;
}

// Vertices with the number of corner sets at each.
std::vector<BoundaryVert> count_fans(const std::vector<std::array<VertId, 4>>& quads,
                                     DisjointSets& fans) {
  std::vector<std::pair<VertId, std::size_t>> corners(4 * quads.size());  // vertex, fan
  for (std::size_t c = 0; c < corners.size(); ++c) corners[c] = {quads[c / 4][c % 4], fans.find(c)};
  parallel_stable_sort(corners.begin(), corners.end());
  std::vector<BoundaryVert> verts;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i == 0 || corners[i].first != corners[i - 1].first) verts.push_back({corners[i].first, 0});
    if (i == 0 || corners[i] != corners[i - 1]) ++verts.back().num_fans;
  }
  return verts;
}

}  // namespace

BoundarySurface make_boundary_surface(const HexMesh& mesh, const HexNeighbors& adjacency) {
  BoundarySurface surface;
  surface.faces = adjacency.boundary;
  for (const HexFace& face : surface.faces) surface.quads.push_back(face_verts(mesh, face));
  const std::vector<Side> sides = sorted_sides(surface.quads);
  DisjointSets fans(4 * surface.quads.size());
  DisjointSets components(surface.quads.size());
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].verts == sides[begin].verts) {
      components.unite(sides[begin].corners[0] / 4, sides[end].corners[0] / 4);
      ++end;
    }
    surface.edges.push_back({sides[begin].verts, end - begin});
    if (end - begin != 2) continue;
    for (std::size_t k = 0; k < 2; ++k)
      fans.unite(sides[begin].corners[k], sides[begin + 1].corners[k]);
  }
  surface.verts = count_fans(surface.quads, fans);
  surface.num_components = components.count();
  return surface;
}

}  // namespace hexwright
