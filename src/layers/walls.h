// Which quads of a mesh are walls, and what bounds them.
#pragma once

#include <string>
#include <vector>

#include "hexwright/layers/layers.h"
#include "hexwright/mesh/hex_adjacency.h"

#include "relax/kernel/boundary_quads.h"

namespace hexwright::layers {

constexpr int kNoSpec = -1;

/// The patches of a mesh beside what is asked of them.
struct WallPatches {
  /// Per labelled patch number: its name and the spec that its name matches first.
  IdVector<PatchId, std::string> name;
  IdVector<PatchId, int> spec;
  int spec_of(PatchId p) const { return p.is_valid() ? spec[p] : kNoSpec; }
};

/// Names are those of the report: the mesh's own, else by place, else PATCH_3. Fills `unmatched`
/// and `names`.
WallPatches find_wall_patches(const HexMesh& mesh, const Similarity& frame,
                              const LayersOptions& options, LayersReport& report);

/// The boundary of one region: its faces towards nothing and towards other regions.
struct Skin {
  static constexpr int kNoLabel = -1;

  std::int32_t region = 0;
  std::vector<HexFace> faces;
  IdVector<QuadId, std::array<VertId, 4>>
      quads;                    ///< counter-clockwise seen from outside the region
  IdVector<QuadId, int> label;  ///< index into labels.quads, or kNoLabel
  IdVector<QuadId, int> spec;   ///< of walls; kNoSpec elsewhere
  relax::BoundaryGraph graph;

  bool is_wall(QuadId q) const { return spec[q] != kNoSpec; }
  /// Between a wall and another quad.
  bool is_rim(const relax::BoundaryGraph::Edge& edge) const {
    return edge.num_quads == 2 && is_wall(edge.quads[0]) != is_wall(edge.quads[1]);
  }
};
/// Of one of a skin's quads; invalid without a label.
PatchId patch_of(const HexMesh& mesh, const Skin& skin, QuadId q);

Skin make_skin(const HexMesh& mesh, const WallPatches& patches, std::int32_t region);

/// Tags of the mesh's regions, ascending; {0} without tags.
std::vector<std::int32_t> list_regions(const HexMesh& mesh);

/// A wall, of quads that hang together, that gets no layers.
struct LeftOut {
  std::vector<PatchId> patches;  ///< all of the wall, ascending
  std::string why;               ///< with the place
};

/// A place in the world, for messages.
std::string say_place(const Similarity& frame, const Vec3& unit);

/// Takes walls that no sheet can run under out of the skin: those that end in a patch that goes on
/// flat or turns round, that touch themselves or other patches at a vertex only, or whose specs ask
/// for different numbers of layers.
std::vector<LeftOut> leave_out_walls(const HexMesh& mesh, const WallPatches& patches,
                                     const LayersOptions& options, const Similarity& frame,
                                     Skin& skin);
/// Takes out the walls that hold any of these vertices. Returns their patches, ascending.
std::vector<PatchId> leave_out_at(const HexMesh& mesh, const std::vector<VertId>& verts,
                                  Skin& skin);

}  // namespace hexwright::layers
