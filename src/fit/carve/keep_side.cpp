#include "fit/carve/keep_side.h"

#include "hexwright/fit/carve.h"

#include "mesh/quad.h"

namespace hexwright::fitting {

using namespace relax;
namespace {

// The background's outer faces on the kept mesh: hexes keep their order, faces their numbers.
std::vector<HexFace> outer_faces(const HexMesh& background, const std::vector<char>& is_kept) {
  IdVector<HexId, HexId> old_to_new(background.num_hexes());
  std::size_t count = 0;
  for (HexId h : background.hexes.ids())
    if (is_kept[h.index()]) old_to_new[h] = HexId(count++);
  std::vector<HexFace> faces;
  for (const HexFace& face : compute_hex_neighbors(background).boundary)
    if (is_kept[face.hex.index()]) faces.push_back({old_to_new[face.hex], face.lf});
  return faces;
}

// Adds the plane with this normal to what holds a vertex.
void hold_in_plane(FitState& state, VertId v, const Vec3& normal) {
  constexpr double kParallel = 1 - 1e-6;
  MoveIn& move = state.move[v];
  Vec3& axis = state.axis[v];
  if (move == MoveIn::Space) {
    move = MoveIn::Plane;
    axis = normal;
  } else if (move == MoveIn::Plane && std::abs(dot(axis, normal)) < kParallel) {
    move = MoveIn::Line;
    axis = normalized(cross(axis, normal));
  } else if (move == MoveIn::Line && std::abs(dot(axis, normal)) > 1e-3) {
    move = MoveIn::Point;
  }
}

void hold_outer_boundary(FitState& state, const std::vector<HexFace>& faces) {
  for (const HexFace& face : faces) {
    const auto quad = face_verts(state.mesh, face);
    const Vec3 normal = quad_normal(state.mesh.positions, quad);
    for (VertId v : quad) hold_in_plane(state, v, normal);
  }
}

}  // namespace

FitState keep_side(const HexMesh& background, const std::vector<char>& is_inside, Side side) {
  std::vector<char> is_kept = is_inside;
  if (side != Side::Inside)
    for (char& kept : is_kept) kept = side == Side::Both || !kept;
  HexMesh part = extract_hexes(background, is_kept);
  if (side == Side::Both) {
    part.region.resize(part.num_hexes());
    for (HexId h : part.hexes.ids())
      part.region[h] = is_inside[h.index()] ? FitState::kInsideRegion : FitState::kOutsideRegion;
  }
  FitState state(std::move(part));
  if (side == Side::Inside) return state;
  state.side = side;
  hold_outer_boundary(state, outer_faces(background, is_kept));
  state.kind.assign(state.num_verts(), VertKind::Interior);
  state.rebuild();
  return state;
}

}  // namespace hexwright::fitting
