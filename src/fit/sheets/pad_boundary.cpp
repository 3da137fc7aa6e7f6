// Based on: Mitchell, Tautges, "Pillowing doublets", 1995. Differs: the copies start on directions
// that see all faces around them, so that a thin enough layer is always valid.
#include "fit/sheets/pad_boundary.h"

#include <optional>

#include "fit/carve/set_check.h"
#include "fit/sheets/insert_sheet.h"

namespace hexwright::fitting {

using namespace relax;

namespace {

// The sheet along the faces between the hexes `takes_copy` and what is beyond them; absent when
// some vertex's faces cannot be seen from any direction.
std::optional<Sheet> make_sheet(const FitState& state, const std::vector<char>& takes_copy) {
  SetCheck check(state.mesh, state.vert_to_hex, state.neighbors, true);
  Sheet sheet;
  for (HexFace face : state.quad_face) {
    if (!takes_copy[face.hex.index()]) {  // the same face seen from its other hex
      const HexId other = state.neighbors.neighbor[face.hex][static_cast<std::size_t>(face.lf)];
      int lf = 0;
      while (state.neighbors.neighbor[other][static_cast<std::size_t>(lf)] != face.hex) ++lf;
      face = {other, lf};
    }
    sheet.quads.push_back(face_verts(state.mesh, face));
    sheet.behind.push_back(face.hex);
  }
  sheet.verts = sheet_verts(sheet.quads);
  for (VertId v : sheet.verts) {
    const VisibleDirection visible = check.direction(v, takes_copy);
    if (!(visible.cosine > 0)) return {};
    sheet.directions.push_back(visible.direction);
  }
  return sheet;
}

bool pad_hexes(FitState& state, const std::vector<char>& takes_copy) {
  const auto sheet = make_sheet(state, takes_copy);
  if (!sheet) return false;
  const auto copies = insert_sheet(state.mesh, state.vert_to_hex, *sheet, takes_copy, 1e-7).copies;
  if (copies.empty() && !sheet->quads.empty()) return false;
  state.rebuild();
  return true;
}

}  // namespace

bool pad_boundary(FitState& state) {
  if (state.side != Side::Both)
    return pad_hexes(state, std::vector<char>(state.mesh.num_hexes(), 1));
  std::vector<char> half = state.inside_hexes();
  const bool inside = pad_hexes(state, half);
  half = state.inside_hexes();
  for (char& x : half) x = !x;
  const bool outside = pad_hexes(state, half);
  return inside && outside;
}

}  // namespace hexwright::fitting
