// First the flow of a liquid that enters evenly through faces that look down the axis and leaves
// through those that look up; then, a few times, the function whose gradient is nearest to that of
// the last one, made a unit vector: distances along the flow. Finite elements of first order;
// the values of a face are one unknown.
#include "polycube/labels/axis_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hexwright/base/parallel.h"

#include "polycube/tets/tet_locator.h"

namespace hexwright::polycube {
namespace {

constexpr int kRounds = 5;
constexpr double kResidual = 1e-8;  // of the right-hand side
constexpr int kMaxIterations = 3000;

struct TetGradients {
  std::array<Vec3, 4> of;  // of the barycentric coordinates
  double volume = 0;
};

TetGradients gradients_of(const TetMesh& mesh, TetId t) {
  const auto p = tet_corners(mesh, t);
  return {barycentric_gradients(p), tet_det(p) / 6};
}

class FieldSolver {
 public:
  FieldSolver(const TetMesh& object, std::span<const AxisFace> faces) : object_(object) {
    number_unknowns(faces);
    gradients_.resize(object.num_tets());
    parallel_for(object.num_tets(),
                 [&](std::size_t t) { gradients_[t] = gradients_of(object, TetId(t)); });
    assemble();
  }

  std::vector<double> run(std::span<const AxisFace> faces, const Context& context) {
    std::vector<double> u = solve(flow(faces), std::vector<double>(num_unknowns_, 0), context);
    for (int round = 0; round < kRounds; ++round) u = solve(unit_slopes(u), u, context);
    std::vector<double> values(object_.num_verts());
    for (std::size_t v = 0; v < values.size(); ++v) values[v] = u[unknown_[v]];
    return values;
  }

 private:
  void number_unknowns(std::span<const AxisFace> faces) {
    constexpr auto kNone = static_cast<std::size_t>(-1);
    unknown_.assign(object_.num_verts(), kNone);
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (VertId v : faces[f].verts) unknown_[v.index()] = f;
    num_unknowns_ = faces.size();
    for (std::size_t& u : unknown_)
      if (u == kNone) u = num_unknowns_++;
  }

  // The matrix by rows, without the diagonal, which is minus the sum of each.
  void assemble() {
    struct Entry {
      std::size_t row, column;
      double value;
    };
    std::vector<Entry> entries;
    entries.reserve(12 * object_.num_tets());
    for (TetId t : object_.tets.ids())
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
          const std::size_t row = unknown(t, i), column = unknown(t, j);
          const TetGradients& g = gradients_[t.index()];
          if (row != column) entries.push_back({row, column, dot(g.of[i], g.of[j]) * g.volume});
        }
    parallel_stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return a.row != b.row ? a.row < b.row : a.column < b.column;
    });
    first_.assign(num_unknowns_ + 1, 0);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const bool is_new = i == 0 || entries[i].row != entries[i - 1].row ||
                          entries[i].column != entries[i - 1].column;
      if (is_new) {
        column_.push_back(entries[i].column);
        value_.push_back(0);
        ++first_[entries[i].row + 1];
      }
      value_.back() += entries[i].value;
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    diagonal_.assign(num_unknowns_, 0);
    for (std::size_t row = 0; row < num_unknowns_; ++row)
      for (std::size_t k = first_[row]; k < first_[row + 1]; ++k) diagonal_[row] -= value_[k];
  }

  std::size_t unknown(TetId t, std::size_t corner) const {
    return unknown_[object_.tets[t][corner].index()];
  }

  // As much flows in as out, whatever the areas.
  std::vector<double> flow(std::span<const AxisFace> faces) const {
    double up = 0, down = 0;
    for (const AxisFace& face : faces) (face.sign > 0 ? up : down) += face.area;
    const double mean = std::sqrt(up * down);
    std::vector<double> rhs(num_unknowns_, 0);
    for (std::size_t f = 0; f < faces.size(); ++f)
      rhs[f] = faces[f].sign > 0 ? faces[f].area * mean / up : -faces[f].area * mean / down;
    return rhs;
  }

  std::vector<double> unit_slopes(const std::vector<double>& u) const {
    std::vector<double> rhs(num_unknowns_, 0);
    for (TetId t : object_.tets.ids()) {
      const TetGradients& g = gradients_[t.index()];
      Vec3 slope;
      for (std::size_t k = 0; k < 4; ++k) slope += g.of[k] * u[unknown(t, k)];
      const Vec3 unit = normalized(slope) * g.volume;
      for (std::size_t k = 0; k < 4; ++k) rhs[unknown(t, k)] += dot(g.of[k], unit);
    }
    return rhs;
  }

  std::vector<double> times(const std::vector<double>& x) const {
    std::vector<double> y(num_unknowns_);
    parallel_for(num_unknowns_, [&](std::size_t row) {
      double sum = diagonal_[row] * x[row];
      for (std::size_t k = first_[row]; k < first_[row + 1]; ++k) sum += value_[k] * x[column_[k]];
      y[row] = sum;
    });
    return y;
  }

  // Conjugate gradients, preconditioned by the diagonal. The matrix is singular by constants alone,
  // and right-hand sides sum to zero.
  // Nocedal, Wright, "Numerical Optimization", 2nd edition, algorithm 5.3.
  std::vector<double> solve(const std::vector<double>& rhs, std::vector<double> x,
                            const Context& context) const {
    const auto dot_of = [](const std::vector<double>& a, const std::vector<double>& b) {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    };
    std::vector<double> r = times(x), z(num_unknowns_);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = rhs[i] - r[i];
    const auto precondition = [&] {
      for (std::size_t i = 0; i < r.size(); ++i) z[i] = r[i] / diagonal_[i];
    };
    precondition();
    std::vector<double> p = z;
    double rz = dot_of(r, z);
    const double enough = kResidual * kResidual * dot_of(rhs, rhs);
    for (int i = 0; i < kMaxIterations && dot_of(r, r) > enough; ++i) {
      context.check_cancelled();
      const auto ap = times(p);
      const double alpha = rz / dot_of(p, ap);
      for (std::size_t k = 0; k < x.size(); ++k) {
        x[k] += alpha * p[k];
        r[k] -= alpha * ap[k];
      }
      precondition();
      const double next = dot_of(r, z);
      for (std::size_t k = 0; k < p.size(); ++k) p[k] = z[k] + next / rz * p[k];
      rz = next;
    }
    return x;
  }

  const TetMesh& object_;
  std::vector<TetGradients> gradients_;
  std::vector<std::size_t> unknown_;  // per vertex
  std::size_t num_unknowns_ = 0;
  std::vector<std::size_t> first_, column_;
  std::vector<double> value_, diagonal_;
};

}  // namespace

std::vector<double> compute_axis_field(const TetMesh& object, std::span<const AxisFace> faces,
                                       const Context& context) {
  return FieldSolver(object, faces).run(faces, context);
}

}  // namespace hexwright::polycube
