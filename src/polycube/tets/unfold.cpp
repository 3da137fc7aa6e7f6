// Minimises, over the tets, |J|^2 / x(det J)^(2/3) + 0.1 (1 + det^2) / x(det J), where J is the
// map's Jacobian and x(d) = (d + sqrt(e^2 + d^2)) / 2 keeps the determinant positive (equations 2
// to 4 of the paper); e falls with the least determinant. Descent by L-BFGS. Differs: e follows the
// least determinant directly; vertices keep to their axes.
#include "polycube/tets/unfold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numeric>

#include "hexwright/base/parallel.h"

#include "polycube/tets/tet_locator.h"

namespace hexwright::polycube {
namespace {

// How much even volumes count beside even shapes.
constexpr double kVolumeShare = 0.1;  // weight of the determinant's own term
constexpr int kMaxRounds = 40, kMaxSteps = 60;
// Steps that L-BFGS remembers.
constexpr std::size_t kMemory = 8;

// Column k of a Jacobian is the image of axis k.
using Matrix = std::array<Vec3, 3>;

// A tet with the gradients of its four barycentric coordinates in the shape it strives for.
struct Element {
  std::array<VertId, 4> verts;
  std::array<Vec3, 4> gradient;
  double weight = 1;  // volume of that shape
};

using Positions = std::vector<Vec3>;

double dot_all(const Positions& a, const Positions& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

class Unfolder {
 public:
  Unfolder(const TetMesh& object, const IdVector<VertId, std::uint8_t>& free_axes, TetMesh& image,
           const UnfoldOptions& options)
      : free_axes_(free_axes), options_(options), x_(image.positions.raw()) {
    double object_volume = 0, image_volume = 0;
    for (TetId t : object.tets.ids()) {
      object_volume += tet_det(reference_of(object, t));
      image_volume += tet_det(tet_corners(image, t));
    }
    scale_ = std::cbrt(image_volume / object_volume);  // so that the determinants' mean is one
    for (TetId t : object.tets.ids()) add_element(object, t);
    list_corners();
  }

  // Continuation in epsilon: while the least determinant is below zero, epsilon is a fifth of it,
  // so that folded tets feel a slope; each round starts where the last one ended.
  std::size_t run(const Context& context) {
    for (int round = 0; round < kMaxRounds && least_det() <= kLeastDet; ++round) {
      context.check_cancelled();
      const double least = std::min(least_det(), 0.0);
      epsilon_sq_ = 1e-6 + 0.04 * least * least;
      if (!descend(context)) break;
    }
    if (least_det() > 0) epsilon_sq_ = 1e-6;
    if (options_.polishes && least_det() > 0) descend(context);
    std::size_t num_folded = 0;
    for (const Element& e : elements_) num_folded += det_of(jacobian(e, x_)) <= 0;
    return num_folded;
  }

 private:
  static constexpr double kLeastDet = 1e-4;  // of the mean; flatter tets map cells to slivers

  std::array<Vec3, 4> reference_of(const TetMesh& object, TetId t) const {
    return options_.reference ? options_.reference(t) : tet_corners(object, t);
  }

  // Only tets with a free vertex count: the others are constants of the energy.
  void add_element(const TetMesh& object, TetId t) {
    Element e{object.tets[t], {}, 1};
    if (std::none_of(e.verts.begin(), e.verts.end(), [&](VertId v) { return free_axes_[v] != 0; }))
      return;
    auto p = reference_of(object, t);
    for (Vec3& q : p) q = q * scale_;
    const double volume = tet_det(p);
    if (!(volume > 0)) return;
    e.weight = volume / 6;
    e.gradient = barycentric_gradients(p);
    elements_.push_back(e);
  }

  static Matrix jacobian(const Element& e, const Positions& x) {
    Matrix j;
    for (std::size_t k = 0; k < 4; ++k)
      for (int a = 0; a < 3; ++a)
        j[static_cast<std::size_t>(a)] += x[e.verts[k].index()] * e.gradient[k][a];
    return j;
  }
  static double det_of(const Matrix& j) { return det(j[0], j[1], j[2]); }

  double least_det() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Element& e : elements_) least = std::min(least, det_of(jacobian(e, x_)));
    return least;
  }

  // Which corners of the elements each vertex is, in order: sums over them do not depend on the
  // number of threads.
  void list_corners() {
    first_corner_.assign(x_.size() + 1, 0);
    for (const Element& e : elements_)
      for (VertId v : e.verts) ++first_corner_[v.index() + 1];
    for (std::size_t v = 0; v < x_.size(); ++v) first_corner_[v + 1] += first_corner_[v];
    corners_.resize(4 * elements_.size());
    auto next = first_corner_;
    for (std::size_t i = 0; i < elements_.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k)
        corners_[next[elements_[i].verts[k].index()]++] = 4 * i + k;
  }

