// Writes LS-DYNA keyword files (.k): solid elements, parts, segment sets and node sets.
//
// A region is a part; a patch is a segment set and, with the same number, a node set; curves and
// corners are node sets. Sections and materials are left to the user: parts refer to number 0.
//
// Based on: LST, "LS-DYNA Keyword User's Manual", volume I: *NODE (I8, 3E16), *ELEMENT_SOLID
// (10I8), *SET_SEGMENT and *SET_NODE_LIST (fields of 10).
#include "io/solver/solver_formats.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

void write_nodes_and_elements(const HexMesh& mesh, const SetTable& table, TextWriter& out) {
  out.text("*NODE\n");
  for (VertId v : mesh.positions.ids()) {
    out.integer_in(8, v.value() + 1);
    for (int axis = 0; axis < 3; ++axis) out.real_in(16, mesh.positions[v][axis]);
    out.text("\n");
  }
  for (std::size_t r = 0; r < table.regions.size(); ++r) {
    out.text("*PART\n").text(table.regions[r].name).text("\n").integer_in(10, r + 1);
    out.integer_in(10, 0).integer_in(10, 0).text("\n");
  }
  out.text("*ELEMENT_SOLID\n");
  for (std::size_t r = 0; r < table.regions.size(); ++r)
    for (std::size_t h : table.regions[r].members) {
      out.integer_in(8, h + 1).integer_in(8, r + 1);
      for (VertId v : mesh.hexes[HexId(h)]) out.integer_in(8, v.value() + 1);
      out.text("\n");
    }
}

void write_segments(const HexMesh& mesh, const NamedSet& patch, std::size_t number,
                    TextWriter& out) {
  out.text("*SET_SEGMENT_TITLE\n").text(patch.name).text("\n").integer_in(10, number).text("\n");
  for (std::size_t q : patch.members) {
    for (VertId v : mesh.labels.quads[q].verts) out.integer_in(10, v.value() + 1);
    out.text("\n");
  }
}

void write_node_list(const HexMesh& mesh, const NamedSet& set, std::size_t number,
                     TextWriter& out) {
  out.text("*SET_NODE_LIST_TITLE\n").text(set.name).text("\n").integer_in(10, number).text("\n");
  out.lines(8, "", set_nodes(mesh, set), [&](VertId v) { out.integer_in(10, v.value() + 1); });
}

}  // namespace

/// Titles may hold anything but '$' and '*' in front, which begin comments and keywords.
NameRules lsdyna_names() {
  NameRules rules;
  rules.max_length = 70;
  rules.is_allowed = is_word_letter_or_mark;
  rules.starts_with_letter = true;
  return rules;
}

std::string lsdyna_text(const HexMesh& mesh, const SetTable& table) {
  TextWriter out;
  out.text("*KEYWORD\n*TITLE\nhexwright\n");
  write_nodes_and_elements(mesh, table, out);
  std::size_t number = 0;
  for (const auto* sets : {&table.patches, &table.patch_groups})
    for (const NamedSet& patch : *sets) {
      write_segments(mesh, patch, ++number, out);
      write_node_list(mesh, patch, number, out);
    }
  for (const auto* sets : {&table.curves, &table.corners})
    for (const NamedSet& set : *sets) write_node_list(mesh, set, ++number, out);
  out.text("*END\n");
  return out.take();
}

}  // namespace hexwright::io
