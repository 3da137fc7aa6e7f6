// Writes SU2 meshes (.su2): hexahedra and one marker per patch.
//
// Every outer face has a marker, faces without a label the marker "unlabeled". The format has no
// regions, no inner faces and no sets of edges or points.
//
// Based on: SU2, "Mesh file", the documentation of the native format; elements are numbered as in
// VTK.
#include "io/solver/boundary_sides.h"
#include "io/solver/solver_formats.h"
#include "io/text/text_writer.h"

namespace hexwright::io {

NameRules su2_names() {
  NameRules rules;
  rules.is_allowed = is_word_letter_or_mark;
  rules.is_unique_per_kind = true;
  return rules;
}

std::string su2_text(const HexMesh& mesh, const SetTable& table) {
  constexpr int kQuad = 9, kHexahedron = 12;
  const BoundarySides sides = find_boundary_sides(mesh, table);
  TextWriter out;
  out.text("NDIME= 3\nNELEM= ").integer(mesh.num_hexes()).text("\n");
  for (HexId h : mesh.hexes.ids())
    out.integer(kHexahedron)
        .text(" ")
        .indices(mesh.hexes[h], 0)
        .text(" ")
        .integer(h.value())
        .text("\n");
  out.text("NPOIN= ").integer(mesh.num_verts()).text("\n");
  for (VertId v : mesh.positions.ids())
    out.point(mesh.positions[v]).text(" ").integer(v.value()).text("\n");
  std::vector<std::vector<HexFace>> faces(table.patches.size() + 1);
  for (const BoundarySide& side : sides.outer) faces[side.patch].push_back(side.face);
  std::size_t num_markers = 0;
  for (const auto& of_patch : faces) num_markers += !of_patch.empty();
  out.text("NMARK= ").integer(num_markers).text("\n");
  for (std::size_t p = 0; p < faces.size(); ++p) {
    if (faces[p].empty()) continue;
    const bool is_labeled = p < table.patches.size();
    out.text("MARKER_TAG= ").text(is_labeled ? table.patches[p].name : sides.unlabeled_name);
    out.text("\nMARKER_ELEMS= ").integer(faces[p].size()).text("\n");
    for (const HexFace& face : faces[p])
      out.integer(kQuad).text(" ").indices(face_verts(mesh, face), 0).text("\n");
  }
  return out.take();
}

}  // namespace hexwright::io
