#include "run/dispersion_pilot.h"

#include "run/path_errors.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace sahl {

namespace {

constexpr std::uint64_t pilots = 64;

std::set<std::uint32_t> media_of_ways(Scene const& scene) {
    std::set<std::uint32_t> media{scene.surroundings.value};
    for (Body const& body : scene.bodies)
        if (!body.open)
            media.insert(body.medium.value);
    return media;
}

/// The source's first wavelength, then those where a medium's index is least or greatest, if it changes.
std::vector<double> telling_wavelengths(Scene const& scene, WavelengthTable const& optics,
                                        SourceSpec const& source) {
    std::vector<double> telling{source.wavelengths.front().first};
    for (std::uint32_t const medium : media_of_ways(scene)) {
        auto const index = [&](auto const& entry) {
            return optics.index({medium}, optics.id_of(entry.first));
        };
        auto const [least, greatest] =
            std::minmax_element(source.wavelengths.begin(), source.wavelengths.end(),
                                [&](auto const& a, auto const& b) { return index(a) < index(b); });
        if (index(*least) == index(*greatest))
            continue;
        for (double const wavelength : {least->first, greatest->first})
            if (std::find(telling.begin(), telling.end(), wavelength) == telling.end())
                telling.push_back(wavelength);
    }
    return telling;
}

/// Trees of the same rays at one wavelength.
Trees at_wavelength(Scene const& scene, WavelengthTable const& optics, TraceOptions const& options,
                    SourceSpec source, double wavelength) {
    source.wavelengths = {{wavelength, 1.0}};
    std::vector<SourceSpec> const sources{std::move(source)};
    Emission const emission(sources, optics, options.seed);
    std::vector<std::uint64_t> const all = spread_rays(emission, emission.rays(), 0.0);
    return trees_of(scene, optics, emission, options, all);
}

SourceDispersion dispersion_of(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
                               TraceOptions const& options, std::size_t number) {
    SourceSpec const& source = scene.sources[number];
    SourceDispersion found{source.name, source.wavelengths.size(), 0.0, 0.0};
    std::vector<double> const telling = telling_wavelengths(scene, optics, source);
    std::uint64_t const begin = emission.first_rays()[number], end = emission.first_rays()[number + 1];
    if (telling.size() < 2 || begin == end)
        return found;
    SourceSpec pilot = source;
    ExplicitRays rays;
    std::uint64_t const of_one = (end - begin) / source.wavelengths.size(), count = std::min(pilots, of_one);
    for (std::uint64_t i = 0; i < count; ++i) {
        Ray const ray = emission.ray(begin + (2 * i + 1) * of_one / (2 * count));
        rays.rays.push_back({ray.origin, ray.direction, 1.0});
    }
    pilot.emitter = std::move(rays);
    std::vector<Trees> trees;
    for (double const wavelength : telling) {
        trees.push_back(at_wavelength(scene, optics, options, pilot, wavelength));
        for (std::size_t i = 0; i + 1 < trees.size(); ++i) {
            PathErrors const errors = compare_paths(trees[i], trees.back(), true);
            found.turn = std::max(found.turn, errors.greatest);
            found.sequence_changed = std::max(found.sequence_changed, errors.changed_share());
        }
    }
    return found;
}

} // namespace

std::vector<SourceDispersion> dispersions(Scene const& scene, WavelengthTable const& optics,
                                          Emission const& emission, TraceOptions const& options) {
    std::vector<SourceDispersion> found;
    for (std::size_t i = 0; i < scene.sources.size(); ++i)
        if (scene.sources[i].wavelengths.size() > 1)
            found.push_back(dispersion_of(scene, optics, emission, options, i));
    return found;
}

std::vector<std::string> dispersion_notes(std::vector<SourceDispersion> const& found, double tolerance) {
    std::vector<std::string> notes;
    for (SourceDispersion const& of : found)
        if (of.turn <= tolerance && of.sequence_changed == 0.0) {
            char text[300];
            std::snprintf(text, sizeof text,
                          "source %s: its %llu wavelengths take the same ways, to within %.2g rad "
                          "(tolerance_rad is %.2g): for directions and places, one of them would do",
                          of.source.c_str(), static_cast<unsigned long long>(of.wavelengths), of.turn,
                          tolerance);
            notes.emplace_back(text);
        }
    return notes;
}

} // namespace sahl
