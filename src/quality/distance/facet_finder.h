// The facet that is nearest to a point, of finer and coarser facets of the same patches.
#pragma once

#include <cstdint>
#include <span>

#include "hexwright/geometry/surface_tree.h"

#include "geometry/tree/triangle_math.h"
#include "quality/distance/nearby_queries.h"

namespace hexwright {

/// Facets to measure to. Those of a patch are no farther from it, and it from them, than the error.
struct FacetSet {
  const SurfaceTree* tree = nullptr;
  std::span<const double> tri_error = {};           ///< empty: exact
  std::span<const std::int32_t> tri_to_patch = {};  ///< empty: each triangle is its own

  double error(TriId t) const { return tri_error.empty() ? 0 : tri_error[t.index()]; }
  std::int32_t patch(TriId t) const {
    return tri_to_patch.empty() ? t.value() : tri_to_patch[t.index()];
  }
};

/// All facets of a reference, and finer ones of some of its patches.
struct FacetSets {
  FacetSet all, finer;                   ///< without a tree: there are no finer ones
  std::span<const char> has_finer = {};  ///< per patch
};

struct FacetRef {
  TriId tri;
  bool is_finer = false;
};

struct NearFacet {
  FacetRef ref;
  double distance = 0, error = 0;
  std::int32_t patch = -1;
};

/// Queries that come in an order where neighbours are near, which bounds each search.
class FacetFinder {
 public:
  explicit FacetFinder(const FacetSets& sets)
      : sets_(sets), all_(sets.all.tree), finer_(sets.finer.tree) {}

  /// The reference must not be empty.
  NearFacet find(const Vec3& p);
  TriangleData data(const FacetRef& ref) const;
  double error(const FacetRef& ref) const { return set(ref).error(ref.tri); }

 private:
  const FacetSet& set(const FacetRef& ref) const { return ref.is_finer ? sets_.finer : sets_.all; }

  const FacetSets& sets_;
  NearbyQueries all_, finer_;
};

}  // namespace hexwright
