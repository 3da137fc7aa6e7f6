// Writes MFEM meshes, version 1.3, whose attribute sets carry names.
//
// Attributes of elements are the regions, those of boundary elements the patches, both counted from
// 1 in increasing order of their numbers; the format has no sets of edges or points.
//
// A mesh of second order has its nodes as a function in H1 of degree 2: at vertices, edges, faces
// and hexes, each in the order in which the library numbers them, which is that of their first hex.
//
// Based on: "MFEM mesh formats", section "MFEM mesh v1.0" and "v1.3" of the library's
// documentation. Its cube and square have our local order.
#include <utility>

#include "io/solver/boundary_sides.h"
#include "io/solver/mfem_order.h"
#include "io/solver/solver_formats.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

constexpr int kSquare = 3, kCube = 5;

void write_name(const std::string& name, std::size_t attribute, TextWriter& out) {
  out.text("\"").text(name).text("\" 1 ").integer(attribute).text("\n");
}

void write_elements(const HexMesh& mesh, const SetTable& table, TextWriter& out) {
  std::vector<std::size_t> attribute(mesh.num_hexes());
  for (std::size_t r = 0; r < table.regions.size(); ++r)
    for (std::size_t h : table.regions[r].members) attribute[h] = r + 1;
  out.text("\nelements\n").integer(mesh.num_hexes()).text("\n");
  for (HexId h : mesh.hexes.ids())
    out.integer(attribute[h.index()])
        .text(" ")
        .integer(kCube)
        .text(" ")
        .indices(mesh.hexes[h], 0)
        .text("\n");
  out.text("\nattribute_sets\n").integer(table.regions.size()).text("\n");
  for (std::size_t r = 0; r < table.regions.size(); ++r)
    write_name(table.regions[r].name, r + 1, out);
}

/// The attributes of the patches that a group is made of.
std::vector<std::size_t> attributes_of(const NamedSet& group, const SetTable& table) {
  std::vector<std::size_t> attributes;
  for (std::size_t p = 0; p < table.patches.size(); ++p)
    if (is_in_group(table.patches[p], group)) attributes.push_back(p + 1);
  return attributes;
}

void write_boundary_names(const SetTable& table, const BoundarySides& sides, TextWriter& out) {
  const std::size_t num_patches = table.patches.size();
  out.text("\nbdr_attribute_sets\n")
      .integer(num_patches + table.patch_groups.size() + (sides.has_unlabeled ? 1 : 0))
      .text("\n");
  for (std::size_t p = 0; p < num_patches; ++p) write_name(table.patches[p].name, p + 1, out);
  if (sides.has_unlabeled) write_name(sides.unlabeled_name, num_patches + 1, out);
  for (const NamedSet& group : table.patch_groups) {
    const auto attributes = attributes_of(group, table);
    out.text("\"").text(group.name).text("\" ").integer(attributes.size());
    for (std::size_t a : attributes) out.text(" ").integer(a);
    out.text("\n");
  }
}

void write_square(std::size_t attribute, const std::array<VertId, 4>& verts, TextWriter& out) {
  out.integer(attribute).text(" ").integer(kSquare).text(" ").indices(verts, 0).text("\n");
}

void write_nodes(const NodeTable& nodes, TextWriter& out) {
  const HexMesh& mesh = nodes.mesh();
  out.text(
      "\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1_3D_P2\nVDim: 3\nOrdering: 1\n\n");
  const auto put = [&](VertId v) { out.point(nodes.positions()[v]).text("\n"); };
  const std::size_t first_face = mesh.num_verts() + mesh.mid_nodes->edges.size();
  for (std::size_t v = 0; v < first_face; ++v) put(VertId(v));
  std::vector<char> is_put(nodes.size(), 0);
  for (HexId h : mesh.hexes.ids())
    for (int lf : kMfemFaces) {
      const VertId v = nodes.face({h, lf});
      if (std::exchange(is_put[v.index()], 1) == 0) put(v);
    }
  for (HexId h : mesh.hexes.ids()) put(nodes.middle(h));
}

}  // namespace

NameRules mfem_names() {
  NameRules rules;
  rules.is_allowed = [](char c) { return c != '"'; };
  rules.is_unique_per_kind = true;
  return rules;
}

std::string mfem_text(const NodeTable& nodes, const SetTable& table) {
  const HexMesh& mesh = nodes.mesh();
  const BoundarySides sides = find_boundary_sides(mesh, table);
  TextWriter out;
  out.text("MFEM mesh v1.3\n\ndimension\n3\n");
  write_elements(mesh, table, out);
  out.text("\nboundary\n").integer(sides.outer.size() + sides.inner.size()).text("\n");
  for (const BoundarySide& side : sides.outer)
    write_square(side.patch + 1, face_verts(mesh, side.face), out);
  for (const InnerSide& side : sides.inner)
    write_square(side.patch + 1, mesh.labels.quads[side.quad].verts, out);
  write_boundary_names(table, sides, out);
  out.text("\nvertices\n").integer(mesh.num_verts()).text("\n");
  if (nodes.is_linear()) {
    out.text("3\n");
    for (const Vec3& p : mesh.positions) out.point(p).text("\n");
  } else {
    write_nodes(nodes, out);
  }
  out.text("mfem_mesh_end\n");
  return out.take();
}

}  // namespace hexwright::io
