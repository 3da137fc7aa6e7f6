// Facets first as the samples had them, then finer ones where their errors matter.
#include "quality/distance/bound_both_ways.h"

#include <algorithm>
#include <optional>

#include "quality/distance/patch_facets.h"

namespace hexwright {
namespace {

/// What the parts of the gap are for: errors of facets where they stand in the way, and pieces.
constexpr double kErrorShare = 0.15, kPieceShare = 0.8;
constexpr int kMostPasses = 4, kMostDivisions = 32;

class Bounder {
 public:
  Bounder(const BothWays& input, const SampledDirection& to_mesh,
          const SampledDirection& to_surface)
      : input_(input),
        to_mesh_(to_mesh),
        to_surface_(to_surface),
        patches_(input.mesh, input.quads),
        has_finer_(patches_.size(), 0) {}

  BoundsBothWays run() {
    start();
    for (int pass = 1; pass < kMostPasses; ++pass)
      if (!refine_to_mesh()) break;
    settle_to_mesh();
    if (!found_.to_surface.open.empty()) refine_to_surface();
    finish();
    return std::move(found_);
  }

 private:
  /// By the facets of the samples; with second order by some of one's own, because samples divide
  /// its quads by another rule.
  void start() {
    const bool is_sampled = !input_.mesh.mid_nodes;
    if (is_sampled) {
      for (std::size_t t = 0; t < 4 * patches_.size(); ++t) {
        all_.tri_to_quad.push_back(static_cast<std::int32_t>(t / 4));
        all_.tri_error.push_back(patches_.facet_error(t / 4, 1));
      }
    } else {
      all_ = make_facets(patches_, std::vector<int>(patches_.size(), 1));
      all_tree_.emplace(std::move(all_.triangles));
    }
    start_to_mesh(is_sampled);
    start_to_surface(is_sampled);
  }

  const SurfaceTree& all_tree() const { return all_tree_ ? *all_tree_ : input_.boundary; }

  void start_to_mesh(bool is_sampled) {
    if (to_mesh_.max > 0) {  // else no sample counts, or none is off
      found_.to_mesh.lower = nearest_patch(to_mesh_.worst).lower;
      found_.to_mesh.worst = to_mesh_.worst;
    }
    std::vector<double> upper;
    if (is_sampled) upper = to_mesh_.vert_distance;
    for (std::size_t v = 0; v < upper.size(); ++v) {
      const TriId t = to_mesh_.vert_nearest[v];
      if (t.is_valid()) upper[v] += all_.tri_error[t.index()];
    }
    bound_to_mesh(upper, {});
  }

  /// Vertices of facets are points of the patches; other samples may not be.
  void start_to_surface(bool is_sampled) {
    const TriMesh& facets = all_tree().surface();
    if (!is_sampled) return bound_to_surface(facets, all_, {});
    DistanceBounds& found = found_.to_surface;
    const auto& d = to_surface_.vert_distance;
    const auto worst = std::max_element(d.begin(), d.end());
    if (worst != d.end() && !to_surface_.has_excuses) {
      found.lower = *worst;
      found.worst = facets.positions[VertId(static_cast<std::size_t>(worst - d.begin()))];
    }
    const auto at = input_.boundary.closest(to_surface_.worst);
    const double lower = at ? to_surface_.max - all_.tri_error[at->tri.index()] : 0;
    if (lower > found.lower) {
      found.lower = lower;
      found.worst = to_surface_.worst;
    }
    bound_to_surface(facets, all_, d);
  }

  QuadPatches::PointBounds nearest_patch(const Vec3& p) const {
    return patches_.bound_distance(p, kErrorShare * input_.gap);
  }

  int divisions_of(std::size_t quad) const {
    return patches_.divisions_for(quad, kErrorShare * input_.gap, kMostDivisions);
  }

