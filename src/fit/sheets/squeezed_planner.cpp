// A set must be manifold and visible where its sheet passes, and must not tear marks apart.
#include "fit/sheets/squeezed_planner.h"

#include <algorithm>

namespace hexwright::fitting {

using namespace relax;

SqueezedPlanner::SqueezedPlanner(const FitState& state, const BoundaryState& boundary,
                                 const SqueezedOptions& options)
    : state_(state),
      boundary_(boundary),
      options_(options),
      check_(state.mesh, state.vert_to_hex, state.neighbors, false),
      is_in_(state.mesh.num_hexes(), 0),
      is_selected_(state.quads.size(), 0),
      is_sheet_vert_(state.num_verts(), 0) {}

std::vector<HexId> SqueezedPlanner::plan(const SqueezedJob& job) {
  if (options_.whole_regions) return try_quads(job, quads_of_region(job.region));
  for (int ring : {options_.ring, 0, options_.ring + 1, options_.ring + 2}) {
    std::vector<HexId> hexes = try_quads(job, grow(job, ring));
    if (!hexes.empty()) return hexes;
  }
  return {};
}

std::vector<QuadId> SqueezedPlanner::grow(const SqueezedJob& job, int ring) const {
  std::vector<QuadId> quads = job.quads;
  for (int k = 0; k < ring; ++k) {
    std::vector<QuadId> next = quads;
    for (QuadId q : quads)
      for (VertId v : state_.quads[q.index()])
        for (QuadId other : boundary_.graph.quads(v))
          if (boundary_.quad_to_region[other] == job.region) next.push_back(other);
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    quads = std::move(next);
  }
  return quads;
}

std::vector<QuadId> SqueezedPlanner::quads_of_region(RegionId region) const {
  std::vector<QuadId> quads;
  for (QuadId q : boundary_.quad_to_region.ids())
    if (boundary_.quad_to_region[q] == region) quads.push_back(q);
  return quads;
}

std::vector<HexId> SqueezedPlanner::try_quads(const SqueezedJob& job,
                                              const std::vector<QuadId>& quads) {
  std::vector<HexId> hexes;
  for (QuadId q : quads) {
    hexes.push_back(state_.quad_face[q.index()].hex);
    is_selected_[q.index()] = 1;
  }
  std::sort(hexes.begin(), hexes.end());
  hexes.erase(std::unique(hexes.begin(), hexes.end()), hexes.end());
  for (HexId h : hexes) is_in_[h.index()] = 1;
  Sheet sheet;
  sheet.add_inner_faces(state_.mesh, state_.neighbors, hexes, is_in_);
  sheet.collect_verts();
  for (VertId v : sheet.verts) is_sheet_vert_[v.index()] = 1;
  const bool is_good = splits_a_squeezed_vert(job) && keeps_marks(job, sheet) && can_pass(sheet);
  for (VertId v : sheet.verts) is_sheet_vert_[v.index()] = 0;
  for (HexId h : hexes) is_in_[h.index()] = 0;
  for (QuadId q : quads) is_selected_[q.index()] = 0;
  if (!is_good) hexes.clear();
  return hexes;
}

bool SqueezedPlanner::splits_a_squeezed_vert(const SqueezedJob& job) const {
  for (QuadId q : job.quads) {
    const unsigned corners = squeezed_corners(state_, boundary_, q, options_.corner_angle);
    for (std::size_t k = 0; k < 4; ++k)
      if ((corners >> k & 1u) != 0 && is_sheet_vert_[state_.quads[q.index()][k].index()])
        return true;
  }
  return false;
}

/// The sheet may end on curves and inside the job's region, but not cross anything else.
bool SqueezedPlanner::keeps_marks(const SqueezedJob& job, const Sheet& sheet) const {
  for (VertId v : sheet.verts) {
    if (state_.move[v] != MoveIn::Space) return false;
    if (!is_rim(v)) continue;
    for (QuadId q : boundary_.graph.quads(v)) {
      if (!is_in_[state_.quad_face[q.index()].hex.index()] || is_selected_[q.index()]) continue;
      if (state_.kind[v] != VertKind::Surface || boundary_.quad_to_region[q] != job.region)
        return false;
    }
    for (BoundaryEdgeId e : boundary_.graph.edges(v))
      if (boundary_.is_marked(e) && is_inside(e)) return false;
  }
  return true;
}

bool SqueezedPlanner::is_inside(BoundaryEdgeId e) const {
  const auto& edge = boundary_.graph.edge(e);
  return edge.num_quads == 2 && is_in_[state_.quad_face[edge.quads[0].index()].hex.index()] &&
         is_in_[state_.quad_face[edge.quads[1].index()].hex.index()];
}

/// On the boundary with quads of the set and of others.
bool SqueezedPlanner::is_rim(VertId v) const {
  bool any_in = false, any_out = false;
  for (QuadId q : boundary_.graph.quads(v))
    (is_in_[state_.quad_face[q.index()].hex.index()] ? any_in : any_out) = true;
  return any_in && any_out;
}

bool SqueezedPlanner::can_pass(const Sheet& sheet) {
  for (VertId v : sheet.verts)
    if (check_.check(v, is_in_, options_.min_cosine) != SetFault::None) return false;
  return true;
}

}  // namespace hexwright::fitting
