// A surface vertex goes to the closest point of its patch whose normal agrees with the mesh's; the
// normal is given up where it would lead far away, and so is the patch.
#include "relax/state/targets.h"

#include <algorithm>

#include "hexwright/base/parallel.h"

#include "mesh/quad.h"
#include "relax/state/curve_targets.h"

namespace hexwright::relax {
namespace {

// Of the boundary vertices with only[v] != 0 (all when `only` is empty); others' are not used.
IdVector<VertId, Vec3> compute_vertex_normals(const FitState& state, std::span<const char> only) {
  IdVector<VertId, Vec3> normals(state.num_verts());
  for (const auto& q : state.quads) {
    if (!only.empty() &&
        std::none_of(q.begin(), q.end(), [&](VertId v) { return only[v.index()] != 0; }))
      continue;
    const Vec3 n = quad_normal(state.mesh.positions, q);
    for (VertId v : q) normals[v] += n;
  }
  return normals;
}

class SurfaceMatcher {
 public:
  SurfaceMatcher(const SurfaceSeeker& seeker, const FitTarget& target)
      : target_(target),
        x_(seeker.position),
        normal_(seeker.normal),
        h_(seeker.size),
        patch_(seeker.patch),
        bound_(seeker.bound) {}

  std::optional<ClosestPoint> find() const {
    auto best = patch_.is_valid() ? find_on_patch() : std::nullopt;
    if (best && distance(*best) > 1.5 * h_) {
      const auto other = query(0.3, {}, 0.4 * distance(*best));
      if (other) best = other;
    }
    return best ? best : find_anywhere();
  }

 private:
  static double distance(const ClosestPoint& c) { return std::sqrt(c.distance_sq); }

  std::optional<ClosestPoint> query(
      double min_cosine, PatchId patch,
      double max_distance = std::numeric_limits<double>::infinity()) const {
    ClosestFilter filter;
    filter.normal = normal_;
    filter.min_cosine = min_cosine;
    filter.patch = patch;
    filter.patches = target_.patches;
    filter.max_distance = max_distance;
    return target_.tree.closest(x_, filter);
  }

  std::optional<ClosestPoint> find_on_patch() const { return find_filtered(-0.2, patch_, 0.3); }
  std::optional<ClosestPoint> find_anywhere() const { return find_filtered(0.1, {}, 0.5); }

  // With the normal filter unless that is much farther than without.
  std::optional<ClosestPoint> find_filtered(double min_cosine, PatchId patch, double slack) const {
    auto facing = query(min_cosine, patch, bound_);
    if (!facing && std::isfinite(bound_)) facing = query(min_cosine, patch);
    if (facing && distance(*facing) <= 0.5 * h_) return facing;
    const auto any = query(-2, patch);
    if (!facing) return any;
    if (any && distance(*facing) > 3 * distance(*any) + slack * h_) return any;
    return facing;
  }

  const FitTarget& target_;
  Vec3 x_, normal_;
  double h_;
  PatchId patch_;
  double bound_;
};

void update_surface_target(FitState& state, const FitTarget& to, VertId v, const Vec3& normal) {
  const TargetQuery query = {state.mesh.positions[v], state.offset[v], state.patch[v]};
  TargetQuery& last = state.query[v];
  if (query.patch == last.patch && query.offset == last.offset &&
      norm_sq(query.from - last.from) < kSamePlace * kSamePlace * state.size[v] * state.size[v])
    return;
  SurfaceSeeker seeker = {query.from, normal, state.size[v], query.patch, query.offset};
  // The last target bounds the search: it is on the surface, mostly still on the right side of it.
  if (state.direction[v] != Vec3{})
    seeker.bound = (1 + 1e-6) * (distance(query.from, state.target[v]) + std::abs(query.offset)) +
                   1e-9 * seeker.size;
  const auto match = match_surface(seeker, to);
  if (!match) return;
  last = query;
  if (distance(match->target, state.target[v]) > 1e-5 * seeker.size ||
      std::abs(dot(match->direction, state.direction[v])) < 0.9999)
    state.is_dirty[v] = 1;
  state.target[v] = match->target;
  state.direction[v] = match->direction;
}

}  // namespace

std::optional<SurfaceMatch> match_surface(const SurfaceSeeker& seeker, const FitTarget& target) {
  const auto found = SurfaceMatcher(seeker, target).find();
  if (!found) return {};
  const Vec3 offset = seeker.position - found->point;
  const double length = norm(offset);
  Vec3 direction = length < 1e-3 * seeker.size ? target.tree.normal(found->tri) : offset / length;
  if (dot(direction, seeker.normal) < 0) direction = -direction;  // whatever the orientation
  return SurfaceMatch{found->point + seeker.offset * direction, direction};
}

void update_targets(FitState& state, const FitTarget& target, double hold,
                    std::span<const char> only) {
  const auto normals = compute_vertex_normals(state, only);
  parallel_for(
      state.num_verts(),
      [&](std::size_t i) {
        const VertId v(i);
        if (!only.empty() && !only[i]) return;
        if (state.kind[v] == VertKind::Surface) {
          update_surface_target(state, target, v, normalized(normals[v]));
        } else if (state.kind[v] != VertKind::Interior && target.features) {
          update_feature_target(state, v, target.tree.surface(), *target.features, hold);
        }
      },
      64);
}

}  // namespace hexwright::relax
