#include "trace/sources.h"

#include "math/input_error.h"
#include "math/overloaded.h"
#include "math/random.h"
#include "math/sequences.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sahl {

namespace {

/// Of the root's random numbers: two for a point or a direction, two for a place within a cell.
enum Draw : std::uint32_t {
    first_coordinate = 11,
    second_coordinate = 12,
    across_cell = 13,
    along_cell = 14
};

/// The points of a beam's pattern, in units of its radius, or of its size; empty where they are drawn by
/// number.
std::vector<dvec2> pattern_points(Beam const& beam) {
    bool const round = beam.radius > 0.0;
    dvec2 const unit = beam.size / std::max(beam.size.x, beam.size.y); // near-square cells
    auto const scaled = [&](std::vector<dvec2> points) {
        for (dvec2& p : points)
            p = {unit.x > 0.0 ? p.x / unit.x : 0.0, unit.y > 0.0 ? p.y / unit.y : 0.0};
        return points;
    };
    switch (beam.pattern) {
    case Pattern::grid:
        return round ? square_grid_in_disk(beam.rays) : scaled(square_grid_in_rectangle(beam.rays, unit));
    case Pattern::hexagonal:
        return round ? hexagonal_in_disk(beam.rays) : scaled(hexagonal_in_rectangle(beam.rays, unit));
    case Pattern::fan: {
        std::vector<dvec2> points = fan(beam.rays);
        for (dvec2& p : points)
            p *= round ? 1.0 : 0.5;
        return points;
    }
    case Pattern::ring: {
        std::vector<dvec2> points = ring(beam.rays);
        for (dvec2& p : points)
            p *= round ? 1.0 : 0.5;
        return points;
    }
    case Pattern::edge:
        return round ? ring(beam.rays) : edge_of_rectangle(beam.rays, beam.size);
    case Pattern::random:
    case Pattern::sobol:
        return {};
    }
    return {};
}

/// A beam without extent is one ray along its axis.
bool is_line(Beam const& beam) {
    return beam.radius == 0.0 && beam.size == dvec2(0.0);
}

dvec3 across(dvec3 const& toward, dvec3 const& up, dvec2 const& p) {
    return p.x * cross(up, toward) + p.y * up;
}

} // namespace

std::uint64_t seed_again(std::uint64_t seed) {
    return mix64(seed ^ 0x6A09E667F3BCC908); // digits of √2: another stream, whatever the seed
}

Emission::Emission(std::vector<SourceSpec> const& sources, WavelengthTable const& optics, std::uint64_t seed)
    : seed_(seed) {
    double all_power = 0.0;
    for (SourceSpec const& spec : sources)
        all_power += spec.power;
    SumUnit const unit = SumUnit::for_total(all_power);
    for (SourceSpec const& spec : sources) {
        Prepared source;
        source.spec = &spec;
        double total = 0.0;
        for (auto const& [wavelength, weight] : spec.wavelengths)
            total += weight;
        for (auto const& [wavelength, weight] : spec.wavelengths) {
            source.wavelengths.push_back(optics.id_of(wavelength));
            source.wavelength_share.push_back(weight / total);
        }
        std::visit(Overloaded{
                       [&](Beam const& beam) {
                           source.rays = beam.rays;
                           if (is_line(beam))
                               source.points.assign(beam.rays, dvec2(0.0));
                           else
                               source.points = pattern_points(beam);
                           if (!source.points.empty())
                               source.rays = source.points.size();
                       },
                       [&](PointEmitter const& emitter) { source.rays = emitter.rays; },
                       [&](LambertianEmitter const& emitter) { source.rays = emitter.rays; },
                       [&](ExplicitRays const& rays) { source.rays = rays.rays.size(); },
                   },
                   spec.emitter);
        sources_.push_back(std::move(source));
        Prepared& prepared = sources_.back();
        Beam const* const beam = std::get_if<Beam>(&spec.emitter);
        bool const equal =
            !std::holds_alternative<ExplicitRays>(spec.emitter) && !(beam && beam->gaussian_radius);
        if (equal)
            prepared.equal = equal_shares(spec.power, prepared.wavelength_share, prepared.rays, unit);
        else
            weigh(prepared, first_.back(), unit);
        first_.push_back(first_.back() + prepared.rays * prepared.wavelengths.size());
    }
}

void Emission::weigh(Prepared& source, std::uint64_t first, SumUnit unit) {
    bool const beam = std::holds_alternative<Beam>(source.spec->emitter);
    auto const weight_of = [&](std::uint64_t within) {
        std::uint64_t const i = within % source.rays;
        return weight(source, beam ? point(source, i, first + within, seed_) : dvec2(0.0), i);
    };
    std::uint64_t const rays = source.rays * source.wavelengths.size();
    for (std::size_t colour = 0; colour < source.wavelengths.size(); ++colour) {
        // Kahan's sum: what a plain one loses would fall on the few rays that make up for roundings
        double weights = 0.0, lost = 0.0;
        for (std::uint64_t i = 0; i < source.rays; ++i) {
            double const next = weight_of(colour * source.rays + i) - lost, sum = weights + next;
            lost = (sum - weights) - next;
            weights = sum;
        }
        if (!(weights > 0.0 && std::isfinite(weights)))
            throw InputError(
                source.spec->place.text(), "no ray of " + source.spec->name + " has any power",
                "give a profile that is not much narrower than the rays lie apart, or weights above 0");
        source.per_weight.push_back(source.spec->power * source.wavelength_share[colour] / weights);
    }
    source.weighted.emplace(unit);
    for (std::uint64_t within = 0; within < rays; ++within)
        source.weighted->add(within, weight_of(within) * source.per_weight[within / source.rays]);
    source.weighted->close(source.spec->power);
}

