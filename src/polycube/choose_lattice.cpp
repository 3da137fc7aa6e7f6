#include "polycube/choose_lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "polycube/lattice/charts.h"
#include "polycube/map/repair_map.h"
#include "polycube/map/sample_map.h"

namespace hexwright::polycube {
namespace {

// Repaired, sampled, completed and dualised as the mesh will be, but not mapped.
std::size_t count_hexes(TetMesh object, const TetMesh& polycube, PolycubeOptions options,
                        const Context& context) {
  Lattice lattice = choose_lattice(object, polycube, options);
  repair_map(object, lattice, context);
  const TetLocator locator(lattice.tets);
  const BoundaryMap boundary(lattice);
  const Grid sampled = sample_map({object, lattice, locator, boundary}, options, context);
  const Grid grid = complete(sampled, options.complete, context).grid;
  return make_dual(grid, options, context).mesh.num_hexes();
}

/// Hexes over those wanted; infinite beyond the budget of cells.
double share_of_wanted(const TetMesh& object, const TetMesh& polycube,
                       const PolycubeOptions& options, const Context& context) {
  try {
    return static_cast<double>(count_hexes(object, polycube, options, context)) /
           static_cast<double>(options.target_hexes);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::OutOfResources) throw;
    return std::numeric_limits<double>::infinity();
  }
}

}  // namespace

Lattice choose_lattice(const TetMesh& object, const TetMesh& polycube, PolycubeOptions& options) {
  const Faces faces = find_faces(polycube, options.spacing);
  if (options.spacing > 0 || options.min_level >= options.max_level) {
    const double spacing = options.spacing > 0 ? options.spacing : geometric_spacing(faces.planes);
    return place_on_lattice(faces, even_scales(faces.planes, spacing), spacing, options.max_cells);
  }
  const auto candidates = suit_scales(faces.planes, object, faces.lattice.tets, options);
  const std::size_t num_folded = count_nonpositive(faces.lattice.tets);
  for (std::size_t i = 0;; ++i) {
    const ScaleCandidate& c = candidates[i];
    Lattice lattice = place_on_lattice(faces, c.scales, c.spacing, options.max_cells);
    if (i + 1 < candidates.size() && count_nonpositive(lattice.tets) > num_folded) continue;
    options.min_level = std::max(0, options.min_level - c.depth);
    options.max_level -= c.depth;
    return lattice;
  }
}

// Hexes go with the inverse cube of the stretch, in steps where the lattice or the levels jump.
double find_stretch(const TetMesh& object, const TetMesh& polycube, const PolycubeOptions& options,
                    const Context& context) {
  constexpr int kMostTries = 8;
  constexpr double kEnough = 0.92, kTooMany = 1.02;  // of the hexes wanted
  constexpr double kCoarsest = 0.9;
  PolycubeOptions trial = options;
  double too_tight = 0, too_loose = std::numeric_limits<double>::infinity();  // known to be
  double best = options.max_stretch, least_miss = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kMostTries; ++i) {
    context.check_cancelled();
    const double share = share_of_wanted(object, polycube, trial, context);
    // A mesh that is too large misses twice as badly.
    const double miss = share > kTooMany ? 2 * std::log(share) : std::abs(std::log(share));
    if (miss < least_miss) {
      least_miss = miss;
      best = trial.max_stretch;
    }
    if (share > kEnough && share <= kTooMany) break;
    (share > 1 ? too_tight : too_loose) = trial.max_stretch;
    double next =
        std::min(kCoarsest, trial.max_stretch * std::clamp(std::cbrt(share / 0.97), 0.25, 4.0));
    if (next <= too_tight || next >= too_loose)
      next = std::min(kCoarsest, std::sqrt(too_tight * too_loose));
    if (next == trial.max_stretch) break;  // the roots alone are more hexes than wanted
    trial.max_stretch = next;
  }
  return best;
}

DualResult make_dual(const Grid& grid, const PolycubeOptions& options, const Context& context) {
  const bool is_paired =
      options.complete.pairing == Pairing::Blocks || options.complete.pairing == Pairing::Octree;
  DualOptions dual_options;
  dual_options.mode = is_paired ? DualMode::Blocks : DualMode::Sheets;
  return build_dual(grid, dual_options, context);
}

}  // namespace hexwright::polycube
