#include "relax/kernel/body.h"

#include <algorithm>

#include "hexwright/base/parallel.h"
#include "hexwright/quality/hex_quality.h"

namespace hexwright::relax {

Body::Body(HexMesh hex_mesh, VertToHex around) : mesh(std::move(hex_mesh)) {
  derive(std::move(around));
  move.assign(num_verts(), MoveIn::Space);
  axis.resize(num_verts());
  size = mean_edge_lengths(*this);
  mark_all_dirty();
}

void Body::derive(VertToHex around) {
  vert_to_hex = std::move(around);
  stars = VertexStars(mesh, vert_to_hex);
  colors = VertexColors(mesh, vert_to_hex);
}

IdVector<VertId, double> mean_edge_lengths(const Body& body) {
  const auto& p = body.mesh.positions;
  IdVector<VertId, double> length(body.num_verts(), 1);
  parallel_for(
      body.num_verts(),
      [&](std::size_t i) {
        const VertId v(i);
        const auto star = body.stars[v];
        double sum = 0;
        for (const HexStar& corner : star)
          for (std::size_t k = 0; k < 3; ++k) sum += distance(p[corner[k]], p[v]);
        if (!star.empty()) length[v] = sum / (3.0 * static_cast<double>(star.size()));
      },
      256);
  return length;
}

void grow_vert_set(const Body& body, std::vector<char>& is_member, int rings) {
  std::vector<VertId> front;
  for (std::size_t v = 0; v < is_member.size(); ++v)
    if (is_member[v]) front.push_back(VertId(v));
  for (int r = 0; r < rings; ++r) {
    std::vector<VertId> next;
    for (VertId v : front) {
      for (const HexCorner& corner : body.vert_to_hex[v]) {
        for (VertId u : body.mesh.hexes[corner.hex]) {
          if (is_member[u.index()]) continue;
          is_member[u.index()] = 1;
          next.push_back(u);
        }
      }
    }
    front = std::move(next);
  }
}

std::vector<char> verts_of_poor_hexes(const Body& body, double below) {
  const auto quality = compute_scaled_jacobians(body.mesh);
  if (std::none_of(quality.begin(), quality.end(), [&](double q) { return q < below; })) return {};
  return verts_of_hexes(body, [&](HexId h) { return quality[h] < below; });
}

}  // namespace hexwright::relax
