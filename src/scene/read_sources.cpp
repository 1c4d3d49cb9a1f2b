// In: the tables [[source]]. Out: emitters in the world, their wavelengths and their power.
#include "scene/read_sources.h"

#include "math/input_error.h"
#include "scene/read_file.h"

#include <cmath>
#include <numbers>

namespace sahl {

namespace {

dvec2 metres2(std::vector<double> const& two_mm) {
    return {metres(two_mm[0]), metres(two_mm[1])};
}

std::uint64_t ray_count(Fields const& fields) {
    return static_cast<std::uint64_t>(fields.integer("rays"));
}

Beam read_beam(Value const& table, Affine const& group) {
    Fields const fields(table, keys::beam);
    Beam beam;
    beam.from = group.point(metres(fields.numbers("from_mm")));
    beam.toward = read_direction(fields, "toward", group);
    beam.up = read_up(fields, "up", beam.toward, group);
    beam.pattern = fields.choice<Pattern>("pattern", {{"grid", Pattern::grid},
                                                      {"hexagonal", Pattern::hexagonal},
                                                      {"random", Pattern::random},
                                                      {"sobol", Pattern::sobol},
                                                      {"fan", Pattern::fan},
                                                      {"ring", Pattern::ring},
                                                      {"edge", Pattern::edge}});
    beam.rays = ray_count(fields);
    if (fields.has("radius_mm") && fields.has("size_mm"))
        throw InputError(fields.place("size_mm").text(), "a beam has radius_mm and size_mm at once",
                         "keep one of the two");
    if (!fields.has("radius_mm") && !fields.has("size_mm") && beam.rays > 1)
        throw InputError(fields.place("rays").text(), "a beam of several rays does not say how wide it is",
                         "give radius_mm or size_mm");
    if (fields.has("radius_mm"))
        beam.radius = metres(fields.number("radius_mm"));
    if (fields.has("size_mm"))
        beam.size = metres2(fields.numbers("size_mm"));
    if (beam.pattern == Pattern::ring && beam.radius == 0.0)
        throw InputError(fields.place("pattern").text(), "a ring of rays has no radius",
                         "give radius_mm above 0");
    if (fields.has("profile"))
        beam.gaussian_radius =
            metres(Fields(fields.at("profile"), keys::profile).number("gaussian_radius_mm"));
    return beam;
}

PointEmitter read_point(Value const& table, Affine const& group) {
    Fields const fields(table, keys::point);
    PointEmitter point;
    double const half_angle_deg = fields.number("half_angle_deg");
    if (half_angle_deg < 180.0 && !fields.has("toward"))
        throw InputError(fields.place().text(), "a point shines into a cone that has no axis",
                         "give toward = [x, y, z]");
    point.at = group.point(metres(fields.numbers("at_mm")));
    point.toward = fields.has("toward") ? read_direction(fields, "toward", group) : dvec3(0.0, 0.0, 1.0);
    point.up = read_up(fields, "up", point.toward, group);
    point.half_angle = half_angle_deg * (std::numbers::pi / 180.0);
    point.rays = ray_count(fields);
    return point;
}

LambertianEmitter read_lambertian(Value const& table, Affine const& group) {
    Fields const fields(table, keys::lambertian);
    LambertianEmitter emitter;
    emitter.at = group.point(metres(fields.numbers("at_mm")));
    emitter.toward = read_direction(fields, "toward", group);
    emitter.up = read_up(fields, "up", emitter.toward, group);
    emitter.size = metres2(fields.numbers("size_mm"));
    emitter.rays = ray_count(fields);
    return emitter;
}

Polarisation read_polarisation(Value const& table, Affine const& group) {
    Fields const fields(table, keys::polarisation);
    auto const s = fields.numbers("stokes");
    if (!(s[0] > 0.0) ||
        std::hypot(s[1], s[2], s[3]) > s[0] * (1.0 + 1e-12)) // twelve digits may have been written
        throw InputError(fields.place("stokes").text(), "no light has this Stokes vector",
                         "make S0 above 0 and √(S1² + S2² + S3²) at most S0");
    dvec3 const stokes = dvec3(s[1], s[2], s[3]) / s[0];
    return {stokes / std::max(1.0, length(stokes)), read_direction(fields, "axis", group)};
}

/// Where the experiment says nothing of wavelengths, a ray file may.
void use_wavelengths_of(RayList const& list, Fields const& fields, SourceSpec& source) {
    if (fields.has("wavelengths_nm") || fields.has("lines") || fields.has("spectrum"))
        return;
    if (list.mixed)
        throw InputError(fields.place("file").text(),
                         "the rays of this file have wavelengths of their own, which are not read",
                         "give wavelengths_nm or spectrum: every ray is then traced at each of them");
    if (list.wavelength)
        source.wavelengths = {{*list.wavelength, 1.0}};
}

SourceSpec read_source(Value const& table, Groups const& groups, std::filesystem::path const& folder) {
    Fields const fields(table, keys::source);
    SourceSpec source;
    source.name = fields.text("name");
    source.place = table.place;
    check_name(source.name, fields.place("name"));
    Affine const group = rigid_group_of(fields, groups);
    std::optional<RayList> list_of_rays; // without the rays themselves
    std::string const kind = fields.only_one_of({"beam", "point", "lambertian", "rays", "file"});
    if (kind == "beam")
        source.emitter = read_beam(fields.at(kind), group);
    else if (kind == "point")
        source.emitter = read_point(fields.at(kind), group);
    else if (kind == "lambertian")
        source.emitter = read_lambertian(fields.at(kind), group);
    else {
        RayList list =
            kind == "rays"
                ? read_ray_list(fields.at(kind), group)
                : read_ray_file(existing_file(folder, fields.text(kind), fields.place(kind)), group);
        source.power = list.power > 0.0 ? list.power : 1.0;
        source.emitter = ExplicitRays{std::move(list.rays)};
        list_of_rays = std::move(list);
    }
    source.wavelengths = read_wavelengths(fields, folder);
    if (list_of_rays)
        use_wavelengths_of(*list_of_rays, fields, source);
    if (fields.has("power_W"))
        source.power = fields.number("power_W");
    if (fields.has("polarisation"))
        source.polarisation = read_polarisation(fields.at("polarisation"), group);
    return source;
}

} // namespace

std::vector<SourceSpec> read_sources(Array const& tables, Groups const& groups,
                                     std::filesystem::path const& folder) {
    std::vector<SourceSpec> sources;
    for (Value const& table : tables)
        sources.push_back(read_source(table, groups, folder));
    return sources;
}

} // namespace sahl
