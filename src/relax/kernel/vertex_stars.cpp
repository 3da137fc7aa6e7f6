// Stars and colours of the vertices of a hex mesh, for sweeps of VertexNewton.
#include "hexwright/base/cancel.h"
#include "hexwright/base/parallel.h"

#include "relax/kernel/vertex_newton.h"

namespace hexwright::relax {
namespace {

// Per local vertex: its edge neighbours n0 n1 n2, then the diagonals d01 d12 d20, by the bits of
// the numbering: the diagonal over two axes is the vertex with both bits flipped.
std::array<std::array<int, 6>, 8> make_star_table() {
  std::array<std::array<int, 6>, 8> table{};
  for (std::size_t lv = 0; lv < 8; ++lv) {
    const auto& n = kHexCornerNeighbors[lv];
    const int own = kHexBitsOfVertex[lv];
    for (std::size_t k = 0; k < 3; ++k) {
      const int step = own ^ kHexBitsOfVertex[static_cast<std::size_t>(n[k])];
      const int next = own ^ kHexBitsOfVertex[static_cast<std::size_t>(n[(k + 1) % 3])];
      table[lv][k] = n[k];
      table[lv][3 + k] = kHexVertexOfBits[static_cast<std::size_t>(own ^ step ^ next)];
    }
  }
  return table;
}
const std::array<std::array<int, 6>, 8> kStarTable = make_star_table();

}  // namespace

VertexStars::VertexStars(const HexMesh& mesh) : VertexStars(mesh, VertToHex(mesh)) {}

VertexStars::VertexStars(const HexMesh& mesh, const VertToHex& vert_to_hex)
    : offset_(mesh.num_verts() + 1, 0), stars_(mesh.num_hexes() * 8) {
  for (std::size_t v = 0; v < mesh.num_verts(); ++v)
    offset_[v + 1] = offset_[v] + vert_to_hex[VertId(v)].size();
  parallel_for(mesh.num_verts(), [&](std::size_t v) {
    std::size_t slot = offset_[v];
    for (const HexCorner& corner : vert_to_hex[VertId(v)]) {
      const auto& hex = mesh.hexes[corner.hex];
      const auto& row = kStarTable[static_cast<std::size_t>(corner.lv)];
      for (std::size_t k = 0; k < 6; ++k) stars_[slot][k] = hex[static_cast<std::size_t>(row[k])];
      ++slot;
    }
  });
}

// Greedy in order of id: the least colour that no hex-neighbour has.
VertexColors::VertexColors(const HexMesh& mesh, const VertToHex& vert_to_hex) {
  std::vector<int> color(mesh.num_verts(), -1);
  std::vector<std::size_t> last_user;  // per colour: the vertex whose neighbour has it, plus 1
  std::vector<std::size_t> count;
  CancelCheck check_cancelled;
  for (std::size_t v = 0; v < mesh.num_verts(); ++v) {
    check_cancelled();
    if (vert_to_hex[VertId(v)].empty()) continue;
    for (const HexCorner& corner : vert_to_hex[VertId(v)])
      for (VertId u : mesh.hexes[corner.hex])
        if (color[u.index()] >= 0) last_user[static_cast<std::size_t>(color[u.index()])] = v + 1;
    std::size_t c = 0;
    while (c < last_user.size() && last_user[c] == v + 1) ++c;
    if (c == last_user.size()) {
      last_user.push_back(0);
      count.push_back(0);
    }
    color[v] = static_cast<int>(c);
    ++count[c];
  }
  offset_.assign(count.size() + 1, 0);
  for (std::size_t c = 0; c < count.size(); ++c) offset_[c + 1] = offset_[c] + count[c];
  verts_.resize(offset_.back());
  std::vector<std::size_t> next(offset_.begin(), offset_.end() - 1);
  for (std::size_t v = 0; v < mesh.num_verts(); ++v)
    if (color[v] >= 0) verts_[next[static_cast<std::size_t>(color[v])]++] = VertId(v);
}

}  // namespace hexwright::relax
