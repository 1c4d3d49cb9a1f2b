// Whether trees whose s and p are kept apart carry what field vectors along the same paths would, and what
// closed forms say of plates.
#include "support/bank.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"
#include "support/textbook.h"

#include <complex>

using namespace sahl;
using namespace sahl::bench;

namespace {

using Complex = std::complex<double>;

Traced trace_apart(Lab const& lab, std::uint64_t log_every = 0) {
    Scene scene = build_scene(lab.experiment);
    WavelengthTable optics(scene);
    Emission emission(scene.sources, optics, 1);
    TraceContext context{
        scene, optics, emission, lab.experiment.trace, SumUnit::for_total(emission.power()), log_every};
    context.polarised = true;
    BatchResult result = trace_batch(context, 0, emission.rays());
    return {std::move(scene), std::move(optics), std::move(emission), std::move(result)};
}

double detected(Traced const& run, std::uint32_t detector) {
    double power = 0.0;
    for (DetectorHit const& hit : run.result.hits)
        power += hit.detector.value == detector ? hit.power : 0.0;
    return power;
}

/// A plate of 1 mm, a thousand wide, its middle at `at`, turned from facing −z by `turned`.
void plate(Lab& lab, MediumId glass, double at, dmat3 const& turned) {
    lab.body("plate " + std::to_string(lab.experiment.objects.size()), Box{{1.0, 1.0, 1e-3}}, glass,
             {turned, {0.0, 0.0, at}});
}

dmat3 about(dvec3 const& axis, double angle) {
    dvec3 const side = perpendicular_to(axis), other = cross(axis, side);
    auto const turned = [&](dvec3 const& v) {
        return dot(v, axis) * axis + dot(v, side) * (std::cos(angle) * side + std::sin(angle) * other) +
               dot(v, other) * (std::cos(angle) * other - std::sin(angle) * side);
    };
    return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
}

/// Light along +z that takes plates, and a detector behind that takes what comes through.
Lab plates(double n, std::vector<dmat3> const& turns, double apart,
           std::optional<Polarisation> polarisation) {
    Lab lab;
    MediumId const glass = lab.medium(n);
    for (std::size_t i = 0; i < turns.size(); ++i)
        plate(lab, glass, apart * static_cast<double>(i), turns[i]);
    lab.rays({{{0.001, 0.002, -5.0}, {0, 0, 1}, 1.0}}).polarisation = polarisation;
    lab.detector("behind", facing({0, 0, 8.0}, {0, 0, -1}), {9, 9});
    lab.experiment.trace.min_power = 1e-8;
    lab.experiment.trace.max_depth = 1000;
    return lab;
}

} // namespace

// All of it comes through to within what was cut.
TEST_CASE("kept apart, a pile of plates transmits what Stokes' formula says for s, for p, and for both",
          "[polarised]") {
    for (BankCase const& c : bank("pile_of_plates")) {
        int const count = static_cast<int>(c.input("plates"));
        if (count > 4)
            continue; // the trees of ten are too large to be cut at nothing
        double const angle = radians(c.input("incidence_deg"));
        std::vector<dmat3> const turns(static_cast<std::size_t>(count), dmat3(1.0));
        // tilted light through upright plates, so that none leaves at their sides
        for (auto const& [key, polarisation] :
             {std::pair("T_s", std::optional(Polarisation{{1, 0, 0}, {0, 1, 0}})),
              std::pair("T_p", std::optional(Polarisation{{-1, 0, 0}, {0, 1, 0}})),
              std::pair("T_unpolarised", std::optional<Polarisation>())}) {
            Lab lab;
            MediumId const glass = lab.medium(c.input("n"));
            for (int i = 0; i < count; ++i)
                plate(lab, glass, 2e-3 * i, dmat3(1.0));
            dvec3 const toward(std::sin(angle), 0.0, std::cos(angle));
            lab.rays({{-0.01 * toward, toward, 1.0}}).polarisation = polarisation;
            lab.detector("behind", facing({0, 0, 2e-3 * count + 1e-3}, {0, 0, -1}), {4, 4});
            lab.experiment.trace.min_power = 1e-7;
            lab.experiment.trace.max_depth = 1000;
            Traced const run = trace_apart(lab);
            double const cut = run.watts(run.result.tally.cut), through = detected(run, 0);
            CAPTURE(c.id, key, through, cut);
            CHECK(cut < 1e-2);
            CHECK(through <= c.output(key) + 1e-13);
            CHECK(through >= c.output(key) - cut - 1e-13);
            CHECK(std::abs(run.result.tally.remainder()) < 1e-13);
        }
    }
}

