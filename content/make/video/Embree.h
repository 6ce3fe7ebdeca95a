// One interface to Embree 3 and 4, as Debian 12 and 13 have them: intersect() finds the first hit of a ray,
// occlude() tests whether it hits anything.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace shoal {

#if __has_include(<embree4/rtcore.h>)
inline void intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray); }
inline void occlude(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }
#else
inline RTCIntersectContext embreeContext() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    return context;
}
inline void intersect(RTCScene scene, RTCRayHit& ray) {
    RTCIntersectContext context = embreeContext();
    rtcIntersect1(scene, &context, &ray);
}
inline void occlude(RTCScene scene, RTCRay& ray) {
    RTCIntersectContext context = embreeContext();
    rtcOccluded1(scene, &context, &ray);
}
#endif

} // namespace shoal
