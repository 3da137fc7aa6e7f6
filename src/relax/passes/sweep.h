// Sweeps of single-vertex solves over the mesh, and schedules of them with growing attachment.
#pragma once

#include <span>
#include <vector>

#include "relax/state/fit_state.h"

namespace hexwright::relax {

/// The share of h below which passes that weigh scaled Jacobians alone let no edge shrink.
constexpr double kEdgeFloor = 0.15;

struct SweepOptions {
  ShapeEnergy shape;
  double weight = 0;            ///< of the attachment; divided by h^2 at each vertex
  double tolerance = 0.03;      ///< a move shorter than this (in h) makes nothing dirty
  bool marks_neighbors = true;  ///< a longer one makes the neighbours dirty too, not itself alone
  double max_step = 1;          ///< longest move of one solve, in h
  /// When positive: a move that takes the least scaled Jacobian around the vertex below this, and
  /// below what it was, is undone.
  double quality_floor = 0;
  /// When positive: a move that takes an edge at the vertex below this share of h, and below what
  /// its shortest edge was, is undone: the scaled Jacobian does not see lengths, and lets edges
  /// shrink to nothing.
  double edge_floor = 0;
  /// Factors of the hexes' shape energies; empty = all one.
  const IdVector<HexId, double>* hex_weight = nullptr;
  double relaxation = 1;      ///< first trial step in Newton steps, in (0, 2)
  double untangle_share = 0;  ///< when positive: regularises determinants by this share of h^3
};

/// Solves every dirty vertex once, colour by colour; returns how many. The same for any number of
/// threads.
std::size_t sweep(Body& body, const SweepOptions& options);

/// Solves the given vertices once each.
class LocalSweep {
 public:
  /// `is_member`: one entry per vertex.
  LocalSweep(const Body& body, const std::vector<char>& is_member);
  void run(Body& body, const SweepOptions& options) const;
  /// Those of them that are dirty.
  void run_dirty(Body& body, const SweepOptions& options) const;
  std::size_t num_verts() const { return verts_.size(); }

 private:
  void run(Body& body, const SweepOptions& options, bool only_dirty) const;

  std::vector<std::size_t> offset_;  // per colour
  std::vector<VertId> verts_;
};

struct Schedule {
  ShapeEnergy shape;
  std::vector<double> weights;
  int sweeps_per_weight = 1;
  double tolerance = 0.03;
  bool hold_curves = false;  ///< curve targets fixed at first, released over the first 60%
};

/// `count` weights from `first` to `last` in equal ratios.
std::vector<double> geometric_weights(double first, double last, int count);

/// For each weight: new targets, then the sweeps.
void run_schedule(FitState& state, const FitTarget& target, const Schedule& schedule,
                  const Context& context);

}  // namespace hexwright::relax
