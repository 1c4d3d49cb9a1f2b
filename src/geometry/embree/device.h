// In: a line in double. Out: what Embree needs of it in float, and where it meets a box. Shared by the trees
// of this folder, the only door to Embree (3 or 4).
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "geometry/embree/reach.h"
#include "math/vec.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace sahl::embree {

#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

constexpr double float_ulp = 0x1p-24; // half a unit in the last place of 1.0f: one rounding's relative error

inline float below(double x) {
    return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
inline float above(double x) {
    return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

/// One device serves all trees: each would start threads of its own. Throws where Embree cannot start.
RTCDevice shared_device();

/// A scene of one geometry, which the scene then owns.
RTCScene scene_of(RTCGeometry geometry, RTCSceneFlags flags);

/// The part of a line, seen from the box's centre, that lies in the box; a few ulp too long, never too short.
inline std::optional<Reach> clip(dvec3 const& start, dvec3 const& direction, dvec3 const& half, Reach reach) {
    auto [from, to] = reach;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (std::abs(start[axis]) > half[axis])
                return std::nullopt;
            continue;
        }
        double const one = (-half[axis] - start[axis]) / direction[axis];
        double const other = (half[axis] - start[axis]) / direction[axis];
        from = std::max(from, std::min(one, other) - 4e-16 * std::abs(one));
        to = std::min(to, std::max(one, other) + 4e-16 * std::abs(other));
    }
    return from <= to ? std::optional(Reach{from, to}) : std::nullopt;
}

/// A ray of Embree's; `direction` unit.
inline RTCRayHit float_ray(dvec3 const& origin, dvec3 const& direction, float far) {
    RTCRayHit ray;
    ray.ray.org_x = static_cast<float>(origin.x);
    ray.ray.org_y = static_cast<float>(origin.y);
    ray.ray.org_z = static_cast<float>(origin.z);
    ray.ray.dir_x = static_cast<float>(direction.x);
    ray.ray.dir_y = static_cast<float>(direction.y);
    ray.ray.dir_z = static_cast<float>(direction.z);
    ray.ray.tnear = 0.0f;
    ray.ray.tfar = far;
    ray.ray.time = 0.0f;
    ray.ray.mask = 0xFFFFFFFFu;
    ray.ray.id = 0;
    ray.ray.flags = 0;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return ray;
}

/// How many rays a packet holds.
inline constexpr unsigned packet_size = 16;

/// Does this Embree trace packets of sixteen as they are? Where the processor lacks AVX-512 it cuts them into
/// smaller ones, whose lanes are counted anew: proposals would go to other rays.
inline bool takes_packets() {
    return rtcGetDeviceProperty(shared_device(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
}

/// Rays that go the same way; `valid` is −1 for those that there are, and 0.
inline void intersect_packet(RTCScene scene, Context& context, int const* valid, RTCRayHit16& rays) {
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &rays, &arguments);
#else
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &context, &rays);
#endif
}

inline void intersect(RTCScene scene, Context& context, RTCRayHit& ray) {
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&context);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &context;
    rtcIntersect1(scene, &ray, &arguments);
#else
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &ray);
#endif
}

} // namespace sahl::embree
