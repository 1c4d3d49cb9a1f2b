#include "run/check_census.h"

#include "math/overloaded.h"
#include "run/trace_scene.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr std::uint64_t pilot_rays = 256; // per source

StartingPlace start_of(Scene const& scene, Ray const& ray) {
    Bvh::Start const ahead = scene.bvh->start_at(ray.origin, ray.direction);
    Bvh::Start const behind = scene.bvh->start_at(ray.origin, -ray.direction);
    StartingPlace start{body_at(scene, ahead.inside), {}, 1};
    auto const on = [&](ObjectId body) {
        if (std::find(start.on.begin(), start.on.end(), body) == start.on.end())
            start.on.push_back(body);
    };
    // a start on a boundary belongs to the side that the ray heads for
    for (auto const& [one, other] : {std::pair(&ahead, &behind), std::pair(&behind, &ahead)})
        for (ShellId const shell : one->inside)
            if (!other->inside.contains(shell))
                on(scene.shells[shell.value].body);
    for (LeftSheet const& sheet : ahead.on)
        on({sheet.object});
    return start;
}

void count_start(PilotOfSource& source, StartingPlace const& start) {
    auto const same = [&](StartingPlace const& s) { return s.body == start.body && s.on == start.on; };
    auto const known = std::find_if(source.starts.begin(), source.starts.end(), same);
    if (known == source.starts.end())
        source.starts.push_back(start);
    else
        ++known->rays;
}

void count_segment(Census& census, Scene const& scene, Segment const& segment) {
    ++census.segments;
    if (segment.surface < 0)
        return;
    ObjectId const id = scene.faces[static_cast<std::size_t>(segment.surface)].body;
    census.bodies[id.value].reached = true;
    census.bodies[id.value].entered |= segment.ended == Event::refracted;
    if (auto const detector = scene.bodies[id.value].detector) {
        DetectorSpec const& spec = scene.detectors[detector->value];
        bool const behind = dot(segment.direction, spec.to_world.linear[2]) >= 0.0 && !spec.back;
        census.detectors[detector->value].hits_from_behind += behind;
    }
}

/// A body may share the boundary of another, which is where segments end by name: what lies beyond the
/// boundary is met as well.
void look_beyond(Census& census, Scene const& scene, Segment const& segment) {
    if (segment.ended != Event::refracted && segment.ended != Event::total_internal)
        return;
    dvec3 const end = segment.origin + segment.length * segment.direction;
    if (auto const body = body_at(scene, scene.bvh->start_at(end, segment.direction).inside)) {
        census.bodies[body->value].reached = true;
        census.bodies[body->value].entered |= segment.ended == Event::refracted;
    }
}

void send_pilots(Census& census, TraceContext const& context, std::size_t number) {
    PilotOfSource& source = census.sources[number];
    std::uint64_t const first = context.emission.first_rays()[number];
    std::uint64_t const count = context.emission.first_rays()[number + 1] - first;
    source.rays = std::min(pilot_rays, count);
    bool const shared_boundaries = std::count_if(context.scene.bodies.begin(), context.scene.bodies.end(),
                                                 [](Body const& body) { return !body.open; }) > 1;
    for (std::uint64_t i = 0; i < source.rays; ++i) {
        std::uint64_t const ray = first + count * i / source.rays;
        StartingPlace const start = start_of(context.scene, context.emission.ray(ray));
        count_start(source, start);
        if (start.body)
            census.bodies[start.body->value].entered = true;
        BatchResult const batch = trace_batch(context, ray, 1);
        source.meet_something += batch.log.segments.front().surface >= 0;
        for (Segment const& segment : batch.log.segments) {
            count_segment(census, context.scene, segment);
            if (shared_boundaries)
                look_beyond(census, context.scene, segment);
        }
        for (DetectorHit const& hit : batch.hits)
            ++census.detectors[hit.detector.value].hits;
        census.lost += batch.lost.size();
        if (!batch.lost.empty() && !census.first_lost_at)
            census.first_lost_at = batch.lost.front().at;
    }
    std::stable_sort(source.starts.begin(), source.starts.end(),
                     [](auto const& a, auto const& b) { return a.rays > b.rays; });
}

/// A body that nothing reaches: does its place lie in an opaque one?
std::optional<ObjectId> wall_round(Scene const& scene, Census const& census, std::uint32_t body) {
    Body const& inner = scene.bodies[body];
    dvec3 const place = inner.mesh ? inner.mesh->soup.positions.front() : dvec3(0.0);
    for (ShellId const shell : scene.bvh->start_at(inner.to_world.point(place), {0.0, 0.0, 1.0}).inside) {
        ObjectId const outer = scene.shells[shell.value].body;
        if (outer.value != body && census.bodies[outer.value].opaque)
            return outer;
    }
    return std::nullopt;
}

} // namespace

bool is_opaque(Surface const& surface) {
    return std::visit(Overloaded{[](Metal const&) { return true; }, [](Absorber const&) { return true; },
                                 [](Diffuse const&) { return true; },
                                 [](Paint const& paint) { return paint.covers == 1.0; },
                                 [](Shares const& shares) { return shares.transmit == 0.0; },
                                 [](Tinted const& tinted) { return tinted.clear == 0.0; },
                                 [](ThinWall const& wall) { return wall.clear == 0.0; }},
                      surface.kind);
}

Census take_census(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
                   TraceOptions const& options) {
    Census census;
    census.sources.resize(scene.sources.size());
    census.bodies.resize(scene.bodies.size());
    census.detectors.resize(scene.detectors.size());
    for (PilotOfBody& body : census.bodies)
        body.opaque = true;
    for (Face const& face : scene.faces)
        if (!face.surface || !is_opaque(scene.surfaces[face.surface->value]))
            census.bodies[face.body.value].opaque = false;
    if (emission.rays() > 0) {
        TraceContext const context{scene, optics, emission, options, power_unit(emission), 1};
        for (std::size_t source = 0; source < scene.sources.size(); ++source)
            send_pilots(census, context, source);
    }
    for (std::uint32_t body = 0; body < scene.bodies.size(); ++body)
        if (!scene.bodies[body].detector && !census.bodies[body].reached)
            census.bodies[body].walled_in = wall_round(scene, census, body);
    return census;
}

} // namespace sahl
