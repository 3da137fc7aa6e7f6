// Negotiated-congestion routing of curves through the boundary's edge graph.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "fit/curves/curve_tube.h"
#include "fit/curves/map_features.h"
#include "fit/curves/match_corners.h"

namespace hexwright::fitting {

using relax::BoundaryGraph;
using relax::BoundaryQuads;

/// What the router works on; all of it outlives the router.
struct RoutingProblem {
  const BoundaryQuads& boundary;
  const BoundaryGraph& graph;
  const TriMesh& surface;
  const FeatureGraph& features;
  const CornerEnds& ends;
  const IdVector<CurveId, std::vector<TubeVert>>& tubes;
  const FeatureMapOptions& options;
};

/// Finds for each curve a path of boundary vertices inside its tube so that in the end no two share
/// a vertex that is not a corner. Sharing is allowed at first and gets dearer every round, by the
/// present number of users and by the vertex's history, until the curves have come to terms.
class CurveRouter {
 public:
  CurveRouter(const RoutingProblem& problem, std::vector<VertId> corner_verts);

  void run();

  const std::vector<VertId>& corner_verts() const { return corner_verts_; }
  /// Empty when the curve could not be mapped; a loop repeats its first vertex.
  const std::vector<VertId>& path(CurveId c) const { return routes_[c].path; }
  const std::string& reason(CurveId c) const { return routes_[c].reason; }
  int num_iterations() const { return num_iterations_; }
  bool is_corner(VertId v) const { return is_corner_[v.index()] != 0; }
  /// True when the edge between two corners is another curve's whole path.
  bool is_taken_edge(VertId a, VertId b, CurveId c) const;

 private:
  struct Route {
    VertId source, target;      // the path's ends, equal on a loop
    double start_arc = 0;       // where a loop starts
    std::vector<double> gates;  // arcs, from the start, that the path must pass in order
    int num_routings = 0;
    std::vector<VertId> path;
    std::string reason;
    bool is_alive = true;
  };
  struct Search;  // one shortest path search

  void choose_ends(CurveId c);
  VertId best_start(CurveId c, double arc) const;
  bool route(CurveId c);
  std::vector<VertId> find_simple_path(Search& search) const;
  static std::vector<VertId> verts_of(const Search& search, const std::vector<int>& states);
  static bool close_off_repeats(Search& search, const std::vector<int>& states);
  std::vector<int> find_path(Search& search) const;
  std::vector<int> trace(const Search& search, int state) const;
  bool may_enter(const Search& search, VertId from, VertId to) const;
  double step_cost(const Search& search, VertId from, VertId to) const;
  bool try_route(CurveId c);
  void occupy(CurveId c, int change);
  void clear_route(CurveId c);
  void kill(CurveId c, std::string reason);
  bool has_conflict(CurveId c) const;
  bool is_contested(VertId v) const { return !is_corner(v) && occupancy_[v.index()] > 1; }
  bool negotiate_round(int iteration);
  bool raise_history();
  void relocate_congested_corners();
  void relocate_corner(std::size_t corner);
  VertId best_relocation(std::size_t corner) const;
  void drop_conflicting();
  void retry_dropped();

  RoutingProblem in_;
  std::vector<VertId> corner_verts_;
  IdVector<CurveId, Route> routes_;
  std::vector<CurveId> order_;  // short curves first
  std::vector<char> is_corner_;
  std::vector<int> occupancy_;
  std::vector<double> history_;
  std::vector<int> num_moves_;  // per vertex: corners that moved to or from it
  std::unordered_map<std::int64_t, CurveId> direct_edges_;  // looked up only, never iterated
  double pressure_ = 0.5;
  bool is_sharing_allowed_ = true;
  int num_iterations_ = 0;

  // Scratch of the searches.
  std::vector<int> tube_slot_;  // per vertex: index in the tube searched, -1 outside
};

}  // namespace hexwright::fitting