  // Of one element; its slopes by the corners' positions go to `slopes`.
  double energy_of(const Element& e, const Positions& x, Vec3* slopes) const {
    const Matrix j = jacobian(e, x);
    const double d = det_of(j), root = std::sqrt(epsilon_sq_ + d * d);
    // chi = (d + sqrt(eps^2 + d^2)) / 2. For d < 0 that is a difference of nearly equal
    // numbers, so it is multiplied out.
    const double chi = d > 0 ? (d + root) / 2 : epsilon_sq_ / (2 * (root - d));
    const double chi_slope = (1 + d / root) / 2;
    const double size = norm_sq(j[0]) + norm_sq(j[1]) + norm_sq(j[2]);
    const double shape = size / std::cbrt(chi * chi), volume = (1 + d * d) / chi;
    // Derivatives by the determinant; the derivative of that by J is its cofactor matrix.
    const double by_det = -2.0 / 3 * shape / chi * chi_slope +
                          kVolumeShare * (2 * d / chi - volume / chi * chi_slope);
    const Matrix cofactor = {cross(j[1], j[2]), cross(j[2], j[0]), cross(j[0], j[1])};
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t a = 0; a < 3; ++a)
        slopes[k] += (j[a] * (2 / std::cbrt(chi * chi)) + cofactor[a] * by_det) *
                     (e.weight * e.gradient[k][static_cast<int>(a)]);
    return e.weight * (shape + kVolumeShare * volume);
  }

  struct Value {
    double energy = 0;
    Positions gradient;
  };

  // Axes that are not free have no slope, so no direction of descent ever leaves a face; vertices
  // that are tied have their mean slope, so they stay together: this is the gradient's projection
  // to the positions that are allowed.
  Value evaluate(const Positions& x) const {
    std::vector<double> parts(elements_.size());
    std::vector<Vec3> slopes(4 * elements_.size());
    parallel_for(elements_.size(), [&](std::size_t i) {
      parts[i] = energy_of(elements_[i], x, slopes.data() + 4 * i);
    });
    Positions g(x.size());
    parallel_for(x.size(), [&](std::size_t v) {
      for (std::size_t c = first_corner_[v]; c < first_corner_[v + 1]; ++c)
        g[v] += slopes[corners_[c]];
      for (int a = 0; a < 3; ++a)
        if (!(free_axes_[VertId(v)] >> a & 1)) g[v][a] = 0;
    });
    for (const Tie& tie : options_.ties) {
      double sum = 0;
      for (VertId v : tie.verts) sum += g[v.index()][tie.axis];
      for (VertId v : tie.verts)
        g[v.index()][tie.axis] = sum / static_cast<double>(tie.verts.size());
    }
    return {std::accumulate(parts.begin(), parts.end(), 0.0), std::move(g)};
  }

  // Two-loop recursion over the last steps and gradient differences.
  // Nocedal, Wright, "Numerical Optimization", 2nd edition, algorithm 7.4.
  Positions direction(const Positions& g) const {
    Positions d = g;
    std::array<double, kMemory> alpha{};
    for (std::size_t i = memory_.size(); i-- > 0;) {
      alpha[i] = dot_all(memory_[i].step, d) / memory_[i].curvature;
      for (std::size_t v = 0; v < d.size(); ++v) d[v] -= memory_[i].change[v] * alpha[i];
    }
    if (!memory_.empty()) {
      const auto& last = memory_.back();
      const double scale = last.curvature / dot_all(last.change, last.change);
      for (Vec3& p : d) p *= scale;
    }
    for (std::size_t i = 0; i < memory_.size(); ++i) {
      const double beta = dot_all(memory_[i].change, d) / memory_[i].curvature;
      for (std::size_t v = 0; v < d.size(); ++v) d[v] += memory_[i].step[v] * (alpha[i] - beta);
    }
    for (Vec3& p : d) p = -p;
    return d;
  }

  // L-BFGS with Armijo's rule. False when not even the first step gains anything.
  bool descend(const Context& context) {
    memory_.clear();
    Value current = evaluate(x_);
    for (int step = 0; step < kMaxSteps; ++step) {
      context.check_cancelled();
      const Positions d = direction(current.gradient);
      const double slope = dot_all(d, current.gradient);
      if (!(slope < 0)) return step > 0;
      double length = memory_.empty() ? 0.1 / std::sqrt(-slope) : 1;
      Positions there;
      Value next;
      for (int halving = 0;; ++halving, length /= 2) {
        if (halving == 30) return step > 0;
        there = x_;
        for (std::size_t v = 0; v < d.size(); ++v) there[v] += d[v] * length;
        next = evaluate(there);
        if (next.energy <= current.energy + 1e-4 * length * slope) break;
      }
      x_.swap(there);  // `there` now holds the last positions
      remember(there, current.gradient, next.gradient);
      const bool has_converged = current.energy - next.energy < 1e-7 * current.energy;
      current = std::move(next);
      if (has_converged) return true;
    }
    return true;
  }

  void remember(const Positions& last_x, const Positions& last_g, const Positions& g) {
    Pair pair{x_, g, 0};
    for (std::size_t v = 0; v < g.size(); ++v) {
      pair.step[v] -= last_x[v];
      pair.change[v] -= last_g[v];
    }
    pair.curvature = dot_all(pair.step, pair.change);
    if (!(pair.curvature > 0)) return;  // not convex along the step: the pair would mislead
    memory_.push_back(std::move(pair));
    if (memory_.size() > kMemory) memory_.pop_front();
  }

  struct Pair {
    Positions step, change;
    double curvature;
  };

  const IdVector<VertId, std::uint8_t>& free_axes_;
  const UnfoldOptions& options_;
  Positions& x_;
  std::vector<Element> elements_;
  std::vector<std::size_t> first_corner_, corners_;  // per vertex, 4 * element + corner
  std::deque<Pair> memory_;
  double scale_ = 1, epsilon_sq_ = 0;
};

}  // namespace

std::size_t unfold(const TetMesh& object, const IdVector<VertId, std::uint8_t>& free_axes,
                   TetMesh& image, const UnfoldOptions& options, const Context& context) {
  return Unfolder(object, free_axes, image, options).run(context);
}

}  // namespace hexwright::polycube
