// Writes the files of an OpenFOAM mesh, the folder polyMesh, as text.
//
// Regions are cellZones, patches the patches (a face without a label is in the patch "unlabeled"),
// labelled quads between hexes faceZones, curves and corners pointZones; patches "wall.1", "wall.2"
// are in the group "wall" too. A patch whose name holds "wall" has the type wall, one whose name
// begins with "symmetry" the type symmetry, others patch.
//
// Based on: OpenFOAM, "User Guide", section "Mesh description": faces between cells come first, by
// owner and then by neighbour (upper-triangular order), their normals from the lower cell to the
// higher; then the faces of each patch, by owner, outwards.
#include <algorithm>
#include <map>

#include "io/solver/boundary_sides.h"
#include "io/solver/solver_formats.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

/// An inner face, seen from its owner, or one of the boundary.
struct FoamFace {
  HexFace face;
  HexId neighbor;  ///< invalid on the boundary
};

TextWriter begin_file(const char* class_name, const char* object) {
  TextWriter out;
  out.text("FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       ");
  out.text(class_name).text(";\n    location    \"constant/polyMesh\";\n    object      ");
  out.text(object).text(";\n}\n\n");
  return out;
}

class FoamWriter {
 public:
  FoamWriter(const HexMesh& mesh, const SetTable& table)
      : mesh_(mesh), table_(table), sides_(find_boundary_sides(mesh, table)) {
    for (HexId h : mesh.hexes.ids()) add_inner_faces(h);
    num_inner_ = faces_.size();
    for (const BoundarySide& side : sides_.outer) faces_.push_back({side.face, HexId()});
  }

  std::vector<FolderFile> run() const {
    return {{"points", points()},        {"faces", faces()},           {"owner", owner()},
            {"neighbour", neighbour()},  {"boundary", boundary()},     {"cellZones", cell_zones()},
            {"faceZones", face_zones()}, {"pointZones", point_zones()}};
  }

 private:
  void add_inner_faces(HexId h) {
    const std::size_t first = faces_.size();
    for (int lf = 0; lf < 6; ++lf) {
      const HexId other = sides_.neighbors.neighbor[h][static_cast<std::size_t>(lf)];
      if (other.is_valid() && h < other) faces_.push_back({{h, lf}, other});
    }
    std::sort(faces_.begin() + static_cast<std::ptrdiff_t>(first), faces_.end(),
              [](const FoamFace& a, const FoamFace& b) { return a.neighbor < b.neighbor; });
  }

  std::string points() const {
    TextWriter out = begin_file("vectorField", "points");
    out.integer(mesh_.num_verts()).text("\n(\n");
    for (const Vec3& p : mesh_.positions) out.text("(").point(p).text(")\n");
    return out.text(")\n").take();
  }

  std::string faces() const {
    TextWriter out = begin_file("faceList", "faces");
    out.integer(faces_.size()).text("\n(\n");
    for (const FoamFace& f : faces_)
      out.text("4(").indices(face_verts(mesh_, f.face), 0).text(")\n");
    return out.text(")\n").take();
  }

  std::string owner() const {
    TextWriter out = begin_file("labelList", "owner");
    out.integer(faces_.size()).text("\n(\n");
    for (const FoamFace& f : faces_) out.integer(f.face.hex.value()).text("\n");
    return out.text(")\n").take();
  }

  std::string neighbour() const {
    TextWriter out = begin_file("labelList", "neighbour");
    out.integer(num_inner_).text("\n(\n");
    for (std::size_t f = 0; f < num_inner_; ++f) out.integer(faces_[f].neighbor.value()).text("\n");
    return out.text(")\n").take();
  }

  static const char* type_of(std::string name) {
    for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (name.starts_with("symmetry")) return "symmetry";
    return name.find("wall") != std::string::npos ? "wall" : "patch";
  }

  const NamedSet* group_of(const NamedSet& patch) const {
    for (const NamedSet& group : table_.patch_groups)
      if (is_in_group(patch, group)) return &group;
    return nullptr;
  }