// At Brewster's angle a plate lets all p through, and of s what Stokes' formula says, T = (1 − r) / (1 + r).
// A second one turned by 90° about the light takes the other half the same way; one that is parallel leaves
// p alone, and of s (1 − r) / (1 + 3 r) where the ways to and fro between the two are counted.
TEST_CASE("two plates at Brewster's angle, parallel and crossed", "[polarised]") {
    double const n = 1.6, brewster = std::atan(n);
    double const r = reflectances(1.0, n, brewster).first, one = (1.0 - r) / (1.0 + r);
    dmat3 const tilt = about({1, 0, 0}, brewster), crossed = about({0, 0, 1}, radians(90.0)) * tilt;
    auto const through = [&](std::vector<dmat3> const& turns, std::optional<Polarisation> light) {
        bool const parallel =
            turns.size() == 2 && turns[0] == turns[1]; // so near that none leaves between them
        Traced const run = trace_apart(plates(n, turns, parallel ? 3e-3 : 3.0, light));
        CHECK(run.watts(run.result.tally.cut) < 1e-4);
        return detected(run, 0);
    };
    Polarisation const s{{1, 0, 0}, {1, 0, 0}}, p{{1, 0, 0}, {0, 1, 0}}, between{{1, 0, 0}, {1, 1, 0}};
    CHECK(through({tilt}, {}) == Approx(0.5 * (1.0 + one)).epsilon(1e-4));
    CHECK(through({tilt}, s) == Approx(one).epsilon(1e-4));
    CHECK(through({tilt}, p) == Approx(1.0).epsilon(1e-12));
    CHECK(through({tilt, crossed}, {}) == Approx(one).epsilon(1e-4));
    CHECK(through({tilt, crossed}, s) == Approx(one).epsilon(1e-4));
    CHECK(through({tilt, crossed}, between) == Approx(one).epsilon(1e-4));
    CHECK(through({tilt, tilt}, p) == Approx(1.0).epsilon(1e-12));
    CHECK(through({tilt, tilt}, s) == Approx((1.0 - r) / (1.0 + 3.0 * r)).epsilon(1e-4));
}

namespace {

struct Field {
    Complex x, y, z;
    Complex along(dvec3 const& v) const { return x * v.x + y * v.y + z * v.z; }
    double power() const { return std::norm(x) + std::norm(y) + std::norm(z); }
};

Field sum(Complex a, dvec3 const& v, Complex b, dvec3 const& w) {
    return {a * v.x + b * w.x, a * v.y + b * w.y, a * v.z + b * w.z};
}

/// Of a piece that goes on in `direction` from one that met a surface: the textbook's amplitudes, for a
/// medium or a metal beyond. Refracted power goes with n cos, too.
std::pair<Field, double> beyond(Field const& field, dvec3 const& before, dvec3 const& direction,
                                dvec3 const& normal, double n1, Complex n2, bool refracted) {
    dvec3 const s = normalize(cross(before, normal));
    dvec3 const p = cross(before, s), p_after = cross(direction, s);
    Complex const c1 = -dot(before, normal), sine = length(cross(before, normal));
    Complex const root = std::sqrt(1.0 - (n1 * sine / n2) * (n1 * sine / n2));
    Complex const c2 = root.imag() < 0.0 ? -root : root;
    Complex const r_s = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2),
                  r_p = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
    Complex const t_s = 2.0 * n1 * c1 / (n1 * c1 + n2 * c2), t_p = 2.0 * n1 * c1 / (n2 * c1 + n1 * c2);
    Field const next =
        sum((refracted ? t_s : r_s) * field.along(s), s, (refracted ? t_p : r_p) * field.along(p), p_after);
    double const area = refracted ? (n2 * c2).real() / (n1 * c1.real()) : 1.0;
    return {next, area * next.power() / field.power()};
}

} // namespace

