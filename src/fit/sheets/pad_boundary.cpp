// Based on: Mitchell, Tautges, "Pillowing doublets", 1995. Differs: the copies start on directions
// that see all faces around them, so that a thin enough layer is always valid.
#include "fit/sheets/pad_boundary.h"

#include <algorithm>
#include <optional>

#include "fit/sheets/insert.h"
#include "fit/sheets/visible.h"

namespace hexwright::fitting {

using namespace relax;

namespace {

/// The face of a boundary quad on the side of the hexes with a region tag; absent when neither has.
std::optional<HexFace> face_of_region(const FitState& state, const HexFace& face,
                                      std::int32_t region) {
  if (state.mesh.region[face.hex] == region) return face;
  const HexId other = state.neighbors.neighbor[face.hex][static_cast<std::size_t>(face.lf)];
  if (!other.is_valid() || state.mesh.region[other] != region) return {};
  const auto& around = state.neighbors.neighbor[other];
  return HexFace{
      other, static_cast<int>(std::find(around.begin(), around.end(), face.hex) - around.begin())};
}

/// False when some vertex's faces cannot be seen from any direction or no layer is thin enough.
bool apply(FitState& state, SheetPlan plan) {
  plan.sheet.collect_verts();
  for (const auto& visible : find_visible_directions(state.mesh, plan.sheet)) {
    if (!(visible.cosine > 0)) return false;
    plan.directions.push_back(visible.direction);
  }
  if (insert_sheet(state.mesh, state.vert_to_hex, plan).copies.empty() && !plan.sheet.quads.empty())
    return false;
  state.rebuild();
  return true;
}

bool pad_region(FitState& state, std::int32_t region) {
  SheetPlan plan;
  for (std::int32_t tag : state.mesh.region) plan.takes_copy.push_back(tag == region ? 1 : 0);
  for (const HexFace& face : state.quad_face)
    if (const auto seen = face_of_region(state, face, region))
      plan.sheet.add_face(state.mesh, *seen);
  return apply(state, std::move(plan));
}

}  // namespace

bool pad_boundary(FitState& state) {
  if (state.side != Side::Both) {
    SheetPlan plan;
    for (const HexFace& face : state.quad_face) plan.sheet.add_face(state.mesh, face);
    return apply(state, std::move(plan));
  }
  std::vector<std::int32_t> regions(state.mesh.region.begin(), state.mesh.region.end());
  std::sort(regions.begin(), regions.end());
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  bool is_padded = true;
  for (std::int32_t region : regions) is_padded &= pad_region(state, region);
  return is_padded;
}

}  // namespace hexwright::fitting
