#include "run/method_choice.h"

#include "geometry/pilot_curving.h"
#include "geometry/smooth_fans.h"
#include "math/joined_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

namespace sahl {

namespace {

constexpr std::uint64_t pilots = 256;    // of each source
constexpr double margin = 2.0;           // for what 256 rays do not see of the worst
constexpr double margin_of_finest = 4.0; // two ways to fit the same data share some of their error
constexpr double rounding = 1e-12;       // rad: of directions in double, with all that a path may make of it
constexpr std::size_t most_apart = 6;    // objects that are judged one by one; of more all take one method

/// From fast to slow, as measured; a fixed order, so that a choice never depends on a clock.
constexpr std::array ladder{Method::recognised, Method::facet, Method::interpolated, Method::quadratic,
                            Method::fitted};

/// Only a file's normals say that its triangles stand for a curved surface: without them a brilliant is a
/// brilliant.
bool has_smooth_normals(std::shared_ptr<Mesh const> const& mesh) {
    if (mesh->soup.normals.empty())
        return false;
    NormalUse const use = smooth_fans(mesh).normals;
    return use == NormalUse::files || use == NormalUse::first_order;
}

class Judge {
  public:
    Judge(Scene& scene, WavelengthTable const& optics, Emission const& emission, TraceOptions const& options)
        : scene_(scene), optics_(optics), emission_(emission), options_(options),
          rays_(spread_rays(emission, pilots, 0.25)), base_(scene.bodies.size()) {
        for (Body const& body : scene.bodies)
            curved_.push_back(body.mesh && !body.open && body.mesh->closed() &&
                              has_smooth_normals(body.mesh));
        for (std::size_t i = 0; i < scene.bodies.size(); ++i)
            if (scene.bodies[i].mesh)
                base_[i] = body_method(curved(i) ? Method::fitted : scene.bodies[i].method);
    }

    bool curved(std::size_t body) const { return curved_[body]; }
    /// The pilots' trees with these bodies met by one method and the others fitted; nothing where it does not
    /// exist.
    std::optional<Trees> trees(std::vector<std::size_t> const& bodies, BodyMethod method) {
        std::vector<BodyMethod> methods = base_;
        for (std::size_t const body : bodies)
            methods[body] = method;
        scene_.bvh = bvh_with(scene_, methods);
        if (is_recognition(method.curving))
            for (std::size_t const body : bodies)
                if (scene_.bvh->curving(static_cast<std::uint32_t>(body)) == Curving::fitted)
                    return std::nullopt;
        return trees_of(scene_, optics_, emission_, options_, rays_);
    }
    std::vector<BodyMethod>& base() { return base_; }

    struct Level {
        Method method;
        double bound;
        double changed;
    };
    /// Bounds of every method that these bodies can be met by, in the ladder's order; none where the curved
    /// surface through the mesh's data loses light, as through a scan's noise.
    std::vector<Level> levels(std::vector<std::size_t> const& bodies);

  private:
    Scene& scene_;
    WavelengthTable const& optics_;
    Emission const& emission_;
    TraceOptions const& options_;
    std::vector<std::uint64_t> rays_;
    std::vector<BodyMethod> base_;
    std::vector<bool> curved_;
};

bool loses_light(Trees const& trees) {
    return std::any_of(trees.begin(), trees.end(), [](auto const& tree) {
        return std::any_of(tree.begin(), tree.end(), [](Segment const& segment) {
            return segment.ended == Event::leak || segment.ended == Event::invalid;
        });
    });
}

std::vector<Judge::Level> Judge::levels(std::vector<std::size_t> const& bodies) {
    std::vector<Level> found;
    Trees const fitted = *trees(bodies, {false, Curving::fitted});
    if (loses_light(fitted))
        return found;
    PathErrors const apart = compare_paths(fitted, *trees(bodies, {false, fitted_apart}), true);
    double const of_fitted = margin_of_finest * apart.tail() + rounding;
    // two solids from half of the vertices each differ by about twice what one from all of them is off
    auto const even = trees(bodies, {false, recognised_even}), odd = trees(bodies, {false, recognised_odd});
    auto const whole = trees(bodies, {false, Curving::recognised});
    double reference_bound = of_fitted;
    Trees const* reference = &fitted;
    if (even && odd && whole) {
        PathErrors const halves = compare_paths(*even, *odd, true);
        double const bound = margin_of_finest * halves.tail() + rounding;
        found.push_back({Method::recognised, bound, compare_paths(*whole, fitted, true).changed_share()});
        if (bound < of_fitted) {
            reference = &*whole;
            reference_bound = bound;
        }
    }
    bool with_normals = true;
    for (std::size_t const body : bodies)
        with_normals = with_normals && !scene_.bodies[body].mesh->soup.normals.empty();
    for (Method const method : ladder) {
        if (method == Method::recognised || (method == Method::interpolated && !with_normals))
            continue;
        PathErrors const errors = compare_paths(*trees(bodies, body_method(method)), *reference, true);
        double bound = margin * errors.tail() + reference_bound;
        if (method == Method::fitted && reference == &fitted)
            bound = of_fitted;
        found.push_back(
            {method, bound, method == Method::fitted ? apart.changed_share() : errors.changed_share()});
    }
    return found;
}

/// Bodies that touch have their boundary in common, and so its method.
std::vector<std::vector<std::size_t>> joined_by_contact(Scene const& scene,
                                                        std::vector<std::vector<std::size_t>> const& single) {
    JoinedSets sets(scene.bodies.size());
    for (auto const& [one, other] : scene.bvh->contacts())
        sets.join(scene.faces[one.value].body.value, scene.faces[other.value].body.value);
    std::map<std::uint32_t, std::vector<std::size_t>> joined;
    for (auto const& group : single)
        joined[sets.find(static_cast<std::uint32_t>(group.front()))].push_back(group.front());
    std::vector<std::vector<std::size_t>> groups;
    for (auto& [root, group] : joined)
        groups.push_back(std::move(group));
    return groups;
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
        choice.bodies.push_back({body.method, std::nullopt, 0.0});
    Judge judge(scene, optics, emission, options);
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (judge.curved(i))
            groups.push_back({i});
    if (groups.empty() || emission.rays() == 0)
        return choice;
    groups = joined_by_contact(scene, groups);
    if (groups.size() > most_apart) {
        std::vector<std::size_t> all;
        for (auto const& group : groups)
            all.insert(all.end(), group.begin(), group.end());
        groups = {all};
    }
    double const share = options.tolerance / static_cast<double>(groups.size()); // errors add up
    std::vector<Method> chosen;
    for (auto const& group : groups) {
        auto const levels = judge.levels(group);
        std::string const& name = scene.bodies[group.front()].name;
        if (levels.empty()) { // its own method stays
            choice.warnings.push_back(no_surface(name));
            continue;
        }
        auto best = std::find_if(levels.begin(), levels.end(),
                                 [&](auto const& level) { return level.bound <= share; });
        if (best == levels.end()) {
            best = std::min_element(levels.begin(), levels.end(),
                                    [](auto const& a, auto const& b) { return a.bound < b.bound; });
            choice.warnings.push_back(none_admissible(name, share, best->bound));
        }
        for (std::size_t const body : group)
            choice.bodies[body] = {best->method, best->bound, best->changed};
    }
    for (auto const& group : groups)
        for (std::size_t const body : group) {
            judge.base()[body] = body_method(choice.bodies[body].method);
            scene.bodies[body].method = choice.bodies[body].method;
        }
    scene.bvh = bvh_with(scene, judge.base());
    return choice;
}

} // namespace sahl