  /// What was open anew, with finer facets of the quads that were in the way. False when there
  /// are none.
  bool refine_to_mesh() {
    const std::vector<std::int32_t>& coarse = found_.to_mesh.coarse;
    const bool is_any = std::ranges::any_of(
        coarse, [&](std::int32_t q) { return !has_finer_[static_cast<std::size_t>(q)]; });
    if (!is_any) return false;
    for (const std::int32_t q : coarse) has_finer_[static_cast<std::size_t>(q)] = 1;
    make_finer();
    const std::vector<TriId> open = std::move(found_.to_mesh.open);
    bound_to_mesh({}, open);
    return true;
  }

  void make_finer() {
    std::vector<int> divisions(patches_.size(), 0);
    for (std::size_t q = 0; q < patches_.size(); ++q)
      if (has_finer_[q]) divisions[q] = divisions_of(q);
    finer_ = make_facets(patches_, divisions);
    finer_tree_.emplace(std::move(finer_.triangles));
  }

  /// The lower bound by all patches, whatever facets told. Where another patch was nearer to the
  /// worst place than they had it, once more from the beginning.
  void settle_to_mesh() {
    DistanceBounds& found = found_.to_mesh;
    if (found.lower == 0) return;  // at no place that is known
    const auto nearest = nearest_patch(found.worst);
    found.lower = nearest.lower;
    if (std::max(found.upper, found.open_upper) <= found.lower + input_.gap) return;
    has_finer_[nearest.nearest] = 1;
    make_finer();
    found.upper = 0;
    bound_to_mesh({}, {});
    for (int pass = 1; pass < kMostPasses; ++pass)
      if (!refine_to_mesh()) break;
    found.lower = nearest_patch(found.worst).lower;
  }

  void refine_to_surface() {
    std::vector<int> divisions(patches_.size(), 0);
    for (const TriId t : found_.to_surface.open) {
      const auto q = static_cast<std::size_t>(all_.tri_to_quad[t.index()]);
      divisions[q] = divisions_of(q);
    }
    const PatchFacets finer = make_facets(patches_, divisions);
    bound_to_surface(finer.triangles, finer, {});
  }

  /// `upper`: of the surface's vertices by the samples, or empty.
  void bound_to_mesh(std::span<const double> upper, std::span<const TriId> tris) {
    FacetSets reference = {.all = {&all_tree(), all_.tri_error, all_.tri_to_quad}, .finer = {}};
    if (finer_tree_) reference.finer = {&*finer_tree_, finer_.tri_error, finer_.tri_to_quad};
    reference.has_finer = has_finer_;
    take({.sampled = input_.surface.surface(),
          .reference = reference,
          .vert_upper = upper,
          .vert_nearest = to_mesh_.vert_nearest,
          .tris = tris,
          .is_first = !finer_tree_},
         to_mesh_, found_.to_mesh);
  }

  void bound_to_surface(const TriMesh& triangles, const PatchFacets& facets,
                        std::span<const double> upper) {
    take({.sampled = triangles,
          .reference = {.all = {&input_.surface}, .finer = {}},
          .sampled_error = facets.tri_error,
          .vert_upper = upper,
          .vert_nearest = to_surface_.vert_nearest,
          .is_first = &facets == &all_},
         to_surface_, found_.to_surface);
  }

  void take(BoundInput input, const SampledDirection& samples, DistanceBounds& found) const {
    const double upper = found.upper;
    input.lower = found.lower;
    input.worst = found.worst;
    input.gap = kPieceShare * input_.gap;
    if (samples.has_excuses) input.counts = &samples.counts;
    input.least_excused = input_.least_excused;
    found = bound_distance(input);
    found.upper = std::max(found.upper, upper);
  }

  void finish() {
    for (DistanceBounds* found : {&found_.to_mesh, &found_.to_surface})
      found->upper = std::max({found->upper, found->open_upper, found->lower});
  }

  const BothWays& input_;
  const SampledDirection &to_mesh_, &to_surface_;
  QuadPatches patches_;
  PatchFacets all_, finer_;
  std::optional<SurfaceTree> all_tree_, finer_tree_;
  std::vector<char> has_finer_;
  BoundsBothWays found_;
};

}  // namespace

BoundsBothWays bound_both_ways(const BothWays& input, const SampledDirection& to_mesh,
                               const SampledDirection& to_surface) {
  return Bounder(input, to_mesh, to_surface).run();
}

}  // namespace hexwright
