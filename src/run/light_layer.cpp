#include "run/light_layer.h"

#include "math/input_error.h"
#include "optics/colour.h"
#include "render/spectral.h"
#include "scene/read_experiment.h"
#include "scene/read_table.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace sahl {

namespace {

constexpr std::uint64_t batches_together = 64; // their hits wait for one another: some 20 MB

DetectorSpec const& detector_called(Experiment const& experiment, Caustics const& caustics) {
    std::vector<std::string> names;
    for (DetectorSpec const& detector : experiment.detectors) {
        if (detector.name == caustics.detector && detector.kind == DetectorKind::rectangle)
            return detector;
        if (detector.kind == DetectorKind::rectangle)
            names.push_back(detector.name);
    }
    throw InputError(caustics.place.text(), "there is no rectangular detector \"" + caustics.detector + "\"",
                     names.empty() ? "add a [[detector]] with size_mm that lies on the paint"
                                   : did_you_mean(caustics.detector, names));
}

/// It lies on its paint within what numbers in a file can say, and so does half of it behind the paint: it is
/// taken a little before it. That is half of what the layer is seen within.
DetectorSpec lifted(DetectorSpec detector) {
    double const lift = 0.5 * on_rectangle * std::max(detector.size.x, detector.size.y);
    detector.to_world.offset += lift * detector.to_world.linear[2];
    return detector;
}

constexpr int looks_a_side = 9;

/// Is there paint behind any of a grid of places on it?
bool lies_on_paint(Scene const& scene, DetectorSpec const& raised) {
    dvec3 const down = -raised.to_world.linear[2];
    double const size = std::max(raised.size.x, raised.size.y), behind_itself = 0.01 * on_rectangle * size;
    for (int i = 0; i < looks_a_side * looks_a_side; ++i) {
        int const row = i / looks_a_side, column = i % looks_a_side;
        dvec2 const share((column + 0.5) / looks_a_side - 0.5, (row + 0.5) / looks_a_side - 0.5);
        dvec3 const from = raised.to_world.point(dvec3(share * raised.size, -behind_itself));
        Bvh::Start const start = scene.bvh->start_at(from, down);
        Interface found;
        if (next_interface(scene, from, down, start.inside, body_at(scene, start.inside), start.on, found) !=
                Meeting::interface ||
            found.t > 1.5 * on_rectangle * size || !found.surface)
            continue;
        auto const& kind = scene.surfaces[found.surface->value].kind;
        if (std::holds_alternative<Paint>(kind) || std::holds_alternative<Diffuse>(kind))
            return true;
    }
    return false;
}

/// What a watt of all sources looks like, of a luminance of 1.
double luminance_of_a_watt(Emission const& emission, Scene const& scene) {
    double sum = 0.0;
    for (SourceSpec const& source : scene.sources) {
        double weights = 0.0, luminance = 0.0;
        for (auto const& [wavelength, weight] : source.wavelengths) {
            weights += weight;
            luminance += weight * colour_matching(wavelength).y;
        }
        sum += source.power * luminance / weights;
    }
    return sum / emission.power();
}

} // namespace

std::optional<LightMap> light_layer(Experiment const& experiment, ModelCache* models, unsigned threads,
                                    Progress const& progress, std::atomic<bool> const& stop) {
    auto const& caustics = experiment.picture->options.caustics;
    if (!caustics)
        return std::nullopt;
    DetectorSpec const detector = detector_called(experiment, *caustics);
    need_sources(experiment);
    Experiment lit = experiment;
    lit.detectors = {lifted(detector)};
    Scene const scene = build_scene(lit, models);
    if (!lies_on_paint(scene, lit.detectors.front()))
        throw InputError(caustics->place.text(),
                         "there is no paint where detector \"" + detector.name +
                             "\" lies: nothing would show its light",
                         "put at_mm on a painted surface and make it face away from that");
    PathFilters const filters = path_filters(scene, {});
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, experiment.trace.seed);
    TraceContext context{scene, optics, emission, experiment.trace, power_unit(emission)};
    context.filters = filters.at_detectors ? &filters : nullptr;

    double const pixel_area = detector.size.x * detector.size.y / detector.columns / detector.rows;
    double const unit = caustics->white * pixel_area * luminance_of_a_watt(emission, scene); // W, weighed
    if (!(unit > 0.0))
        throw InputError(caustics->place.text(), "the eye does not see the light of these sources",
                         "give them wavelengths between 380 and 780 nm");
    std::vector<dvec3> colours;
    for (double const wavelength : optics.wavelengths())
        colours.push_back(linear_srgb(colour_matching(wavelength)) / unit);
    LightMap map(detector.to_world, detector.size, detector.columns, detector.rows);
    std::uint64_t const batches = (emission.rays() + rays_per_batch - 1) / rays_per_batch;
    tbb::task_arena arena(threads ? static_cast<int>(threads) : tbb::task_arena::automatic);
    std::vector<std::vector<DetectorHit>> hits;
    for (std::uint64_t begin = 0; begin < batches && !stop; begin += batches_together) {
        std::uint64_t const count = std::min(batches_together, batches - begin);
        hits.assign(count, {});
        arena.execute([&] {
            tbb::parallel_for(std::uint64_t{0}, count, [&](std::uint64_t i) {
                std::uint64_t const first = (begin + i) * rays_per_batch;
                hits[i] = trace_batch(context, first, std::min(rays_per_batch, emission.rays() - first)).hits;
            });
        });
        for (auto const& batch : hits)
            for (DetectorHit const& hit : batch)
                map.add(hit.at, hit.power * colours[hit.wavelength.value]);
        if (progress)
            progress(begin + count, batches);
    }
    return map;
}

} // namespace sahl
