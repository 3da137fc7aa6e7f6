#include "hexwright/mesh/cut_hexes.h"

#include <algorithm>

#include "hexwright/base/parallel.h"
#include "hexwright/mesh/hex_numbering.h"

namespace hexwright {
namespace {

struct KeyedFace {
  std::array<VertId, 4> key;  // sorted
  std::size_t source = 0;     // 6 * hex + local face
};

// Per hex face: the lowest (hex, face) that has the same vertices.
std::vector<std::size_t> find_first_faces(const HexMesh& mesh) {
  std::vector<KeyedFace> faces(6 * mesh.num_hexes());
  parallel_for(faces.size(), [&](std::size_t source) {
    KeyedFace& face = faces[source];
    face.source = source;
    for (std::size_t k = 0; k < 4; ++k)
      face.key[k] =
          mesh.hexes[HexId(source / 6)][static_cast<std::size_t>(kHexFaces[source % 6][k])];
    std::sort(face.key.begin(), face.key.end());
  });
  parallel_stable_sort(faces.begin(), faces.end(),
                       [](const KeyedFace& a, const KeyedFace& b) { return a.key < b.key; });
  std::vector<std::size_t> first(faces.size());
  for (std::size_t i = 0, begin = 0; i < faces.size(); ++i) {
    if (faces[i].key != faces[begin].key) begin = i;
    first[faces[i].source] = faces[begin].source;
  }
  return first;
}

}  // namespace

TetMesh cut_hexes(const HexMesh& mesh) {
  TetMesh result;
  result.positions = mesh.positions;
  const auto first = find_first_faces(mesh);
  std::vector<VertId> center(first.size());
  for (std::size_t source = 0; source < first.size(); ++source) {
    if (first[source] != source) continue;
    Vec3 sum;
    for (int lv : kHexFaces[source % 6])
      sum += mesh.positions[mesh.hexes[HexId(source / 6)][static_cast<std::size_t>(lv)]];
    center[source] = result.positions.push_back(sum * 0.25);
  }
  for (HexId h : mesh.hexes.ids()) {
    Vec3 sum;
    for (VertId v : mesh.hexes[h]) sum += mesh.positions[v];
    const VertId middle = result.positions.push_back(sum * 0.125);
    for (std::size_t lf = 0; lf < 6; ++lf)
      for (std::size_t k = 0; k < 4; ++k) {
        const auto vert = [&](std::size_t i) {
          return mesh.hexes[h][static_cast<std::size_t>(kHexFaces[lf][i % 4])];
        };
        result.tets.push_back({middle, vert(k), vert(k + 1), center[first[6 * h.index() + lf]]});
      }
  }
  return result;
}

}  // namespace hexwright
