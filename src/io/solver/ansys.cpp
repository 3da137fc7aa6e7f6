// Writes archives of Ansys Mechanical APDL (.cdb): SOLID185 elements, of second order
// SOLID186, and components.
//
// A region is an element component, and the material number of its elements; patches, curves and
// corners are node components (the format has no sets of faces: loads go on the nodes of a face).
//
// Based on: Ansys, "Mechanical APDL Command Reference", CDWRITE and CMBLOCK; "Programmer's
// Reference", chapter 3, NBLOCK and EBLOCK.
#include "io/solver/solver_formats.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

/// Field of 21 characters with 13 digits and an exponent of three, as "(6e21.13e3)" says.
void write_real(double value, TextWriter& out) {
  TextWriter plain;
  const std::string text = plain.real_rounded(value, 13).take();
  const std::string_view all = text;
  const std::size_t e = all.find('e');
  const bool is_short = all.size() - e == 4;  // "e+05" and not "e+105"
  out.text(std::string(21 - all.size() - (is_short ? 1 : 0), ' ')).text(all.substr(0, e));
  out.text("E").text(all.substr(e + 1, 1)).text(is_short ? "0" : "").text(all.substr(e + 2));
}

void write_nodes(const IdVector<VertId, Vec3>& positions, TextWriter& out) {
  const std::size_t count = positions.size();
  out.text("NBLOCK,6,SOLID,").integer(count).text(",").integer(count);
  out.text("\n(3i9,6e21.13e3)\n");
  for (VertId v : positions.ids()) {
    out.integer_in(9, v.value() + 1).integer_in(9, 0).integer_in(9, 0);
    for (int axis = 0; axis < 3; ++axis) write_real(positions[v][axis], out);
    out.text("\n");
  }
  out.text("N,R5.3,LOC,       -1,\n");
}

/// Fields: material, type, real constants, section, system, birth, solid model, shape, number of
/// nodes, an unused one, the element's number and its nodes, those beyond the eighth on a second
/// line.
void write_elements(const NodeTable& nodes, const SetTable& table, TextWriter& out) {
  const HexMesh& mesh = nodes.mesh();
  const std::size_t count = mesh.num_hexes();
  std::vector<std::size_t> material(count);
  for (std::size_t r = 0; r < table.regions.size(); ++r)
    for (std::size_t h : table.regions[r].members) material[h] = r + 1;
  out.text("EBLOCK,19,SOLID,").integer(count).text(",").integer(count).text("\n(19i9)\n");
  for (HexId h : mesh.hexes.ids()) {
    out.integer_in(9, material[h.index()]);
    for (int field : {1, 1, 1, 0, 0, 0, 0, nodes.nodes_per_hex(), 0}) out.integer_in(9, field);
    out.integer_in(9, h.value() + 1);
    const NodeList list = nodes.hex(h);
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (k == 8) out.text("\n");
      out.integer_in(9, list[k].value() + 1);
    }
    out.text("\n");
  }
  out.text("       -1\n");
}

void write_component(const std::string& name, const char* kind, const std::vector<std::size_t>& ids,
                     TextWriter& out) {
  out.text("CMBLOCK,").text(name).text(",").text(kind).text(",").integer(ids.size());
  out.text("\n(8i10)\n");
  out.lines(8, "", ids, [&](std::size_t id) { out.integer_in(10, id + 1); });
}

}  // namespace

NameRules ansys_names() {
  NameRules rules;
  rules.max_length = 32;
  rules.is_allowed = is_word_letter;
  rules.starts_with_letter = true;
  rules.ignores_case = true;
  rules.is_upper_case = true;
  rules.reserved = {"ALL", "STAT", "DEFA"};
  return rules;
}

std::string ansys_text(const NodeTable& nodes, const SetTable& table) {
  TextWriter out;
  out.text("/COM,hexwright\n/PREP7\n/NOPR\nET,1,").text(nodes.is_linear() ? "185\n" : "186\n");
  write_nodes(nodes.positions(), out);
  write_elements(nodes, table, out);
  for (const NamedSet& region : table.regions)
    write_component(region.name, "ELEM", region.members, out);
  for (const auto* sets : {&table.patches, &table.patch_groups, &table.curves, &table.corners})
    for (const NamedSet& set : *sets) {
      std::vector<std::size_t> members;
      for (VertId v : nodes.set_nodes(set)) members.push_back(v.index());
      write_component(set.name, "NODE", members, out);
    }
  out.text("/GO\nFINISH\n");
  return out.take();
}

}  // namespace hexwright::io
