// Writes Nastran bulk data (.bdf): CHEXA elements, property numbers, face lists and sets.
//
// A region is a PSOLID (its material is left to the user); a patch is a BSURFS, which lists faces
// of elements by three of their grid points, and a SET1 of its grid points with the same number;
// curves and corners are SET1. The format numbers sets: names stand in comments before them.
//
// Based on: MSC, "Nastran Quick Reference Guide": GRID* (fields of 16), CHEXA, PSOLID, SET1,
// BSURFS.
#include "io/solver/solver_formats.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

/// Fields of 8 characters, eight to a line after the name; lines that go on end with '+', and the
/// next begins with it.
class Card {
 public:
  Card(TextWriter& out, std::string name) : out_(out) {
    name.resize(8, ' ');
    out_.text(name);
  }
  ~Card() { out_.text("\n"); }
  Card(const Card&) = delete;
  Card& operator=(const Card&) = delete;
  Card& field(std::size_t value) {
    begin_field();
    out_.integer_in(8, value);
    return *this;
  }
  Card& empty_field() {
    begin_field();
    out_.text("        ");
    return *this;
  }

 private:
  void begin_field() {
    if (num_fields_ > 0 && num_fields_ % 8 == 0) out_.text("+\n+       ");
    ++num_fields_;
  }
  TextWriter& out_;
  int num_fields_ = 0;
};

std::size_t number(VertId v) { return v.index() + 1; }

void write_grid(const IdVector<VertId, Vec3>& positions, TextWriter& out) {
  for (VertId v : positions.ids()) {
    const Vec3& p = positions[v];
    out.text("GRID*   ").integer_in(16, number(v)).text("                ");
    out.real_in(16, p.x).real_in(16, p.y).text("\n*       ").real_in(16, p.z).text("\n");
  }
}

void write_elements(const NodeTable& nodes, const SetTable& table, TextWriter& out) {
  for (std::size_t r = 0; r < table.regions.size(); ++r) {
    out.text("$ region ").integer(r + 1).text(" ").text(table.regions[r].name).text("\n");
    Card(out, "PSOLID").field(r + 1).field(1);
    for (std::size_t h : table.regions[r].members) {
      Card card(out, "CHEXA");
      card.field(h + 1).field(r + 1);
      const NodeList list = nodes.hex(HexId(h));
      for (std::size_t k = 0; k < list.size(); ++k) card.field(number(list[kUprightEdgesFirst[k]]));
    }
  }
}

void write_faces(const HexMesh& mesh, const NamedSet& patch, std::size_t id,
                 const std::vector<HexFace>& sides, TextWriter& out) {
  out.text("$ patch ").integer(id).text(" ").text(patch.name).text("\n");
  Card card(out, "BSURFS");
  card.field(id).empty_field().empty_field().empty_field();
  for (std::size_t q : patch.members) {
    const auto verts = face_verts(mesh, sides[q]);
    card.field(sides[q].hex.index() + 1);
    card.field(number(verts[0])).field(number(verts[1])).field(number(verts[2]));
  }
}

void write_set(const NodeTable& nodes, const NamedSet& set, std::size_t id, TextWriter& out) {
  out.text("$ set ").integer(id).text(" ").text(set.name).text("\n");
  Card card(out, "SET1");
  card.field(id);
  for (VertId v : nodes.set_nodes(set)) card.field(number(v));
}

}  // namespace

NameRules nastran_names() {
  NameRules rules;
  rules.max_length = 60;
  rules.is_allowed = is_word_letter_or_mark;
  return rules;
}

std::string nastran_text(const NodeTable& nodes, const SetTable& table) {
  const HexMesh& mesh = nodes.mesh();
  const std::vector<HexFace> sides = find_quad_sides(mesh);
  TextWriter out;
  out.text("$ hexwright\nSOL 101\nCEND\nBEGIN BULK\n");
  write_grid(nodes.positions(), out);
  write_elements(nodes, table, out);
  std::size_t id = 0;
  for (const auto* sets : {&table.patches, &table.patch_groups})
    for (const NamedSet& patch : *sets) {
      write_faces(mesh, patch, ++id, sides, out);
      write_set(nodes, patch, id, out);
    }
  for (const auto* sets : {&table.curves, &table.corners})
    for (const NamedSet& set : *sets) write_set(nodes, set, ++id, out);
  out.text("ENDDATA\n");
  return out.take();
}

}  // namespace hexwright::io
