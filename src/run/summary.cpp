#include "run/summary.h"

#include "optics/colour.h"
#include "run/health_report.h"
#include "run/values.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sahl {

namespace {

char const* name_of(BranchPolicy policy) {
    return policy == BranchPolicy::split      ? "split"
           : policy == BranchPolicy::roulette ? "roulette"
                                              : "dominant";
}

/// Ten digits, but where two wavelengths would then be called the same: a table must not have a key twice.
std::vector<std::string> wavelength_names(WavelengthTable const& optics) {
    auto const with_digits = [](double wavelength, int digits) {
        char text[32];
        std::snprintf(text, sizeof text, "%.*g", digits, wavelength * 1e9);
        return std::string(text);
    };
    std::vector<std::string> names, unique;
    for (double const wavelength : optics.wavelengths())
        names.push_back(with_digits(wavelength, 10));
    for (std::size_t i = 0; i < names.size(); ++i)
        unique.push_back(std::count(names.begin(), names.end(), names[i]) == 1
                             ? names[i]
                             : with_digits(optics.wavelengths()[i], 17));
    return unique;
}

Value figures(Moments const& moments, SumUnit unit, DetectorKind kind) {
    bool const placed = kind != DetectorKind::sphere;
    auto const spot = spot_of(moments, unit);
    Table table{{"power_W", of(moments.power.value(unit))}, {"hits", of(moments.hits)}};
    table.emplace_back("centroid_mm", spot && placed ? of(spot->centroid, 1e3) : nothing());
    table.emplace_back("rms_radius_mm", spot && placed ? of(spot->rms_radius * 1e3) : nothing());
    table.emplace_back("mean_direction", spot ? of(spot->mean_direction) : nothing());
    table.emplace_back("mean_optical_path_mm", spot ? of(spot->mean_optical_path * 1e3) : nothing());
    return of(std::move(table));
}

/// What a detector was asked to record beyond its sums.
void add_extras(Table& table, DetectorRecord const& record, WavelengthTable const& optics) {
    if (record.spec().spot) {
        std::vector<double> const radii = record.encircled();
        Table encircled;
        for (std::size_t const percent : {50, 80, 90, 95, 100})
            encircled.emplace_back(std::to_string(percent),
                                   radii.empty() ? nothing() : of(radii[percent - 1] * 1e3));
        table.emplace_back("encircled_mm", of(std::move(encircled)));
    }
    if (auto const& far = record.far_field()) {
        std::vector<double> const intensities = far->intensities();
        table.emplace_back(
            "far_field",
            of(Table{{"peak_W_per_sr", of(*std::max_element(intensities.begin(), intensities.end()))},
                     {"beyond_W", of(far->beyond())}}));
    }
    if (record.spec().spectrum) {
        dvec3 xyz(0.0);
        for (std::size_t i = 0; i < record.by_wavelength().size(); ++i)
            xyz += record.by_wavelength()[i].power.value(record.unit()) * lumens_per_watt *
                   colour_matching(optics.wavelengths()[i]);
        double const sum = xyz.x + xyz.y + xyz.z;
        table.emplace_back("colour", of(Table{{"XYZ_lm", of(xyz)},
                                              {"xy", sum > 0.0 ? of(dvec2(xyz.x, xyz.y) / sum) : nothing()},
                                              {"sRGB", of(srgb_of(xyz))}}));
    }
    if (record.spec().path_bins > 0) {
        Histogram const paths = record.optical_paths();
        bool const dark = paths.powers.empty();
        table.emplace_back("optical_path", of(Table{{"shortest_mm", dark ? nothing() : of(paths.from * 1e3)},
                                                    {"longest_mm", dark ? nothing() : of(paths.to * 1e3)},
                                                    {"rms_mm", dark ? nothing() : of(paths.rms * 1e3)}}));
    }
}

Value detector_figures(DetectorRecord const& record, Scene const& scene, WavelengthTable const& optics,
                       Tally const& tally) {
    SumUnit const unit = tally.unit;
    Value value = figures(record.all(), unit, record.spec().kind);
    Table& table = std::get<Table>(value.data);
    double const power = record.all().power.value(unit);
    double const sigma = record.sigma();
    DetectorSpec const& spec = record.spec();
    bool const once = spec.absorbs || spec.kind == DetectorKind::sphere; // no light comes twice
    Value const high = once ? of(power + tally.cut.value(unit) + tally.error.value(unit) + sigma)
                            : nothing(); // what goes on may come back: only the low end is certain
    table.emplace_back("power_bound_W", of(Array{of(std::max(0.0, power - sigma)), high}));
    table.emplace_back("sigma_W", of(sigma));
    table.emplace_back("peak_W_per_mm2",
                       spec.kind == DetectorKind::rectangle ? of(record.peak() * 1e-6) : nothing());
    add_extras(table, record, optics);
    Table by_wavelength, by_source;
    std::vector<std::string> const names = wavelength_names(optics);
    for (std::size_t i = 0; i < record.by_wavelength().size(); ++i)
        by_wavelength.emplace_back(names[i], figures(record.by_wavelength()[i], unit, spec.kind));
    for (std::size_t i = 0; i < record.by_source().size(); ++i)
        by_source.emplace_back(scene.sources[i].name, figures(record.by_source()[i], unit, spec.kind));
    table.emplace_back("by_wavelength", of(std::move(by_wavelength)));
    table.emplace_back("by_source", of(std::move(by_source)));
    return value;
}

Value absorbed(Scene const& scene, Tally const& tally) {
    Table table;
    std::vector<Table> faces_of_body(scene.bodies.size() + 1); // of the surroundings none
    for (std::size_t i = 0; i < scene.faces.size(); ++i)
        if (tally.absorbed_at_face[i] != ExactSum{})
            faces_of_body[scene.faces[i].body.value].emplace_back(
                scene.faces[i].name, of(tally.absorbed_at_face[i].value(tally.unit)));
    auto const entry = [&](std::string const& name, ExactSum const& bulk, std::size_t body) {
        Table& faces = faces_of_body[body];
        table.emplace_back(
            name, of(Table{{"bulk", of(bulk.value(tally.unit))}, {"surface", of(std::move(faces))}}));
    };
    for (std::size_t body = 0; body < scene.bodies.size(); ++body)
        entry(scene.bodies[body].name, tally.absorbed_in_body[body], body);
    if (tally.absorbed_in_body.back() != ExactSum{})
        entry("surroundings", tally.absorbed_in_body.back(), scene.bodies.size());
    return of(std::move(table));
}

Value escaped(WavelengthTable const& optics, Tally const& tally) {
    Table table;
    std::vector<std::string> const names = wavelength_names(optics);
    for (std::size_t i = 0; i < optics.wavelengths().size(); ++i) {
        auto const& sums = tally.escaped_by_wavelength[i];
        dvec3 const sum(sums[1].value(tally.unit), sums[2].value(tally.unit), sums[3].value(tally.unit));
        double const size = length(sum);
        table.emplace_back(names[i], size > 0.0 ? of(sum / size) : nothing());
    }
    return of(std::move(table));
}

/// An error bound belongs to a mesh; exact shapes are met to rounding.
Value objects(Scene const& scene, MethodChoice const& choice) {
    Table table;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        Body const& body = scene.bodies[i];
        if (body.detector)
            continue;
        ObjectChoice const chosen = i < choice.bodies.size() ? choice.bodies[i] : ObjectChoice{};
        Table entry{{"method", of(std::string(body.mesh ? name_of(body.method) : "exact"))},
                    {"error_bound_rad", !body.mesh     ? of(0.0)
                                        : chosen.bound ? of(*chosen.bound)
                                                       : nothing()}};
        if (chosen.bound)
            entry.emplace_back("sequence_changed", of(chosen.sequence_changed));
        if (body.decimated)
            entry.emplace_back("decimated", decimation_value(body));
        entry.emplace_back("medium", body.open ? nothing() : of(scene.media[body.medium.value].name));
        table.emplace_back(body.name, of(std::move(entry)));
    }
    return of(std::move(table));
}

