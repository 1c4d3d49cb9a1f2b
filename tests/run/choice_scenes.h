// In: bodies as exact shapes and as meshes that stand for them. Out: scenes of the one and of the other, and
// how often rays err by more than a bound.
#pragma once

#include "math/random.h"
#include "run/method_choice.h"
#include "support/curved.h"
#include "support/lab.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace sahl::bench {

constexpr double ball_radius = 5e-3;

/// A body as a shape in its place, and as a mesh that stands for it.
struct Pair {
    std::string name;
    Shape shape;
    Affine place;
    std::shared_ptr<Mesh const> mesh; // in the world's frame
    double index = 1.5;
};

inline TriangleSoup jittered(std::uint32_t frequency, double share) {
    TriangleSoup soup = geodesic_soup(1.0, frequency);
    std::map<std::array<double, 3>, std::uint64_t> number; // vertices are there once a face
    for (dvec3& p : soup.positions) {
        auto const key = as_float(p);
        auto const [at, is_new] = number.try_emplace({key.x, key.y, key.z}, number.size());
        auto const draw = [&](std::uint32_t k) {
            return share / frequency * (uniform(5, at->second, 0, k) - 0.5);
        };
        p = normalize(key + dvec3(draw(0), draw(1), draw(2)));
    }
    return soup;
}

inline dmat3 turned(double a, double b) {
    dmat3 const z(std::cos(a), std::sin(a), 0.0, -std::sin(a), std::cos(a), 0.0, 0.0, 0.0, 1.0);
    dmat3 const x(1.0, 0.0, 0.0, 0.0, std::cos(b), std::sin(b), 0.0, -std::sin(b), std::cos(b));
    return z * x;
}

/// A triaxial ellipsoid, turned, of irregular triangles.
/// exact_normals   those of the ellipsoid; else those of the triangles, averaged by area, as many programs
/// write them
inline Pair ellipsoid(std::uint32_t frequency, bool exact_normals, double jitter,
                      dvec3 const& axes = {5e-3, 4e-3, 6e-3}, dmat3 const& turn = turned(0.7, 0.4),
                      double index = 1.5) {
    dmat3 const map = turn * dmat3(axes.x, 0, 0, 0, axes.y, 0, 0, 0, axes.z);
    TriangleSoup soup = jittered(frequency, jitter);
    for (dvec3& p : soup.positions)
        p = map * p;
    dmat3 const back = glm::transpose(glm::inverse(map)), to_unit = glm::inverse(map);
    auto mesh = float_mesh(soup, [&](dvec3 const& p) { return normalize(back * (to_unit * p)); });
    if (!exact_normals) {
        TriangleSoup averaged = mesh->soup;
        averaged.normals.assign(averaged.positions.size(), dvec3(0.0));
        std::map<std::array<double, 3>, dvec3> sums;
        auto const key = [&](std::uint32_t i) {
            dvec3 const& p = averaged.positions[i];
            return std::array<double, 3>{p.x, p.y, p.z};
        };
        for (auto const& [a, b, c] : averaged.triangles)
            for (std::uint32_t const i : {a, b, c})
                sums[key(i)] += cross(averaged.positions[b] - averaged.positions[a],
                                      averaged.positions[c] - averaged.positions[a]);
        for (std::uint32_t i = 0; i < averaged.positions.size(); ++i)
            averaged.normals[i] = normalize(as_float(normalize(sums[key(i)])));
        mesh = std::make_shared<Mesh const>(make_mesh(averaged));
    }
    return {"ellipsoid " + std::to_string(frequency) + (exact_normals ? "" : ", normals by area"),
            Sphere{1.0}, Affine{map, dvec3(0.0)}, mesh, index};
}

inline Pair ball(std::uint32_t frequency, dvec3 const& at = dvec3(0.0), double index = 1.5) {
    TriangleSoup soup = geodesic_soup(ball_radius, frequency);
    for (dvec3& p : soup.positions)
        p += at;
    return {"ball " + std::to_string(frequency), Sphere{ball_radius}, moved(at),
            float_mesh(soup, [&](dvec3 const& p) { return normalize(p - at); }), index};
}

struct Case {
    std::string name;
    std::vector<Pair> bodies;
    double beam; // m
    double slant = 0.0;
};

inline Lab lab_of(Case const& c) {
    Lab lab;
    lab.experiment.trace.min_power = 1e-3;
    Beam beam{};
    beam.toward = normalize(dvec3(c.slant, 0.5 * c.slant, 1.0));
    beam.from = dvec3(1e-4, 2e-4, 0.0) - 0.02 * beam.toward;
    beam.up = {0.0, 1.0, 0.0};
    beam.radius = c.beam;
    beam.pattern = Pattern::hexagonal;
    beam.rays = 1500;
    lab.source(beam);
    return lab;
}

inline Scene exact_scene(Case const& c) {
    Lab lab = lab_of(c);
    int number = 0;
    for (Pair const& pair : c.bodies)
        lab.body("body" + std::to_string(number++), pair.shape, lab.medium(pair.index), pair.place);
    return build_scene(lab.experiment);
}

