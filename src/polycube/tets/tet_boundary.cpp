// Facets sorted by their three vertices: those that stand alone belong to one tet. Sorting instead
// of hashing keeps the order of the result a function of the mesh.
#include "polycube/tets/tet_boundary.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

namespace hexwright::polycube {
namespace {

// Local faces of a positive tet, counter-clockwise seen from outside.
constexpr std::array<std::array<int, 3>, 4> kTetFaces = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct KeyedFacet {
  std::array<VertId, 3> key;  // sorted
  std::size_t source;         // 4 * tet + local face
};

}  // namespace

IdVector<TriId, std::array<VertId, 3>> boundary_facets(const TetMesh& mesh) {
  const auto facet = [&](std::size_t source) {
    const auto& tet = mesh.tets[TetId(source / 4)];
    const auto& f = kTetFaces[source % 4];
    return std::array<VertId, 3>{tet[f[0]], tet[f[1]], tet[f[2]]};
  };
  std::vector<KeyedFacet> keyed(mesh.num_tets() * 4);
  for (std::size_t source = 0; source < keyed.size(); ++source) {
    keyed[source] = {facet(source), source};
    std::sort(keyed[source].key.begin(), keyed[source].key.end());
  }
  parallel_stable_sort(keyed.begin(), keyed.end(),
                       [](const KeyedFacet& a, const KeyedFacet& b) { return a.key < b.key; });
  std::vector<std::size_t> single;
  for (std::size_t begin = 0, end = 0; begin < keyed.size(); begin = end) {
    while (end < keyed.size() && keyed[end].key == keyed[begin].key) ++end;
    if (end - begin == 1) single.push_back(keyed[begin].source);
  }
  std::sort(single.begin(), single.end());
  IdVector<TriId, std::array<VertId, 3>> facets;
  for (std::size_t source : single) facets.push_back(facet(source));
  return facets;
}

}  // namespace hexwright::polycube
