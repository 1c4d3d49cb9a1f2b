#include "run/method_levels.h"

#include "geometry/data_steps.h"
#include "geometry/pilot_curving.h"
#include "math/joined_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace sahl {

namespace {

constexpr std::uint64_t pilots = 256; // of each source
constexpr double margin = 2.0;        // for what 256 rays do not see of the worst
// two ways to fit the same data share some of their error, and over all of a coarse mesh they err alike
constexpr double margin_of_finest = 3.5, margin_of_coarse = 7.0;
constexpr std::size_t coarse = 1000; // triangles
// if a single number errs, and all ways to halve by chance tell it too small: once in five hundred scenes
constexpr double margin_of_halves = 1.8;
constexpr double rounding = 1e-12; // rad: of directions in double, with all that a path may make of it

constexpr std::size_t most_apart = 6; // groups that are judged one by one

/// After recognised, which is faster than any; the order is from fast to slow, as measured.
constexpr std::array by_triangle{Method::facet, Method::interpolated, Method::quadratic, Method::fitted};

bool loses_light(Trees const& trees) {
    return std::any_of(trees.begin(), trees.end(), [](auto const& tree) {
        return std::any_of(tree.begin(), tree.end(), [](Segment const& segment) {
            return segment.ended == Event::leak || segment.ended == Event::invalid;
        });
    });
}

} // namespace

std::vector<bool> curvable_meshes(Scene const& scene) {
    std::vector<bool> curvable;
    for (Body const& body : scene.bodies)
        curvable.push_back(body.mesh && (body.open || body.mesh->closed()));
    for (auto const& [one, other] : scene.bvh->contacts())
        for (FaceId const face : {one, other})
            if (std::uint32_t const body = scene.faces[face.value].body.value; scene.bodies[body].open)
                curvable[body] = false;
    return curvable;
}

MethodPilots::MethodPilots(Scene& scene, WavelengthTable const& optics, Emission const& emission,
                           TraceOptions const& options, std::vector<bool> curved)
    : scene_(scene), optics_(optics), emission_(emission), options_(options),
      rays_(spread_rays(emission, pilots, 0.25)), base_(scene.bodies.size()), curved_(std::move(curved)) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (scene.bodies[i].mesh)
            base_[i] = body_method(curved_[i] ? Method::fitted : scene.bodies[i].method);
}

/// The pilots' trees with these bodies met by one method; nothing where it does not exist.
std::optional<Trees> MethodPilots::trees(std::vector<std::size_t> const& bodies, BodyMethod method) {
    std::vector<BodyMethod> methods = base_;
    for (std::size_t const body : bodies)
        methods[body] = method;
    scene_.bvh = bvh_with(scene_, methods, &store_);
    if (is_recognition(method.curving))
        for (std::size_t const body : bodies)
            if (scene_.bvh->curving(static_cast<std::uint32_t>(body)) == Curving::fitted)
                return std::nullopt;
    return trees_of(scene_, optics_, emission_, options_, rays_);
}

MethodLevels MethodPilots::levels(std::vector<std::size_t> const& bodies) {
    MethodLevels found;
    Trees fitted = *trees(bodies, {false, Curving::fitted});
    std::optional<Trees> whole = trees(bodies, {false, Curving::recognised});
    if (whole && loses_light(*whole))
        whole.reset();
    bool const fits = !loses_light(fitted);
    found.loses_light = !fits && !whole;
    if (found.loses_light)
        return found;
    Trees* reference = nullptr;
    double reference_bound = INFINITY, of_fitted = INFINITY;
    PathErrors apart;
    if (fits) {
        apart = compare_paths(fitted, *trees(bodies, {false, fitted_apart}), true);
        bool const is_coarse = std::any_of(bodies.begin(), bodies.end(), [&](std::size_t body) {
            return scene_.bodies[body].mesh->soup.triangles.size() < coarse;
        });
        of_fitted = reference_bound =
            std::max(margin_of_finest * apart.tail(), is_coarse ? margin_of_coarse * apart.greatest : 0.0) +
            rounding;
        reference = &fitted;
    }
    if (whole) {
        // two solids from half of the vertices each differ by about twice what one from all of them is off;
        // by chance less: so of all ways to halve, the one that tells most
        std::optional<PathErrors> halves;
        for (unsigned way = 0; way < ways_to_halve; ++way) {
            auto const half = trees(bodies, {false, recognised_by({way, false})}),
                       rest = trees(bodies, {false, recognised_by({way, true})});
            if (!half || !rest) {
                halves.reset();
                break;
            }
            PathErrors const apart_by = compare_paths(*half, *rest, true);
            if (!halves || halves->tail() < apart_by.tail())
                halves = apart_by;
        }
        if (halves) {
            double bound = margin_of_halves * halves->tail() + rounding, changed = 0.0;
            if (fits) {
                PathErrors const from_fitted = compare_paths(*whole, fitted, true);
                changed = from_fitted.changed_share();
                // a surface that is nearly what it is held to be misleads all halves alike
                if (of_fitted < bound)
                    bound = std::max(bound, from_fitted.tail() + of_fitted);
                // and which of two surfaces that both go through all places is right, pilots cannot tell
                of_fitted = reference_bound = std::max(of_fitted, margin * from_fitted.tail());
            }
            found.levels.push_back({Method::recognised, bound, 0.5 * halves->rms, changed});
            if (bound < of_fitted) {
                reference = &*whole;
                reference_bound = bound;
            }
        }
    }
    found.loses_light = reference == nullptr;
    bool const with_normals = std::all_of(bodies.begin(), bodies.end(), [&](std::size_t body) {
        return !scene_.bodies[body].mesh->soup.normals.empty();
    });
    for (Method const method : by_triangle) {
        if (found.loses_light || (method == Method::interpolated && !with_normals))
            continue;
        bool const finest = method == Method::fitted && reference == &fitted;
        auto const met =
            method == Method::fitted ? std::optional(fitted) : trees(bodies, body_method(method));
        if (loses_light(*met))
            continue;
        PathErrors const errors = finest ? apart : compare_paths(*met, *reference, true);
        found.levels.push_back({method, finest ? of_fitted : margin * errors.tail() + reference_bound,
                                errors.rms,
                                method == Method::fitted ? apart.changed_share() : errors.changed_share()});
    }
    if (reference)
        found.reference = std::move(*reference);
    found.reference_bound = reference_bound;
    return found;
}

