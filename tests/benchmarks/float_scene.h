// In: a mesh. Out: its triangles in Embree's floats, and nothing else.
#pragma once

#include "geometry/mesh.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>

namespace sahl::bench {

class FloatScene {
  public:
    FloatScene(Mesh const& mesh, RTCSceneFlags flags)
        : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        rtcSetSceneFlags(scene_, flags);
        RTCGeometry const geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto const& soup = mesh.soup;
        auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, soup.positions.size()));
        for (dvec3 const& p : soup.positions)
            for (int axis = 0; axis < 3; ++axis)
                *vertex++ = static_cast<float>(p[axis]);
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, soup.triangles.size()));
        for (auto const& triangle : soup.triangles)
            index = std::copy(triangle.begin(), triangle.end(), index);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    FloatScene(FloatScene const&) = delete;
    ~FloatScene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    operator RTCScene() const { return scene_; }

  private:
    RTCDevice device_;
    RTCScene scene_;
};

} // namespace sahl::bench
