#include "geometry/embree/triangle_tree.h"

#include "geometry/embree/device.h"
#include "math/products.h"

namespace sahl {

using namespace embree;

namespace {

/// Edges are moved outward by this many ulp of the mesh's size. Rounding the line and the corners to float
/// moves them against each other by 3 ulp at the most; the rest keeps that true of what the line sees of a
/// triangle, and joins what is lifted at an edge, where it is met at a slope of a tenth or more.
constexpr double growth_ulps = 64.0;

/// Triangles are lifted outward by this many ulp of the mesh's size: a line that cuts off a corner so thin
/// that float cannot see it meets them, if not the right ones. It meets them at a small slope, which is told.
constexpr double lift_ulps = 3.0;

/// Embree's t of a triangle that is met at a slope s is wrong by fewer ulp of the mesh's size than this over
/// s.
constexpr double t_ulps = 16.0;

/// How much more of the line than was asked for is searched on either side, as a share of the mesh's size:
/// room for that error at slopes down to 4e-3.
constexpr double margin_share = 1.0 / 4096.0;

struct Query {
    Context embree;
    double (*callback)(void*, Proposal const&);
    void* context;
    double to;    // t of the caller's line
    double start; // t at which the float ray starts
    double unit;  // length of the caller's direction
    double per_unit;
    double margin; // m
    float sure;    // square of a slope
    float far() const {
        return static_cast<float>((to - start) * unit + margin);
    } // the margin covers rounding
};

void propose(RTCFilterFunctionNArguments const* arguments) {
    if (!arguments->valid[0])
        return;
    auto& query = *reinterpret_cast<Query*>(arguments->context);
    auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
    auto const& hit = *reinterpret_cast<RTCHit const*>(arguments->hit);
    float const along = hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z;
    float const squared = hit.Ng_x * hit.Ng_x + hit.Ng_y * hit.Ng_y + hit.Ng_z * hit.Ng_z;
    bool const sure = along * along > query.sure * squared;
    Proposal const proposal{hit.primID, query.start + static_cast<double>(ray.tfar) * query.per_unit,
                            !sure          ? 0
                            : along < 0.0f ? -1
                                           : 1};
    double const to = query.callback(query.context, proposal);
    if (to >= query.to) {
        arguments->valid[0] = 0;
        return;
    }
    query.to = to;
    // beyond the hit itself, so that all that lies at one place is proposed
    ray.tfar = query.far();
}

using Corners = std::array<dvec3, 3>;

/// A triangle that holds all points of a plane no farther than `growth` from this one.
Corners grown(Corners const& c, double growth) {
    dvec3 const across = precise_cross(c[1] - c[0], c[2] - c[0]);
    double const area = length(across);
    std::array<double, 3> edge{}; // opposite each corner
    for (std::size_t i = 0; i < 3; ++i)
        edge[i] = length(c[(i + 2) % 3] - c[(i + 1) % 3]);
    double const around = edge[0] + edge[1] + edge[2];
    std::size_t const longest =
        static_cast<std::size_t>(std::max_element(edge.begin(), edge.end()) - edge.begin());
    // the edges of a triangle scaled about the centre of its inscribed circle move by its radius, area /
    // around
    if (area * 4.0 >= growth * around) {
        dvec3 const centre = (edge[0] * c[0] + edge[1] * c[1] + edge[2] * c[2]) / around;
        double const scale = 1.0 + growth * around / area;
        return {centre + scale * (c[0] - centre), centre + scale * (c[1] - centre),
                centre + scale * (c[2] - centre)};
    }
    // of a needle that would be far too much: half of a rectangle of twice its size
    dvec3 const &a = c[(longest + 1) % 3], &b = c[(longest + 2) % 3];
    double const height = area / edge[longest];
    dvec3 const ahead = (b - a) / edge[longest];
    dvec3 const up =
        area > 0.0 ? cross(across / area, ahead) : perpendicular_to(ahead); // to the third corner
    dvec3 const corner = a - growth * (ahead + up);
    dvec3 const other = corner + 2.0 * (edge[longest] + 2.0 * growth) * ahead;
    return {corner, other, corner + 2.0 * (height + 2.0 * growth) * up};
}

} // namespace

struct TriangleTree::State {
    dvec3 centre{0.0}, half{0.0};
    double size = 0.0, margin = 0.0; // m, the diagonal of the box of all, a share of it
    double sure = sure_slope;
    RTCScene scene = nullptr;
    ~State() {
        if (scene)
            rtcReleaseScene(scene);
    }
};

TriangleTree::TriangleTree(std::span<std::array<dvec3, 3> const> triangles, double sure)
    : state_(std::make_unique<State>()) {
    State& state = *state_;
    state.sure = std::max(sure, sure_slope);
    if (triangles.empty())
        return;
    dvec3 low(INFINITY), high(-INFINITY);
    for (Corners const& triangle : triangles)
        for (dvec3 const& p : triangle) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    state.centre = 0.5 * (low + high);
    state.size = length(high - low);
    double const growth = growth_ulps * float_ulp * state.size + std::numeric_limits<float>::min();
    state.margin = margin_share * state.size;
    state.half = 0.5 * (high - low) + state.margin;

    RTCGeometry const geometry = rtcNewGeometry(shared_device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * triangles.size()));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), triangles.size()));
    unsigned next = 0;
    double const lift = lift_ulps * float_ulp * state.size;
    for (Corners const& triangle : triangles) {
        Corners const larger = grown(triangle, growth);
        dvec3 const normal = cross(larger[1] - larger[0], larger[2] - larger[0]);
        dvec3 const shift = lift / length(normal) * normal - state.centre;
        for (dvec3 const& corner : larger) {
            for (int axis = 0; axis < 3; ++axis)
                *vertex++ = static_cast<float>(corner[axis] + shift[axis]);
            *index++ = next++;
        }
    }
    rtcSetGeometryIntersectFilterFunction(geometry, propose);
    state.scene = scene_of(geometry, RTC_SCENE_FLAG_NONE);
}

TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;
TriangleTree::~TriangleTree() = default;

double TriangleTree::blur() const {
    return t_ulps / sure_slope * float_ulp * state_->size;
}

double TriangleTree::lift() const {
    return growth_ulps * float_ulp * state_->size;
}

void TriangleTree::visit_triangles(dvec3 const& origin, dvec3 const& direction, double unit, Reach reach,
                                   Callback callback, void* context) const {
    State const& state = *state_;
    if (!state.scene || !(unit > 0.0) || !std::isfinite(unit) || !std::isfinite(dot(origin, origin)))
        return;
    dvec3 const start = origin - state.centre;
    double const per_unit = 1.0 / unit, margin = state.margin;
    Reach part{reach.from - margin * per_unit, std::min(reach.to, (state.size + margin) * per_unit)};
    dvec3 const out = glm::abs(start) - state.half;
    if (std::max({out.x, out.y, out.z}) > 0.0 || reach.from != 0.0) { // it starts outside the box
        auto const clipped = clip(start, direction, state.half, {part.from, reach.to});
        if (!clipped)
            return;
        part = *clipped;
    }
    Query query{{},       callback,  context,
                reach.to, part.from, unit,
                per_unit, margin,    static_cast<float>(state.sure * state.sure)};
    RTCRayHit ray = float_ray(start + part.from * direction, per_unit * direction,
                              static_cast<float>((part.to - part.from) * unit + margin));
    intersect(state.scene, query.embree, ray);
}

} // namespace sahl
