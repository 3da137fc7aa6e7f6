// Writes Abaqus input files (.inp), which CalculiX reads too: C3D8 or C3D20 elements and named
// sets.
//
// Element sets per region and EALL of all; per patch an element-face surface and a node set with
// _NODES behind its name; node sets of curves and corners. Coordinates have 13 digits, because
// CalculiX reads at most 20 characters of a number.
#include "io/solver/solver_formats.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

// Number of the face S1..S6 of a C3D8 for each of our local faces -x +x -y +y -z +z.
// Dassault Systemes, "Abaqus Elements Guide", "Three-dimensional solid element library": S1 is
// nodes 1-2-3-4, S2 5-8-7-6, S3 1-5-6-2, S4 2-6-7-3, S5 3-7-8-4, S6 4-8-5-1.
constexpr std::array<int, 6> kAbaqusFace = {6, 4, 3, 5, 1, 2};

void write_node_set(TextWriter& out, const std::string& name, const std::vector<VertId>& nodes) {
  out.text("*NSET, NSET=").text(name).text("\n");
  out.lines(8, ", ", nodes, [&](VertId v) { out.integer(v.value() + 1); });
}

/// A line takes 16 numbers; one that goes on ends with a comma.
void write_element(HexId h, const NodeList& nodes, TextWriter& out) {
  constexpr std::size_t kPerLine = 16;
  out.integer(h.value() + 1);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    out.text(k + 1 == kPerLine ? ",\n" : ", ").integer(nodes[k].value() + 1);
  out.text("\n");
}

void write_nodes_and_elements(const NodeTable& nodes, const SetTable& table, TextWriter& out) {
  out.text("*HEADING\nhexwright\n*NODE\n");
  const auto& positions = nodes.positions();
  for (VertId v : positions.ids()) {
    out.integer(v.value() + 1);
    for (int axis = 0; axis < 3; ++axis) out.text(", ").real_rounded(positions[v][axis], 12);
    out.text("\n");
  }
  for (const NamedSet& region : table.regions) {
    out.text("*ELEMENT, TYPE=").text(nodes.is_linear() ? "C3D8" : "C3D20");
    out.text(", ELSET=").text(region.name).text("\n");
    for (std::size_t h : region.members) write_element(HexId(h), nodes.hex(HexId(h)), out);
  }
  out.text("*ELSET, ELSET=EALL\n");
  for (const NamedSet& region : table.regions) out.text(region.name).text("\n");
}

void write_quad_set(const NodeTable& nodes, const NamedSet& patch,
                    const std::vector<HexFace>& sides, TextWriter& out) {
  write_node_set(out, patch.name + "_NODES", nodes.set_nodes(patch));
  out.text("*SURFACE, NAME=").text(patch.name).text(", TYPE=ELEMENT\n");
  for (std::size_t q : patch.members)
    out.integer(sides[q].hex.value() + 1)
        .text(", S")
        .integer(kAbaqusFace[static_cast<std::size_t>(sides[q].lf)])
        .text("\n");
}

}  // namespace

/// Names in quotes could hold more, but CalculiX knows no quotes.
NameRules abaqus_names() {
  NameRules rules;
  rules.max_length = 80;
  rules.is_allowed = is_word_letter;
  rules.starts_with_letter = true;
  rules.ignores_case = true;
  rules.suffix = "_NODES";
  rules.reserved = {"EALL"};
  return rules;
}

std::string abaqus_text(const NodeTable& nodes, const SetTable& table) {
  const std::vector<HexFace> sides = find_quad_sides(nodes.mesh());
  TextWriter out;
  write_nodes_and_elements(nodes, table, out);
  for (const auto* patches : {&table.patches, &table.patch_groups})
    for (const NamedSet& patch : *patches) write_quad_set(nodes, patch, sides, out);
  for (const auto* sets : {&table.curves, &table.corners})
    for (const NamedSet& set : *sets) write_node_set(out, set.name, nodes.set_nodes(set));
  return out.take();
}

}  // namespace hexwright::io