Value lost_rays(TraceOutcome const& outcome) {
    Array array;
    for (LostRay const& ray : outcome.lost)
        array.push_back(of(Table{{"ray", of(ray.ray)},
                                 {"event", of(std::string(name_of(ray.event)))},
                                 {"at_mm", of(ray.at, 1e3)},
                                 {"power_W", of(ray.power)}}));
    return of(std::move(array));
}

/// What rounding left of the paths; null where it was not followed.
Value digits_lost(Experiment const& experiment, DigitsLost const& digits) {
    if (!experiment.trace.digits_lost)
        return nothing();
    Array segments;
    for (std::uint64_t const count : digits.segments)
        segments.push_back(of(count));
    bool const none = digits.most < 0.0;
    return of(Table{{"most", none ? nothing() : of(digits.most)},
                    {"ray", none ? nothing() : of(digits.ray)},
                    {"depth", none ? nothing() : of(std::uint64_t{digits.depth})},
                    {"from_mm", none ? nothing() : of(digits.at, 1e3)},
                    {"segments", of(std::move(segments))}});
}

/// Paths of which rounding left nothing are where they are by chance.
std::vector<std::string> warnings_of(Experiment const& experiment, Scene const& scene,
                                     TraceOutcome const& outcome) {
    std::vector<std::string> warnings = scene.warnings;
    std::uint64_t const lost = outcome.digits.segments[DigitsLost::none_left];
    if (experiment.trace.digits_lost && lost > 0)
        warnings.push_back(
            std::to_string(lost) + " of " + std::to_string(outcome.tally.segments()) +
            " segments had lost all 16 digits: where they went is right as a sample, not one by one");
    return warnings;
}

} // namespace

