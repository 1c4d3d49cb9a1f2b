#include "geometry/embree/triangle_tree.h"

#include "geometry/embree/device.h"
#include "math/products.h"

#include <array>

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

/// What one line asks, beside what Embree is told.
struct Asked {
    double to;    // t of the caller's line
    double start; // t at which the float ray starts
    double unit;  // length of the caller's direction
    double per_unit;

    /// The margin covers rounding.
    float far(double margin) const { return static_cast<float>((to - start) * unit + margin); }
};

struct Query {
    Context embree;
    double (*callback)(void*, Proposal const&);
    void* context;
    double margin; // m
    float sure;    // square of a slope
    Asked asked;
};

struct PacketQuery {
    Context embree;
    double (*callback)(void*, std::size_t, Proposal const&);
    void* context;
    double margin;
    float sure;
    std::array<Asked, packet_size> asked;
};

/// Embree's hit as a proposal.
///   along, squared   of its normal, which has any length: times the direction, times itself
Proposal proposal_of(Asked const& asked, unsigned triangle, float t, float along, float squared, float sure) {
    bool const is_sure = along * along > sure * squared;
    return {triangle, asked.start + static_cast<double>(t) * asked.per_unit,
            !is_sure       ? 0
            : along < 0.0f ? -1
                           : 1};
}

void propose_to_packet(RTCFilterFunctionNArguments const* arguments) {
    auto& query = *reinterpret_cast<PacketQuery*>(arguments->context);
    unsigned const n = arguments->N;
    for (unsigned i = 0; i < n; ++i) {
        if (!arguments->valid[i])
            continue;
        Asked& asked = query.asked[i];
        float const x = RTCHitN_Ng_x(arguments->hit, n, i), y = RTCHitN_Ng_y(arguments->hit, n, i),
                    z = RTCHitN_Ng_z(arguments->hit, n, i);
        float const along = x * RTCRayN_dir_x(arguments->ray, n, i) +
                            y * RTCRayN_dir_y(arguments->ray, n, i) + z * RTCRayN_dir_z(arguments->ray, n, i);
        float& far = RTCRayN_tfar(arguments->ray, n, i);
        double const to = query.callback(query.context, i,
                                         proposal_of(asked, RTCHitN_primID(arguments->hit, n, i), far, along,
                                                     x * x + y * y + z * z, query.sure));
        if (to >= asked.to) {
            arguments->valid[i] = 0;
            continue;
        }
        asked.to = to;
        far = asked.far(query.margin);
    }
}

