// Wall layers: rows of thin hexes along walls, as boundary layers of flows need them.
//
// Based on: Marechal, "All hexahedral boundary layers generation", 25th International Meshing
// Roundtable, 2016; Reberol, Verhetsel, Henrotte, Bommes, Remacle, "Robust topological
// construction of all-hexahedral boundary layer meshes", ACM TOMS 49(1), 2023.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hexwright/base/context.h"
#include "hexwright/layers/layer_spec.h"
#include "hexwright/mesh/hex_mesh.h"
#include "hexwright/target/target.h"

namespace hexwright {

struct LayersOptions {
  /// The first whose pattern a patch's name matches counts for the patch; none: no layers.
  std::vector<LayerSpec> specs;
  /// Least share of the walls' area with all layers, each at least half as high as asked for.
  double min_coverage = 0;

  bool empty() const { return specs.empty(); }
};

/// Why layers are lower than asked for, or absent.
enum class LayerLimit : std::uint8_t {
  None,
  Gap,    ///< 0.4 of the way to a facing wall, 0.7 of that to the end of the mesh
  Size,   ///< three edges of the wall, here or nearby; or a neighbour at a rim that stays
  Shape,  ///< hexes would be inverted or too oblique
  Rim     ///< no sheet: see the note
};
constexpr int kNumLayerLimits = 5;

/// How the layers of one patch came out.
struct PatchLayers {
  std::string patch;
  int count = 0;               ///< layers asked for
  double area = 0;             ///< of the wall, each side that is meshed
  double covered = 0;          ///< share of it with all layers, each at least half as high as asked
  double mean_thickness = 0;   ///< of all layers together, over the one asked for; by area
  double least_thickness = 0;  ///< the same at its least
  Vec3 least_at;
  double mean_first = 0;  ///< height of the first layer, by area
  /// Share of the area that is lower by more than 5%, by its reason.
  double reduced[kNumLayerLimits] = {};
  std::string note;  ///< where and why a sheet was left out; empty: nowhere

  void to_world(const Similarity& frame);
};

struct LayersReport {
  std::vector<PatchLayers> patches;    ///< of the walls, by number
  std::vector<std::string> unmatched;  ///< patterns that no patch's name matches
  std::vector<std::string> names;      ///< of all patches, when something is unmatched
  std::size_t num_sheet_hexes = 0;     ///< before the split
  double seconds = 0;

  /// Covered share of all walls together; 1 without walls.
  double coverage() const;
  void to_world(const Similarity& frame);
};

struct LayersResult {
  HexMesh mesh;
  /// Per hex: 0, or the number of its layer, counted from the wall.
  IdVector<HexId, std::int32_t> layer;
  LayersReport report;
};

/// Puts a sheet of hexes under the walls, relaxes the inside, and splits the sheet. Walls keep
/// their vertices where they are; labels follow. Hexes of the mesh keep their order and come first.
/// Mesh and target are in unit coordinates. Mid-nodes of second order are not looked at: take them
/// out before, and curve the result. Guarantees: every hex of the result, each layer too, has
/// positive corners; a wall where that cannot be has no layers, and its patches say so.
/// Errors: BadArgument when a corner of a hex is not positive, for a bad pattern, or for lengths in
/// metres.
LayersResult add_layers(const HexMesh& mesh, const Target& target, const LayersOptions& options,
                        const Context& context);

/// "layers on wall.1: 8 on 99.2% of the area, height 97.0% of the wish (least 55% at (1 2 3)),
/// first 0.01; lower by a facing wall 2.1%", one line per patch, and its note below.
std::string layers_to_text(const LayersReport& report);

}  // namespace hexwright
