// Moves one vertex of a hex mesh to a better place without ever inverting an element: a Newton step
// on a barrier energy of the incident hex corners. Also what a parallel sweep over all vertices
// needs: the corners around each vertex laid out in order, and a colouring.
//
// Energy of a corner with edge vectors e0 e1 e2, T = |e0|^2 + |e1|^2 + |e2|^2 and determinant D:
//     shape = (1 - blend) T^3 / (27 D^2) + blend |e0|^2 |e1|^2 |e2|^2 / D^2
// (the second term is one over the squared scaled Jacobian); a vertex's energy is the sum of
// shape^power over the corners of its hexes that it takes part in, plus its attachment.
// Based on: Knupp's condition-number and shape metrics; Escobar et al. 2003 and Garanzha et al.
// 2021 for the regularised determinant that also works on inverted elements.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hexwright/mesh/hex_adjacency.h"

namespace hexwright::relax {

struct ShapeEnergy {
  double blend = 0;  ///< share of the scaled-Jacobian term, in [0, 1]
  int power = 1;     ///< the larger, the more the worst corners dominate
  /// Zero: a barrier, every determinant must be and stays positive. Positive: determinants D are
  /// replaced by (D + sqrt(D^2 + untangle^2)) / 2, which is finite on inverted corners too.
  double untangle = 0;
};

/// The set a vertex is pulled to; `direction` is a plane's normal or a line's tangent.
enum class AttachTo : std::uint8_t { Nothing, Plane, Line, Point };
/// The set a vertex may move in; `axis` is a plane's normal or a line's direction (unit).
enum class MoveIn : std::uint8_t { Space, Plane, Line, Point };

/// What is asked of one vertex besides shape.
struct VertexGoal {
  AttachTo attach = AttachTo::Nothing;
  MoveIn move = MoveIn::Space;
  /// Energy: weight * ((x-t).d)^2 for a plane, weight * (|x-t|^2 - ((x-t).d)^2) for a line (a
  /// direction shorter than one also holds the vertex along the line), weight * |x-t|^2 for a
  /// point.
  double weight = 0;
  Vec3 target, direction;
  Vec3 axis;
  /// Factors of the incident hexes' shape energies, in the star's order; empty = all one.
  std::span<const double> hex_weights;
  /// Length of the first trial step in Newton steps, in (0, 2): above 1 is over-relaxation, with
  /// which sweeps over a whole mesh converge in far fewer rounds.
  double relaxation = 1;
  double max_step = 0;  ///< longest displacement of one solve; shorter than 1e-6 of it is no move
};

/// Around one vertex, for each incident hex: its three edge neighbours n0 n1 n2 (right-handed) and
/// the three vertices d01 d12 d20 diagonal to it in the faces spanned by them.
using HexStar = std::array<VertId, 6>;

/// Vertex -> the stars of its incident hexes, in compressed rows ordered as VertToHex.
class VertexStars {
 public:
  VertexStars() = default;
  explicit VertexStars(const HexMesh& mesh);
  VertexStars(const HexMesh& mesh, const VertToHex& vert_to_hex);
  std::span<const HexStar> operator[](VertId v) const {
    return {stars_.data() + offset_[v.index()], stars_.data() + offset_[v.index() + 1]};
  }
  std::size_t num_verts() const { return offset_.empty() ? 0 : offset_.size() - 1; }

 private:
  std::vector<std::size_t> offset_;  // num_verts + 1
  std::vector<HexStar> stars_;
};

/// Energy, gradient and the positive semidefinite Hessian used (xx xy xz yy yz zz) at the vertex's
/// position. Infinite energy when a determinant is not positive and `untangle` is zero.
struct VertexDerivatives {
  double energy = 0;
  Vec3 gradient;
  std::array<double, 6> hessian{};
};

/// Solves for single vertices. Holds scratch memory: one object per thread.
class VertexNewton {
 public:
  /// One Newton step: bounded by max_step and, for a barrier, by 0.9 of the way to the first
  /// vanishing determinant; accepted when the energy falls enough (Armijo). Writes positions[v] and
  /// returns the length moved; 0 when nothing better was found.
  double solve(VertId v, std::span<const HexStar> star, const VertexGoal& goal,
               const ShapeEnergy& shape, IdSpan<VertId, Vec3> positions);

  /// What `solve` starts from, for checks and for callers with a solver of their own.
  VertexDerivatives evaluate(VertId v, std::span<const HexStar> star, const VertexGoal& goal,
                             const ShapeEnergy& shape, IdSpan<VertId, const Vec3> positions);

 private:
  std::vector<double> lanes_;  // per incident hex: its four corners side by side
};

/// Least scaled Jacobian over the corners that move with a vertex (its own and its neighbours').
double min_scaled_jacobian_around(const Vec3& position, std::span<const HexStar> star,
                                  IdSpan<VertId, const Vec3> positions);

/// Vertices grouped so that no two of a group share a hex: the members of a group can be solved at
/// the same time, and the result does not depend on how many are.
class VertexColors {
 public:
  VertexColors() = default;
  VertexColors(const HexMesh& mesh, const VertToHex& vert_to_hex);
  std::size_t num_colors() const { return offset_.empty() ? 0 : offset_.size() - 1; }
  /// The vertices of a colour in order of id.
  std::span<const VertId> operator[](std::size_t color) const {
    return {verts_.data() + offset_[color], verts_.data() + offset_[color + 1]};
  }

 private:
  std::vector<std::size_t> offset_;  // num_colors + 1
  std::vector<VertId> verts_;
};

}  // namespace hexwright::relax