void MethodPilots::swap_meshes(std::vector<std::size_t> const& bodies,
                               std::vector<std::shared_ptr<Mesh const>>& meshes) {
    for (std::size_t i = 0; i < bodies.size(); ++i)
        std::swap(scene_.bodies[bodies[i]].mesh, meshes[i]);
}

std::vector<MethodLevel> MethodPilots::levels_with(std::vector<std::size_t> const& bodies,
                                                   std::vector<std::shared_ptr<Mesh const>> const& meshes,
                                                   MethodLevels const& found) {
    std::vector<std::shared_ptr<Mesh const>> others = meshes;
    swap_meshes(bodies, others);
    std::vector<MethodLevel> levels;
    auto const add = [&](Method method) {
        auto const met = trees(bodies, body_method(method));
        if (!met || loses_light(*met))
            return;
        PathErrors const errors = compare_paths(*met, found.reference, true);
        levels.push_back(
            {method, margin * errors.tail() + found.reference_bound, errors.rms, errors.changed_share()});
    };
    add(Method::recognised);
    for (Method const method : by_triangle)
        add(method);
    swap_meshes(bodies, others);
    for (auto const& mesh : meshes) // they are but tried
        store_.forget(mesh.get());
    return levels;
}

PathErrors MethodPilots::moved_by(std::vector<std::size_t> const& bodies,
                                  std::vector<std::shared_ptr<Mesh const>> const& meshes) {
    std::vector<BodyMethod> methods;
    for (Body const& body : scene_.bodies)
        methods.push_back(body_method(body.method));
    auto const trees_now = [&] {
        scene_.bvh = bvh_with(scene_, methods);
        return trees_of(scene_, optics_, emission_, options_, rays_);
    };
    Trees const before = trees_now();
    std::vector<std::shared_ptr<Mesh const>> others = meshes;
    swap_meshes(bodies, others);
    PathErrors errors = compare_paths(trees_now(), before, true);
    swap_meshes(bodies, others);
    return errors;
}

double MethodPilots::floor_of(std::vector<std::size_t> const& bodies) {
    BodyMethod const fitted{false, Curving::fitted};
    Trees const given = *trees(bodies, fitted);
    std::vector<std::shared_ptr<Mesh const>> kept;
    for (std::size_t const body : bodies) {
        kept.push_back(scene_.bodies[body].mesh);
        scene_.bodies[body].mesh = std::make_shared<Mesh const>(shaken(*kept.back()));
    }
    Trees const moved = *trees(bodies, fitted);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        store_.forget(scene_.bodies[bodies[i]].mesh.get());
        scene_.bodies[bodies[i]].mesh = kept[i];
    }
    return compare_paths(given, moved, true).rms / shaken_by;
}

std::vector<std::vector<std::size_t>> judged_together(Scene const& scene, std::vector<bool> const& curved) {
    JoinedSets sets(scene.bodies.size());
    for (auto const& [one, other] : scene.bvh->contacts())
        sets.join(scene.faces[one.value].body.value, scene.faces[other.value].body.value);
    std::map<std::uint32_t, std::vector<std::size_t>> joined;
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < curved.size(); ++i)
        if (curved[i]) {
            joined[sets.find(static_cast<std::uint32_t>(i))].push_back(i);
            all.push_back(i);
        }
    if (joined.size() > most_apart)
        return {all};
    std::vector<std::vector<std::size_t>> groups;
    for (auto& [root, group] : joined)
        groups.push_back(std::move(group));
    return groups;
}

ChosenLevel chosen_level(std::vector<MethodLevel> const& levels, double tolerance) {
    for (MethodLevel const& level : levels)
        if (level.bound <= tolerance)
            return {level, true};
    return {*std::min_element(levels.begin(), levels.end(),
                              [](auto const& a, auto const& b) { return a.bound < b.bound; }),
            false};
}

} // namespace sahl
