// In: a scene of the torture suite. Out: what other tools do with it: triangles in float in Embree, hits in
// float.
#include "float_finder.h"

#include <algorithm>
#include <cmath>

namespace sahl::bench {

namespace {

struct Query {
#if RTC_VERSION_MAJOR >= 4
    RTCRayQueryContext embree;
#else
    RTCIntersectContext embree;
#endif
    FloatScene::Last but;
};

void pass_by_the_last(RTCFilterFunctionNArguments const* arguments) {
    auto const& but = reinterpret_cast<Query const*>(arguments->context)->but;
    if (RTCHitN_geomID(arguments->hit, 1, 0) == but.part &&
        RTCHitN_primID(arguments->hit, 1, 0) == but.triangle)
        arguments->valid[0] = 0;
}

} // namespace

FloatScene::FloatScene(TortureCase const& torture)
    : torture_(torture), device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    dvec3 low(INFINITY), high(-INFINITY);
    for (std::uint32_t p = 0; p < torture.parts.size(); ++p) {
        Mesh const& mesh = *std::get<MeshRef>(torture.parts[p].geometry);
        auto& positions = positions_.emplace_back();
        for (dvec3 const& local : mesh.soup.positions) {
            dvec3 const at = torture.parts[p].place.point(local);
            low = glm::min(low, at);
            high = glm::max(high, at);
            positions.emplace_back(at);
        }
        RTCGeometry const geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, positions.size()));
        for (std::size_t i = 0; i < positions.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                vertices[3 * i + static_cast<std::size_t>(axis)] = positions[i][axis];
        auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.soup.triangles.size()));
        for (std::size_t i = 0; i < mesh.soup.triangles.size(); ++i)
            std::copy_n(mesh.soup.triangles[i].begin(), 3, indices + 3 * i);
        rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
        rtcSetGeometryIntersectFilterFunction(geometry, pass_by_the_last);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene_, geometry, p);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(scene_);
    size_ = length(high - low);
}

FloatScene::~FloatScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

std::array<dvec3, 3> FloatScene::corners(std::uint32_t part, std::uint32_t triangle) const {
    TorturePart const& of = torture_.parts[part];
    auto const& soup = std::get<MeshRef>(of.geometry)->soup;
    auto const& [a, b, c] = soup.triangles[triangle];
    return {of.place.point(soup.positions[a]), of.place.point(soup.positions[b]),
            of.place.point(soup.positions[c])};
}

FloatScene::Hit FloatScene::meet(fvec3 const& origin, fvec3 const& direction, float from,
                                 Last const& but) const {
    RTCRayHit ray{};
    ray.ray.org_x = origin.x;
    ray.ray.org_y = origin.y;
    ray.ray.org_z = origin.z;
    ray.ray.dir_x = direction.x;
    ray.ray.dir_y = direction.y;
    ray.ray.dir_z = direction.z;
    ray.ray.tnear = from;
    ray.ray.tfar = INFINITY;
    ray.ray.mask = 0xFFFFFFFFu;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    Query query{{}, but};
#if RTC_VERSION_MAJOR >= 4
    rtcInitRayQueryContext(&query.embree);
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.context = &query.embree;
    rtcIntersect1(scene_, &ray, &arguments);
#else
    rtcInitIntersectContext(&query.embree);
    rtcIntersect1(scene_, &query.embree, &ray);
#endif
    Hit hit;
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return hit;
    hit.any = true;
    hit.t = ray.ray.tfar;
    hit.u = ray.hit.u;
    hit.v = ray.hit.v;
    hit.part = ray.hit.geomID;
    hit.triangle = ray.hit.primID;
    auto const& corners = std::get<MeshRef>(torture_.parts[hit.part].geometry)->soup.triangles[hit.triangle];
    auto const& p = positions_[hit.part];
    fvec3 const &a = p[corners[0]], &b = p[corners[1]], &c = p[corners[2]];
    hit.normal = normalize(cross(b - a, c - a));
    fvec3 const wa = (1.0f - hit.u - hit.v) * a, ub = hit.u * b, vc = hit.v * c;
    hit.point = wa + ub + vc;
    constexpr float half = 0x1p-24f, gamma7 = 7.0f * half / (1.0f - 7.0f * half);
    hit.error = gamma7 * (glm::abs(wa) + glm::abs(ub) + glm::abs(vc));
    return hit;
}

void FloatFinder::begin(TortureRay const& ray, std::vector<std::uint32_t> const& inside) {
    origin_ = fvec3(ray.origin);
    direction_ = fvec3(ray.direction);
    told_ = dvec3(origin_);
    last_ = {};
    if (ray.part)
        last_ = {*ray.part, ray.face};
    turns_.assign(torture_.parts.size(), 0);
    for (std::uint32_t const part : inside)
        turns_[part] = 1;
}

std::uint32_t FloatFinder::medium_in(std::vector<int> const& turns) const {
    std::uint32_t medium = 0;
    int best = -1;
    for (std::uint32_t p = 0; p < turns.size(); ++p)
        if (turns[p] > 0 && (best < 0 || torture_.parts[p].priority >=
                                             torture_.parts[static_cast<std::size_t>(best)].priority)) {
            best = static_cast<int>(p);
            medium = torture_.parts[p].medium;
        }
    return medium;
}

Answer FloatFinder::next() {
    Answer answer;
    answer.before = medium_in(turns_);
    after_ = turns_;
    double t = 0.0;
    for (int silent = 0; silent < 16; ++silent) {
        hit_ = scene_.meet(origin_, direction_, from(), excludes_last() ? last_ : FloatScene::Last{});
        if (!hit_.any)
            return answer;
        t += static_cast<double>(hit_.t);
        before_ = after_;
        after_[hit_.part] += dot(hit_.normal, direction_) < 0.0f ? 1 : -1;
        answer.after = medium_in(after_);
        if (answer.after != answer.before) {
            answer.kind = Answer::Kind::boundary;
            answer.t = t;
            answer.part = hit_.part;
            answer.face = hit_.triangle;
            answer.normal = normalize(dvec3(hit_.normal));
            return answer;
        }
        last_ = {hit_.part, hit_.triangle}; // the same medium behind it: straight on
        origin_ = start(hit_, direction_);
    }
    answer.kind = Answer::Kind::lost;
    return answer;
}

void FloatFinder::go_on(dvec3 const& direction, bool crosses) {
    direction_ = fvec3(direction);
    turns_ = crosses ? after_ : before_;
    last_ = {hit_.part, hit_.triangle};
    told_ = dvec3(hit_.point);
    origin_ = start(hit_, direction_);
}

} // namespace sahl::bench
