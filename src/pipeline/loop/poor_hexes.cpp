// One leaf in a few hundred is split, so the rest of the mesh stays as it was.
#include "pipeline/loop/poor_hexes.h"

#include <algorithm>
#include <cmath>

#include "hexwright/mesh/hex_adjacency.h"
#include "hexwright/quality/hex_quality.h"

#include "mesh/hex_center.h"
#include "mesh/quad.h"
#include "pipeline/loop/demands.h"
#include "pipeline/loop/hex_limit.h"

namespace hexwright {
namespace {

/// Hexes are poor below this share of the lift's goal.
constexpr double kPoorShare = 0.8;
/// Where all of them would ask for too many cells, the worst alone are refined for: those below
/// these shares of that.
constexpr double kShares[] = {1, 0.75, 0.5};
constexpr int kMostTries = 3;
/// Of the cells from try to try, and of the hexes in all.
constexpr double kMostGrowth = 1.5, kMostHexes = 1.6;

/// Whether two boundary faces of the hex meet at an angle of which the sine is below `least`: no
/// corner there has a larger scaled Jacobian.
bool holds_wedge(const HexMesh& mesh, const HexNeighbors& neighbors, HexId h, double least) {
  std::vector<std::array<VertId, 4>> faces;
  std::vector<Vec3> normals;
  for (int f = 0; f < 6; ++f) {
    if (neighbors.neighbor[h][static_cast<std::size_t>(f)].is_valid()) continue;
    faces.push_back(face_verts(mesh, {h, f}));
    normals.push_back(quad_normal(mesh.positions, faces.back()));
  }
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      const bool is_sharp = dot(normals[i], normals[j]) < 0;
      const bool meet = std::ranges::any_of(
          faces[i], [&](VertId v) { return std::ranges::find(faces[j], v) != faces[j].end(); });
      if (meet && is_sharp && norm(cross(normals[i], normals[j])) < least) return true;
    }
  return false;
}

double least_quality(const Round& round) { return round.verdict.quality.min_scaled_jacobian; }

/// Of hexes whose Jacobian may vanish inside.
std::size_t num_unproven(const Round& round) { return round.fit.report.unproven.size(); }

/// A solver refuses what is not positive inside; a poor hex it takes.
bool is_sounder(const Round& a, const Round& b) {
  if (num_unproven(a) != num_unproven(b)) return num_unproven(a) < num_unproven(b);
  return least_quality(a) > least_quality(b);
}

bool is_any(const std::vector<char>& marks) {
  return std::find(marks.begin(), marks.end(), 1) != marks.end();
}

/// Whether a grid grows little over the round's, and is within the budgets.
bool is_affordable(const RoundInput& input, const Round& round, std::size_t num_cells,
                   std::size_t num_spent) {
  return static_cast<double>(num_cells) <=
             kMostGrowth * static_cast<double>(round.grid.num_cells()) &&
         find_exceeded(input, round, num_cells, num_spent, false).empty();
}

/// The grid for another try, completed; absent when nothing can be split, or only at too many
/// cells.
std::optional<CompleteResult> next_try(const RoundInput& input, const Round& round, double goal,
                                       std::span<const Vec3> missed, std::size_t num_spent) {
  for (const double share : kShares) {
    std::vector<Vec3> places = find_poor_places(round.fit.mesh, share * goal);
    for (HexId h : round.fit.report.unproven) places.push_back(center_of(round.fit.mesh, h));
    places.insert(places.end(), missed.begin(), missed.end());
    const std::vector<char> marks = mark_splittable(input, round.grid, places);
    if (!is_any(marks)) return {};
    CompleteResult next = even_out(input, split_cells(round.grid, marks), true);
    if (is_affordable(input, round, next.grid.num_cells(), num_spent)) return next;
  }
  return {};
}

/// With a budget of hexes, more of them never give a mesh that is farther off; within the tolerance
/// all are alike.
bool is_no_farther(const RoundInput& input, const Round& before, const Round& after) {
  return input.options.most_hexes == 0 ||
         max_distance(after) <= std::max(max_distance(before), input.options.sizing.tolerance);
}

}  // namespace

std::vector<Vec3> find_poor_places(const HexMesh& mesh, double goal) {
  const IdVector<HexId, double> quality = compute_scaled_jacobians(mesh);
  std::vector<Vec3> places;
  std::optional<HexNeighbors> neighbors;
  for (HexId h : quality.ids()) {
    if (quality[h] >= goal) continue;
    if (!neighbors) neighbors = compute_hex_neighbors(mesh);
    if (holds_wedge(mesh, *neighbors, h, goal)) continue;
    places.push_back(center_of(mesh, h));
  }
  return places;
}

Round refine_where_poor(const RoundInput& input, Round lifted, MeshResult& result) {
  const double goal = kPoorShare * input.options.fit.lift_goal;
  const auto most_for_this =
      static_cast<std::size_t>(kMostHexes * static_cast<double>(lifted.fit.mesh.num_hexes()));
  std::size_t num_spent = 0;
  for (const RoundRecord& record : result.rounds) num_spent += record.num_background;
  Round best = lifted, current = std::move(lifted);
  for (int k = 0; k < kMostTries && result.num_rounds < input.options.max_rounds; ++k) {
    const bool is_good = least_quality(best) >= goal && num_unproven(best) == 0;
    if (is_good || best.verdict.quality.num_inverted > 0) break;
    std::vector<Vec3> missed;
    if (!meets_no_less(input, best, current)) missed = collect_places(input, current, false);
    std::optional<CompleteResult> next = next_try(input, current, goal, missed, num_spent);
    if (!next) break;
    current = lift_round(input, run_round(input, std::move(*next)));
    result.rounds.push_back(current.record);
    num_spent += current.record.num_background;
    ++result.num_rounds;
    if (current.fit.mesh.num_hexes() > most_for_this || !meets_no_less(input, best, current) ||
        !is_sounder(current, best) || !is_no_farther(input, best, current))
      continue;
    if (!is_within_limit(input, current)) {
      result.is_limited = true;
      continue;
    }
    best = current;
    result.best_round = result.num_rounds;
  }
  return best;
}

}  // namespace hexwright
