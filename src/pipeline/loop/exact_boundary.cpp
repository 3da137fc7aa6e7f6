// One vertex at a time, in the order of their numbers: the exact shape's answers depend on nothing
// but the vertex, and whether a move is taken on the moves before it.
#include "pipeline/loop/exact_boundary.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/cancel.h"
#include "hexwright/quality/hex_quality.h"
#include "hexwright/quality/judge.h"

#include "base/stage_log.h"
#include "mesh/quad.h"
#include "relax/kernel/vertex_newton.h"

namespace hexwright {
namespace {

/// Of the edges around: what is farther away belongs to something else, as where parts were united
/// and the exact shape has no curve.
constexpr double kFarthest = 0.5;
constexpr int kSweeps = 3, kHalvings = 4;
/// Hexes around may fall to the mesh's least scaled Jacobian, within these bounds.
constexpr double kLeastFloor = 0.4, kMostFloor = 0.5;
/// Closer than this, in unit coordinates, is on the shape.
constexpr double kArrived = 1e-10;

enum class Place : std::uint8_t { None, Surface, Curve, Corner };

class ExactMover {
 public:
  ExactMover(const RoundInput& input, HexMesh& mesh)
      : input_(input),
        mesh_(mesh),
        place_(mesh.num_verts(), Place::None),
        normal_(mesh.num_verts()),
        reach_(mesh.num_verts(), 0.0),
        vert_to_hex_(mesh),
        stars_(mesh, vert_to_hex_) {
    const bool is_outside = input.options.fit.carve.side == Side::Outside;
    for (const LabeledQuad& quad : mesh.labels.quads) add_quad(quad, is_outside ? -1 : 1);
    for (const LabeledEdge& edge : mesh.labels.edges)
      for (const VertId v : edge.verts) place_[v] = Place::Curve;
    for (const VertId v : mesh.labels.corners) place_[v] = Place::Corner;
  }

  ExactReport run() {
    ExactReport report;
    find_goals();
    floor_ = std::clamp(least_quality(), kLeastFloor, kMostFloor);
    report.max_before = largest_miss();
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      for (const VertId v : goal_.ids()) {
        check_cancelled();
        if (goal_[v]) move(v);
      }
    for (const VertId v : goal_.ids()) {
      report.num_verts += place_[v] != Place::None;
      if (!goal_[v]) continue;
      const double miss = distance(mesh_.positions[v], *goal_[v]);
      ++(miss <= kArrived ? report.num_exact : report.num_short);
    }
    report.max_after = largest_miss();
    return report;
  }

 private:
  void add_quad(const LabeledQuad& quad, double sign) {
    const auto& p = mesh_.positions;
    const auto& q = quad.verts;
    const Vec3 n = sign * quad_normal(p, q);
    for (std::size_t k = 0; k < 4; ++k) {
      const double length = distance(p[q[k]], p[q[(k + 1) % 4]]);
      for (const VertId v : {q[k], q[(k + 1) % 4]})
        reach_[v] = reach_[v] > 0 ? std::min(reach_[v], length) : length;
      place_[q[k]] = Place::Surface;
      normal_[q[k]] += n;
    }
  }

  void find_goals() {
    goal_.resize(mesh_.num_verts());
    for (const VertId v : place_.ids()) {
      check_cancelled();
      if (place_[v] != Place::None) goal_[v] = find_goal(v);
    }
  }

  /// In unit coordinates. What is no curve or corner of the exact shape, as on the border of a
  /// part that was named by rule, is on its surface.
  std::optional<Vec3> find_goal(VertId v) const {
    const Similarity& frame = input_.target.frame;
    const ExactShape& exact = *input_.options.exact;
    const Vec3 p = frame.to_world(mesh_.positions[v]);
    const auto near = [&](const Vec3& found) -> std::optional<Vec3> {
      const Vec3 goal = frame.to_unit(found);
      if (distance(goal, mesh_.positions[v]) > kFarthest * reach_[v]) return {};
      return goal;
    };
    if (place_[v] == Place::Corner)
      if (const auto found = exact.on_corner(p))
        if (const auto goal = near(*found)) return goal;
    if (place_[v] != Place::Surface)
      if (const auto found = exact.on_curve(p))
        if (const auto goal = near(found->point)) return goal;
    const Vec3 normal = frame.pose.apply_inverse(normalized(normal_[v]));
    const auto found = exact.on_surface(p, normal);
    return found ? near(found->point) : std::nullopt;
  }

  double least_quality() const {
    const auto quality = compute_scaled_jacobians(mesh_);
    return *std::min_element(quality.begin(), quality.end());
  }

  double largest_miss() const {
    double largest = 0;
    for (const VertId v : goal_.ids())
      if (goal_[v]) largest = std::max(largest, distance(mesh_.positions[v], *goal_[v]));
    return largest / input_.target.diagonal();
  }

  void move(VertId v) {
    const Vec3 way = *goal_[v] - mesh_.positions[v];
    if (norm(way) <= kArrived) return;
    double share = 1;
    for (int halving = 0; halving <= kHalvings; ++halving, share *= 0.5)
      if (try_move(v, share == 1 ? *goal_[v] : mesh_.positions[v] + share * way)) return;
  }

  bool try_move(VertId v, const Vec3& there) {
    const IdSpan<VertId, const Vec3> positions(mesh_.positions);
    const Vec3 origin = mesh_.positions[v];
    const double before = relax::min_scaled_jacobian_around(origin, stars_[v], positions);
    const double after = relax::min_scaled_jacobian_around(there, stars_[v], positions);
    if (!(after > 0 && after >= std::min(before - 1e-12, floor_))) return false;
    const int unproven = count_unproven(v);
    mesh_.positions[v] = there;
    if (count_unproven(v) <= unproven) return true;
    mesh_.positions[v] = origin;
    return false;
  }

  int count_unproven(VertId v) const {
    int count = 0;
    for (const HexCorner& corner : vert_to_hex_[v])
      count += check_positivity(mesh_.corners(corner.hex)) != Positivity::Positive;
    return count;
  }

  const RoundInput& input_;
  HexMesh& mesh_;
  double floor_ = 0;
  IdVector<VertId, Place> place_;
  IdVector<VertId, Vec3> normal_;   ///< outwards, not of unit length
  IdVector<VertId, double> reach_;  ///< the shortest boundary edge at a vertex
  VertToHex vert_to_hex_;
  relax::VertexStars stars_;
  IdVector<VertId, std::optional<Vec3>> goal_;
};

}  // namespace

ExactReport put_on_exact_shape(const RoundInput& input, Round& round) {
  ExactReport report;
  if (round.fit.mesh.num_hexes() == 0) return report;
  report = run_stage(round.stages, "exact boundary", input.context,
                     [&] { return ExactMover(input, round.fit.mesh).run(); });
  curve_round(input, round, input.options.exact.get());
  round.verdict = run_stage(round.stages, "judge", input.context, [&] {
    return judge(round.fit.mesh, input.target, input.plan.judge, input.context);
  });
  return report;
}

}  // namespace hexwright
