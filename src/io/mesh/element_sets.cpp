// Groups labels and finds the hexes behind labelled quads.
#include "io/mesh/element_sets.h"

#include <algorithm>

#include <fmt/format.h>

#include "hexwright/base/error.h"
#include "hexwright/base/parallel.h"

namespace hexwright::io {
namespace {

std::array<VertId, 4> sorted(std::array<VertId, 4> verts) {
  std::sort(verts.begin(), verts.end());
  return verts;
}

}  // namespace

LabelSets group_labels(const HexMesh& mesh) {
  LabelSets sets;
  for (HexId h : mesh.hexes.ids())
    sets.hexes_of_region[mesh.region.empty() ? 0 : mesh.region[h]].push_back(h.index());
  for (std::size_t q = 0; q < mesh.labels.quads.size(); ++q)
    sets.quads_of_patch[std::max(-1, mesh.labels.quads[q].patch.value())].push_back(q);
  for (std::size_t e = 0; e < mesh.labels.edges.size(); ++e)
    sets.edges_of_curve[std::max(-1, mesh.labels.edges[e].curve.value())].push_back(e);
  return sets;
}

std::string set_name(std::string_view kind, std::int32_t label) {
  const bool is_region = kind == "REGION";  // the only kind with negative numbers of its own
  if (label < 0 && !is_region) return fmt::format("{}_NONE", kind);
  return label < 0 ? fmt::format("{}_MINUS_{}", kind, -std::int64_t{label})
                   : fmt::format("{}_{}", kind, label);
}

std::vector<HexFace> find_quad_faces(const HexMesh& mesh) {
  struct Face {
    std::array<VertId, 4> key;
    HexFace face;
  };
  std::vector<Face> faces(mesh.labels.quads.empty() ? 0 : 6 * mesh.num_hexes());
  parallel_for(faces.size(), [&](std::size_t i) {
    const HexFace face = {HexId(i / 6), static_cast<int>(i % 6)};
    faces[i] = {sorted(face_verts(mesh, face)), face};
  });
  parallel_stable_sort(faces.begin(), faces.end(),
                       [](const Face& a, const Face& b) { return a.key < b.key; });
  std::vector<HexFace> result;
  for (const LabeledQuad& quad : mesh.labels.quads) {
    const auto key = sorted(quad.verts);
    const auto found = std::lower_bound(
        faces.begin(), faces.end(), key,
        [](const Face& face, const std::array<VertId, 4>& k) { return face.key < k; });
    if (found == faces.end() || found->key != key)
      throw Error(ErrorCode::BadArgument,
                  "a labelled quad is no face of any hex; remove it from the labels");
    result.push_back(found->face);
  }
  return result;
}

}  // namespace hexwright::io
