#include "run/method_chart.h"

#include "math/input_error.h"
#include "run/method_levels.h"
#include "run/path_errors.h"
#include "run/values.h"
#include "scene/scene_methods.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>

namespace sahl {

namespace {

constexpr std::uint64_t rays_compared = 2000; // of each source
constexpr std::uint64_t rays_timed = 20000;   // in all
constexpr int rounds = 7;

double cpu_seconds() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// One way to meet the scene's meshes.
struct Way {
    MethodFigures figures;
    std::unique_ptr<Bvh const> bvh;
    Trees trees;
    std::vector<double> seconds;
};

std::vector<Way> ways_of(Scene const& scene) {
    constexpr std::array<std::pair<Method, char const*>, 5> all{{{Method::facet, "facet"},
                                                                 {Method::interpolated, "interpolated"},
                                                                 {Method::quadratic, "quadratic"},
                                                                 {Method::fitted, "fitted"},
                                                                 {Method::recognised, "recognised"}}};
    std::vector<Way> ways;
    std::vector<bool> const curvable = curvable_meshes(scene);
    bool const normals = std::any_of(scene.bodies.begin(), scene.bodies.end(), [](Body const& body) {
        return body.mesh && !body.mesh->soup.normals.empty();
    });
    for (auto const& [method, name] : all) {
        if (method == Method::interpolated && !normals)
            continue;
        std::vector<BodyMethod> methods(scene.bodies.size());
        for (std::size_t i = 0; i < scene.bodies.size(); ++i)
            if (Body const& body = scene.bodies[i]; body.mesh)
                methods[i] = curvable[i] ? body_method(method) : body_method(body.method);
        auto bvh = bvh_with(scene, methods);
        bool recognised = false;
        for (std::uint32_t i = 0; i < scene.bodies.size(); ++i)
            recognised = recognised || bvh->curving(i) == Curving::recognised;
        if (method == Method::recognised && !recognised)
            continue;
        Way& way = ways.emplace_back();
        way.figures.method = name;
        way.bvh = std::move(bvh);
    }
    return ways;
}

/// The experiment of exact shapes that errors are held against.
struct ExactSide {
    Experiment experiment;
    Scene scene;
    WavelengthTable optics;
    Emission emission;
    Trees trees{};

    explicit ExactSide(ExperimentSource const& source)
        : experiment(read_experiment(source.tree, source.file)), scene(build_scene(experiment)),
          optics(scene), emission(scene.sources, optics, experiment.trace.seed) {}
};

void find_front(std::vector<MethodFigures>& methods) {
    for (MethodFigures& one : methods)
        one.front = std::none_of(methods.begin(), methods.end(), [&](MethodFigures const& other) {
            bool const no_worse = other.ns_per_segment <= one.ns_per_segment && other.rms <= one.rms;
            return no_worse && (other.ns_per_segment < one.ns_per_segment || other.rms < one.rms);
        });
}

} // namespace

MethodChart method_chart(ExperimentSource const& source, std::optional<ExperimentSource> const& exact) {
    Experiment const experiment = read_experiment(source.tree, source.file);
    Scene scene = build_scene(experiment);
    std::vector<bool> const curvable = curvable_meshes(scene);
    if (std::find(curvable.begin(), curvable.end(), true) == curvable.end())
        throw InputError(source.file.string(),
                         "has no object that is a closed mesh or a mirror of its own: there is nothing to "
                         "choose between",
                         "chart an experiment with a model that is closed, or open with a surface");
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, experiment.trace.seed);
    std::vector<std::uint64_t> const rays = spread_rays(emission, rays_compared, 0.5);
    std::vector<Way> ways = ways_of(scene);
    TraceOptions const& options = experiment.trace;
    auto const swapped = [&](Way& way, auto const& use) {
        std::swap(scene.bvh, way.bvh);
        use();
        std::swap(scene.bvh, way.bvh);
    };
    for (Way& way : ways)
        swapped(way, [&] { way.trees = trees_of(scene, optics, emission, options, rays); });