dvec2 Emission::point(Prepared const& source, std::uint64_t number, std::uint64_t ray,
                      std::uint64_t seed) const {
    if (!source.points.empty())
        return source.points[number];
    bool const sobol = std::visit(Overloaded{[](Beam const& b) { return b.pattern == Pattern::sobol; },
                                             [](auto const&) { return true; }},
                                  source.spec->emitter);
    auto const drawn = [&](Draw x, Draw y) {
        return dvec2(uniform(seed, ray, 0, x), uniform(seed, ray, 0, y));
    };
    dvec2 square = sobol ? sobol_2d(static_cast<std::uint32_t>(number), mix64(seed_))
                         : drawn(first_coordinate, second_coordinate);
    if (sobol && seed != seed_) { // anywhere in its own cell, as if the points were no more than stratified
        double const cells = std::max(1.0, std::floor(std::sqrt(static_cast<double>(source.rays))));
        square = (floor(square * cells) + drawn(across_cell, along_cell)) / cells;
    }
    Beam const* const beam = std::get_if<Beam>(&source.spec->emitter);
    if (!beam)
        return square;
    return beam->radius > 0.0 ? disk_from_square(square) : square - 0.5;
}

double Emission::weight(Prepared const& source, dvec2 const& point, std::uint64_t number) const {
    if (auto const* const rays = std::get_if<ExplicitRays>(&source.spec->emitter))
        return rays->rays[number].weight;
    auto const* const beam = std::get_if<Beam>(&source.spec->emitter);
    if (!beam || !beam->gaussian_radius)
        return 1.0;
    dvec2 const at = beam->radius > 0.0 ? beam->radius * point : beam->size * point;
    return std::exp(-2.0 * dot(at, at) / (*beam->gaussian_radius * *beam->gaussian_radius));
}

Ray Emission::ray(std::uint64_t number, bool again) const {
    std::uint64_t const seed = again ? seed_again(seed_) : seed_;
    auto const next = std::upper_bound(first_.begin(), first_.end(), number);
    auto const index = static_cast<std::size_t>(next - first_.begin()) - 1;
    Prepared const& source = sources_[index];
    std::uint64_t const within = number - first_[index];
    std::uint64_t const colour = within / source.rays, i = within % source.rays;
    Ray ray;
    ray.source = {static_cast<std::uint32_t>(index)};
    ray.wavelength = source.wavelengths[colour];
    std::visit(
        Overloaded{
            [&](Beam const& beam) {
                dvec2 const p = point(source, i, number, seed);
                ray.origin = beam.from + across(beam.toward, beam.up,
                                                beam.radius > 0.0 ? beam.radius * p : beam.size * p);
                ray.direction = beam.toward;
                if (source.weighted)
                    ray.power = source.weighted->of(within, weight(source, p, i) * source.per_weight[colour]);
            },
            [&](PointEmitter const& emitter) { // uniform in the cosine and in azimuth
                dvec2 const p = point(source, i, number, seed);
                double const half = std::sin(0.5 * emitter.half_angle);
                double const drop = 2.0 * half * half * p.x; // 1 − cos
                double const side = std::sqrt(drop * (2.0 - drop)), azimuth = 2.0 * std::numbers::pi * p.y;
                dvec2 const circle(side * std::cos(azimuth), side * std::sin(azimuth));
                ray.origin = emitter.at;
                ray.direction =
                    normalize((1.0 - drop) * emitter.toward + across(emitter.toward, emitter.up, circle));
            },
            [&](LambertianEmitter const& emitter) {
                dvec2 const p = point(source, i, number, seed);
                dvec2 const disk = disk_from_square({uniform(seed, number, 0, first_coordinate),
                                                     uniform(seed, number, 0, second_coordinate)});
                double const up = std::sqrt(std::max(0.0, 1.0 - dot(disk, disk)));
                ray.origin = emitter.at + across(emitter.toward, emitter.up, emitter.size * (p - 0.5));
                ray.direction = normalize(up * emitter.toward + across(emitter.toward, emitter.up, disk));
            },
            [&](ExplicitRays const& rays) {
                ray.origin = rays.rays[i].origin;
                ray.direction = rays.rays[i].direction;
                ray.power = source.weighted->of(within, rays.rays[i].weight * source.per_weight[colour]);
            },
        },
        source.spec->emitter);
    if (!source.weighted)
        ray.power = source.equal[colour].of(i);
    return ray;
}

double Emission::power() const {
    double sum = 0.0;
    for (Prepared const& source : sources_)
        sum += source.spec->power;
    return sum;
}

} // namespace sahl
