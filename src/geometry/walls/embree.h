// Embree 3 or 4, whichever the system carries: they differ in the header's folder and in one call.
#pragma once

#if defined(HEXWRIGHT_EMBREE_MAJOR) && HEXWRIGHT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace hexwright {

/// The first hit of a ray, written into the query.
inline void intersect_first(RTCScene scene, RTCRayHit& query) {
#if defined(HEXWRIGHT_EMBREE_MAJOR) && HEXWRIGHT_EMBREE_MAJOR >= 4
  rtcIntersect1(scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
#endif
}

}  // namespace hexwright
