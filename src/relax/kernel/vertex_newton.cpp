// One incident hex contributes four corners: the vertex's own and those of its three edge
// neighbours. They are computed side by side, one per lane. With x the moving vertex, every corner
// takes the same form
//     e = x - base,  D = e . (f x g),  T = |e|^2 + |k e - g|^2 + |k e - f|^2
// where k = 0 and (f, g) are the fixed edges at a neighbour's corner, and k = 1, base = n0,
// f = n2 - n0, g = n1 - n0 at the vertex's own.
//
// Based on: exact Newton on one vertex at a time; D is linear and T quadratic in x.
#include "relax/kernel/vertex_newton.h"

#include <cmath>
#include <limits>
#include <memory>

// Lanes are compiled a second time for AVX2 and chosen when the program starts. Both compute the
// same operations in the same order, so results do not depend on the choice.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HEXWRIGHT_LANE_CLONES __attribute__((target_clones("avx2", "default"), flatten))
#else
#define HEXWRIGHT_LANE_CLONES
#endif
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are never passed between compiled functions
#define HEXWRIGHT_LANE_INLINE inline __attribute__((always_inline))
#else
#define HEXWRIGHT_LANE_INLINE inline
#endif

namespace hexwright::relax {
namespace {

#if defined(__GNUC__)
using Lanes = double __attribute__((vector_size(32)));
HEXWRIGHT_LANE_INLINE Lanes splat(double s) { return Lanes{s, s, s, s}; }
#else
struct Lanes {
  double v[4];
  double operator[](int i) const { return v[i]; }
  friend Lanes operator+(Lanes a, const Lanes& b) {
    for (int i = 0; i < 4; ++i) a.v[i] += b.v[i];
    return a;
  }
  friend Lanes operator-(Lanes a, const Lanes& b) {
    for (int i = 0; i < 4; ++i) a.v[i] -= b.v[i];
    return a;
  }
  friend Lanes operator*(Lanes a, const Lanes& b) {
    for (int i = 0; i < 4; ++i) a.v[i] *= b.v[i];
    return a;
  }
  friend Lanes operator/(Lanes a, const Lanes& b) {
    for (int i = 0; i < 4; ++i) a.v[i] /= b.v[i];
    return a;
  }
};
inline Lanes splat(double s) { return {{s, s, s, s}}; }
#endif

struct Lanes3 {
  Lanes x, y, z;
};
HEXWRIGHT_LANE_INLINE Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HEXWRIGHT_LANE_INLINE Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HEXWRIGHT_LANE_INLINE Lanes3 operator*(const Lanes& s, const Lanes3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
HEXWRIGHT_LANE_INLINE Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
HEXWRIGHT_LANE_INLINE Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
HEXWRIGHT_LANE_INLINE Lanes3 splat(const Vec3& p) { return {splat(p.x), splat(p.y), splat(p.z)}; }
HEXWRIGHT_LANE_INLINE Lanes3 pack(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return {Lanes{a.x, b.x, c.x, d.x}, Lanes{a.y, b.y, c.y, d.y}, Lanes{a.z, b.z, c.z, d.z}};
}
HEXWRIGHT_LANE_INLINE double sum(const Lanes& a) { return (a[0] + a[1]) + (a[2] + a[3]); }
HEXWRIGHT_LANE_INLINE double least(const Lanes& a) {
  return std::min(std::min(a[0], a[1]), std::min(a[2], a[3]));
}
HEXWRIGHT_LANE_INLINE Lanes square_root(const Lanes& a) {
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}
// a^n, n >= 1, by the same multiplications on every machine.
HEXWRIGHT_LANE_INLINE Lanes power(Lanes a, int n) {
  Lanes result = splat(1.0);
  for (;; a = a * a) {
    if (n & 1) result = result * a;
    n >>= 1;
    if (n == 0) return result;
  }
}

// The four corners of one incident hex as functions of the displacement d of the vertex.
struct alignas(32) HexLanes {
  Lanes3 e, f, g;     // see the head of the file
  Lanes3 normal;      // f x g, the gradient of D
  Lanes det;          // D at d = 0
  double weight = 1;  // of the hex's energy
};

HEXWRIGHT_LANE_INLINE Lanes own_lane() { return Lanes{1, 0, 0, 0}; }

HEXWRIGHT_LANE_INLINE HexLanes gather(const Vec3& x, const HexStar& star,
                                      IdSpan<VertId, const Vec3> p) {
  const Vec3 &n0 = p[star[0]], &n1 = p[star[1]], &n2 = p[star[2]];
  const Vec3 &d01 = p[star[3]], &d12 = p[star[4]], &d20 = p[star[5]];
  const Lanes3 base = pack(n0, n0, n1, n2);
  HexLanes h;
  h.e = splat(x) - base;
  h.f = pack(n2, d20, d01, d12) - base;
  h.g = pack(n1, d01, d12, d20) - base;
  h.normal = cross(h.f, h.g);
  h.det = dot(h.e, h.normal);
  return h;
}

// The edges that move besides e: k e - f and k e - g. At a neighbour's corner they are fixed.
struct MovingEdges {
  Lanes3 e, f, g;
  Lanes ee, ff, gg;  // squared lengths
};
HEXWRIGHT_LANE_INLINE MovingEdges edges_at(const HexLanes& h, const Lanes3& d) {
  MovingEdges m;
  m.e = h.e + d;
  const Lanes k = own_lane();
  m.f = k * m.e - h.f;
  m.g = k * m.e - h.g;
  m.ee = dot(m.e, m.e);
  m.ff = dot(m.f, m.f);
  m.gg = dot(m.g, m.g);
  return m;
}

// The determinant the energy divides by, and its derivative with respect to D.
struct Barrier {
  Lanes value, slope;
};
HEXWRIGHT_LANE_INLINE Barrier barrier(const Lanes& det, double untangle) {
  if (untangle == 0) return {det, splat(1.0)};
  const Lanes root = square_root(det * det + splat(untangle * untangle));
  // Written so that a large negative D does not cancel: (D + root) = untangle^2 / (root - D).
  Lanes value = splat(0.0);
  for (int i = 0; i < 4; ++i) {
    const double v =
        det[i] > 0 ? 0.5 * (det[i] + root[i]) : 0.5 * untangle * untangle / (root[i] - det[i]);
#if defined(__GNUC__)
    value[i] = v;
#else
    value.v[i] = v;
#endif
  }
  return {value, value / root};
}

double attachment_energy(const VertexGoal& goal, const Vec3& x) {
  if (goal.attach == AttachTo::Nothing) return 0;
  const Vec3 y = x - goal.target;
  const double along = dot(y, goal.direction);
  switch (goal.attach) {
    case AttachTo::Plane:
      return goal.weight * along * along;
    case AttachTo::Line:
      return goal.weight * (norm_sq(y) - along * along);
    default:
      return goal.weight * norm_sq(y);
  }
}

void add_attachment(const VertexGoal& goal, const Vec3& x, VertexDerivatives& out) {
  if (goal.attach == AttachTo::Nothing) return;
  const double point = goal.attach == AttachTo::Plane ? 0.0 : 2 * goal.weight;
  const double outer = goal.attach == AttachTo::Plane  ? 2 * goal.weight
                       : goal.attach == AttachTo::Line ? -2 * goal.weight
                                                       : 0.0;
  const Vec3 y = x - goal.target;
  const Vec3& u = goal.direction;
  out.energy += attachment_energy(goal, x);
  out.gradient += point * y + outer * dot(y, u) * u;
  out.hessian[0] += point + outer * u.x * u.x;
  out.hessian[1] += outer * u.x * u.y;
  out.hessian[2] += outer * u.x * u.z;
  out.hessian[3] += point + outer * u.y * u.y;
  out.hessian[4] += outer * u.y * u.z;
  out.hessian[5] += point + outer * u.z * u.z;
}

// Sums over lanes of energy, gradient and Hessian.
struct LaneSums {
  Lanes energy = splat(0.0);
  Lanes3 gradient = {splat(0.0), splat(0.0), splat(0.0)};
  Lanes xx = splat(0.0), xy = splat(0.0), xz = splat(0.0);
  Lanes yy = splat(0.0), yz = splat(0.0), zz = splat(0.0);
};
HEXWRIGHT_LANE_INLINE void add_outer(LaneSums& s, const Lanes& w, const Lanes3& a) {
  const Lanes3 wa = w * a;
  s.xx = s.xx + wa.x * a.x;
  s.xy = s.xy + wa.x * a.y;
  s.xz = s.xz + wa.x * a.z;
  s.yy = s.yy + wa.y * a.y;
  s.yz = s.yz + wa.y * a.z;
  s.zz = s.zz + wa.z * a.z;
}
HEXWRIGHT_LANE_INLINE void add_diagonal(LaneSums& s, const Lanes& w) {
  s.xx = s.xx + w;
  s.yy = s.yy + w;
  s.zz = s.zz + w;
}

// E = T^3 / 27 D^2 to the power p: log-gradient p (3 T'/T - 2 D'/D); its Hessian is exact.
HEXWRIGHT_LANE_INLINE void add_condition_term(const HexLanes& h, const MovingEdges& m,
                                              const Barrier& b, const ShapeEnergy& shape,
                                              LaneSums& s) {
  const Lanes k = own_lane();
  const Lanes one = splat(1.0), p = splat(static_cast<double>(shape.power));
  const Lanes inv_trace = one / (m.ee + m.ff + m.gg);
  const Lanes inv_det = one / b.value;
  const Lanes trace = m.ee + m.ff + m.gg;
  Lanes energy = trace * trace * trace * inv_det * inv_det * splat(1.0 / 27);
  if (shape.power != 1) energy = power(energy, shape.power);
  energy = energy * splat((1 - shape.blend) * h.weight);
  const Lanes3 half_trace_grad = m.e + k * (m.f + m.g);  // T' / 2
  const Lanes slope = inv_det * b.slope;
  const Lanes3 log_grad =
      (splat(6.0) * inv_trace * p) * half_trace_grad - (splat(2.0) * slope * p) * h.normal;
  s.energy = s.energy + energy;
  s.gradient = s.gradient + energy * log_grad;
  const Lanes ep = energy * p;
  add_outer(s, energy, log_grad);
  add_outer(s, splat(-12.0) * ep * inv_trace * inv_trace, half_trace_grad);
  add_outer(s, splat(2.0) * ep * slope * slope, h.normal);
  add_diagonal(s, ep * splat(6.0) * inv_trace * (one + k + k));
}

// E = |e0|^2 |e1|^2 |e2|^2 / D^2 to the power p; of the Hessian the positive semidefinite part:
// for each moving edge 2/l^2 (I - u u^T) instead of 2/l^2 (I - 2 u u^T).
HEXWRIGHT_LANE_INLINE void add_jacobian_term(const HexLanes& h, const MovingEdges& m,
                                             const Barrier& b, const ShapeEnergy& shape,
                                             LaneSums& s) {
  const Lanes k = own_lane();
  const Lanes one = splat(1.0), two = splat(2.0), p = splat(static_cast<double>(shape.power));
  const Lanes inv_det = one / b.value;
  Lanes energy = m.ee * m.ff * m.gg * inv_det * inv_det;
  if (shape.power != 1) energy = power(energy, shape.power);
  energy = energy * splat(shape.blend * h.weight);
  const Lanes ie = one / m.ee, jf = k / m.ff, jg = k / m.gg;  // zero for edges that stay
  const Lanes slope = inv_det * b.slope;
  const Lanes3 log_grad =
      p * ((two * ie) * m.e + (two * jf) * m.f + (two * jg) * m.g - (two * slope) * h.normal);
  s.energy = s.energy + energy;
  s.gradient = s.gradient + energy * log_grad;
  const Lanes e2 = two * energy * p;
  add_outer(s, energy, log_grad);
  add_outer(s, e2 * slope * slope, h.normal);
  add_diagonal(s, e2 * (ie + jf + jg));
  add_outer(s, splat(0.0) - e2 * ie * ie, m.e);
  // jf and jg hold 1/l^2 on the one lane where they count.
  add_outer(s, splat(0.0) - e2 * jf * jf, m.f);
  add_outer(s, splat(0.0) - e2 * jg * jg, m.g);
}

// The shape energy and its derivatives at d = 0; false when a barrier is violated already.
HEXWRIGHT_LANE_CLONES bool sum_shape(const HexLanes* lanes, std::size_t num_hexes,
                                     const ShapeEnergy& shape, VertexDerivatives& out) {
  LaneSums s;
  const Lanes3 none = {splat(0.0), splat(0.0), splat(0.0)};
  for (std::size_t i = 0; i < num_hexes; ++i) {
    const HexLanes& h = lanes[i];
    if (shape.untangle == 0 && !(least(h.det) > 0)) return false;
    const MovingEdges m = edges_at(h, none);
    const Barrier b = barrier(h.det, shape.untangle);
    if (shape.blend < 1) add_condition_term(h, m, b, shape, s);
    if (shape.blend > 0) add_jacobian_term(h, m, b, shape, s);
  }
  out.energy = sum(s.energy);
  out.gradient = {sum(s.gradient.x), sum(s.gradient.y), sum(s.gradient.z)};
  out.hessian = {sum(s.xx), sum(s.xy), sum(s.xz), sum(s.yy), sum(s.yz), sum(s.zz)};
  return true;
}

HEXWRIGHT_LANE_CLONES void gather_all(const Vec3& x, std::span<const HexStar> star,
                                      IdSpan<VertId, const Vec3> positions, HexLanes* lanes) {
  for (std::size_t i = 0; i < star.size(); ++i) lanes[i] = gather(x, star[i], positions);
}

// The shape energy after the displacement d; infinite behind the barrier.
HEXWRIGHT_LANE_CLONES double shape_at(const HexLanes* lanes, std::size_t num_hexes,
                                      const Vec3& step, const ShapeEnergy& shape) {
  const Lanes3 d = splat(step);
  Lanes total = splat(0.0);
  for (std::size_t i = 0; i < num_hexes; ++i) {
    const HexLanes& h = lanes[i];
    const Lanes det = h.det + dot(h.normal, d);
    if (shape.untangle == 0 && !(least(det) > 0)) return std::numeric_limits<double>::infinity();
    const MovingEdges m = edges_at(h, d);
    const Lanes inv_det = splat(1.0) / barrier(det, shape.untangle).value;
    const Lanes inv_det_sq = inv_det * inv_det;
    const Lanes trace = m.ee + m.ff + m.gg;
    const Lanes condition = trace * trace * trace * inv_det_sq * splat(1.0 / 27);
    const Lanes jacobian = m.ee * m.ff * m.gg * inv_det_sq;
    total = total + splat((1 - shape.blend) * h.weight) * power(condition, shape.power);
    if (shape.blend > 0)
      total = total + splat(shape.blend * h.weight) * power(jacobian, shape.power);
  }
  return sum(total);
}

// Largest share of the step d, at most `limit`, that goes 0.9 of the way to the first D = 0.
HEXWRIGHT_LANE_CLONES double bound_step(const HexLanes* lanes, std::size_t num_hexes,
                                        const Vec3& step, double limit) {
  const Lanes3 d = splat(step);
  for (std::size_t i = 0; i < num_hexes; ++i) {
    const Lanes change = dot(lanes[i].normal, d);
    const Lanes room = splat(0.9) * lanes[i].det;
    if (!(least(room + splat(limit) * change) < 0)) continue;
    for (int k = 0; k < 4; ++k)
      if (change[k] < 0) limit = std::min(limit, -room[k] / change[k]);
  }
  return limit;
}

// Restricts gradient and Hessian to the directions a vertex may move in: H := P H P + tr (I - P).
void restrict_motion(const VertexGoal& goal, VertexDerivatives& v) {
  if (goal.move == MoveIn::Space) return;
  const Vec3& a = goal.axis;
  const bool line = goal.move == MoveIn::Line;
  std::array<double, 9> p, h, hp{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double outer = a[static_cast<int>(i)] * a[static_cast<int>(j)];
      p[3 * i + j] = line ? outer : (i == j ? 1.0 : 0.0) - outer;
    }
  constexpr std::array<std::size_t, 9> kSlot = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  for (std::size_t i = 0; i < 9; ++i) h[i] = v.hessian[kSlot[i]];
  const double trace = h[0] + h[4] + h[8];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) hp[3 * i + j] += h[3 * i + k] * p[3 * k + j];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) {
      double s = trace * ((i == j ? 1.0 : 0.0) - p[3 * i + j]);
      for (std::size_t k = 0; k < 3; ++k) s += p[3 * i + k] * hp[3 * k + j];
      v.hessian[kSlot[3 * i + j]] = s;
    }
  const double along = dot(v.gradient, a);
  v.gradient = line ? along * a : v.gradient - along * a;
}

// Solves H d = -gradient by LDL^T after adding 1e-9 of the trace; zero when H is not definite.
Vec3 newton_direction(const VertexDerivatives& v) {
  const auto& h = v.hessian;
  const double shift = 1e-9 * (h[0] + h[3] + h[5]);
  const double d0 = h[0] + shift;
  if (!(d0 > 0)) return {};
  const double l10 = h[1] / d0, l20 = h[2] / d0;
  const double d1 = h[3] + shift - l10 * h[1];
  if (!(d1 > 0)) return {};
  const double l21 = (h[4] - l20 * h[1]) / d1;
  const double d2 = h[5] + shift - l20 * h[2] - l21 * l21 * d1;
  if (!(d2 > 0)) return {};
  const double y0 = -v.gradient.x, y1 = -v.gradient.y - l10 * y0;
  const double y2 = -v.gradient.z - l20 * y0 - l21 * y1;
  const double z = y2 / d2, y = y1 / d1 - l21 * z;
  return {y0 / d0 - l10 * y - l20 * z, y, z};
}

// The direction itself must stay in the allowed set in spite of rounding.
Vec3 restrict_step(const VertexGoal& goal, const Vec3& d) {
  if (goal.move == MoveIn::Plane) return d - dot(d, goal.axis) * goal.axis;
  if (goal.move == MoveIn::Line) return dot(d, goal.axis) * goal.axis;
  return d;
}

HexLanes* scratch(std::vector<double>& memory, std::size_t num_hexes) {
  constexpr std::size_t kAlign = alignof(HexLanes) / sizeof(double);
  const std::size_t needed = num_hexes * (sizeof(HexLanes) / sizeof(double)) + kAlign;
  if (memory.size() < needed) memory.resize(needed);
  void* start = memory.data();
  std::size_t room = memory.size() * sizeof(double);
  return static_cast<HexLanes*>(std::align(alignof(HexLanes), sizeof(HexLanes), start, room));
}

}  // namespace

