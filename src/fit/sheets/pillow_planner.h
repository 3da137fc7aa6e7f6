// Which hexes a pillow under squeezed quads takes, and the sheet around them.
#pragma once

#include "fit/carve/set_check.h"
#include "fit/sheets/feature_layers.h"
#include "fit/sheets/sheet.h"

namespace hexwright::fitting {

/// Squeezed quads of one region that are treated together.
struct PillowJob {
  RegionId region;
  std::vector<QuadId> quads;  ///< squeezed ones, of the state the job was made in
};

/// Finds sets that can be pillowed in one state of the mesh.
class PillowPlanner {
 public:
  PillowPlanner(const FitState& state, const FeatureMarks& marks, const MarkedGraph& marked,
                const PillowOptions& options);

  /// The hexes, ascending, of the first extent that works; none when none does.
  std::vector<HexId> plan(const PillowJob& job);

  /// The job's quads and `ring` vertex rings around them in its region, ascending.
  std::vector<QuadId> grow(const PillowJob& job, int ring) const;

 private:
  std::vector<QuadId> quads_of_region(RegionId region) const;
  std::vector<HexId> try_quads(const PillowJob& job, const std::vector<QuadId>& quads);
  bool splits_a_squeezed_vert(const PillowJob& job) const;
  bool keeps_marks(const PillowJob& job, const Sheet& sheet) const;
  bool is_inside(BoundaryEdgeId e) const;
  bool is_rim(VertId v) const;
  bool can_pass(const Sheet& sheet);

  const FitState& state_;
  const FeatureMarks& marks_;
  const MarkedGraph& marked_;
  const PillowOptions& options_;
  SetCheck check_;
  std::vector<char> is_in_, is_selected_, is_sheet_vert_;  // scratch, all 0 between calls
};

}  // namespace hexwright::fitting
