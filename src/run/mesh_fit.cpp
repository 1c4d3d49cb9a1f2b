#include "run/mesh_fit.h"

#include "geometry/curved_tree.h"
#include "geometry/data_steps.h"
#include "run/values.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

constexpr double helium_d_line = 587.5618e-9; // m
constexpr double aperture = 0.8;              // beyond it, grazing light tells of little but itself
constexpr std::uint64_t rays_of_beam = 1000;  // of which pilots are taken
constexpr double only_rounding = 1e-11;       // rad: below it, no triangle errs

/// Of the error by the length of an edge; triangles are as its inverse square.
double order_of(Method method) {
    return method == Method::facet ? 1.0 : method == Method::fitted ? 4.0 : 2.0;
}

char const* use_name(NormalUse use) {
    switch (use) {
    case NormalUse::files:
        return "used";
    case NormalUse::flat:
        return "flat";
    case NormalUse::first_order:
        return "first_order";
    default:
        return "none";
    }
}

Value optional_value(std::optional<double> const& x) {
    return x ? of(*x) : nothing();
}

Table fit_of_data(Body const& body) {
    CurvedTree const fitted(body.mesh, PatchKind::fitted);
    SmoothFans const& fans = fitted.fans();
    DataSteps const steps = steps_of(body.mesh->soup.positions);
    double const millimetres = 1e3 * std::cbrt(std::abs(glm::determinant(body.to_world.linear)));
    double const step = steps.floats ? fans.reach * 0x1p-23 : steps.even;
    bool const compared = fans.normals == NormalUse::files || fans.normals == NormalUse::first_order;
    return {{"triangles", of(std::uint64_t{body.mesh->soup.triangles.size()})},
            {"normals", of(std::string(use_name(fans.normals)))},
            {"normals_off_rad", compared ? of(fans.normals_off) : nothing()},
            {"places_tell_rad", compared ? of(fans.positions_blur) : nothing()},
            {"step_mm", of(step * millimetres)},
            {"quadratic_instead", of(fitted.share_stood_in())}};
}

void add_levels(Table& entry, MethodLevels const& found, double triangles, double tolerance, double floor) {
    ChosenLevel const chosen = chosen_level(found.levels, tolerance);
    Array levels;
    for (MethodLevel const& level : found.levels)
        levels.push_back(of(Table{
            {"method", of(std::string(name_of(level.method)))},
            {"bound_rad", of(level.bound)},
            {"rms_rad", of(level.rms)},
            {"sequence_changed", of(level.changed)},
            {"triangles_for_tolerance", optional_value(triangles_for(level, triangles, tolerance, floor))}}));
    entry.emplace_back("floor_rad", of(floor));
    entry.emplace_back("fastest_within",
                       chosen.within ? of(std::string(name_of(chosen.level.method))) : nothing());
    entry.emplace_back("levels", of(std::move(levels)));
}

/// The world's box of all bodies but detectors.
std::pair<dvec3, dvec3> box_of(Scene const& scene) {
    dvec3 low(INFINITY), high(-INFINITY);
    for (Body const& body : scene.bodies)
        for (int corner = 0; body.mesh && corner < 8; ++corner) {
            dvec3 p;
            for (int axis = 0; axis < 3; ++axis)
                p[axis] = (corner >> axis & 1) != 0 ? body.mesh->high[axis] : body.mesh->low[axis];
            p = body.to_world.point(p);
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    return {low, high};
}

} // namespace

std::optional<double> triangles_for(MethodLevel const& level, double triangles, double tolerance,
                                    double floor) {
    // what is left of the bound when the digits' part is gone; that part does not fall with the fineness
    double const allowed = tolerance - floor, has = level.bound - floor;
    if (level.method == Method::recognised || level.bound <= only_rounding || allowed <= 0.0 || has <= 0.0)
        return {};
    return triangles * std::pow(has / allowed, 2.0 / order_of(level.method));
}

Value mesh_fits(Scene& scene, WavelengthTable const& optics, Emission const& emission,
                TraceOptions const& options) {
    Table fits{{"tolerance_rad", of(options.tolerance)}};
    Table models;
    std::vector<bool> const curvable = curvable_meshes(scene);
    auto const groups = judged_together(scene, curvable);
    MethodPilots pilots(scene, optics, emission, options, curvable);
    for (std::size_t g = 0; emission.rays() > 0 && g < groups.size(); ++g) {
        std::vector<std::size_t> const& bodies = groups[g];
        MethodLevels const found = pilots.levels(bodies);
        double const floor = found.loses_light ? 0.0 : pilots.floor_of(bodies);
        for (std::size_t const body : bodies) {
            Table entry = fit_of_data(scene.bodies[body]);
            entry.emplace_back("loses_light", of(found.loses_light));
            if (!found.loses_light)
                add_levels(entry, found, static_cast<double>(scene.bodies[body].mesh->soup.triangles.size()),
                           options.tolerance / static_cast<double>(groups.size()), floor);
            models.emplace_back(scene.bodies[body].name, of(std::move(entry)));
        }
    }
    fits.emplace_back("share_rad", of(options.tolerance / static_cast<double>(std::max<std::size_t>(
                                                              groups.size(), 1)))); // errors add up
    fits.emplace_back("models", of(std::move(models)));
    return of(std::move(fits));
}

std::vector<SourceSpec> probing_beams(Scene const& scene) {
    std::vector<SourceSpec> sources;
    auto const [low, high] = box_of(scene);
    dvec3 const centre = 0.5 * (low + high), half = 0.5 * (high - low);
    for (int axis = 0; axis < 3; ++axis) {
        double const radius = aperture * std::min(half[(axis + 1) % 3], half[(axis + 2) % 3]);
        if (!(radius > 0.0) || !std::isfinite(radius))
            continue;
        dvec3 toward(0.03, 0.02, 0.05); // so that no ray runs along a plane of symmetry
        toward[axis] = 1.0;
        Beam beam{};
        beam.toward = normalize(toward);
        beam.up = perpendicular_to(beam.toward);
        beam.from = centre - 2.0 * length(half) * beam.toward;
        beam.radius = radius;
        beam.pattern = Pattern::hexagonal;
        beam.rays = rays_of_beam;
        sources.push_back({std::string("along ") + "xyz" [axis],
                           beam,
                           {
                               { helium_d_line, 1.0 }
                           },
                           1.0,
                           {},
                           {}});
    }
    return sources;
}

} // namespace sahl
