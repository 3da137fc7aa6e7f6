#include "relax/state/fit_state.h"

#include <algorithm>

#include "relax/kernel/boundary_quads.h"

namespace hexwright::relax {

double FitState::residual(VertId v) const {
  const Vec3 y = mesh.positions[v] - target[v];
  switch (kind[v]) {
    case VertKind::Interior:
      return 0;
    case VertKind::Surface:
      return std::abs(dot(y, direction[v])) / size[v];
    case VertKind::Curve: {
      const double along = dot(y, direction[v]);
      return std::sqrt(std::max(0.0, norm_sq(y) - along * along)) / size[v];
    }
    case VertKind::Corner:
      return norm(y) / size[v];
  }
  return 0;
}

void FitState::resize_arrays() {
  const std::size_t n = num_verts();
  kind.resize(n, VertKind::Interior);
  patch.resize(n);
  curve.resize(n);
  arc.resize(n, 0);
  feature_point.resize(n);
  offset.resize(n, 0);
  target.resize(n);
  direction.resize(n);
  query.resize(n);
  move.resize(n, MoveIn::Space);
  axis.resize(n);
  size.resize(n, 0);
  is_dirty.resize(n, 1);
}

std::vector<char> FitState::inside_hexes() const {
  std::vector<char> inside(mesh.num_hexes(), side == Side::Inside);
  if (side == Side::Both)
    for (HexId h : mesh.hexes.ids()) inside[h.index()] = mesh.region[h] != kOutsideRegion;
  return inside;
}

bool FitState::is_fitted_face(const HexFace& face) const {
  const HexId other = neighbors.neighbor[face.hex][static_cast<std::size_t>(face.lf)];
  if (side == Side::Both) {
    const std::int32_t here = mesh.region[face.hex];
    if (here == kOutsideRegion) return false;
    const std::int32_t there = other.is_valid() ? mesh.region[other] : kOutsideRegion;
    if (there == here || (there != kOutsideRegion && there < here)) return false;
  } else if (other.is_valid()) {
    return false;
  }
  const auto quad = face_verts(mesh, face);
  return std::any_of(quad.begin(), quad.end(), [&](VertId v) { return move[v] == MoveIn::Space; });
}

void FitState::find_quads() {
  quad_face.clear();
  quads.clear();
  for (HexId h : mesh.hexes.ids()) {
    for (int lf = 0; lf < 6; ++lf) {
      const HexFace face{h, lf};
      if (!is_fitted_face(face)) continue;
      auto quad = face_verts(mesh, face);
      if (side == Side::Outside) std::swap(quad[1], quad[3]);
      quad_face.push_back(face);
      quads.push_back(quad);
    }
  }
}

void FitState::rebuild() {
  resize_arrays();
  derive(VertToHex(mesh));
  neighbors = compute_hex_neighbors(mesh);
  find_quads();
  for (const auto& quad : quads)
    for (VertId v : quad)
      if (kind[v] == VertKind::Interior) kind[v] = VertKind::Surface;
  update_sizes();
  mark_all_dirty();
}

void FitState::update_sizes() {
  const auto length = compute_edge_lengths(IdSpan<VertId, const Vec3>(mesh.positions),
                                           IdSpan<QuadId, const std::array<VertId, 4>>(quads));
  size = mean_edge_lengths(*this);
  for (VertId v : size.ids())
    if (length[v] > 0) size[v] = length[v];
}

}  // namespace hexwright::relax
