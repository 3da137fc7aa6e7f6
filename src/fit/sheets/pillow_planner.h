// Which hexes a pillow under squeezed quads takes, and the sheet around them.
#pragma once

#include "fit/carve/set_check.h"
#include "fit/sheets/feature_layers.h"

namespace hexwright::fitting {

using relax::BoundaryEdgeId;
using relax::FitState;

/// Squeezed quads of one region that are treated together.
struct PillowJob {
  RegionId region;
  std::vector<QuadId> quads;  ///< squeezed ones, of the state the job was made in
};

/// Hexes to pillow and the sheet around them.
struct PillowSet {
  std::vector<HexId> hexes;  ///< ascending
  Sheet sheet;
};

/// Finds sets that can be pillowed in one state of the mesh.
class PillowPlanner {
 public:
  PillowPlanner(const FitState& state, const FeatureMarks& marks, const MarkedGraph& marked,
                const PillowOptions& options);

  /// The job's set with the first extent that works; empty hexes when none does.
  PillowSet plan(const PillowJob& job);

  /// The job's quads and `ring` vertex rings around them in its region, ascending.
  std::vector<QuadId> grow(const PillowJob& job, int ring) const;

 private:
  std::vector<QuadId> quads_of_region(RegionId region) const;
  PillowSet try_quads(const PillowJob& job, const std::vector<QuadId>& quads);
  void collect_faces(PillowSet& set) const;
  bool splits_a_squeezed_vert(const PillowJob& job) const;
  bool keeps_marks(const PillowJob& job, const PillowSet& set) const;
  bool is_inside(BoundaryEdgeId e) const;
  bool is_rim(VertId v) const;
  bool find_directions(PillowSet& set);

  const FitState& state_;
  const FeatureMarks& marks_;
  const MarkedGraph& marked_;
  const PillowOptions& options_;
  SetCheck check_;
  std::vector<char> is_in_, is_selected_, is_sheet_vert_;  // scratch, all 0 between calls
};

}  // namespace hexwright::fitting
