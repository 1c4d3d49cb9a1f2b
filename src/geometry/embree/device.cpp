#include "geometry/embree/device.h"

#include <stdexcept>
#include <string>

namespace sahl::embree {

RTCDevice shared_device() {
    static struct Device {
        RTCDevice handle = rtcNewDevice(nullptr);
        ~Device() { rtcReleaseDevice(handle); }
    } device;
    if (!device.handle)
        throw std::runtime_error("Embree cannot start: error " +
                                 std::to_string(static_cast<int>(rtcGetDeviceError(nullptr))));
    return device.handle;
}

RTCScene scene_of(RTCGeometry geometry, RTCSceneFlags flags) {
    RTCScene const scene = rtcNewScene(shared_device());
    rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
    rtcCommitGeometry(geometry);
    rtcSetSceneFlags(scene, flags);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

} // namespace sahl::embree
