// Writes Gmsh files, version 4.1, as text.
//
// Physical groups carry the labels: volumes REGION_r, surfaces PATCH_p, curves CURVE_c and the
// points CORNERS. Every label is one elementary entity of the same dimension; all nodes belong to
// the first volume.
//
// Based on: Geuzaine, Remacle, "Gmsh reference manual", section "MSH file format", version 4.1. Its
// hexahedron and quadrilateral have our local order.
#include <algorithm>

#include "io/mesh/element_sets.h"
#include "io/mesh/volume_file.h"
#include "io/text/text_writer.h"

namespace hexwright::io {
namespace {

// Gmsh's element types.
constexpr int kGmshLine = 1, kGmshQuad = 3, kGmshHex = 5, kGmshPoint = 15;

/// Entity and physical tags must be positive: label + 1, moved up when labels are negative (-1 is
/// "none").
class TagMap {
 public:
  explicit TagMap(const ElementSets& sets)
      : lowest_(sets.empty() ? 0 : std::min(0, sets.begin()->first)) {}
  std::int64_t operator()(std::int32_t label) const { return std::int64_t{label} - lowest_ + 1; }

 private:
  std::int32_t lowest_;
};

class GmshWriter {
 public:
  explicit GmshWriter(const HexMesh& mesh)
      : mesh_(mesh),
        sets_(group_labels(mesh)),
        regions_(sets_.hexes_of_region),
        patches_(sets_.quads_of_patch),
        curves_(sets_.edges_of_curve) {}

  std::string run() {
    out_.text("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    write_names();
    write_entities();
    write_nodes();
    write_elements();
    return out_.take();
  }

 private:
  void name(int dimension, std::int64_t tag, const std::string& text) {
    out_.integer(dimension).text(" ").integer(tag).text(" \"").text(text).text("\"\n");
  }

  void write_names() {
    const bool has_corners = !mesh_.labels.corners.empty();
    out_.text("$PhysicalNames\n")
        .integer(sets_.hexes_of_region.size() + sets_.quads_of_patch.size() +
                 sets_.edges_of_curve.size() + (has_corners ? 1 : 0))
        .text("\n");
    if (has_corners) name(0, 1, "CORNERS");
    for (const auto& [curve, edges] : sets_.edges_of_curve)
      name(1, curves_(curve), set_name("CURVE", curve));
    for (const auto& [patch, quads] : sets_.quads_of_patch)
      name(2, patches_(patch), set_name("PATCH", patch));
    for (const auto& [region, hexes] : sets_.hexes_of_region)
      name(3, regions_(region), set_name("REGION", region));
    out_.text("$EndPhysicalNames\n");
  }

  /// One entity: tag, box, its physical group, no bounding entities.
  void entity(std::int64_t tag, const Box3& box) {
    out_.integer(tag).text(" ").point(box.lo).text(" ").point(box.hi).text(" 1 ");
    out_.integer(tag).text(" 0\n");
  }

  template <class Elements>
  Box3 box_of(const Elements& elements, const std::vector<std::size_t>& which) const {
    Box3 box;
    for (std::size_t i : which)
      for (VertId v : elements[i].verts) box.extend(mesh_.positions[v]);
    return box;
  }

  void write_entities() {
    out_.text("$Entities\n").integer(mesh_.labels.corners.size()).text(" ");
    out_.integer(sets_.edges_of_curve.size()).text(" ").integer(sets_.quads_of_patch.size());
    out_.text(" ").integer(sets_.hexes_of_region.size()).text("\n");
    for (std::size_t c = 0; c < mesh_.labels.corners.size(); ++c)
      out_.integer(c + 1).text(" ").point(mesh_.positions[mesh_.labels.corners[c]]).text(" 1 1\n");
    for (const auto& [curve, edges] : sets_.edges_of_curve)
      entity(curves_(curve), box_of(mesh_.labels.edges, edges));
    for (const auto& [patch, quads] : sets_.quads_of_patch)
      entity(patches_(patch), box_of(mesh_.labels.quads, quads));
    for (const auto& [region, hexes] : sets_.hexes_of_region) {
      Box3 box;
      for (std::size_t h : hexes)
        for (VertId v : mesh_.hexes[HexId(h)]) box.extend(mesh_.positions[v]);
      entity(regions_(region), box);
    }
    out_.text("$EndEntities\n");
  }

  void write_nodes() {
    const std::size_t count = mesh_.num_verts();
    const std::int64_t volume =
        sets_.hexes_of_region.empty() ? 1 : regions_(sets_.hexes_of_region.begin()->first);
    out_.text("$Nodes\n1 ").integer(count).text(" 1 ").integer(count).text("\n3 ");
    out_.integer(volume).text(" 0 ").integer(count).text("\n");
    for (std::size_t v = 1; v <= count; ++v) out_.integer(v).text("\n");
    for (const Vec3& p : mesh_.positions) out_.point(p).text("\n");
    out_.text("$EndNodes\n");
  }

  void block(int dimension, std::int64_t entity_tag, int type, std::size_t count) {
    out_.integer(dimension).text(" ").integer(entity_tag).text(" ").integer(type).text(" ");
    out_.integer(count).text("\n");
  }
  template <class Verts>
  void element(const Verts& verts) {
    out_.integer(++last_element_).text(" ").indices(verts, 1).text("\n");
  }

  void write_elements() {
    const BoundaryLabels& labels = mesh_.labels;
    const std::size_t count =
        labels.corners.size() + labels.edges.size() + labels.quads.size() + mesh_.num_hexes();
    out_.text("$Elements\n")
        .integer(labels.corners.size() + sets_.edges_of_curve.size() + sets_.quads_of_patch.size() +
                 sets_.hexes_of_region.size())
        .text(" ");
    out_.integer(count).text(" 1 ").integer(count).text("\n");
    for (std::size_t c = 0; c < labels.corners.size(); ++c) {
      block(0, static_cast<std::int64_t>(c) + 1, kGmshPoint, 1);
      element(std::array{labels.corners[c]});
    }
    for (const auto& [curve, edges] : sets_.edges_of_curve) {
      block(1, curves_(curve), kGmshLine, edges.size());
      for (std::size_t e : edges) element(labels.edges[e].verts);
    }
    for (const auto& [patch, quads] : sets_.quads_of_patch) {
      block(2, patches_(patch), kGmshQuad, quads.size());
      for (std::size_t q : quads) element(labels.quads[q].verts);
    }
    for (const auto& [region, hexes] : sets_.hexes_of_region) {
      block(3, regions_(region), kGmshHex, hexes.size());
      for (std::size_t h : hexes) element(mesh_.hexes[HexId(h)]);
    }
    out_.text("$EndElements\n");
  }

  const HexMesh& mesh_;
  LabelSets sets_;
  TagMap regions_, patches_, curves_;
  TextWriter out_;
  std::size_t last_element_ = 0;
};

}  // namespace

std::string gmsh_text(const HexMesh& mesh) { return GmshWriter(mesh).run(); }

}  // namespace hexwright::io