  std::string boundary() const {
    TextWriter list;
    std::size_t count = 0;
    for (std::size_t begin = 0, end = 0; begin < sides_.outer.size(); begin = end, ++count) {
      const std::size_t patch = sides_.outer[begin].patch;
      while (end < sides_.outer.size() && sides_.outer[end].patch == patch) ++end;
      const NamedSet* set = patch < table_.patches.size() ? &table_.patches[patch] : nullptr;
      const std::string& name = set ? set->name : sides_.unlabeled_name;
      list.text("    ").text(name).text("\n    {\n        type        ").text(type_of(name));
      if (const NamedSet* group = set ? group_of(*set) : nullptr)
        list.text(";\n        inGroups    1(").text(group->name).text(")");
      list.text(";\n        nFaces      ").integer(end - begin);
      list.text(";\n        startFace   ").integer(num_inner_ + begin).text(";\n    }\n");
    }
    TextWriter out = begin_file("polyBoundaryMesh", "boundary");
    return out.integer(count).text("\n(\n").text(list.take()).text(")\n").take();
  }

  static void begin_zone(const std::string& name, const char* type, const char* labels,
                         std::size_t count, TextWriter& out) {
    out.text(name).text("\n{\n    type ").text(type).text(";\n    ").text(labels);
    out.text(" List<label>\n").integer(count).text("\n(\n");
  }

  std::string cell_zones() const {
    TextWriter out = begin_file("regIOobject", "cellZones");
    out.integer(table_.regions.size()).text("\n(\n");
    for (const NamedSet& region : table_.regions) {
      begin_zone(region.name, "cellZone", "cellLabels", region.members.size(), out);
      for (std::size_t h : region.members) out.integer(h).text("\n");
      out.text(")\n;\n}\n");
    }
    return out.text(")\n").take();
  }

  std::string point_zones() const {
    TextWriter out = begin_file("regIOobject", "pointZones");
    out.integer(table_.curves.size() + table_.corners.size()).text("\n(\n");
    for (const auto* sets : {&table_.curves, &table_.corners})
      for (const NamedSet& set : *sets) {
        const auto nodes = set_nodes(mesh_, set);
        begin_zone(set.name, "pointZone", "pointLabels", nodes.size(), out);
        for (VertId v : nodes) out.integer(v.value()).text("\n");
        out.text(")\n;\n}\n");
      }
    return out.text(")\n").take();
  }

  /// A face is flipped when the quad looks from the neighbour to the owner.
  bool is_flipped(const InnerSide& side) const {
    const auto face = face_verts(mesh_, side.face);
    const auto& quad = mesh_.labels.quads[side.quad].verts;
    const auto at = std::find(face.begin(), face.end(), quad[0]) - face.begin();
    return face[static_cast<std::size_t>((at + 1) % 4)] != quad[1];
  }

  /// Of an inner face, by its owner.
  std::size_t number_of(const HexFace& face) const {
    const auto end = faces_.begin() + static_cast<std::ptrdiff_t>(num_inner_);
    auto at = std::lower_bound(faces_.begin(), end, face.hex,
                               [](const FoamFace& f, HexId owner) { return f.face.hex < owner; });
    while (!(at->face == face)) ++at;
    return static_cast<std::size_t>(at - faces_.begin());
  }

  std::string face_zones() const {
    std::map<std::size_t, std::vector<InnerSide>> patch_to_sides;
    for (const InnerSide& side : sides_.inner) patch_to_sides[side.patch].push_back(side);
    TextWriter out = begin_file("regIOobject", "faceZones");
    out.integer(patch_to_sides.size()).text("\n(\n");
    for (const auto& [patch, sides] : patch_to_sides) {
      begin_zone(table_.patches[patch].name, "faceZone", "faceLabels", sides.size(), out);
      for (const InnerSide& s : sides) out.integer(number_of(s.face)).text("\n");
      out.text(")\n;\n    flipMap List<bool>\n").integer(sides.size()).text("\n(\n");
      for (const InnerSide& side : sides) out.text(is_flipped(side) ? "1\n" : "0\n");
      out.text(")\n;\n}\n");
    }
    return out.text(")\n").take();
  }

  const HexMesh& mesh_;
  const SetTable& table_;
  BoundarySides sides_;
  std::vector<FoamFace> faces_;
  std::size_t num_inner_ = 0;
};

}  // namespace

/// A word of OpenFOAM has no blanks, quotes, slashes, semicolons, braces or brackets.
NameRules openfoam_names() {
  NameRules rules;
  rules.is_allowed = is_word_letter_or_mark;
  rules.starts_with_letter = true;
  return rules;
}

std::vector<FolderFile> openfoam_files(const HexMesh& mesh, const SetTable& table) {
  return FoamWriter(mesh, table).run();
}

}  // namespace hexwright::io
