// Who touches whom in a hex mesh, as flat arrays. Built once per connectivity in linear time.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "hexwright/mesh/hex_mesh.h"

namespace hexwright {

/// A corner of a hex: which hex and which of its 8 local vertices.
struct HexCorner {
  HexId hex;
  int lv = 0;
};

/// A face of a hex: which hex and which of its 6 local faces.
struct HexFace {
  HexId hex;
  int lf = 0;
  friend bool operator==(const HexFace&, const HexFace&) = default;
};

/// Vertex -> incident hex corners, in compressed rows sorted by hex.
class VertToHex {
 public:
  VertToHex() = default;
  explicit VertToHex(const HexMesh& mesh);
  std::span<const HexCorner> operator[](VertId v) const {
    return {corners_.data() + offset_[v.index()], corners_.data() + offset_[v.index() + 1]};
  }

 private:
  std::vector<std::size_t> offset_;  // num_verts + 1
  std::vector<HexCorner> corners_;
};

/// Face neighbours: neighbor[h][lf] = the hex on the other side, invalid on the boundary.
struct HexNeighbors {
  IdVector<HexId, std::array<HexId, 6>> neighbor;
  std::vector<HexFace> boundary;  ///< in order of (hex, lf)
  std::vector<HexFace>
      non_conforming;  ///< faces shared by three or more hexes; empty in a valid mesh
};
HexNeighbors compute_hex_neighbors(const HexMesh& mesh);

/// The four vertices of a hex's face, counter-clockwise seen from outside the hex.
inline std::array<VertId, 4> face_verts(const HexMesh& mesh, HexFace face) {
  const auto& v = mesh.hexes[face.hex];
  const auto& f = kHexFaces[static_cast<std::size_t>(face.lf)];
  return {v[f[0]], v[f[1]], v[f[2]], v[f[3]]};
}

}  // namespace hexwright
