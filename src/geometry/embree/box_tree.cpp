#include "geometry/embree/box_tree.h"

#include "geometry/embree/device.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sahl {

using namespace embree;

namespace {

struct Query {
    Context embree;
    double (*callback)(void*, std::uint32_t, double);
    void* context;
    double to;    // t of the caller's line
    double start; // t at which the float ray starts
    double unit;  // length of the caller's direction
    double slack; // m: what rounding to float may move a box's border along the ray
};

} // namespace

struct BoxTree::State {
    std::vector<Bounds> boxes;
    Bounds all;
    dvec3 centre{0.0};
    double growth = 0.0; // m
    RTCScene scene = nullptr;

    static void grown_box(RTCBoundsFunctionArguments const* arguments);
    ~State() {
        if (scene)
            rtcReleaseScene(scene);
    }
};

namespace {

void meet_box(RTCIntersectFunctionNArguments const* arguments) {
    if (!arguments->valid[0])
        return;
    auto& query = *reinterpret_cast<Query*>(arguments->context);
    double const to = query.callback(query.context, arguments->primID, query.to);
    if (to >= query.to)
        return;
    query.to = to;
    float& far = RTCRayN_tfar(RTCRayHitN_RayN(arguments->rayhit, arguments->N), arguments->N, 0);
    far = std::min(far, above((to - query.start) * query.unit * (1.0 + 4.0 * float_ulp) + query.slack));
}

} // namespace

void BoxTree::State::grown_box(RTCBoundsFunctionArguments const* arguments) {
    auto const& state = *static_cast<State const*>(arguments->geometryUserPtr);
    Bounds const& box = state.boxes[arguments->primID];
    dvec3 const low = box.low - state.centre - state.growth, high = box.high - state.centre + state.growth;
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = below(low.x);
    out.lower_y = below(low.y);
    out.lower_z = below(low.z);
    out.upper_x = above(high.x);
    out.upper_y = above(high.y);
    out.upper_z = above(high.z);
}

BoxTree::BoxTree(std::span<Bounds const> boxes) : state_(std::make_unique<State>()) {
    State& state = *state_;
    state.boxes.assign(boxes.begin(), boxes.end());
    if (boxes.empty())
        return;
    state.all = boxes.front();
    for (Bounds const& box : boxes)
        state.all = {glm::min(state.all.low, box.low), glm::max(state.all.high, box.high)};
    state.centre = 0.5 * (state.all.low + state.all.high);
    // The float line starts at the box of all and ends behind it: its start and its direction, each rounded
    // once per coordinate, move it by at most 2 · 2⁻²⁴ of the diagonal; a factor of 8 covers Embree's own
    // arithmetic.
    state.growth =
        8.0 * float_ulp * length(state.all.high - state.all.low) + std::numeric_limits<float>::min();
    RTCGeometry const geometry = rtcNewGeometry(shared_device(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(boxes.size()));
    rtcSetGeometryUserData(geometry, &state);
    rtcSetGeometryBoundsFunction(geometry, State::grown_box, nullptr);
    rtcSetGeometryIntersectFunction(geometry, meet_box);
    state.scene = scene_of(geometry, RTC_SCENE_FLAG_ROBUST);
}

BoxTree::BoxTree(BoxTree&&) noexcept = default;
BoxTree& BoxTree::operator=(BoxTree&&) noexcept = default;
BoxTree::~BoxTree() = default;

void BoxTree::visit_boxes(dvec3 const& origin, dvec3 const& direction, Reach reach, Callback callback,
                          void* context) const {
    State const& state = *state_;
    double const unit = length(direction);
    if (!state.scene || !(unit > 0.0) || !std::isfinite(unit) || !std::isfinite(dot(origin, origin)))
        return;
    // clip to the box of all, in double, so that the float ray is no longer than the box and starts near it
    dvec3 const start = origin - state.centre;
    dvec3 const half = 0.5 * (state.all.high - state.all.low) + 4.0 * state.growth;
    auto const part = clip(start, direction, half, reach);
    if (!part)
        return;
    auto const [from, to] = *part;
    dvec3 const at = start + from * direction;
    dvec3 const along = direction / unit;
    Query query{{}, callback, context, to, from, unit, 8.0 * state.growth};
    RTCRayHit ray = float_ray(at, along, above((to - from) * unit * (1.0 + 4.0 * float_ulp) + query.slack));
    intersect(state.scene, query.embree, ray);
}

} // namespace sahl
