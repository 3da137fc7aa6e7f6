// A counting sort by label, and the hex behind each quad.
#include "facets.h"

#include <algorithm>

#include "hexwright/io/set_table.h"

namespace hexwright::python {
namespace {

template <std::size_t N, class Element, class Label>
LabelTable<N> sort_by_label(const std::vector<Element>& elements, Label&& label) {
  std::size_t num_labels = 0;
  for (const Element& e : elements)
    if (label(e).is_valid()) num_labels = std::max(num_labels, label(e).index() + 1);
  const auto slot = [&](const Element& e) {
    return label(e).is_valid() ? label(e).index() : num_labels;
  };
  std::vector<std::size_t> start(num_labels + 2, 0);
  for (const Element& e : elements) ++start[slot(e) + 1];
  for (std::size_t k = 0; k <= num_labels; ++k) start[k + 1] += start[k];
  start.pop_back();
  LabelTable<N> table{std::vector<std::array<VertId, N>>(elements.size()), start};
  for (const Element& e : elements) table.verts[start[slot(e)]++] = e.verts;
  return table;
}

bool runs_alike(const std::array<VertId, 4>& a, std::array<VertId, 4> b) {
  std::rotate(b.begin(), std::find(b.begin(), b.end(), a[0]), b.end());
  return a[1] == b[1];
}

/// The face of a hex that is the quad; an invalid hex when there is none.
HexFace find_owner(const HexMesh& mesh, const VertToHex& vert_to_hex,
                   const std::array<VertId, 4>& quad) {
  const auto faces = find_quad_faces(mesh, vert_to_hex, quad);
  const auto alike = std::find_if(faces.begin(), faces.end(), [&](const HexFace& face) {
    return runs_alike(quad, face_verts(mesh, face));
  });
  return alike != faces.end() ? *alike : faces.empty() ? HexFace{} : faces.front();
}

}  // namespace

FacetTable sort_facets(const HexMesh& mesh) {
  FacetTable table;
  table.quads =
      sort_by_label<4>(mesh.labels.quads, [](const LabeledQuad& quad) { return quad.patch; });
  const VertToHex vert_to_hex(mesh);
  for (const auto& quad : table.quads.verts) {
    const HexFace face = find_owner(mesh, vert_to_hex, quad);
    table.owner.push_back(face.hex);
    table.side.push_back(static_cast<std::int8_t>(face.lf));
  }
  return table;
}

LabelTable<2> sort_curves(const HexMesh& mesh) {
  return sort_by_label<2>(mesh.labels.edges, [](const LabeledEdge& edge) { return edge.curve; });
}

}  // namespace hexwright::python