inline Scene mesh_scene(Case const& c) {
    Lab lab = lab_of(c);
    std::vector<MeshSpec> specs;
    int number = 0;
    for (Pair const& pair : c.bodies)
        specs.push_back({"body" + std::to_string(number++), pair.mesh, lab.medium(pair.index), {}, 0});
    return with_meshes(build_scene(lab.experiment), specs);
}

inline double share_above(PathErrors const& errors, double bound) {
    std::size_t same = 0, above = 0;
    for (double const off : errors.by_ray)
        if (off >= 0.0) {
            ++same;
            above += off > bound;
        }
    return same ? static_cast<double>(above) / static_cast<double>(same) : 0.0;
}

/// Of many scenes, each with eight tolerances: what `auto` chose, against the truth.
struct Verdict {
    std::size_t choices = 0, violations = 0; // of the bound: more than one in a thousand rays err by more
    std::size_t admissible = 0, found = 0;   // some method errs a tenth of the tolerance; one was found
    std::size_t possible = 0, cheapest = 0;  // some method truly is within; the fastest of these was chosen
    std::vector<double> ratios;              // bound over the greatest true error
    std::string table;

    double median_ratio() const {
        std::vector<double> sorted = ratios;
        std::sort(sorted.begin(), sorted.end());
        return sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
    }
    std::string text() const {
        std::ostringstream words;
        words << table << choices << " choices, " << violations << " violations; a level found in " << found
              << " of " << admissible
              << " where one is ten times better than asked; the fastest that is truly "
              << "within chosen in " << cheapest << " of " << possible << "; median bound / true error "
              << median_ratio();
        return words.str();
    }
};

inline Verdict judged(std::vector<Case> const& list) {
    constexpr std::array ladder{Method::recognised, Method::facet, Method::interpolated, Method::quadratic,
                                Method::fitted}; // from fast to slow
    Verdict verdict;
    std::ostringstream table;
    for (Case const& c : list) {
        Scene const exact = exact_scene(c);
        WavelengthTable const optics(exact);
        Emission const emission(exact.sources, optics, 1);
        TraceOptions options = lab_of(c).experiment.trace;
        std::vector<std::uint64_t> const unseen = spread_rays(emission, 1200, 0.77);
        Trees const truth = trees_of(exact, optics, emission, options, unseen);
        Scene scene = mesh_scene(c);
        auto const errors_now = [&] {
            return compare_paths(trees_of(scene, optics, emission, options, unseen), truth, false);
        };
        std::map<Method, double> greatest; // of every method that exists, all bodies by the same
        double best = INFINITY;
        for (Method const method : ladder) {
            scene.bvh = bvh_with(scene, std::vector<BodyMethod>(scene.bodies.size(), body_method(method)));
            bool exists = true;
            for (std::uint32_t i = 0; method == Method::recognised && i < scene.bodies.size(); ++i)
                exists = exists && scene.bvh->curving(i) == Curving::recognised;
            if (exists)
                best = std::min(best, greatest[method] = errors_now().greatest);
        }
        table << c.name << " " << c.bodies.front().name << ": best " << best;
        for (int decade = 2; decade <= 9; ++decade) {
            options.tolerance = std::pow(10.0, -decade) * (decade == 9 ? 3.0 : 1.0);
            MethodChoice const choice = choose_methods(scene, optics, emission, options);
            double bound = 0.0;
            for (ObjectChoice const& object : choice.bodies)
                bound += object.bound.value_or(0.0);
            PathErrors const errors = errors_now();
            ++verdict.choices;
            // nothing is promised where no bound is stated, but then it counts as not found
            bool const stated = std::all_of(choice.bodies.begin(), choice.bodies.end(),
                                            [](auto const& object) { return object.bound.has_value(); });
            bool const wrong = stated && share_above(errors, bound) > 1e-3;
            verdict.violations += wrong;
            if (stated && errors.greatest > 1e-12)
                verdict.ratios.push_back(bound / errors.greatest);
            if (10.0 * best <= options.tolerance) {
                ++verdict.admissible;
                verdict.found += choice.warnings.empty();
                if (!choice.warnings.empty())
                    table << "; NOT FOUND at " << options.tolerance << ", bound " << bound;
            }
            auto const fastest = std::find_if(ladder.begin(), ladder.end(), [&](Method method) {
                return greatest.count(method) && greatest[method] <= options.tolerance;
            });
            if (c.bodies.size() == 1 && fastest != ladder.end()) {
                ++verdict.possible;
                verdict.cheapest += choice.bodies.front().method == *fastest;
            }
            if (decade == 2 || decade == 6 || decade == 8 || wrong)
                table << "; " << options.tolerance << ": " << name_of(choice.bodies.front().method)
                      << ", bound " << bound << ", true " << errors.greatest << (wrong ? " VIOLATED" : "");
        }
        table << "\n";
    }
    verdict.table = table.str();
    return verdict;
}

} // namespace sahl::bench