    MethodChart chart;
    chart.title = experiment.title;
    chart.rays = rays.size();
    if (auto kept = keeps_all_triangles(experiment))
        chart.warnings.push_back(std::move(*kept));
    std::optional<ExactSide> truth;
    if (exact) {
        truth.emplace(*exact);
        if (truth->emission.rays() != emission.rays())
            throw InputError(exact->file.string(), "has other rays than " + source.file.string(),
                             "give it the same sources");
        truth->trees = trees_of(truth->scene, truth->optics, truth->emission, options, rays);
        chart.reference = "the exact shapes of " + exact->file.filename().string();
    } else {
        chart.reference = ways.back().figures.method;
        ways.back().figures.reference = true;
    }
    Trees const& reference = truth ? truth->trees : ways.back().trees;
    for (Way& way : ways) {
        PathErrors const errors = compare_paths(way.trees, reference, !truth);
        way.figures.rms = errors.rms;
        way.figures.leaving = errors.leaving;
        way.figures.greatest = errors.greatest;
        way.figures.changed = errors.changed_share();
    }
    SumUnit const unit = power_unit(emission);
    TraceContext const context{scene, optics, emission, options, unit, 0};
    std::uint64_t const timed = std::min(rays_timed, emission.rays());
    auto const time = [&](Way& way, TraceContext const& of) {
        double const start = cpu_seconds();
        way.figures.segments = trace_batch(of, 0, timed).tally.segments();
        way.seconds.push_back(cpu_seconds() - start);
    };
    Way by_shapes;
    for (int round = 0; round < rounds; ++round) {
        for (Way& way : ways)
            swapped(way, [&] { time(way, context); });
        if (truth)
            time(by_shapes, {truth->scene, truth->optics, truth->emission, options, unit, 0});
    }
    if (truth) {
        by_shapes.figures.method = "exact";
        by_shapes.figures.reference = true;
        ways.push_back(std::move(by_shapes));
    }
    for (Way& way : ways) {
        std::sort(way.seconds.begin(), way.seconds.end());
        way.figures.ns_per_segment =
            way.seconds[way.seconds.size() / 2] / static_cast<double>(way.figures.segments) * 1e9;
        chart.methods.push_back(way.figures);
    }
    find_front(chart.methods);
    return chart;
}

std::string chart_csv(MethodChart const& chart) {
    std::string csv =
        "method,ns_per_segment,segments,rms_rad,leaving_rms_rad,max_rad,sequence_changed,reference,front\n";
    for (MethodFigures const& m : chart.methods) {
        char line[300];
        std::snprintf(line, sizeof line, "%s,%.6g,%llu,%.6g,%.6g,%.6g,%.6g,%d,%d\n", m.method.c_str(),
                      m.ns_per_segment, static_cast<unsigned long long>(m.segments), m.rms, m.leaving,
                      m.greatest, m.changed, m.reference, m.front);
        csv += line;
    }
    return csv;
}

Value chart_value(MethodChart const& chart) {
    Array methods;
    for (MethodFigures const& m : chart.methods)
        methods.push_back(of(Table{{"method", of(m.method)},
                                   {"ns_per_segment", of(m.ns_per_segment)},
                                   {"segments", of(m.segments)},
                                   {"rms_rad", of(m.rms)},
                                   {"leaving_rms_rad", of(m.leaving)},
                                   {"max_rad", of(m.greatest)},
                                   {"sequence_changed", of(m.changed)},
                                   {"reference", of(m.reference)},
                                   {"front", of(m.front)}}));
    return of(Table{{"title", of(chart.title)},
                    {"held_against", of(chart.reference)},
                    {"rays", of(chart.rays)},
                    {"methods", of(std::move(methods))}});
}

} // namespace sahl
