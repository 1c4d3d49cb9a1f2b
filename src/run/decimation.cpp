#include "run/decimation.h"

#include "geometry/mesh_decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace sahl {

namespace {

constexpr double margin = 2.0; // for what the pilots do not see of the worst
/// Shares of a mesh's size by which it may be decimated.
constexpr std::array steps{1e-9, 3e-9, 1e-8, 3e-8, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3};
constexpr double worth_it = 0.7; // of the triangles: with more than these left nothing is gained

std::size_t triangles_of(std::vector<std::shared_ptr<Mesh const>> const& meshes) {
    std::size_t count = 0;
    for (auto const& mesh : meshes)
        count += mesh->soup.triangles.size();
    return count;
}

FewerTriangles as_they_are(Scene const& scene, std::vector<std::size_t> const& bodies) {
    FewerTriangles same;
    for (std::size_t const body : bodies)
        same.meshes.push_back(scene.bodies[body].mesh);
    same.within.assign(bodies.size(), 0.0);
    return same;
}

/// Each by `step` of its size; bodies that share a mesh still do.
FewerTriangles decimated_by(double step, Scene const& scene, std::vector<std::size_t> const& bodies,
                            std::vector<bool> const& free) {
    FewerTriangles fewer = as_they_are(scene, bodies);
    std::map<std::shared_ptr<Mesh const>, std::shared_ptr<Mesh const>> made;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!free[bodies[i]])
            continue;
        std::shared_ptr<Mesh const> const mesh = fewer.meshes[i];
        double const size = length(mesh->high - mesh->low);
        auto [entry, is_new] = made.try_emplace(mesh);
        if (is_new)
            if (auto left = decimated(*mesh, step * size))
                entry->second = std::make_shared<Mesh const>(std::move(*left));
        if (!entry->second)
            continue;
        fewer.meshes[i] = entry->second;
        fewer.within[i] = step * size * stretch_of(scene.bodies[bodies[i]].to_world);
    }
    return fewer;
}

} // namespace

std::vector<bool> free_to_decimate(Scene const& scene) {
    std::vector<bool> free;
    for (Body const& body : scene.bodies)
        free.push_back(body.mesh != nullptr);
    for (auto const& [one, other] : scene.bvh->contacts())
        for (FaceId const face : {one, other})
            free[scene.faces[face.value].body.value] = false;
    return free;
}

std::optional<FewerTriangles> asked_for(Scene const& scene, std::vector<std::size_t> const& bodies,
                                        std::vector<bool> const& free) {
    FewerTriangles fewer = as_they_are(scene, bodies);
    bool some = false;
    std::map<std::pair<std::shared_ptr<Mesh const>, double>, std::shared_ptr<Mesh const>> made;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        Body const& body = scene.bodies[bodies[i]];
        if (!(body.decimate > 0.0) || !free[bodies[i]])
            continue;
        double const within = body.decimate / stretch_of(body.to_world);
        auto [entry, is_new] = made.try_emplace(std::pair(body.mesh, within));
        if (is_new)
            if (auto left = decimated(*body.mesh, within))
                entry->second = std::make_shared<Mesh const>(std::move(*left));
        if (!entry->second)
            continue;
        fewer.meshes[i] = entry->second;
        fewer.within[i] = body.decimate;
        some = true;
    }
    return some ? std::optional(std::move(fewer)) : std::nullopt;
}

std::optional<Decimated> fewest(MethodPilots& judge, Scene const& scene,
                                std::vector<std::size_t> const& bodies, std::vector<bool> const& free,
                                MethodLevels const& found, MethodLevel const& whole, double tolerance) {
    std::optional<Decimated> best;
    if (whole.method == Method::recognised) // an exact solid is met in the same time, whatever its mesh
        return best;
    auto const all = static_cast<double>(triangles_of(as_they_are(scene, bodies).meshes));
    // a coarser mesh errs more: halving finds the coarsest that does
    std::size_t low = 0, high = steps.size();
    while (low < high) {
        std::size_t const middle = (low + high) / 2;
        FewerTriangles fewer = decimated_by(steps[middle], scene, bodies, free);
        bool const gains = static_cast<double>(triangles_of(fewer.meshes)) < worth_it * all;
        bool within = !gains; // nothing is left out, or little: a coarser one may do
        if (gains) {
            auto const levels = judge.levels_with(bodies, fewer.meshes, found);
            // a slower method on fewer triangles is no gain
            auto const level = std::find_if(levels.begin(), levels.end(), [&](MethodLevel const& l) {
                return l.bound <= tolerance && l.method <= whole.method;
            });
            within = level != levels.end();
            if (within)
                best = {std::move(fewer), *level};
        }
        (within ? low : high) = within ? middle + 1 : middle;
    }
    return best;
}

void put(Scene& scene, std::vector<std::size_t> const& bodies, FewerTriangles const& to, double turn,
         double changed) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        Body& body = scene.bodies[bodies[i]];
        if (body.mesh == to.meshes[i])
            continue;
        body.decimated = Decimation{body.mesh, to.within[i], turn, changed};
        body.mesh = to.meshes[i];
    }
}

std::vector<std::string> decimate_by_name(Scene& scene, WavelengthTable const& optics,
                                          Emission const& emission, TraceOptions const& options) {
    std::vector<std::string> warnings;
    std::vector<std::size_t> bodies;
    std::vector<bool> const free = free_to_decimate(scene);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        Body const& body = scene.bodies[i];
        if (!(body.decimate > 0.0) || body.decimated)
            continue;
        if (free[i])
            bodies.push_back(i);
        else
            warnings.push_back(body.name + ": it touches another body, and keeps its triangles");
    }
    auto const fewer = asked_for(scene, bodies, free);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (!fewer || fewer->meshes[i] == scene.bodies[bodies[i]].mesh)
            warnings.push_back(scene.bodies[bodies[i]].name + ": it is no manifold, and keeps its triangles");
    if (!fewer)
        return warnings;
    MethodPilots judge(scene, optics, emission, options, std::vector<bool>(scene.bodies.size(), false));
    PathErrors const moved = judge.moved_by(bodies, fewer->meshes);
    put(scene, bodies, *fewer, std::min(margin * moved.tail(), std::numbers::pi), moved.changed_share());
    std::vector<BodyMethod> methods;
    for (Body const& body : scene.bodies)
        methods.push_back(body_method(body.method));
    scene.bvh = bvh_with(scene, methods);
    return warnings;
}

} // namespace sahl
