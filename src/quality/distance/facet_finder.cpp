#include "quality/distance/facet_finder.h"

namespace hexwright {

/// Coarse facets of a patch that has finer ones say nothing.
NearFacet FacetFinder::find(const Vec3& p) {
  all_.find(p);
  const TriId of_all = all_.nearest();
  NearFacet near = {
      {of_all, false}, all_.last_distance(), sets_.all.error(of_all), sets_.all.patch(of_all)};
  if (!sets_.finer.tree) return near;
  finer_.find(p);
  const bool is_replaced = sets_.has_finer[static_cast<std::size_t>(near.patch)];
  if (!is_replaced && near.distance <= finer_.last_distance()) return near;
  const TriId of_finer = finer_.nearest();
  return {{of_finer, true},
          finer_.last_distance(),
          sets_.finer.error(of_finer),
          sets_.finer.patch(of_finer)};
}

TriangleData FacetFinder::data(const FacetRef& ref) const {
  const SurfaceTree& tree = *set(ref).tree;
  const auto c = tree.surface().corners(ref.tri);
  return TriangleData::make(c[0], c[1], c[2], tree.normal(ref.tri));
}

}  // namespace hexwright
