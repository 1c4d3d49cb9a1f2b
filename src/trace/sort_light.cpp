#include "trace/sort_light.h"

#include "math/overloaded.h"
#include "optics/snell.h"

namespace sahl {

namespace {

SortedWays by_shares(double reflect, double transmit, bool total) {
    SortedWays ways;
    if (total)
        return {std::nullopt, (reflect + transmit) * ideal_mirror};
    double const kept = 1.0 - reflect - transmit;
    return {transmit * lets_pass, reflect * ideal_mirror, kept, kept};
}

/// Of `clean`, which `clear` of the light meets, beside a mirror; what goes through it is tinted.
SortedWays with_colour(SortedWays const& clean, double clear, double passes, double mirrored) {
    double const kept = std::max(0.0, 1.0 - clear - mirrored);
    SortedWays ways{std::nullopt, clear * clean.back + mirrored * ideal_mirror, kept, kept};
    if (clean.through) {
        ways.through = clear * passes * *clean.through;
        ways.absorbed_s += clear * (1.0 - passes) * clean.through->s;
        ways.absorbed_p += clear * (1.0 - passes) * clean.through->p;
    }
    return ways;
}

/// Unit, across the plane of incidence; where there is none, s and p are alike.
dvec3 s_axis(dvec3 const& direction, dvec3 const& normal) {
    dvec3 const across = cross(direction, normal);
    double const size = length(across);
    constexpr double rounding = 1e-15; // of a product of unit vectors
    return size > rounding ? across / size : perpendicular_to(direction);
}

} // namespace

PolarisedLight emitted_light(Scene const& scene, Ray const& ray) {
    auto const& given = scene.sources[ray.source.value].polarisation;
    return given ? PolarisedLight{perpendicular_to(ray.direction, given->axis), given->stokes}
                 : PolarisedLight{perpendicular_to(ray.direction), dvec3(0.0)};
}

SortedLight sort_light(Scene const& scene, WavelengthTable const& optics, Interface const& interface,
                       dvec3 const& direction, MediumId medium, WavelengthId wavelength,
                       PolarisedLight const& light, Branches& branches) {
    dvec3 const& normal = branches.by_facet ? interface.facet_normal : interface.normal;
    Incidence const incidence = Approach(direction, normal).incidence;
    double const before = optics.index(medium, wavelength);
    double const after = optics.index(interface.medium_after, wavelength);
    double const colour = optics.wavelengths()[wavelength.value];
    SortedWays const ways =
        interface.surface
            ? std::visit(Overloaded{
                             [&](Metal const&) {
                                 return sorted_by_metal(incidence, before,
                                                        optics.metal(*interface.surface, wavelength));
                             },
                             [&](Shares const& s) {
                                 return by_shares(s.reflect, s.transmit,
                                                  branches.ended == Event::total_internal);
                             },
                             [&](Absorber const&) { return by_shares(0.0, 0.0, false); },
                             [&](Diffuse const& s) { return by_shares(s.reflectance, 0.0, false); },
                             [&](Paint const& s) {
                                 return by_shares(s.covers * s.reflect, 1.0 - s.covers,
                                                  branches.ended == Event::total_internal);
                             },
                             [&](Tinted const& s) {
                                 return with_colour(sorted_by_dielectric(incidence, before, after), s.clear,
                                                    at_wavelength(s.transmitted, colour),
                                                    at_wavelength(s.mirrored, colour));
                             },
                             [&](ThinWall const& s) {
                                 return with_colour(sorted_by_plate(incidence, before,
                                                                    optics.index(s.wall, wavelength), after),
                                                    s.clear, at_wavelength(s.transmitted, colour),
                                                    at_wavelength(s.mirrored, colour));
                             },
                         },
                         scene.surfaces[interface.surface->value].kind)
            : sorted_by_dielectric(incidence, before, after);
    dvec3 const s = s_axis(direction, normal);
    dvec3 const stokes = told_by(light, direction, s).stokes;
    branches.absorbed = Sorting{ways.absorbed_s, ways.absorbed_p}.share(stokes);
    SortedLight lights;
    for (Outgoing& outgoing : branches.outgoing) {
        PolarisedLight& left = outgoing.crosses ? lights.through : lights.back;
        if (outgoing.event == Event::scattered) {
            left = {perpendicular_to(outgoing.direction), dvec3(0.0)};
            continue;
        }
        Sorting const& way = outgoing.crosses ? *ways.through : ways.back;
        outgoing.share = way.share(stokes);
        left = {perpendicular_to(outgoing.direction, s), way.stokes_after(stokes)};
    }
    return lights;
}

} // namespace sahl
