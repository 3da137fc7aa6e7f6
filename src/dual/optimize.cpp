// Four rows, each on the vertices of hexes that need it and with a few sweeps at a time:
//   kUntangle  regularised energy around inverted hexes;
//   kSpread    a barrier energy almost everywhere, as a start;
//   kWorst     one of higher power, so that the worst corners dominate, around hexes that are poor;
//   kMean      weighted energies that raise the mean scaled Jacobian and hold up the least.
// Based on: Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov, "Foldover-free maps in 50 lines
// of code", ACM TOG 40(4), 2021 (regularised determinants, decreased until nothing is inverted);
// Hunter, Lange, "A tutorial on MM algorithms", The American Statistician 58(1), 2004 (the
// weights). Differs: solved vertex by vertex with Newton steps, and only around bad hexes.
#include "dual/optimize.h"

#include <utility>

#include "relax/passes/mean_weights.h"
#include "relax/passes/pass.h"

namespace hexwright::dual {

using namespace relax;

namespace {

constexpr double kPositive = 1e-3;  // below: inverted, or flat but for rounding
constexpr int kMeanPower = 4;       // the larger, the closer to the least corner

IdVector<HexId, double> weigh(const HexMesh& mesh) {
  constexpr double kKnee = 0.6;
  return mean_weights(mesh, kMeanPower, kKnee);
}

/// Half an edge at most, and what moves less than a fiftieth of that is left alone.
constexpr SweepOptions sweep_with(const ShapeEnergy& shape) {
  return {.shape = shape, .tolerance = 0.01, .max_step = 0.5};
}

// Hexes that are inverted or nearly so, with less and less regularisation and wider and wider
// surroundings.
constexpr Pass kUntangle = {.limit = 0.02,
                            .max_rounds = 40,
                            .rings = 1,
                            .rounds_per_ring = 6,
                            .sweep = sweep_with({0, 1, 0}),
                            .sweeps = 3,
                            .again = Again::Moving,
                            .untangle = {0.3, 0.01, 0.7}};
// First almost everywhere, as a start for what follows; then where something is really bad.
constexpr Pass kSpread = {
    .limit = 0.9, .sweep = sweep_with({0.8, 1, 0}), .sweeps = 3, .again = Again::Moving};
constexpr Pass kWorst = {.limit = 0.4,
                         .max_rounds = 4,
                         .rings = 1,
                         .sweep = sweep_with({0.9, 4, 0}),
                         .sweeps = 3,
                         .again = Again::Moving};
constexpr Pass kMean = {.limit = 0.95,
                        .max_rounds = 2,
                        .sweep = sweep_with({1, kMeanPower, 0}),
                        .sweeps = 4,
                        .again = Again::Moving,
                        .weigh = weigh};

// Vertices of the domain's faces slide in them, of its edges along them.
void restrict_moves(const FixedAxes& fixed_axes, Body& body) {
  for (VertId v : fixed_axes.ids()) {
    const int fixed = fixed_axes[v];
    if (fixed == 7) body.move[v] = MoveIn::Point;
    for (int a = 0; a < 3; ++a) {
      const bool is_plane = fixed == 1 << a, is_line = fixed == (7 ^ 1 << a);
      if (!is_plane && !is_line) continue;
      body.move[v] = is_plane ? MoveIn::Plane : MoveIn::Line;
      body.axis[v][a] = 1;
    }
  }
}

// Lets the boundary vertices of inverted hexes leave the boundary: some corners where the domain
// is neither convex nor concave leave no other way. Returns how many.
std::size_t free_inverted(Body& body) {
  const std::vector<char> region = verts_of_poor_hexes(body, kPositive);
  std::size_t num_freed = 0;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const VertId v(i);
    if (!region[i] || body.move[v] == MoveIn::Space) continue;
    body.move[v] = MoveIn::Space;
    ++num_freed;
  }
  return num_freed;
}

bool untangle(Body& body, const Context& context) {
  return run(kUntangle, body, context) || verts_of_poor_hexes(body, kPositive).empty();
}

}  // namespace

std::size_t optimize_positions(HexMesh& mesh, VertToHex vert_to_hex, const FixedAxes& fixed_axes,
                               const Context& context) {
  constexpr int kMaxReleases = 3;
  Body body(std::move(mesh), std::move(vert_to_hex));
  restrict_moves(fixed_axes, body);
  std::size_t num_freed = 0;
  bool is_clear = untangle(body, context);
  for (int k = 0; k < kMaxReleases && !is_clear; ++k) {
    num_freed += free_inverted(body);
    is_clear = untangle(body, context);
  }
  for (const Pass* pass : {&kSpread, &kWorst, &kMean}) run(*pass, body, context);
  mesh = std::move(body.mesh);
  return num_freed;
}

}  // namespace hexwright::dual
