#include "run/method_choice.h"

#include "geometry/smooth_fans.h"
#include "run/decimation.h"
#include "run/method_levels.h"
#include "run/normal_warnings.h"

#include <cstdio>

namespace sahl {

namespace {

/// Only a file's normals say that its triangles stand for a curved surface: without them a brilliant is a
/// brilliant.
bool has_smooth_normals(std::shared_ptr<Mesh const> const& mesh) {
    if (mesh->soup.normals.empty())
        return false;
    NormalUse const use = smooth_fans(mesh).normals;
    return use == NormalUse::files || use == NormalUse::first_order;
}

std::vector<bool> curved_bodies(Scene const& scene) {
    std::vector<bool> curved = curvable_meshes(scene);
    for (std::size_t i = 0; i < curved.size(); ++i)
        curved[i] = curved[i] && has_smooth_normals(scene.bodies[i].mesh);
    return curved;
}

std::string none_admissible(std::string const& name, double tolerance, double bound) {
    char text[300];
    std::snprintf(
        text, sizeof text,
        "%s: no method meets its share of tolerance_rad, %.3g; the best bound is %.3g rad. A finer mesh, "
        "normals of more digits, or an exact shape would",
        name.c_str(), tolerance, bound);
    return text;
}

std::string no_surface(std::string const& name) {
    return name + ": the curved surface through its triangles and normals loses light, as that of a rough "
                  "scan does; it is "
                  "traced by its triangles. trace.method chooses otherwise";
}

} // namespace

MethodChoice choose_methods(Scene& scene, WavelengthTable const& optics, Emission const& emission,
                            TraceOptions const& options) {
    MethodChoice choice;
    for (Body const& body : scene.bodies)
        choice.bodies.push_back({body.method, std::nullopt, 0.0, 0.0});
    std::vector<bool> const curved = curved_bodies(scene);
    auto const groups = judged_together(scene, curved);
    if (groups.empty() || emission.rays() == 0)
        return choice;
    MethodPilots judge(scene, optics, emission, options, curved);
    std::vector<bool> const free = free_to_decimate(scene);
    double const share = options.tolerance / static_cast<double>(groups.size()); // errors add up
    std::vector<std::optional<FewerTriangles>> fewer(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        auto const& group = groups[g];
        MethodLevels const found = judge.levels(group);
        std::string const& name = scene.bodies[group.front()].name;
        if (found.loses_light) { // its own method stays
            choice.warnings.push_back(no_surface(name));
            continue;
        }
        ChosenLevel chosen = chosen_level(found.levels, share);
        if ((fewer[g] = asked_for(scene, group, free))) {
            auto const levels = judge.levels_with(group, fewer[g]->meshes, found);
            if (!levels.empty())
                chosen = chosen_level(levels, share);
            else // they lose light
                fewer[g].reset();
        } else if (options.decimate && chosen.within) {
            if (auto made = fewest(judge, scene, group, free, found, chosen.level, share)) {
                chosen.level = made->level;
                fewer[g] = std::move(made->to);
            }
        }
        MethodLevel const& best = chosen.level;
        if (!chosen.within)
            choice.warnings.push_back(none_admissible(name, share, best.bound));
        for (std::size_t const body : group)
            choice.bodies[body] = {best.method, best.bound, best.changed, found.reference_bound};
    }
    for (std::size_t g = 0; g < groups.size(); ++g)
        if (fewer[g]) {
            ObjectChoice const& chosen = choice.bodies[groups[g].front()];
            put(scene, groups[g], *fewer[g], *chosen.bound - chosen.reference_bound, chosen.sequence_changed);
        }
    for (auto const& group : groups)
        for (std::size_t const body : group) {
            judge.methods()[body] = body_method(choice.bodies[body].method);
            scene.bodies[body].method = choice.bodies[body].method;
        }
    scene.bvh = judge.met();
    return choice;
}

MethodChoice settle_methods(Scene& scene, WavelengthTable const& optics, Emission const& emission,
                            TraceOptions const& options) {
    MethodChoice choice;
    if (options.method == Method::automatic)
        choice = choose_methods(scene, optics, emission, options);
    else
        choice.warnings = normal_warnings(scene);
    for (std::string& warning : decimate_by_name(scene, optics, emission, options))
        choice.warnings.push_back(std::move(warning));
    return choice;
}

} // namespace sahl
