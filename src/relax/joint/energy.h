// The least scaled Jacobian of a small group of hexes as a smooth function of all its vertices at
// once, and the steps that raise it.
//
// With values v_c (the scaled Jacobian of every corner, and 2 |e| / h of every edge, which keeps
// edges above a quarter of the local size):
//     F(x) = (1/b) ln sum_c exp(-b v_c) + kPull sum_i (off_i / slack_i)^2,
// whose first term tends to -min v_c as b grows.
//
// Based on: Gauss-Newton with Levenberg's damping (Nocedal, Wright, "Numerical Optimization", 2nd
// ed., section 10.3) on the log-sum-exp; the curvature of the single v_c is left out. Differs: the
// linear systems, of low rank beside their damping, are solved by conjugate gradients with 3 x 3
// blocks as preconditioner (ibid., section 5.1), so that no matrix is ever formed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hexwright/base/vec3.h"

#include "relax/state/fit_state.h"

namespace hexwright::relax {

/// Local numbering: movable vertices first.
using LocalVert = std::uint16_t;

/// Corner of a hex: the vertex and its three edge neighbours, right-handed.
using LocalCorner = std::array<LocalVert, 4>;

struct LocalEdge {
  std::array<LocalVert, 2> verts;
  double size = 0;  ///< h; the edge counts as half of it would
};

/// What corners and edges the energy is a sum over. Each has at least one movable vertex.
struct JointShape {
  std::vector<LocalCorner> corners;
  std::vector<LocalEdge> edges;
  std::size_t num_movable = 0;
};

/// How a movable vertex is held while all move. Without slack it slides: surface vertices in the
/// plane across `axis`, curve vertices along it, corners not at all; interior ones are always free.
struct JointFreedom {
  VertKind kind = VertKind::Interior;
  Vec3 axis;         ///< unit: the surface's normal, the curve's tangent
  Vec3 off;          ///< from where it belongs to where it is: along the normal, across the tangent
  double slack = 0;  ///< length that `off` is compared with
  double size = 1;   ///< h: the unit of its steps
};

struct JointValue {
  double energy = 0;
  double least = 0;  ///< least scaled Jacobian over the corners
};

/// The energy of one shape; scratch memory is kept between calls.
class JointEnergy {
 public:
  explicit JointEnergy(const JointShape& shape) : shape_(shape) {}

  /// `positions`: of all local vertices; `freedom`: of the movable ones.
  JointValue evaluate(std::span<const Vec3> positions, std::span<const JointFreedom> freedom,
                      double sharpness);

  /// Fixes where steps start from: the place of the last evaluate().
  void linearize(std::span<const Vec3> positions, std::span<const JointFreedom> freedom,
                 double sharpness);

  /// From there the step for every movable vertex, none longer than `longest` times its size.
  std::span<const Vec3> step(std::span<const JointFreedom> freedom, double damping, double longest);

 private:
  struct Row {  // one corner or edge that matters, in units of the vertices' sizes
    double weight = 0;
    std::size_t count = 0;
    std::array<LocalVert, 4> verts{};
    std::array<Vec3, 4> gradient;
  };
  void add_row(double weight, std::span<const LocalVert> verts, std::span<const Vec3> gradient,
               std::span<const JointFreedom> freedom);
  void add_pulls(std::span<const JointFreedom> freedom);
  void precondition(std::span<const JointFreedom> freedom);
  void multiply(std::span<const JointFreedom> freedom);
  void solve(std::span<const JointFreedom> freedom);

  const JointShape& shape_;
  std::vector<double> values_, weights_;  // of corners, then edges
  double weight_sum_ = 0;

  // The linear system, multiplied by the sum of weights: rows of rank one, pulls, damping.
  double sharpness_ = 0, scale_ = 0, diagonal_ = 0;
  std::vector<Row> rows_;
  std::vector<Vec3> rhs_;
  std::vector<double> pull_;
  std::vector<std::array<double, 6>> block_, inverse_;  // symmetric 3 x 3: xx xy xz yy yz zz
  std::vector<Vec3> x_, r_, z_, p_, ap_;
};

}  // namespace hexwright::relax
