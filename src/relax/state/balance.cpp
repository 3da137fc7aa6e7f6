// Least squares over samples of the boundary quads: sample s at the surface-normal distance e_s
// moves by sum_v N_v(s) (n_s . n_v) d_v when the quad's vertices v move by d_v along their normals.
// The normal equations are those of a mass matrix; a few Gauss-Seidel sweeps solve them.
//
// Based on: best approximation by continuous piecewise bilinear functions; 2 x 2 Gauss points
// integrate a quadratic patch's error against them exactly.
#include "relax/state/balance.h"

#include <algorithm>
#include <cmath>

#include "hexwright/base/parallel.h"

namespace hexwright::relax {
namespace {

constexpr double kGauss = 0.21132486540518712;  // (1 - 1/sqrt 3) / 2
constexpr double kMinCosine = 0.3;              // between a quad's normal and the surface's
constexpr double kMaxError = 0.5;               // in h: farther is no match but a miss

// One sample: what it adds to the sum of squares is weight * (error + sum_k slope[k] d_k)^2.
struct Sample {
  double error = 0, weight = 0;
  std::array<double, 4> slope{};
};
using QuadSamples = std::array<Sample, 4>;

class Balance {
 public:
  Balance(FitState& state, const FitTarget& target) : state_(state), target_(target) {}

  void run(const BalanceOptions& options) {
    find_normals();
    take_samples();
    solve(options);
  }

 private:
  bool is_free(VertId v) const {
    return state_.kind[v] == VertKind::Surface && state_.move[v] == MoveIn::Space;
  }

  // The surface's normal at each vertex, on the mesh's outer side.
  void find_normals() {
    const auto& p = state_.mesh.positions;
    normal_.assign(state_.num_verts(), {});
    for (const auto& q : state_.quads) {
      const Vec3 n = cross(p[q[2]] - p[q[0]], p[q[3]] - p[q[1]]);
      for (VertId v : q) normal_[v] += n;
    }
    for (VertId v : normal_.ids()) {
      if (!is_free(v)) continue;
      const Vec3& d = state_.direction[v];
      normal_[v] = dot(d, normal_[v]) < 0 ? -d : d;
    }
  }

  PatchId patch_of(const std::array<VertId, 4>& quad) const {
    for (VertId v : quad)
      if (is_free(v) && state_.patch[v].is_valid()) return state_.patch[v];
    return {};
  }

  void take_samples() {
    samples_.assign(state_.quads.size(), {});
    parallel_for(
        samples_.size(),
        [&](std::size_t q) {
          const auto& quad = state_.quads[q];
          if (std::none_of(quad.begin(), quad.end(), [&](VertId v) { return is_free(v); })) return;
          for (std::size_t i = 0; i < 4; ++i)
            samples_[q][i] =
                take_sample(quad, i & 1 ? 1 - kGauss : kGauss, i & 2 ? 1 - kGauss : kGauss);
        },
        32);
  }

  Sample take_sample(const std::array<VertId, 4>& quad, double s, double t) const {
    const auto& p = state_.mesh.positions;
    const Vec3 &a = p[quad[0]], &b = p[quad[1]], &c = p[quad[2]], &d = p[quad[3]];
    const std::array<double, 4> share = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
    const Vec3 x = share[0] * a + share[1] * b + share[2] * c + share[3] * d;
    const Vec3 area = cross((1 - t) * (b - a) + t * (c - d), (1 - s) * (d - a) + s * (c - b));
    const double h = 0.5 * (distance(a, c) + distance(b, d));
    ClosestFilter filter;
    filter.normal = normalized(area);
    filter.min_cosine = kMinCosine;
    filter.patch = patch_of(quad);
    filter.patches = target_.patches;
    filter.max_distance = kMaxError * h;
    Sample sample;
    const auto found = target_.tree.closest(x, filter);
    if (!found) return sample;
    const Vec3 offset = x - found->point;
    const double length = norm(offset);
    Vec3 n = length < 1e-3 * h ? target_.tree.normal(found->tri) : offset / length;
    if (dot(n, filter.normal) < 0) n = -n;
    sample.error = dot(offset, n);
    sample.weight = norm(area);
    for (std::size_t k = 0; k < 4; ++k)
      if (is_free(quad[k])) sample.slope[k] = share[k] * dot(n, normal_[quad[k]]);
    return sample;
  }

  struct Use {
    std::size_t quad = 0, corner = 0;
  };

  // Gauss-Seidel in the vertices' order; the errors follow every change.
  void solve(const BalanceOptions& options) {
    std::vector<std::vector<Use>> uses(state_.num_verts());
    for (std::size_t q = 0; q < state_.quads.size(); ++q)
      for (std::size_t k = 0; k < 4; ++k)
        if (is_free(state_.quads[q][k])) uses[state_.quads[q][k].index()].push_back({q, k});
    IdVector<VertId, double> change(state_.num_verts(), 0);
    for (int sweep = 0; sweep < options.num_sweeps; ++sweep) {
      for (VertId v : change.ids()) {
        double gradient = 0, curvature = 0;
        for (const Use& use : uses[v.index()])
          for (const Sample& s : samples_[use.quad]) {
            gradient += s.weight * s.slope[use.corner] * s.error;
            curvature += s.weight * s.slope[use.corner] * s.slope[use.corner];
          }
        if (!(curvature > 0)) continue;
        const double step = -gradient / curvature;
        change[v] += step;
        for (const Use& use : uses[v.index()])
          for (Sample& s : samples_[use.quad]) s.error += s.slope[use.corner] * step;
      }
    }
    for (VertId v : change.ids()) {
      if (!is_free(v)) continue;
      const double now =
          state_.offset[v] + dot(state_.mesh.positions[v] - state_.target[v], normal_[v]);
      const double limit = options.max_offset * state_.size[v];
      state_.offset[v] = std::clamp(now + change[v], -limit, limit);
    }
  }

  FitState& state_;
  const FitTarget& target_;
  IdVector<VertId, Vec3> normal_;
  std::vector<QuadSamples> samples_;
};

}  // namespace

void balance_offsets(FitState& state, const FitTarget& target, const BalanceOptions& options) {
  Balance(state, target).run(options);
}

}  // namespace hexwright::relax
