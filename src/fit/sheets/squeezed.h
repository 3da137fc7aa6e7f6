// Sheets under regions whose quads are squeezed flat between two pieces of a curve.
//
// Based on: Marechal, "Advances in octree-based all-hexahedral mesh generation: handling sharp
// features", 18th International Meshing Roundtable, 2009. Differs: the sheets may cover only the
// surroundings of the squeezed quads.
#pragma once

#include <numbers>

#include "fit/curves/boundary_state.h"

namespace hexwright::fitting {

/// Quads with two consecutive marked edges at a curve vertex, or at a corner with an angle above
/// `corner_angle` (radians): on the surface they would have a straight or reflex corner.
std::vector<QuadId> find_squeezed_quads(const FitState& state, const BoundaryState& boundary,
                                        double corner_angle);
/// The same for one quad: its corners that are squeezed, as bits of the local vertices.
unsigned squeezed_corners(const FitState& state, const BoundaryState& boundary, QuadId q,
                          double corner_angle);

struct SqueezedOptions {
  bool whole_regions = true;  ///< pad all of a region with squeezed quads; else only around them
  int ring = 1;               ///< vertex rings around squeezed quads, when not whole regions
  double corner_angle = 140 * std::numbers::pi / 180;  ///< radians
  /// Squeezed corners at other vertices are left alone; empty = none are. One entry per vertex.
  std::vector<char> is_wanted;
  double min_cosine = 0.02;  ///< least visibility of the sheet at each of its vertices
};

struct SqueezedReport {
  std::size_t num_sheets = 0, num_skipped = 0, num_hexes = 0;
};

/// Pads what is squeezed; state and boundary are rebuilt. Sizes are those of the present positions.
SqueezedReport pad_squeezed_quads(FitState& state, BoundaryState& boundary,
                                  const SqueezedOptions& options);

}  // namespace hexwright::fitting
