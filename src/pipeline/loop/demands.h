// What is asked of a result, as one table: the loop ranks its rounds by it, takes the places to
// refine from it, ends when it is met, and the gate says its sentences.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/loop/round.h"

namespace hexwright {

/// Whether what is missed fails the gate.
enum class Severity { Warning, Failure };

/// One demand on a round. Functions that are null do not apply.
struct Demand {
  const char* name;
  bool (*is_met)(const RoundInput&, const Round&);
  /// By how much an unmet demand is missed, for comparing two rounds that miss the same demands.
  /// Null: missed is missed.
  double (*shortfall)(const RoundInput&, const Round&) = nullptr;
  /// Where finer cells can help; may hold points while the demand is met (places just below the
  /// tolerance). Null: all cells, or none in particular.
  std::vector<Vec3> (*places)(const RoundInput&, const Round&) = nullptr;
  /// Whether another round can help. Null: whenever the demand is unmet.
  bool (*is_curable)(const RoundInput&, const Round&) = nullptr;
  /// What is to be said of an unmet demand; empty = nothing. Null: the judge's own sentences say
  /// it.
  std::string (*sentence)(const RoundInput&, const Round&) = nullptr;
  bool is_distance = false;  ///< all cells a little smaller mend it as well
  /// Refined for when nothing else is left, and only while that costs few cells.
  bool is_minor = false;
  Severity severity = Severity::Warning;
};

/// All demands. The order is their rank: what comes first decides first.
std::span<const Demand> demands();

/// Whether `after` meets all that `before` meets, of the demands that users are told of.
bool meets_no_less(const RoundInput& input, const Round& before, const Round& after);

/// The surface's boundary components and genus. By the boundary and not by the hexes: cavities
/// count as components of it too.
bool has_expected_topology(const RoundInput& input, const Round& round);

/// Whether too little of the curves is followed.
bool misses_features(const RoundInput& input, const Round& round);

/// By how much the volume is off, as a share of the surface's; 0 where that is not known.
double volume_off(const RoundInput& input, const Round& round);

/// Whether a mesh so far off fails: only where sizing aimed at a distance, and of the inside, for
/// the box around an object is no part of the surface. Shares of the diagonal.
bool is_gated(const MeshOptions& options, double distance);
std::string say_beyond_gate(double distance, double tolerance);

/// Two-way, as shares of the diagonal; 1 = no distance was measured.
double max_distance(const Round& round);
double mean_distance(const Round& round);

}  // namespace hexwright