// A ball, a tilted block and a metal mirror between them: planes of incidence turn along every path, light is
// reflected totally in the block, and some paths are eight surfaces long.
TEST_CASE("every branch of a polarised tree carries what a field vector along it would", "[polarised]") {
    Lab lab;
    MediumId const flint = lab.medium(1.7), crown = lab.medium(1.5);
    Complex const silver(0.05, 3.9);
    lab.body("ball", Sphere{1e-2}, crown);
    Dice dice(8);
    lab.body("block", Box{{2e-2, 3e-2, 2e-2}}, flint, {dice.rotation(), {0, 0, 4e-2}});
    lab.sheet("mirror", Rectangle{{0.2, 0.2}}, lab.surface(Metal{{{587.6e-9, silver.real(), silver.imag()}}}),
              facing({0, 0, 9e-2}, {0.3, 0.4, -1.0}));
    std::vector<RaySpec> rays;
    for (int i = 0; i < 60; ++i)
        rays.push_back({{dice.between(-8e-3, 8e-3), dice.between(-8e-3, 8e-3), -5e-2},
                        normalize(dvec3(dice.between(-0.05, 0.05), dice.between(-0.05, 0.05), 1.0)),
                        1.0});
    // an ellipse: field 0.8 along the axis, 0.6 i across it
    Complex const along(0.8, 0.0), across(0.0, 0.6);
    Complex const pair = 2.0 * along * std::conj(across);
    lab.rays(rays).polarisation =
        Polarisation{{std::norm(along) - std::norm(across), pair.real(), pair.imag()}, {1, 0, 0}};
    lab.experiment.trace.min_power = 1e-5;
    Traced const run = trace_apart(lab, 1);
    std::vector<Segment> const& rows = run.segments();
    std::vector<Field> fields(rows.size());
    std::size_t root = 0, checked = 0, total = 0, deepest = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Segment const& row = rows[i];
        if (row.parent < 0) {
            root = i;
            dvec3 const axis = perpendicular_to(row.direction, {1, 0, 0});
            fields[i] = sum(along, axis, across, cross(row.direction, axis));
            continue;
        }
        std::size_t const parent = root + static_cast<std::size_t>(row.parent);
        Segment const& before = rows[parent];
        bool const mirror = before.surface == static_cast<std::int32_t>(run.face("mirror").value);
        bool const refracted = row.born == Event::refracted;
        double const n1 = run.optics.index({before.medium}, {0}), n_own = run.optics.index({row.medium}, {0});
        // what lies beyond a surface that reflects: glass seen from air and air seen from glass, here
        bool const at_ball = before.surface == static_cast<std::int32_t>(run.face("ball").value);
        double const n2 = refracted ? n_own : n1 == 1.0 ? (at_ball ? 1.5 : 1.7) : 1.0;
        dvec3 const step =
            refracted ? n1 * before.direction - n2 * row.direction : row.direction - before.direction;
        dvec3 const normal = normalize(dot(step, before.direction) > 0.0 ? -step : step);
        auto const [field, share] = beyond(fields[parent], before.direction, row.direction, normal, n1,
                                           mirror ? silver : Complex(n2), refracted);
        fields[i] = field;
        total += row.born == Event::total_internal;
        deepest = std::max<std::size_t>(deepest, row.depth);
        checked += before.power_end > 1e-3;
        if (std::abs(row.power_start - share * before.power_end) > 1e-11 * before.power_end) {
            CAPTURE(i, row.ray, row.depth, name_of(row.born), row.power_start, share * before.power_end);
            FAIL();
        }
    }
    CHECK(checked > 300);
    CHECK(total > 50);
    CHECK(deepest >= 8);
    CHECK(std::abs(run.result.tally.remainder()) < 1e-14);
}