std::vector<std::string> failures_of(Experiment const& experiment, TraceOutcome const& outcome) {
    std::vector<std::string> failures;
    char text[200];
    Tally const& tally = outcome.tally;
    double const emitted = tally.emitted.value(tally.unit), remainder = tally.remainder();
    if (std::abs(remainder) > experiment.limits.ledger * emitted) {
        std::snprintf(text, sizeof text,
                      "the ledger does not close: %.3g of the emitted power is missing (limit %.3g)",
                      remainder / emitted, experiment.limits.ledger);
        failures.emplace_back(text);
    }
    auto const lost = tally.ended[static_cast<std::size_t>(Event::leak)] +
                      tally.ended[static_cast<std::size_t>(Event::invalid)];
    double const share =
        static_cast<double>(lost) / static_cast<double>(std::max<std::uint64_t>(1, tally.segments()));
    if (share > experiment.limits.leak) {
        std::snprintf(text, sizeof text,
                      "%llu of %llu segments leaked or were invalid (limit %.3g of them): see lost_rays",
                      static_cast<unsigned long long>(lost),
                      static_cast<unsigned long long>(tally.segments()), experiment.limits.leak);
        failures.emplace_back(text);
    }
    return failures;
}

Value options_of(Experiment const& experiment, RunFacts const& facts) {
    TraceOptions const& trace = experiment.trace;
    return of(Table{{"max_depth", of(std::uint64_t{trace.max_depth})},
                    {"min_power", of(trace.min_power)},
                    {"branch", of(std::string(name_of(trace.branch)))},
                    {"split_until", of(trace.split_until)},
                    {"split_depth", of(std::uint64_t{trace.split_depth})},
                    {"method", of(std::string(name_of(trace.method)))},
                    {"tolerance_rad", of(trace.tolerance)},
                    {"tolerance_power", of(trace.tolerance_power)},
                    {"digits_lost", of(trace.digits_lost)},
                    {"log", of(experiment.log.on)},
                    {"log_every", of(experiment.log.every)},
                    {"log_min_power", of(experiment.log.min_power)},
                    {"log_where", of(experiment.log.where.text)},
                    {"limit_leak", of(experiment.limits.leak)},
                    {"limit_ledger", of(experiment.limits.ledger)},
                    {"set", of(facts.set)}});
}

Value summary_of(Experiment const& experiment, Scene const& scene, WavelengthTable const& optics,
                 TraceOutcome const& outcome, RunFacts const& facts, MethodChoice const& choice,
                 Pilots const& pilots) {
    Tally const& tally = outcome.tally;
    SumUnit const unit = tally.unit;
    std::uint64_t const segments = tally.segments();
    Table events;
    for (std::size_t i = 1; i < event_names.size(); ++i)
        if (static_cast<Event>(i) != Event::emitted)
            events.emplace_back(std::string(event_names[i]), of(tally.ended[i]));
    events.emplace_back("recovered", of(tally.recovered));
    Table detectors;
    for (DetectorRecord const& record : outcome.detectors)
        detectors.emplace_back(record.spec().name, detector_figures(record, scene, optics, tally));
    std::vector<std::string> const failures = failures_of(experiment, outcome);
    return of(Table{
        {"title", of(experiment.title)},
        {"program", of(facts.program)},
        {"experiment_sha256", of(facts.experiment_sha256)},
        {"seed", of(experiment.trace.seed)},
        {"options", options_of(experiment, facts)},
        {"passed", of(failures.empty())},
        {"failures", of(failures)},
        {"rays", of(outcome.rays)},
        {"segments", of(segments)},
        {"seconds", of(outcome.seconds)},
        {"segments_per_second", of(static_cast<double>(segments) / std::max(outcome.seconds, 1e-9))},
        {"threads", of(std::uint64_t{outcome.threads})},
        {"energy_W", of(Table{{"emitted", of(tally.emitted.value(unit))},
                              {"detected", of(tally.detected.value(unit))},
                              {"absorbed", of(tally.absorbed.value(unit))},
                              {"escaped", of(tally.escaped.value(unit))},
                              {"cut", of(tally.cut.value(unit))},
                              {"error", of(tally.error.value(unit))},
                              {"remainder", of(tally.remainder())}})},
        {"events", of(std::move(events))},
        {"lost_rays", lost_rays(outcome)},
        {"absorbed_W", absorbed(scene, tally)},
        {"escaped_direction", escaped(optics, tally)},
        {"detectors", of(std::move(detectors))},
        {"objects", objects(scene, choice)},
        {"models", models_value(scene, false)},
        {"digits_lost", digits_lost(experiment, outcome.digits)},
        {"pilots", pilots_value(pilots)},
        {"warnings", of(warnings_of(experiment, scene, outcome))},
    });
}

} // namespace sahl
