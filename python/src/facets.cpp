// A counting sort by label, and the hex behind each quad.
#include "facets.h"

#include <algorithm>

#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright::python {
namespace {

/// Where each element goes, and where each label begins; elements without a label go last.
struct Order {
  std::vector<std::size_t> element_to_place;
  std::vector<std::size_t> start;
};

template <class Elements, class Label>
Order order_by_label(const Elements& elements, Label&& label) {
  std::size_t num_labels = 0;
  for (const auto& e : elements)
    if (label(e).is_valid()) num_labels = std::max(num_labels, label(e).index() + 1);
  const auto slot = [&](const auto& e) {
    return label(e).is_valid() ? label(e).index() : num_labels;
  };
  Order order;
  std::vector<std::size_t> count(num_labels + 1, 0);
  for (const auto& e : elements) ++count[slot(e)];
  order.start.assign(num_labels + 1, 0);
  for (std::size_t k = 0; k < num_labels; ++k) order.start[k + 1] = order.start[k] + count[k];
  std::vector<std::size_t> next = order.start;
  for (const auto& e : elements) order.element_to_place.push_back(next[slot(e)]++);
  return order;
}

bool is_same_quad(std::array<VertId, 4> a, std::array<VertId, 4> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

bool runs_alike(const std::array<VertId, 4>& a, std::array<VertId, 4> b) {
  std::rotate(b.begin(), std::find(b.begin(), b.end(), a[0]), b.end());
  return a[1] == b[1];
}

/// The face of a hex that is the quad; an invalid hex when there is none.
HexFace find_owner(const HexMesh& mesh, const VertToHex& vert_to_hex,
                   const std::array<VertId, 4>& quad) {
  HexFace owner;
  for (const HexCorner& corner : vert_to_hex[quad[0]])
    for (int lf = 0; lf < 6; ++lf) {
      const HexFace face{corner.hex, lf};
      const auto verts = face_verts(mesh, face);
      if (!is_same_quad(verts, quad)) continue;
      if (runs_alike(quad, verts)) return face;
      owner = face;
    }
  return owner;
}

}  // namespace

FacetTable sort_facets(const HexMesh& mesh) {
  const auto& quads = mesh.labels.quads;
  const Order order = order_by_label(quads, [](const LabeledQuad& q) { return q.patch; });
  FacetTable table;
  table.start = order.start;
  table.quads.resize(quads.size());
  table.owner.resize(quads.size());
  table.side.resize(quads.size());
  const VertToHex vert_to_hex(mesh);
  for (std::size_t i = 0; i < quads.size(); ++i) {
    const std::size_t place = order.element_to_place[i];
    for (std::size_t k = 0; k < 4; ++k) table.quads[place][k] = quads[i].verts[k].value();
    const HexFace face = find_owner(mesh, vert_to_hex, quads[i].verts);
    table.owner[place] = face.hex.value();
    table.side[place] = static_cast<std::int8_t>(face.lf);
  }
  return table;
}

CurveTable sort_curves(const HexMesh& mesh) {
  const auto& edges = mesh.labels.edges;
  const Order order = order_by_label(edges, [](const LabeledEdge& e) { return e.curve; });
  CurveTable table;
  table.start = order.start;
  table.edges.resize(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i)
    table.edges[order.element_to_place[i]] = {edges[i].verts[0].value(), edges[i].verts[1].value()};
  return table;
}

}  // namespace hexwright::python
