// Which hexes a sheet under squeezed quads goes around, and the sheet around them.
#pragma once

#include "fit/carve/set_check.h"
#include "fit/sheets/sheet.h"
#include "fit/sheets/squeezed.h"

namespace hexwright::fitting {

/// Squeezed quads of one region that are treated together.
struct SqueezedJob {
  RegionId region;
  std::vector<QuadId> quads;  ///< squeezed ones, of the state the job was made in
};

/// Finds sets that can be padded in one state of the mesh.
class SqueezedPlanner {
 public:
  SqueezedPlanner(const FitState& state, const BoundaryState& boundary,
                  const SqueezedOptions& options);

  /// The hexes, ascending, of the first extent that works; none when none does.
  std::vector<HexId> plan(const SqueezedJob& job);

  /// The job's quads and `ring` vertex rings around them in its region, ascending.
  std::vector<QuadId> grow(const SqueezedJob& job, int ring) const;

 private:
  std::vector<QuadId> quads_of_region(RegionId region) const;
  std::vector<HexId> try_quads(const SqueezedJob& job, const std::vector<QuadId>& quads);
  bool splits_a_squeezed_vert(const SqueezedJob& job) const;
  bool keeps_marks(const SqueezedJob& job, const Sheet& sheet) const;
  bool is_inside(BoundaryEdgeId e) const;
  bool is_rim(VertId v) const;
  bool can_pass(const Sheet& sheet);

  const FitState& state_;
  const BoundaryState& boundary_;
  const SqueezedOptions& options_;
  SetCheck check_;
  std::vector<char> is_in_, is_selected_, is_sheet_vert_;  // scratch, all 0 between calls
};

}  // namespace hexwright::fitting
