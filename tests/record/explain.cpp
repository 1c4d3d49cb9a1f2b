// The text that explains a ray tells angles, shares and reasons that follow from the rows.
#include "record/explain.h"
#include "record/detector_normals.h"

#include "support/catch.h"

#include <cmath>
#include <limits>

using namespace sahl;

namespace {

constexpr double rad = 3.14159265358979323846 / 180.0;
constexpr double inf = std::numeric_limits<double>::infinity();

LogHeader header() {
    LogHeader header;
    header.sources = {"laser"};
    header.source_power_W = {1.0};
    header.source_first_ray = {0, 100};
    header.surfaces = {"prism.left", "prism.right", "screen", "silver.front"};
    header.media = {"air", "glass"};
    header.wavelengths_m = {587.5618 * 1e-9};
    header.refractive_index = {1.0, 1.5168};
    return header;
}

Segment segment(std::uint32_t index, std::int32_t parent, Event born, Event ended, std::int32_t surface,
                std::uint16_t medium, double degrees, double power_start, double power_end) {
    Segment s;
    s.ray = 17;
    s.index = index;
    s.parent = parent;
    s.depth = static_cast<std::uint16_t>(parent + 1);
    s.born = born;
    s.ended = ended;
    s.surface = surface;
    s.medium = medium;
    s.wavelength = 587.5618 * 1e-9;
    s.direction = {std::cos(degrees * rad), std::sin(degrees * rad), 0.0};
    s.length = ended == Event::escaped ? inf : ended == Event::cut_power ? 0.0 : 0.01;
    s.optical_path = s.length;
    s.power_start = power_start;
    s.power_end = power_end;
    return s;
}

/// In air at 30° to the x axis onto a face whose normal is x; in the glass onto one whose normal is y, which
/// reflects all; back out through the first face's twin, onto a screen; what was reflected first escapes.
std::vector<Segment> prism() {
    double const inside = std::asin(std::sin(30.0 * rad) / 1.5168) / rad;
    return {segment(0, -1, Event::emitted, Event::refracted, 0, 0, 30.0, 1.0, 1.0),
            segment(1, 0, Event::refracted, Event::total_internal, 1, 1, inside, 0.95, 0.836),
            segment(2, 0, Event::reflected, Event::escaped, -1, 0, 150.0, 0.05, 0.05),
            segment(3, 1, Event::total_internal, Event::refracted, 0, 1, -inside, 0.836, 0.836),
            segment(4, 3, Event::refracted, Event::detected, 2, 0, -30.0, 0.8, 0.8),
            segment(5, 3, Event::reflected, Event::cut_power, -1, 1, 180.0 + inside, 0.036, 0.036)};
}

bool has(std::string const& text, std::string const& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("the explanation of a ray gives angles, shares and the reason of every end") {
    std::string const text = explain_ray(header(), prism());
    INFO(text);
    CHECK(has(
        text,
        "ray 17 of laser, 587.5618 nm, 6 segments\n#0 emitted in air (n 1), 10 mm, optical path 10 mm\n"));
    CHECK(has(text,
              "split by prism.left at (8.66025, 5, 0) mm: incidence 30.00°, refraction 19.25°, n 1 → 1.5168; "
              "T 95 %, R 5 %\n")); // sin 19.25° = 0.5/1.5168
    CHECK(has(text, "├─ #1 refracted in glass (n 1.5168), 10 mm"));
    CHECK(has(text, "│  │  power 0.95 W (95 %) → 0.836 W (83.6 %), absorbed 12 % on the way\n"));
    CHECK(has(text,
              "total internal reflection: incidence 70.75° exceeds the critical angle 41.25° against air, "
              "n 1.5168 → 1"));
    CHECK(has(text, "│  #3 total_internal in glass"));
    CHECK(has(text, "refraction 30.00°, n 1.5168 → 1; T 95.69 %, R 4.306 %\n"));
    CHECK(has(text, "│  ├─ #4 refracted in air"));
    CHECK(has(text, "detected by screen at (8.66025, -5, 0) mm\n"));
    CHECK(has(text, "│  └─ #5 reflected in glass (n 1.5168)\n"));
    CHECK(has(text, "cut: power below the limit\n"));
    CHECK(has(text,
              "└─ #2 reflected in air (n 1), without end\n      power 0.05 W (5 %)\n      escaped towards "
              "(-0.866025, 0.5, 0)\n"));
    CHECK_FALSE(has(text, "not in the log"));
}

TEST_CASE("the angle at a flat detector follows from the log's experiment, with what was set", "[record]") {
    LogHeader told = header();
    told.experiment_text = R"(
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 5}}
medium = "N-BK7"
[[source]]
name = "laser"
rays = [[0, 0, -50, 0, 0, 1]]
[[detector]]
name = "screen"
at_mm = [0, 0, 0]
facing = [0, 0, 1]
size_mm = [9, 9]
)";
    told.options_json = R"({"set": ["detector.screen.facing=[-2, 0, 0]"]})";
    auto const normals = detector_normals(told);
    REQUIRE(normals.count("screen") == 1);
    std::string const text = explain_ray(told, prism(), nullptr, normals);
    INFO(text);
    CHECK(has(text, "detected by screen at (8.66025, -5, 0) mm: incidence 30.00°\n"));
    told.experiment_text = "catalogues = [\"not-here.agf\"]" + told.experiment_text;
    CHECK(detector_normals(told).empty());
}

