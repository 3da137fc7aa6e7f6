#include "quality/distance/facet_finder.h"

#include <cmath>

namespace hexwright {

ClosestPoint FacetFinder::closest(const FacetSet& set, const Vec3& p, Last& last) {
  constexpr double kSlack = 1 + 1e-9;  // covers rounding
  ClosestFilter filter;
  filter.hint = last.tri;
  if (last.tri.is_valid())
    filter.max_distance = (last.distance + hexwright::distance(p, last.point)) * kSlack;
  auto hit = set.tree->closest(p, filter);
  if (!hit) hit = set.tree->closest(p);
  last = {hit->tri, p, std::sqrt(hit->distance_sq)};
  return *hit;
}

/// Coarse facets of a patch that has finer ones say nothing.
NearFacet FacetFinder::find(const Vec3& p) {
  const ClosestPoint of_all = closest(sets_.all, p, all_);
  NearFacet near = {
      {of_all.tri, false}, all_.distance, sets_.all.error(of_all.tri), sets_.all.patch(of_all.tri)};
  if (!sets_.finer.tree) return near;
  const ClosestPoint of_finer = closest(sets_.finer, p, finer_);
  const bool is_replaced = sets_.has_finer[static_cast<std::size_t>(near.patch)];
  if (!is_replaced && near.distance <= finer_.distance) return near;
  return {{of_finer.tri, true},
          finer_.distance,
          sets_.finer.error(of_finer.tri),
          sets_.finer.patch(of_finer.tri)};
}

TriangleData FacetFinder::data(const FacetRef& ref) const {
  const SurfaceTree& tree = *set(ref).tree;
  const auto c = tree.surface().corners(ref.tri);
  return TriangleData::make(c[0], c[1], c[2], tree.normal(ref.tri));
}

}  // namespace hexwright
