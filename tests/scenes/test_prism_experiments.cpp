// In: the experiments with prisms that turn light: dove-prism, pellin-broca, penta-prism, roof-prism; their
// prisms are OBJ meshes. Out: that light leaves them where, and along what, reflections and Snell's law say.
#include "support/catch.h"
#include "support/experiments.h"
#include "support/textbook.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

double const n = 1.5168;

std::string const no_sweep = "sweep={}";

/// The way of light that is refracted in and out, and reflected so often between.
Segment out_of(Rows const& rows, std::size_t times, Event reflection) {
    std::vector<Event> births(times + 2, reflection);
    births.front() = births.back() = Event::refracted;
    return branch(rows, births);
}

} // namespace

TEST_CASE("the Dove experiment turns an image by twice the prism's angle, all of it by one path") {
    // height over length of a ray within: 45° less the refraction at an end face
    double const down = radians(45.0) - std::asin(std::sin(radians(45.0)) / n), length_mm = 42.6;
    double const height = length_mm / (1.0 + 1.0 / std::tan(down)); // of the prism whose axis stays
    double const inside = length_mm - height;                       // run along x of a ray on the axis
    for (double const angle : {0.0, 30.0, 73.0}) {
        CAPTURE(angle);
        Run const run =
            run_of("dove-prism", {text("object.dove.turn_deg[0]=", angle), "source.stem.beam.rays=50"});
        dvec3 const normal(0.0, std::cos(radians(angle)), std::sin(radians(angle))); // of the base, inwards
        std::size_t rays = 0;
        for (std::uint64_t ray = 0; ray < run.names.source_first_ray[1]; ++ray, ++rays) {
            Rows const rows = rows_of(run, ray);
            Segment const out =
                branch(rows, {Event::passed, Event::refracted, Event::total_internal, Event::refracted});
            dvec3 const in = 1e3 * rows.front().origin, at = 1e3 * end_of(out);
            dvec3 const expected = in - 2.0 * dot(in, normal) * normal;
            REQUIRE(out.ended == Event::detected);
            // roundings of 40 mm, 7e-15 mm, in some ten places and directions
            CHECK(std::abs(at.y - expected.y) < 1e-12);
            CHECK(std::abs(at.z - expected.z) < 1e-12);
            CHECK(length(out.direction - dvec3(1, 0, 0)) < 1e-14);
            double const path = 80.0 - inside + n * inside / std::cos(down);
            CHECK(std::abs(1e3 * out.optical_path - path) < 1e-12);
        }
        CHECK(rays >= 50);
    }
}

TEST_CASE("the Dove experiment reflects the ray of the textbook where the closed form says") {
    double const middle = 0.5 * 10.0760411697982; // of a prism that stands on y = 0 and begins at x = 0
    Run const run = run_of("dove-prism", {"source.fan.beam.from_mm=" + text(dvec3(-40.0, 4.0 - middle, 0.0)),
                                          "source.fan.beam.radius_mm=0", "source.fan.beam.rays=1",
                                          "object.dove.turn_deg[0]=0"});
    Rows const rows = rows_of(run, run.names.source_first_ray[3]);
    Segment const reflected = branch(rows, {Event::passed, Event::refracted, Event::total_internal});
    Segment const out =
        branch(rows, {Event::passed, Event::refracted, Event::total_internal, Event::refracted});
    CHECK(std::abs(1e3 * reflected.origin.x + 21.3 - 16.911403707912074) < 1e-12);
    CHECK(std::abs(1e3 * out.origin.x + 21.3 - 36.523958830201800) < 1e-12);
    CHECK(std::abs(1e3 * out.origin.y + middle - 6.0760411697982003) < 1e-12);
    double const outside = branch(rows, {Event::passed}).optical_path;
    CHECK(std::abs(1e3 * (reflected.optical_path - outside) - 51.645525486272912) < 1e-12);
}

TEST_CASE("the Pellin-Broca experiment turns one line by a right angle, each line at its own setting") {
    struct Setting {
        double turn_deg, deviation_deg[3]; // of F, d, C
    };
    Setting const settings[] = {{-60.837413258511156, {90.0, 92.080150467944971, 92.891973268785038}},
                                {-59.782955281437395, {87.858943477282711, 90.0, 90.833004989894602}},
                                {-59.364195341482867, {86.990009233354685, 89.157766266608208, 90.0}}};
    for (Setting const& setting : settings) {
        Run const run =
            run_of("pellin-broca", {no_sweep, text("group.table.turn_deg[2]=", setting.turn_deg)});
        for (std::size_t line = 0; line < 3; ++line) {
            // 19 rays of each line in order; one will do, they are parallel
            Segment const out = out_of(rows_of(run, 19 * line), 1, Event::total_internal);
            double const deviation = degrees(std::atan2(-out.direction.y, out.direction.x));
            CHECK(std::abs(deviation - setting.deviation_deg[line]) < 1e-12);
        }
    }
}

