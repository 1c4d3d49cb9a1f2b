#include "trace/interact.h"

#include "math/overloaded.h"
#include "math/random.h"
#include "math/sequences.h"
#include "optics/fresnel.h"
#include "optics/plate.h"
#include "optics/snell.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// What one meeting needs to know; `normal` is the facing one that holds for both outgoing directions.
struct Encounter {
    dvec3 direction, normal;
    double n_before, n_after;
    Outgoing reflected(double share, Event event) const {
        return {reflect(direction, normal), share, event, false};
    }
};

Branches dielectric(Encounter const& met) {
    Branches branches;
    Approach const approach(met.direction, met.normal);
    double const squared = transmitted_normal_squared(approach.incidence, met.n_before, met.n_after);
    if (squared <= 0.0) {
        branches.ended = Event::total_internal;
        branches.outgoing.push_back(met.reflected(1.0, Event::total_internal));
        return branches;
    }
    double const transmitted_normal = std::sqrt(squared);
    FresnelShares const shares =
        fresnel_shares(approach.incidence, met.n_before, met.n_after, transmitted_normal);
    branches.ended = Event::refracted;
    branches.outgoing.push_back(
        {refracted(approach, met.normal, met.n_before, met.n_after, transmitted_normal),
         shares.transmittance(), Event::refracted, true});
    if (double const r = shares.reflectance(); r > 0.0)
        branches.outgoing.push_back(met.reflected(r, Event::reflected));
    return branches;
}

Branches constant_shares(Encounter const& met, double reflect_share, double transmit_share) {
    Branches branches;
    branches.absorbed = 1.0 - reflect_share - transmit_share;
    branches.ended = Event::absorbed;
    if (transmit_share > 0.0) {
        if (auto const through = refract(met.direction, met.normal, met.n_before, met.n_after)) {
            branches.ended = Event::refracted;
            branches.outgoing.push_back({*through, transmit_share, Event::refracted, true});
        } else { // refraction is impossible: that share reflects too
            branches.ended = Event::total_internal;
            branches.outgoing.push_back(met.reflected(reflect_share + transmit_share, Event::total_internal));
            return branches;
        }
    }
    if (reflect_share > 0.0) {
        branches.ended = branches.outgoing.empty() ? Event::reflected : branches.ended;
        branches.outgoing.push_back(met.reflected(reflect_share, Event::reflected));
    }
    return branches;
}

Branches metallic(Encounter const& met, std::complex<double> metal) {
    FresnelShares const shares =
        fresnel_metal(Approach(met.direction, met.normal).incidence, met.n_before, metal);
    Branches branches;
    branches.absorbed = shares.transmittance();
    branches.ended = Event::reflected;
    branches.outgoing.push_back(met.reflected(shares.reflectance(), Event::reflected));
    return branches;
}

Branches tinted(Encounter const& met, Tinted const& surface, double wavelength) {
    double const passes = at_wavelength(surface.transmitted, wavelength);
    double const mirrored = at_wavelength(surface.mirrored, wavelength);
    Branches branches;
    branches.absorbed = std::max(0.0, 1.0 - surface.clear - mirrored);
    branches.ended = Event::absorbed;
    double reflected = mirrored;
    Event back = Event::reflected;
    if (surface.clear > 0.0) {
        Branches const boundary = dielectric(met);
        for (Outgoing out : boundary.outgoing) {
            if (!out.crosses) {
                reflected += surface.clear * out.share;
                back = out.event;
                continue;
            }
            branches.absorbed += surface.clear * out.share * (1.0 - passes);
            out.share *= surface.clear * passes;
            if (out.share > 0.0)
                branches.outgoing.push_back(out);
        }
    }
    if (reflected > 0.0)
        branches.outgoing.push_back(met.reflected(reflected, back));
    if (!branches.outgoing.empty())
        branches.ended = branches.outgoing[0].event;
    return branches;
}

