// A pass over the surroundings of what is bad: a row that says who moves, with what energy and
// pull, and how often; and the one loop that runs such rows.
#pragma once

#include <span>
#include <vector>

#include "hexwright/base/context.h"

#include "relax/passes/sweep.h"

namespace hexwright::relax {

enum class Bad : std::uint8_t {
  Hexes,  ///< whose scaled Jacobian is below the limit
  Verts,  ///< farther than the limit, in h, from where they belong
};

/// Who is solved again in the sweeps after the first.
enum class Again : std::uint8_t {
  All,
  Dirty,   ///< who moved, or has a neighbour or a target that did
  Moving,  ///< who moved itself: misses what neighbours make possible, and costs least
};

/// Regularisation of determinants, as a share of h^3: it falls from the first round's by a ratio a
/// round down to the last. All 0: none, and no hex inverts.
struct Regularisation {
  double first = 0, last = 0, ratio = 1;
};

/// Pulled to nothing.
inline constexpr double kNoWeights[] = {0};

struct Pass {
  Bad bad = Bad::Hexes;
  double limit = 0;
  int max_rounds = 1;       ///< each finds anew what is bad
  int rings = 0;            ///< of hexes around the bad that move along
  int rounds_per_ring = 0;  ///< one ring more every so many rounds; 0 = never
  /// Its weight, marks_neighbors, untangle_share and hex_weight follow from the row's fields below.
  SweepOptions sweep;
  std::span<const double> weights = kNoWeights;  ///< of the attachment, in turn
  int sweeps = 1;                                ///< at each weight
  Again again = Again::All;
  Regularisation untangle = {};
  /// Weighs the hexes before each sweep; null = all one.
  IdVector<HexId, double> (*weigh)(const HexMesh& mesh) = nullptr;
};

/// True when nothing bad was left at the start of a round. Requires Bad::Hexes.
bool run(const Pass& pass, Body& body, const Context& context);
bool run(const Pass& pass, FitState& state, const Context& context) = delete;  // has a target

/// Boundary vertices are pulled to the target, anew at every weight. Bad hexes are first met with
/// the targets as they are: what vertices were last asked for is what they have arrived at.
bool run(const Pass& pass, FitState& state, const FitTarget& target, const Context& context);

/// The sweeps of one round of such a row on a given region, one entry per vertex, without rings:
/// for sets that no row finds.
void run_on(const std::vector<char>& region, const Pass& pass, FitState& state,
            const FitTarget& target, const Context& context);

// The rows of the fit.

inline constexpr double kPolishWeights[] = {1e6};
/// Raises the worst scaled Jacobians with an energy that the worst corners dominate.
inline constexpr Pass kPolish = {.limit = 0.35,
                                 .max_rounds = 8,
                                 .rings = 1,
                                 .sweep = {.shape = {0.9, 3, 0}},
                                 .weights = kPolishWeights,
                                 .sweeps = 3};

inline constexpr double kRefitWeights[] = {30, 100, 300, 1e3, 3e3, 1e4, 1e5};
/// Stuck vertices come from several of them having to move together: weakening the attachment
/// around them and raising it again slowly lets the neighbours make room.
inline constexpr Pass kRefit = {.bad = Bad::Verts,
                                .limit = 0.04,
                                .max_rounds = 2,
                                .rings = 2,
                                .sweep = {.shape = {0.9, 1, 0}, .tolerance = 0.01},
                                .weights = kRefitWeights,
                                .sweeps = 3,
                                .again = Again::Dirty};
/// The same for models without curves, which settle here what their least will be.
inline constexpr Pass kThoroughRefit = {.bad = Bad::Verts,
                                        .limit = 0.02,
                                        .max_rounds = 4,
                                        .rings = 3,
                                        .sweep = kRefit.sweep,
                                        .weights = kRefitWeights,
                                        .sweeps = 3,
                                        .again = Again::Dirty};

}  // namespace hexwright::relax