void propose(RTCFilterFunctionNArguments const* arguments) {
    if (arguments->N > 1)
        return propose_to_packet(arguments);
    if (!arguments->valid[0])
        return;
    auto& query = *reinterpret_cast<Query*>(arguments->context);
    auto& ray = *reinterpret_cast<RTCRay*>(arguments->ray);
    auto const& hit = *reinterpret_cast<RTCHit const*>(arguments->hit);
    float const along = hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z;
    float const squared = hit.Ng_x * hit.Ng_x + hit.Ng_y * hit.Ng_y + hit.Ng_z * hit.Ng_z;
    double const to = query.callback(
        query.context, proposal_of(query.asked, hit.primID, ray.tfar, along, squared, query.sure));
    if (to >= query.asked.to) {
        arguments->valid[0] = 0;
        return;
    }
    query.asked.to = to;
    // beyond the hit itself, so that all that lies at one place is proposed
    ray.tfar = query.asked.far(query.margin);
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

namespace {

/// The part of a line that Embree is asked about, seen from the box's centre; none: it misses the box.
std::optional<Reach> part_of(dvec3 const& start, dvec3 const& direction, double per_unit, Reach reach,
                             dvec3 const& half, double size, double margin) {
    dvec3 const out = glm::abs(start) - half;
    if (std::max({out.x, out.y, out.z}) > 0.0 || reach.from != 0.0) // it starts outside the box
        return clip(start, direction, half, {reach.from - margin * per_unit, reach.to});
    return Reach{-margin * per_unit, std::min(reach.to, (size + margin) * per_unit)};
}

bool is_line(dvec3 const& origin, double unit) {
    return unit > 0.0 && std::isfinite(unit) && std::isfinite(dot(origin, origin));
}

} // namespace

void TriangleTree::visit_triangles(dvec3 const& origin, dvec3 const& direction, double unit, Reach reach,
                                   Callback callback, void* context) const {
    State const& state = *state_;
    if (!state.scene || !is_line(origin, unit))
        return;
    dvec3 const start = origin - state.centre;
    double const per_unit = 1.0 / unit, margin = state.margin;
    auto const part = part_of(start, direction, per_unit, reach, state.half, state.size, margin);
    if (!part)
        return;
    Query query{{},
                callback,
                context,
                margin,
                static_cast<float>(state.sure * state.sure),
                {reach.to, part->from, unit, per_unit}};
    RTCRayHit ray = float_ray(start + part->from * direction, per_unit * direction,
                              static_cast<float>((part->to - part->from) * unit + margin));
    intersect(state.scene, query.embree, ray);
}

bool TriangleTree::visits_together() const {
    static_assert(most_together == packet_size);
    return state_->scene && takes_packets();
}

namespace {

using Numbers = TriangleTree::Lines::Numbers;

/// The parts of a packet's lines that Embree is asked about.
struct Parts {
    alignas(64) std::array<Numbers, 3> start; // from the box's centre
    alignas(64) Numbers from, to, per_unit;
    alignas(64) std::array<int, packet_size> valid; // as Embree has it

    /// As part_of() has them, all at once: a line that starts in the box is cut by it, too.
    Parts(TriangleTree::Lines const& lines, dvec3 const& centre, dvec3 const& half, double margin) {
        Numbers sum; // not finite if anything is not
        for (std::size_t i = 0; i < packet_size; ++i) {
            sum[i] = 0.0;
            per_unit[i] = 1.0 / lines.unit[i];
            from[i] = -margin * per_unit[i];
            to[i] = std::numeric_limits<double>::infinity();
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double const middle = centre[static_cast<int>(axis)], reach = half[static_cast<int>(axis)];
            for (std::size_t i = 0; i < packet_size; ++i) {
                double const along = lines.direction[axis][i], at = lines.origin[axis][i] - middle;
                double const per_metre = 1.0 / along;
                double const one = (-reach - at) * per_metre, other = (reach - at) * per_metre;
                // comparisons with 0/0 are false: it constrains nothing; of the rounding the margin is wider
                double const near = one < other ? one : other, far = one < other ? other : one;
                from[i] = near > from[i] ? near : from[i];
                to[i] = far < to[i] ? far : to[i];
                start[axis][i] = at;
                sum[i] += at + along;
            }
        }
        for (std::size_t i = 0; i < packet_size; ++i) {
            double const zero = (sum[i] - sum[i]) + (per_unit[i] - per_unit[i]);
            bool const meets = from[i] <= to[i] && to[i] < std::numeric_limits<double>::infinity();
            valid[i] = i < lines.count && meets && zero == 0.0 && per_unit[i] > 0.0 ? -1 : 0;
        }
    }
};

/// Of lines that are not valid nothing matters, but that they are numbers.
void fill(RTCRayHit16& rays, TriangleTree::Lines const& lines, Parts const& parts, double margin) {
    float* const origin[3] = {rays.ray.org_x, rays.ray.org_y, rays.ray.org_z};
    float* const direction[3] = {rays.ray.dir_x, rays.ray.dir_y, rays.ray.dir_z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < packet_size; ++i) {
            double const along = lines.direction[axis][i];
            double const at = parts.start[axis][i] + parts.from[i] * along;
            origin[axis][i] = parts.valid[i] ? static_cast<float>(at) : 0.0f;
            direction[axis][i] = parts.valid[i] ? static_cast<float>(parts.per_unit[i] * along) : 1.0f;
        }
    for (std::size_t i = 0; i < packet_size; ++i) {
        double const length = (parts.to[i] - parts.from[i]) * lines.unit[i] + margin;
        rays.ray.tnear[i] = 0.0f;
        rays.ray.tfar[i] = parts.valid[i] ? static_cast<float>(length) : 0.0f;
        rays.ray.time[i] = 0.0f;
        rays.ray.mask[i] = 0xFFFFFFFFu;
        rays.ray.id[i] = rays.ray.flags[i] = 0;
        rays.hit.geomID[i] = rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
}

} // namespace

void TriangleTree::visit_packet(Lines const& lines, PacketCallback callback, void* context) const {
    State const& state = *state_;
    Parts const parts(lines, state.centre, state.half, state.margin);
    int any = 0;
    for (int const valid : parts.valid)
        any |= valid;
    if (!any)
        return;
    PacketQuery query;
    query.callback = callback;
    query.context = context;
    query.margin = state.margin;
    query.sure = static_cast<float>(state.sure * state.sure);
    for (std::size_t i = 0; i < packet_size; ++i)
        query.asked[i] = {std::numeric_limits<double>::infinity(), parts.from[i], lines.unit[i],
                          parts.per_unit[i]};
    alignas(64) RTCRayHit16 rays;
    fill(rays, lines, parts, state.margin);
    intersect_packet(state.scene, query.embree, parts.valid.data(), rays);
}

void TriangleTree::visit_lines(Lines const& lines, Beginning begin, Callback callback, void* context) const {
    State const& state = *state_;
    if (!state.scene)
        return;
    Parts const parts(lines, state.centre, state.half, state.margin);
    Query query{{}, callback, context, state.margin, static_cast<float>(state.sure * state.sure), {}};
    for (std::size_t i = 0; i < lines.count; ++i) {
        if (!parts.valid[i])
            continue;
        begin(context, i);
        query.asked = {std::numeric_limits<double>::infinity(), parts.from[i], lines.unit[i],
                       parts.per_unit[i]};
        dvec3 const start(parts.start[0][i], parts.start[1][i], parts.start[2][i]), along = lines.along(i);
        double const length = (parts.to[i] - parts.from[i]) * lines.unit[i] + state.margin;
        RTCRayHit ray =
            float_ray(start + parts.from[i] * along, parts.per_unit[i] * along, static_cast<float>(length));
        intersect(state.scene, query.embree, ray);
    }
}

} // namespace sahl
