// Writes Abaqus input files (.inp), which CalculiX reads too: C3D8 elements and named sets.
//
// Element sets REGION_r; element-face surfaces PATCH_p with node sets PATCH_p_NODES; node sets
// CURVE_c and CORNERS. Coordinates have 13 digits, because CalculiX reads at most 20 characters of
// a number.
#include <algorithm>

#include "io/mesh/element_sets.h"
#include "io/mesh/volume_file.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

// Number of the face S1..S6 of a C3D8 for each of our local faces -x +x -y +y -z +z.
// Dassault Systemes, "Abaqus Elements Guide", "Three-dimensional solid element library": S1 is
// nodes 1-2-3-4, S2 5-8-7-6, S3 1-5-6-2, S4 2-6-7-3, S5 3-7-8-4, S6 4-8-5-1.
constexpr std::array<int, 6> kAbaqusFace = {6, 4, 3, 5, 1, 2};

void write_node_set(TextWriter& out, const std::string& name, std::vector<VertId> nodes) {
  constexpr std::size_t kPerLine = 8;
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  out.text("*NSET, NSET=").text(name).text("\n");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool is_line_end = i % kPerLine + 1 == kPerLine || i + 1 == nodes.size();
    out.integer(nodes[i].value() + 1).text(is_line_end ? "\n" : ", ");
  }
}

template <class Elements>
std::vector<VertId> nodes_of(const Elements& elements, const std::vector<std::size_t>& which) {
  std::vector<VertId> nodes;
  for (std::size_t i : which)
    nodes.insert(nodes.end(), elements[i].verts.begin(), elements[i].verts.end());
  return nodes;
}

void write_nodes_and_elements(const HexMesh& mesh, const LabelSets& sets, TextWriter& out) {
  out.text("*HEADING\nhexwright\n*NODE\n");
  for (VertId v : mesh.positions.ids()) {
    out.integer(v.value() + 1);
    for (int axis = 0; axis < 3; ++axis) out.text(", ").real_rounded(mesh.positions[v][axis], 12);
    out.text("\n");
  }
  for (const auto& [region, hexes] : sets.hexes_of_region) {
    out.text("*ELEMENT, TYPE=C3D8, ELSET=").text(set_name("REGION", region)).text("\n");
    for (std::size_t h : hexes) {
      out.integer(h + 1);
      for (VertId v : mesh.hexes[HexId(h)]) out.text(", ").integer(v.value() + 1);
      out.text("\n");
    }
  }
}

}  // namespace

std::string abaqus_text(const HexMesh& mesh) {
  const LabelSets sets = group_labels(mesh);
  const std::vector<HexFace> faces = find_quad_faces(mesh);
  TextWriter out;
  write_nodes_and_elements(mesh, sets, out);
  for (const auto& [patch, quads] : sets.quads_of_patch) {
    const std::string name = set_name("PATCH", patch);
    write_node_set(out, name + "_NODES", nodes_of(mesh.labels.quads, quads));
    out.text("*SURFACE, NAME=").text(name).text(", TYPE=ELEMENT\n");
    for (std::size_t q : quads)
      out.integer(faces[q].hex.value() + 1)
          .text(", S")
          .integer(kAbaqusFace[static_cast<std::size_t>(faces[q].lf)])
          .text("\n");
  }
  for (const auto& [curve, edges] : sets.edges_of_curve)
    write_node_set(out, set_name("CURVE", curve), nodes_of(mesh.labels.edges, edges));
  if (!mesh.labels.corners.empty()) write_node_set(out, "CORNERS", mesh.labels.corners);
  return out.take();
}

}  // namespace hexwright::io
