#include "hexwright/mesh/hex_adjacency.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

namespace hexwright {

VertToHex::VertToHex(const HexMesh& mesh) : offset_(mesh.num_verts() + 1, 0) {
  for (const auto& hex : mesh.hexes)
    for (VertId v : hex) ++offset_[v.index() + 1];
  for (std::size_t v = 0; v < mesh.num_verts(); ++v) offset_[v + 1] += offset_[v];
  corners_.resize(offset_.back());
  std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
  for (HexId h : mesh.hexes.ids())
    for (int lv = 0; lv < 8; ++lv)
      corners_[next[mesh.hexes[h][static_cast<std::size_t>(lv)].index()]++] = {h, lv};
}

namespace {

// A face keyed by its sorted vertices: equal keys are the same quad.
struct KeyedFace {
  std::array<VertId, 4> key;
  HexFace face;
};

std::vector<KeyedFace> sorted_faces(const HexMesh& mesh) {
  std::vector<KeyedFace> faces(mesh.num_hexes() * 6);
  parallel_for(mesh.num_hexes(), [&](std::size_t h) {
    for (int lf = 0; lf < 6; ++lf) {
      const HexFace face{HexId(h), lf};
      auto key = face_verts(mesh, face);
      std::sort(key.begin(), key.end());
      faces[6 * h + static_cast<std::size_t>(lf)] = {key, face};
    }
  });
  parallel_stable_sort(faces.begin(), faces.end(),
                       [](const KeyedFace& a, const KeyedFace& b) { return a.key < b.key; });
  return faces;
}

bool face_order(const HexFace& a, const HexFace& b) {
  return a.hex != b.hex ? a.hex < b.hex : a.lf < b.lf;
}

}  // namespace

HexNeighbors compute_hex_neighbors(const HexMesh& mesh) {
  HexNeighbors result;
  result.neighbor.resize(mesh.num_hexes());
  const auto faces = sorted_faces(mesh);
  const auto slot = [&](const HexFace& f) -> HexId& {
    return result.neighbor[f.hex][static_cast<std::size_t>(f.lf)];
  };
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    while (end < faces.size() && faces[end].key == faces[begin].key) ++end;
    if (end - begin == 1) {
      result.boundary.push_back(faces[begin].face);
    } else if (end - begin == 2) {
      slot(faces[begin].face) = faces[begin + 1].face.hex;
      slot(faces[begin + 1].face) = faces[begin].face.hex;
    } else {
      for (std::size_t i = begin; i < end; ++i) result.non_conforming.push_back(faces[i].face);
    }
  }
  std::sort(result.boundary.begin(), result.boundary.end(), face_order);
  std::sort(result.non_conforming.begin(), result.non_conforming.end(), face_order);
  return result;
}

}  // namespace hexwright
