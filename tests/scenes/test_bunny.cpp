// In: the two experiments with the Stanford bunny, where models/fetch_bunny.py has brought it. Out: that rays
// meet it where a search through all its triangles says, that six walls catch all light, and that light
// inside it runs as far as statistical ray optics says.
#include "support/catch.h"
#include "support/experiments.h"

#include <array>
#include <fstream>
#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

using Triangle = std::array<dvec3, 3>;

/// In metres; the file is in centimetres, its lines are v and f of three numbers.
std::vector<Triangle> bunny_triangles() {
    std::ifstream file(SAHL_SOURCE_DIR "/models/bunny.obj");
    std::vector<dvec3> places;
    std::vector<Triangle> triangles;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string key;
        words >> key;
        if (dvec3 p; key == "v" && words >> p.x >> p.y >> p.z)
            places.push_back(1e-2 * p);
        if (std::size_t a = 0, b = 0, c = 0; key == "f" && words >> a >> b >> c)
            triangles.push_back({places.at(a - 1), places.at(b - 1), places.at(c - 1)});
    }
    REQUIRE(triangles.size() == 3674);
    return triangles;
}

double volume_of(std::vector<Triangle> const& triangles) {
    double six = 0.0;
    for (auto const& [a, b, c] : triangles)
        six += dot(a, cross(b, c));
    return six / 6.0;
}

/// How far, or infinity. T. Möller, B. Trumbore, J. Graphics Tools 2 (1997) 21.
double first_hit(std::vector<Triangle> const& triangles, dvec3 const& from, dvec3 const& along) {
    double nearest = INFINITY;
    for (auto const& [a, b, c] : triangles) {
        dvec3 const e1 = b - a, e2 = c - a, across = cross(along, e2), to = from - a, q = cross(to, e1);
        double const det = dot(e1, across), u = dot(to, across) / det, v = dot(along, q) / det;
        double const t = dot(e2, q) / det;
        if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < nearest)
            nearest = t;
    }
    return nearest;
}

} // namespace

TEST_CASE(
    "rays meet the bunny where a search through all its triangles says, and six walls catch all light") {
    if (!has_bunny())
        return;
    Run const run = run_of("glass-bunny", {"source.beam.beam.rays=500", "log.every=1"});
    std::vector<Triangle> const triangles = bunny_triangles();
    std::size_t hits = 0, misses = 0;
    double met = 0.0, returned = 0.0; // W, at first meetings
    for (Segment const& root : run.segments) {
        if (root.depth == 1 && root.born == Event::reflected)
            returned += root.power_start;
        if (root.depth == 0) {
            double const distance = first_hit(triangles, root.origin, root.direction);
            if (std::isinf(distance)) {
                CHECK(root.ended == Event::detected); // by the wall behind
                ++misses;
            } else { // glTF has coordinates as floats: 6e-8 of 0.1 m, and a slant of up to some hundred
                CHECK(root.ended == Event::refracted);
                CHECK(std::abs(root.length - distance) < 1e-6);
                met += root.power_end;
                ++hits;
            }
        }
    }
    double const n = index_of(run, "N-SF11"), least = (n - 1.0) / (n + 1.0); // at normal incidence
    CHECK(returned > least * least * met);
    CHECK(hits > 300);
    CHECK(misses > 20);
    CHECK(number_at(run.summary, {"energy_W", "escaped"}) == 0.0);
    CHECK(number_at(run.summary, {"events", "leak"}) == 0.0);
}

TEST_CASE("in an evenly bright room light runs in the bunny as far as statistical ray optics says") {
    if (!has_bunny())
        return;
    std::vector<std::string> set;
    for (char const* wall : {"left", "right", "bottom", "top", "back", "front"})
        set.push_back("source." + std::string(wall) + ".lambertian.rays=50000");
    Folder const out;
    Value const summary = run_experiment_of("bunny-in-a-bright-room", out.path() / "out", set).summary;
    double const n = 1.5168, absorption = 1e-4, emitted = 6.0, walls = 6 * 0.16 * 0.16; // 1/m, W, m²
    // from all 4π directions the radiance inside is n² times the room's, emitted / (π walls)
    double const bunny = emitted * 4.0 * n * n * absorption * volume_of(bunny_triangles()) / walls;
    double const radius = 0.025, lost = std::pow(1.0 - 1.0 / (n * n), 1.5);
    double const mean_path = 4.0 / 3.0 * radius * n * n * (1.0 - lost);
    double const ball = emitted * absorption * mean_path * 4.0 * std::numbers::pi * radius * radius / walls;
    // 3 %: over six seeds the two figures scatter by 0.6 % and 0.9 %
    CHECK(std::abs(number_at(summary, {"absorbed_W", "bunny", "bulk"}) / bunny - 1.0) < 0.03);
    CHECK(std::abs(number_at(summary, {"absorbed_W", "ball", "bulk"}) / ball - 1.0) < 0.03);
    CHECK(number_at(summary, {"energy_W", "cut"}) == 0.0);
}