TEST_CASE("the penta prism experiment turns light by a right angle however the prism is turned") {
    for (double const turn : {-5.0, -1.7, 0.0, 3.0, 5.0}) {
        CAPTURE(turn);
        Run const run = run_of("penta-prism", {no_sweep, text("group.holder.turn_deg[2]=", turn)});
        double const inside = std::asin(std::sin(radians(turn)) / index_of(run, "N-BK7"));
        double const path = 20.0 * (2.0 + std::sqrt(2.0)) / std::cos(inside);
        for (std::uint64_t ray = 0; ray < 5; ++ray) {
            Rows const rows = rows_of(run, ray);
            Segment const out = out_of(rows, 2, Event::reflected);
            CHECK(length(out.direction - dvec3(0, 1, 0)) < 2e-15); // four roundings of a direction
            double length_mm = 0.0;
            for (Segment const* s = &rows[static_cast<std::size_t>(out.parent)]; s->parent >= 0;
                 s = &rows[static_cast<std::size_t>(s->parent)])
                length_mm += 1e3 * s->length;
            CHECK(std::abs(length_mm - path) < 1e-12);
        }
    }
}

TEST_CASE("the roof prism experiment turns an image over and round, and doubles it where the roof errs") {
    Run const right = run_of("roof-prism", {no_sweep});
    // half a turn about the ridge, which runs along (0, 1, 1) through z − y = 10 √2
    Segment const out = out_of(rows_of(right, right.names.source_first_ray[1]), 2, Event::total_internal);
    double const ridge = 10.0 * std::sqrt(2.0);
    CHECK(length(1e3 * out.origin - dvec3(-3.0, 20.0, 2.0 + ridge)) < 1e-13);
    CHECK(length(out.direction - dvec3(0, 1, 0)) < 1e-15);

    Run const wrong = run_of("roof-prism", {no_sweep, "object.prism.scale[0]=1.0001454546823523"});
    // the roof is 30″ too wide: the light is turned about the ridge by 60″ more, or less
    double const sine = 0.00031198910859080054; // n sin 60″ sin 45°
    std::size_t left = 0, all = 0;
    for (std::uint64_t ray = 0; ray < wrong.names.source_first_ray[1]; ++ray, ++all) {
        Rows const rows = rows_of(wrong, ray);
        Segment const double_image = out_of(rows, 2, Event::total_internal);
        CHECK(std::abs(std::abs(double_image.direction.x) - sine) < 1e-15);
        left += double_image.direction.x < 0.0 ? 1 : 0;
    }
    CHECK(left > all / 3);
    CHECK(left < 2 * all / 3);
}

TEST_CASE("the corner cube experiment returns six beams, each where its three reflections send it") {
    Run const run = run_of("corner-cube", {});
    struct Beam {
        char const* faces; // in the order in which they are met
        dvec3 arcsec;      // the part of the direction across the axis, outside
    };
    Beam const beams[] = {{"xyz", {22.7694555637867, -28.023122739979, 5.25366717619236}},
                          {"xzy", {22.7686743667916, -7.00650670801274, -15.7621676587788}},
                          {"yxz", {-12.2595398499249, 7.00485373967383, 5.25468611025111}},
                          {"yzx", {-22.7683064034425, 7.0048876667081, 15.7634187367344}},
                          {"zxy", {12.2594323012725, -7.00592926374339, -5.25350303752908}},
                          {"zyx", {-22.7695631107928, 28.0230661302079, -5.25350301941512}}};
    dvec3 const axis = normalize(dvec3(1.0));
    std::size_t met[6] = {}, rays = 0;
    for (std::uint64_t ray = 0; ray < 600; ++ray) {
        Rows const path = direct_path(rows_of(run, ray));
        if (path.size() != 6 || path[3].ended != Event::total_internal)
            continue; // it meets an edge, or the front on its way
        std::string faces;
        for (std::size_t i = 1; i < 4; ++i)
            faces += surface_at_end(run, path[i]).back();
        for (std::size_t i = 0; i < 6; ++i)
            if (beams[i].faces == faces) {
                dvec3 const& d = path[5].direction;
                dvec3 const across = radians(1.0 / 3600.0) * beams[i].arcsec;
                // some ten roundings of a direction, 1e-16 each, and the cube's edges are given to 2e-16
                CHECK(length(d - dot(d, axis) * axis - across) < 2e-15);
                ++met[i];
                ++rays;
            }
    }
    CHECK(rays > 550);
    for (std::size_t const count : met)
        CHECK(count > 80);
}

TEST_CASE("the corner cube experiment with one right angle wrong returns two beams, 2 √(2/3) n ε away") {
    // e = 5″, 0, 0
    Run const run = run_of("corner-cube", {"object.cube.matrix=[1, 0, 0, 0, -2.424127168048471e-05, "
                                           "1.0000242412716804, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]",
                                           "source.star.beam.rays=60"});
    for (std::uint64_t ray = 0; ray < 60; ++ray) {
        Rows const path = direct_path(rows_of(run, ray));
        if (path.size() != 6)
            continue;
        double const off = radians(angle_deg(path[5].direction, dvec3(1.0)));
        CHECK(std::abs(off - radians(12.384620140888563 / 3600.0)) < 2e-15);
    }
}