Branches thin_wall(Encounter const& met, ThinWall const& surface, double n_wall, double wavelength) {
    double const passes = at_wavelength(surface.transmitted, wavelength);
    double const mirrored = at_wavelength(surface.mirrored, wavelength);
    Branches branches;
    branches.absorbed = std::max(0.0, 1.0 - surface.clear - mirrored);
    auto const through = met.n_before == met.n_after
                             ? std::optional(met.direction)
                             : refract(met.direction, met.normal, met.n_before, met.n_after);
    Incidence const incidence = Approach(met.direction, met.normal).incidence;
    auto const plate = through ? fresnel_plate(incidence, met.n_before, n_wall, met.n_after) : std::nullopt;
    if (!plate) {
        branches.ended = Event::total_internal;
        branches.outgoing.push_back(met.reflected(surface.clear + mirrored, Event::total_internal));
        return branches;
    }
    double const transmitted = surface.clear * plate->transmittance();
    double const reflected = surface.clear * plate->reflectance() + mirrored;
    branches.absorbed += transmitted * (1.0 - passes);
    branches.ended = Event::absorbed;
    if (transmitted * passes > 0.0)
        branches.outgoing.push_back({*through, transmitted * passes, Event::refracted, true});
    if (reflected > 0.0)
        branches.outgoing.push_back(met.reflected(reflected, Event::reflected));
    if (!branches.outgoing.empty())
        branches.ended = branches.outgoing[0].event;
    return branches;
}

Branches diffuse(Encounter const& met, double reflectance, Draw const& draw) {
    Branches branches;
    branches.absorbed = 1.0 - reflectance;
    branches.ended = Event::absorbed;
    if (reflectance <= 0.0)
        return branches;
    // cosine law: a point of the unit disk, lifted onto the hemisphere (Malley's method)
    dvec2 const disk = disk_from_square(
        {uniform(draw.seed, draw.ray, draw.place, 1), uniform(draw.seed, draw.ray, draw.place, 2)});
    dvec3 const x = perpendicular_to(met.normal);
    dvec3 const y = cross(met.normal, x);
    double const up = std::sqrt(std::max(0.0, 1.0 - dot(disk, disk)));
    branches.ended = Event::scattered;
    branches.outgoing.push_back(
        {normalize(disk.x * x + disk.y * y + up * met.normal), reflectance, Event::scattered, false});
    return branches;
}

/// An interpolated normal may send light to the wrong side of the triangle; then the triangle's own holds.
bool keeps_sides(Branches const& branches, dvec3 const& facet_normal) {
    return std::all_of(branches.outgoing.begin(), branches.outgoing.end(), [&](Outgoing const& out) {
        double const side = dot(out.direction, facet_normal);
        return out.crosses ? side < 0.0 : side > 0.0;
    });
}

} // namespace

Branches interact(Scene const& scene, WavelengthTable const& optics, Interface const& interface,
                  dvec3 const& direction, MediumId medium, WavelengthId wavelength, Draw const& draw) {
    auto const with = [&](dvec3 const& normal) {
        Encounter const met{direction, normal, optics.index(medium, wavelength),
                            optics.index(interface.medium_after, wavelength)};
        if (!interface.surface)
            return dielectric(met);
        return std::visit(
            Overloaded{
                [&](Metal const&) { return metallic(met, optics.metal(*interface.surface, wavelength)); },
                [&](Shares const& s) { return constant_shares(met, s.reflect, s.transmit); },
                [&](Absorber const&) { return constant_shares(met, 0.0, 0.0); },
                [&](Diffuse const& s) { return diffuse(met, s.reflectance, draw); },
                [&](Paint const& s) { return constant_shares(met, s.covers * s.reflect, 1.0 - s.covers); },
                [&](Tinted const& s) { return tinted(met, s, optics.wavelengths()[wavelength.value]); },
                [&](ThinWall const& s) {
                    return thin_wall(met, s, optics.index(s.wall, wavelength),
                                     optics.wavelengths()[wavelength.value]);
                },
            },
            scene.surfaces[interface.surface->value].kind);
    };
    if (interface.normal == interface.facet_normal)
        return with(interface.normal);
    if (dot(direction, interface.normal) < 0.0)
        if (Branches branches = with(interface.normal); keeps_sides(branches, interface.facet_normal))
            return branches;
    Branches branches = with(interface.facet_normal);
    branches.by_facet = true;
    return branches;
}

} // namespace sahl