VertexDerivatives VertexNewton::evaluate(VertId v, std::span<const HexStar> star,
                                         const VertexGoal& goal, const ShapeEnergy& shape,
                                         IdSpan<VertId, const Vec3> positions) {
  HexLanes* lanes = scratch(lanes_, star.size());
  gather_all(positions[v], star, positions, lanes);
  for (std::size_t i = 0; i < goal.hex_weights.size(); ++i) lanes[i].weight = goal.hex_weights[i];
  VertexDerivatives result;
  if (!sum_shape(lanes, star.size(), shape, result)) {
    result.energy = std::numeric_limits<double>::infinity();
    return result;
  }
  add_attachment(goal, positions[v], result);
  return result;
}

double VertexNewton::solve(VertId v, std::span<const HexStar> star, const VertexGoal& goal,
                           const ShapeEnergy& shape, IdSpan<VertId, Vec3> positions) {
  if (goal.move == MoveIn::Point || star.empty()) return 0;
  const IdSpan<VertId, const Vec3> read{std::span<const Vec3>(positions.raw())};
  VertexDerivatives now = evaluate(v, star, goal, shape, read);
  if (!std::isfinite(now.energy)) return 0;
  restrict_motion(goal, now);
  const Vec3 step = restrict_step(goal, newton_direction(now));
  const double length = norm(step);
  if (!(length < 1e100) || length < 1e-6 * goal.max_step) return 0;
  HexLanes* lanes = scratch(lanes_, star.size());
  double share = std::min(goal.relaxation, goal.max_step / length);
  if (shape.untangle == 0) share = bound_step(lanes, star.size(), step, share);
  const double slope = dot(now.gradient, step);
  const Vec3 origin = positions[v];
  for (int attempt = 0; attempt < 8; ++attempt, share *= 0.4) {
    const Vec3 d = share * step;
    const double energy =
        shape_at(lanes, star.size(), d, shape) + attachment_energy(goal, origin + d);
    if (energy <= now.energy + 1e-4 * share * slope) {
      positions[v] = origin + d;
      return share * length;
    }
  }
  return 0;
}

HEXWRIGHT_LANE_CLONES double min_scaled_jacobian_around(const Vec3& position,
                                                        std::span<const HexStar> star,
                                                        IdSpan<VertId, const Vec3> positions) {
  const Lanes3 none = {splat(0.0), splat(0.0), splat(0.0)};
  double result = 1;
  for (const HexStar& s : star) {
    const HexLanes h = gather(position, s, positions);
    const MovingEdges m = edges_at(h, none);
    const Lanes product = m.ee * m.ff * m.gg;
    if (!(least(product) > 0)) return -1;  // an edge without length
    result = std::min(result, least(h.det / square_root(product)));
  }
  return result;
}

}  // namespace hexwright::relax
