// Based on: Mitchell, Tautges, "Pillowing doublets", 1995. Differs: the copies start on directions
// that see all faces around them, so that a thin enough layer is always valid.
#include "fit/pad_boundary.h"

#include "hexwright/base/error.h"

#include "fit/insert_sheet.h"
#include "fit/set_check.h"

namespace hexwright::fitting {

void pad_boundary(FitState& state) {
  const std::vector<char> all(state.mesh.num_hexes(), 1);
  SetCheck check(state.mesh, state.vert_to_hex, state.neighbors, true);
  Sheet sheet;
  sheet.quads = state.quads;
  for (const HexFace& face : state.quad_face) sheet.behind.push_back(face.hex);
  sheet.verts = sheet_verts(sheet.quads);
  for (VertId v : sheet.verts) {
    const VisibleDirection visible = check.direction(v, all);
    if (!(visible.cosine > 0)) {
      throw Error(ErrorCode::BadGeometry,
                  "no direction sees all boundary faces around the vertex; thicken the mesh there "
                  "or carve it anew",
                  "vertex " + std::to_string(v.value()));
    }
    sheet.directions.push_back(visible.direction);
  }
  const auto copies = insert_sheet(state.mesh, state.vert_to_hex, sheet, {}, 1e-7);
  if (copies.empty() && !sheet.quads.empty())
    throw Error(ErrorCode::BadGeometry, "the boundary layer cannot be made thin enough");
  state.rebuild();
}

}  // namespace hexwright::fitting
