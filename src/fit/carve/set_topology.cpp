#include "fit/carve/set_topology.h"

#include <algorithm>
#include <array>

#include "base/disjoint_sets.h"

namespace hexwright::fitting {
namespace {

bool in(const std::vector<char>& in_set, HexId h) { return h.is_valid() && in_set[h.index()]; }

// A set of faces of a cube, neither none nor all, is a disc if it and its complement are each
// connected across edges: two faces share one unless they are opposite.
bool is_connected(unsigned faces) {
  // Opposite faces are the bits 2k and 2k+1: sets that hold no third face are the only ones apart.
  return faces != 0b000011u && faces != 0b001100u && faces != 0b110000u;
}

std::array<bool, 64> make_disc_table() {
  std::array<bool, 64> table{};
  for (unsigned faces = 1; faces < 63; ++faces)
    table[faces] = is_connected(faces) && is_connected(63u & ~faces);
  return table;
}

}  // namespace

SetTopology compute_set_topology(const HexMesh& mesh, const HexNeighbors& neighbors,
                                 const std::vector<char>& in_set) {
  BasicDisjointSets<std::int32_t> pieces(mesh.num_verts());
  std::vector<char> on_boundary(mesh.num_verts(), 0);
  long num_quads = 0;
  for (HexId h : mesh.hexes.ids()) {
    if (!in_set[h.index()]) continue;
    for (int lf = 0; lf < 6; ++lf) {
      if (in(in_set, neighbors.neighbor[h][static_cast<std::size_t>(lf)])) continue;
      ++num_quads;
      const auto quad = face_verts(mesh, {h, lf});
      for (VertId v : quad) {
        on_boundary[v.index()] = 1;
        pieces.unite(quad[0].value(), v.value());
      }
    }
  }
  const auto num_verts = std::count(on_boundary.begin(), on_boundary.end(), 1);
  SetTopology topology;
  // Vertices off the boundary are pieces of their own.
  topology.num_components =
      pieces.count() - (mesh.num_verts() - static_cast<std::size_t>(num_verts));
  topology.euler_characteristic = num_verts - num_quads;  // V - E + F with E = 2 F
  return topology;
}

unsigned faces_on_set(const HexNeighbors& neighbors, const std::vector<char>& in_set, HexId h) {
  unsigned faces = 0;
  for (std::size_t lf = 0; lf < 6; ++lf)
    if (in(in_set, neighbors.neighbor[h][lf])) faces |= 1u << lf;
  return faces;
}

bool is_disc(unsigned faces) {
  static const std::array<bool, 64> kTable = make_disc_table();
  return kTable[faces];
}

bool is_one_thick(unsigned faces) {
  for (unsigned axis = 0; axis < 3; ++axis)
    if ((faces >> (2 * axis) & 3u) == 0) return true;
  return false;
}

}  // namespace hexwright::fitting
