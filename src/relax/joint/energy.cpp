#include "relax/joint/energy.h"

#include <algorithm>
#include <cmath>

namespace hexwright::relax {
namespace {

constexpr double kPull = 0.002;
constexpr double kNegligible = 1e-4;  // weight beside the largest from which a value matters
constexpr int kMaxIterations = 30;    // of conjugate gradients ...
constexpr double kResidual = 0.05;    // ... or until the residual fell to this share

double corner_value(const LocalCorner& c, std::span<const Vec3> p) {
  const Vec3 a = p[c[1]] - p[c[0]], b = p[c[2]] - p[c[0]], d = p[c[3]] - p[c[0]];
  const double lengths_sq = norm_sq(a) * norm_sq(b) * norm_sq(d);
  return lengths_sq > 0 ? det(a, b, d) / std::sqrt(lengths_sq) : -1;
}

double edge_value(const LocalEdge& e, std::span<const Vec3> p) {
  return 2 * distance(p[e.verts[0]], p[e.verts[1]]) / e.size;
}

Vec3 along(const Vec3& axis, const Vec3& x) { return dot(x, axis) * axis; }

// What is left of a step where it is restricted.
Vec3 project(const JointFreedom& f, const Vec3& x) {
  if (f.slack > 0) return x;
  switch (f.kind) {
    case VertKind::Interior:
      return x;
    case VertKind::Surface:
      return x - along(f.axis, x);
    case VertKind::Curve:
      return along(f.axis, x);
    case VertKind::Corner:
      return {};
  }
  return {};
}

// The part of a step that the pull acts on.
Vec3 held_part(const JointFreedom& f, const Vec3& x) {
  if (f.kind == VertKind::Surface) return along(f.axis, x);
  return f.kind == VertKind::Curve ? x - along(f.axis, x) : x;
}

std::array<double, 6> outer(const Vec3& a) {
  return {a.x * a.x, a.x * a.y, a.x * a.z, a.y * a.y, a.y * a.z, a.z * a.z};
}

void add_scaled(std::array<double, 6>& m, double s, const std::array<double, 6>& a) {
  for (std::size_t k = 0; k < 6; ++k) m[k] += s * a[k];
}

std::array<double, 6> invert(const std::array<double, 6>& m) {
  const double a = m[3] * m[5] - m[4] * m[4], b = m[2] * m[4] - m[1] * m[5],
               c = m[1] * m[4] - m[2] * m[3];
  const double inv = 1 / (m[0] * a + m[1] * b + m[2] * c);
  return {inv * a,
          inv * b,
          inv * c,
          inv * (m[0] * m[5] - m[2] * m[2]),
          inv * (m[1] * m[2] - m[0] * m[4]),
          inv * (m[0] * m[3] - m[1] * m[1])};
}

Vec3 times(const std::array<double, 6>& m, const Vec3& v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[1] * v.x + m[3] * v.y + m[4] * v.z,
          m[2] * v.x + m[4] * v.y + m[5] * v.z};
}

double dot(std::span<const Vec3> a, std::span<const Vec3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += hexwright::dot(a[i], b[i]);
  return sum;
}

}  // namespace

JointValue JointEnergy::evaluate(std::span<const Vec3> positions,
                                 std::span<const JointFreedom> freedom, double sharpness) {
  values_.clear();
  JointValue result;
  result.least = 1;
  for (const LocalCorner& corner : shape_.corners) {
    values_.push_back(corner_value(corner, positions));
    result.least = std::min(result.least, values_.back());
  }
  double lowest = result.least;
  for (const LocalEdge& edge : shape_.edges) {
    values_.push_back(edge_value(edge, positions));
    lowest = std::min(lowest, values_.back());
  }
  weights_.resize(values_.size());
  const double cut = -std::log(kNegligible) / sharpness;
  weight_sum_ = 0;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const double above = values_[i] - lowest;
    weights_[i] = above < cut ? std::exp(-sharpness * above) : 0;
    weight_sum_ += weights_[i];
  }
  result.energy = -lowest + std::log(weight_sum_) / sharpness;
  for (const JointFreedom& f : freedom)
    if (f.slack > 0) result.energy += kPull * norm_sq(f.off) / (f.slack * f.slack);
  return result;
}

void JointEnergy::add_row(double weight, std::span<const LocalVert> verts,
                          std::span<const Vec3> gradient, std::span<const JointFreedom> freedom) {
  Row row;
  row.weight = weight;
  for (std::size_t k = 0; k < verts.size(); ++k) {
    if (verts[k] >= shape_.num_movable) continue;
    const JointFreedom& f = freedom[verts[k]];
    row.verts[row.count] = verts[k];
    row.gradient[row.count++] = f.size * project(f, gradient[k]);
  }
  rows_.push_back(row);
}

