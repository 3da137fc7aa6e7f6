// A hexahedral mesh, and the labels that tie its boundary to the features of a surface.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hexwright/base/issue.h"
#include "hexwright/base/vec3.h"
#include "hexwright/mesh/element_ids.h"
#include "hexwright/mesh/hex_numbering.h"
#include "hexwright/mesh/mid_nodes.h"

namespace hexwright {

/// A quad of a hex mesh's boundary (or region interface) and the surface patch it lies on.
struct LabeledQuad {
  std::array<VertId, 4> verts;  ///< counter-clockwise seen from outside
  PatchId patch;                ///< invalid when unknown
  friend bool operator==(const LabeledQuad&, const LabeledQuad&) = default;
};

/// A mesh edge that represents a piece of a feature curve.
struct LabeledEdge {
  std::array<VertId, 2> verts;
  CurveId curve;
  friend bool operator==(const LabeledEdge&, const LabeledEdge&) = default;
};

/// What users lose elsewhere: which part of the surface each boundary element represents. May be
/// empty.
struct BoundaryLabels {
  std::vector<LabeledQuad> quads;
  std::vector<LabeledEdge> edges;
  std::vector<VertId> corners;
  /// Names of patches and curves, or empty when none has one; "" for one without.
  IdVector<PatchId, std::string> patch_names;
  IdVector<CurveId, std::string> curve_names;
  friend bool operator==(const BoundaryLabels&, const BoundaryLabels&) = default;
};

struct HexMesh {
  IdVector<VertId, Vec3> positions;
  IdVector<HexId, std::array<VertId, 8>> hexes;  ///< numbering: hex_numbering.h
  IdVector<HexId, std::int32_t> region;          ///< one tag per hex, or empty (all 0)
  BoundaryLabels labels;
  /// Names of regions by tag, "" for one without; tags that are negative or beyond have none.
  std::vector<std::string> region_names;
  /// Present in a mesh of second order. Stages that move vertices or change hexes drop them.
  std::optional<MidNodes> mid_nodes;

  std::size_t num_verts() const { return positions.size(); }
  std::size_t num_hexes() const { return hexes.size(); }
  std::array<Vec3, 8> corners(HexId h) const {
    std::array<Vec3, 8> p;
    for (int lv = 0; lv < 8; ++lv) p[lv] = positions[hexes[h][lv]];
    return p;
  }

  /// First index out of range, coordinate that is not finite, or array of a wrong length.
  std::optional<Issue> find_problem() const;
};

Box3 bounding_box(const HexMesh& mesh);

/// Drops vertices that no hex uses, keeping the order of the others; labels follow.
void remove_unused_verts(HexMesh& mesh);

}  // namespace hexwright
