// The largest distance of a surface of facets from another one, between bounds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hexwright/base/function_ref.h"

#include "quality/distance/facet_finder.h"

namespace hexwright {

/// What is measured, and how closely.
struct BoundInput {
  const TriMesh& sampled;
  FacetSets reference;
  std::span<const double> sampled_error = {};  ///< per triangle; empty: exact
  /// Per vertex of `sampled`: no less than its distance, and the triangle of all facets of the
  /// reference that is nearest; empty: not known.
  std::span<const double> vert_upper = {};
  std::span<const TriId> vert_nearest = {};
  std::span<const TriId> tris = {};  ///< of `sampled`, to look at; empty: all
  double lower = 0;                  ///< the largest distance is no less
  Vec3 worst = {};                   ///< where it is reached
  double gap = 0;                    ///< between the bounds, if facets allow
  /// Of a sample so far off: whether it counts; null: always.
  const FunctionRef<bool(const Vec3& p, double distance)>* counts = nullptr;
  bool is_first = false;     ///< finer facets follow where those at hand stand in the way
  double least_excused = 0;  ///< pieces so small are left out when their centre does not count
};

struct DistanceBounds {
  /// With errors taken off: for the patches where they are sampled; where they are the reference,
  /// only those nearest to `worst` by their facets are considered.
  double lower = 0;
  double upper = 0;       ///< for the patches, of what is no farther than lower + gap
  double open_upper = 0;  ///< of the rest, for which facets are too coarse
  Vec3 worst;
  std::vector<TriId> open;           ///< triangles of `sampled` with such a rest
  std::vector<std::int32_t> coarse;  ///< patches of the reference that it is nearest to, repeated
};

/// Same result for any number of threads.
DistanceBounds bound_distance(const BoundInput& input);

}  // namespace hexwright