TEST_CASE("what a log leaves out for its power is not said to be absorbed", "[record]") {
    auto rows = prism();
    rows.resize(5); // 4.3 % of what #3 carries was reflected and not logged
    LogHeader thinned = header();
    thinned.min_power = 0.05;
    std::string const text = explain_ray(thinned, rows);
    INFO(text);
    CHECK(has(text, "5 segments; pieces below 5 % of its power are not in the log\n"));
    CHECK(has(text, "refraction 30.00°, n 1.5168 → 1; T 95.69 %\n"));
}

TEST_CASE("a total reflection names the medium behind only if it can reflect all") {
    auto rows = prism();
    rows.resize(4);
    rows[1].medium = rows[0].medium = rows[3].medium = 0; // air on this side, and nothing of glass behind
    CHECK(has(explain_ray(header(), rows), "total internal reflection: incidence 70.75°; R 100 %"));
}

TEST_CASE("a mirror's explanation gives the angle and what the mirror absorbs") {
    std::string const text =
        explain_ray(header(), {segment(0, -1, Event::emitted, Event::reflected, 3, 0, 45.0, 2.0, 2.0),
                               segment(1, 0, Event::reflected, Event::absorbed, 0, 0, 135.0, 1.9, 1.9)});
    INFO(text);
    CHECK(has(
        text,
        "reflected by silver.front at (7.07107, 7.07107, 0) mm: incidence 45.00°; R 95 %, absorbed 5 %\n"));
    CHECK(has(text, "#1 reflected in air"));
    CHECK(has(text, "absorbed by prism.left at"));
}

TEST_CASE("rows that are not in the log are said to be missing") {
    auto rows = prism();
    rows.erase(rows.begin() + 1);
    std::string text = explain_ray(header(), rows);
    INFO(text);
    CHECK(has(text, "some of its rows are not in the log"));
    CHECK(has(text, "#3 total_internal in glass (n 1.5168), from #1, which is not in the log"));
    rows.resize(1);
    CHECK(has(explain_ray(header(), rows),
              "refracted by prism.left at (8.66025, 5, 0) mm: its branches are not in the log\n"));
    CHECK(explain_ray(header(), {}).empty());
}

TEST_CASE("a guide with ten thousand reflections is explained without deep indentation") {
    std::vector<Segment> rows;
    for (std::int32_t i = 0; i < 10000; ++i)
        rows.push_back(segment(static_cast<std::uint32_t>(i), i - 1,
                               i == 0 ? Event::emitted : Event::total_internal, Event::total_internal, 1, 1,
                               i % 2 == 0 ? 20.0 : -20.0, 1.0, 1.0));
    std::string const text = explain_ray(header(), rows);
    CHECK(text.size() < 10000 * 300);
    CHECK(has(text, "\n#9999 total_internal"));
}