void JointEnergy::linearize(std::span<const Vec3> p, std::span<const JointFreedom> freedom,
                            double sharpness) {
  sharpness_ = sharpness;
  scale_ = weight_sum_;
  rows_.clear();
  for (std::size_t i = 0; i < shape_.corners.size(); ++i) {
    if (weights_[i] == 0) continue;
    const LocalCorner& c = shape_.corners[i];
    const Vec3 a = p[c[1]] - p[c[0]], b = p[c[2]] - p[c[0]], d = p[c[3]] - p[c[0]];
    const double aa = norm_sq(a), bb = norm_sq(b), dd = norm_sq(d), v = values_[i];
    const double inv = 1 / std::sqrt(aa * bb * dd);
    std::array<Vec3, 4> g;
    g[1] = inv * cross(b, d) - (v / aa) * a;
    g[2] = inv * cross(d, a) - (v / bb) * b;
    g[3] = inv * cross(a, b) - (v / dd) * d;
    g[0] = -(g[1] + g[2] + g[3]);
    add_row(weights_[i], c, g, freedom);
  }
  for (std::size_t k = 0; k < shape_.edges.size(); ++k) {
    const double weight = weights_[shape_.corners.size() + k];
    if (weight == 0) continue;
    const LocalEdge& e = shape_.edges[k];
    const Vec3 g = (2 / e.size) * normalized(p[e.verts[1]] - p[e.verts[0]]);
    add_row(weight, e.verts, std::array<Vec3, 2>{-g, g}, freedom);
  }
  rhs_.assign(shape_.num_movable, {});
  block_.assign(shape_.num_movable, {});
  for (const Row& row : rows_) {
    for (std::size_t k = 0; k < row.count; ++k) {
      rhs_[row.verts[k]] += row.weight * row.gradient[k];
      add_scaled(block_[row.verts[k]], sharpness * row.weight, outer(row.gradient[k]));
    }
  }
  add_pulls(freedom);
}

void JointEnergy::add_pulls(std::span<const JointFreedom> freedom) {
  pull_.assign(shape_.num_movable, 0);
  for (std::size_t i = 0; i < pull_.size(); ++i) {
    const JointFreedom& f = freedom[i];
    if (f.slack == 0) continue;
    const double ratio = f.size / f.slack;
    pull_[i] = 2 * kPull * scale_ * ratio * ratio;
    rhs_[i] -= (pull_[i] / f.size) * f.off;
    constexpr std::array<double, 6> kIdentity = {1, 0, 0, 1, 0, 1};
    const double sign = f.kind == VertKind::Surface ? 1 : -1;
    if (f.kind != VertKind::Surface) add_scaled(block_[i], pull_[i], kIdentity);
    if (f.kind != VertKind::Corner) add_scaled(block_[i], sign * pull_[i], outer(f.axis));
  }
}

void JointEnergy::multiply(std::span<const JointFreedom> freedom) {
  for (std::size_t i = 0; i < p_.size(); ++i) {
    ap_[i] = diagonal_ * p_[i];
    if (pull_[i] > 0) ap_[i] += pull_[i] * held_part(freedom[i], p_[i]);
  }
  for (const Row& row : rows_) {
    double change = 0;
    for (std::size_t k = 0; k < row.count; ++k)
      change += hexwright::dot(row.gradient[k], p_[row.verts[k]]);
    change *= sharpness_ * row.weight;
    for (std::size_t k = 0; k < row.count; ++k) ap_[row.verts[k]] += change * row.gradient[k];
  }
}

void JointEnergy::precondition(std::span<const JointFreedom> freedom) {
  for (std::size_t i = 0; i < r_.size(); ++i)
    z_[i] = project(freedom[i], times(inverse_[i], r_[i]));
}

void JointEnergy::solve(std::span<const JointFreedom> freedom) {
  const std::size_t n = rhs_.size();
  x_.assign(n, {});
  r_ = rhs_;
  z_.resize(n);
  ap_.resize(n);
  precondition(freedom);
  p_ = z_;
  double rz = dot(r_, z_);
  const double enough = kResidual * kResidual * rz;
  for (int k = 0; k < kMaxIterations && rz > enough; ++k) {
    multiply(freedom);
    const double curvature = dot(p_, ap_);
    if (!(curvature > 0)) return;
    const double alpha = rz / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      x_[i] += alpha * p_[i];
      r_[i] -= alpha * ap_[i];
    }
    precondition(freedom);
    const double next = dot(r_, z_);
    for (std::size_t i = 0; i < n; ++i) p_[i] = z_[i] + (next / rz) * p_[i];
    rz = next;
  }
}

std::span<const Vec3> JointEnergy::step(std::span<const JointFreedom> freedom, double damping,
                                        double longest) {
  diagonal_ = damping * sharpness_ * scale_;
  inverse_ = block_;
  for (auto& m : inverse_) {
    add_scaled(m, diagonal_, {1, 0, 0, 1, 0, 1});
    m = invert(m);
  }
  solve(freedom);
  double length = 0;
  for (const Vec3& v : x_) length = std::max(length, norm(v));
  const double scale = length > longest ? longest / length : 1;
  for (std::size_t i = 0; i < x_.size(); ++i) x_[i] *= scale * freedom[i].size;
  return x_;
}

}  // namespace hexwright::relax
