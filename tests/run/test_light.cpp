// Detectors of every kind in whole experiments, against closed forms.
#include "math/input_error.h"
#include "run/run.h"
#include "support/bench.h"
#include "support/catch.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

namespace fs = std::filesystem;

std::string bytes_of(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    REQUIRE(in.good());
    return {std::istreambuf_iterator<char>(in), {}};
}

/// A table's rows of numbers, the header passed over.
std::vector<std::vector<double>> rows_in(fs::path const& file) {
    std::istringstream text(bytes_of(file));
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(text, line);
    while (std::getline(text, line)) {
        std::istringstream fields(line);
        std::vector<double> row;
        for (std::string field; std::getline(fields, field, ',');)
            row.push_back(std::stod(field));
        rows.push_back(row);
    }
    return rows;
}

/// Runs an experiment that is written as text into a folder, and gives its summary.
Value trace_into(fs::path const& out, std::string const& experiment, std::vector<std::string> const& set = {},
                 fs::path const& folder = {}) {
    Folder const scratch;
    fs::path const file = (folder.empty() ? scratch.path() : folder) / "light.toml";
    std::ofstream(file, std::ios::binary) << experiment;
    RunOptions options;
    options.out = out;
    RunResult result = run_experiment(load_experiment(file, set), options);
    CHECK(result.failures.empty());
    return std::move(result.summary);
}

std::string const white_wall = "[[detector]]\nname = \"wall\"\nat_mm = [0, 0, 10]\nfacing = [0, 0, -1]\n";
std::string const lamp = "[[source]]\nname = \"lamp\"\nlambertian = {at_mm = [0, 0, 0], toward = [0, 0, 1], "
                         "size_mm = [1, 1], rays = 40000}\n";

} // namespace

TEST_CASE("a Lambertian lamp's far field falls as the cosine, on a rectangle and on a sphere",
          "[detectors]") {
    Folder const folder;
    std::string const far = "far_field = {rings = 18, to_deg = 90}\n";
    Value const summary =
        trace_into(folder.path() / "out", lamp + white_wall +
                                              "size_mm = [1e6, 1e6]\n"
                                              "absorbs = false\n" +
                                              far + "[[detector]]\nname = \"sphere\"\nsphere = true\n" + far);
    for (std::string const name : {"wall", "sphere"}) {
        auto const rows = rows_in(folder.path() / "out" / "detectors" / (name + ".far_field.csv"));
        REQUIRE(rows.size() == 18);
        double sum = 0.0;
        for (auto const& row : rows) {
            double const a = row[0] * std::numbers::pi / 180.0, b = row[1] * std::numbers::pi / 180.0;
            double const power = std::sin(b) * std::sin(b) - std::sin(a) * std::sin(a);
            CAPTURE(name, row[0]);
            CHECK(row[4] ==
                  Approx(power).margin(4.0 * std::sqrt(power / 40000.0))); // four standard errors of a count
            // in the middle of its ring I = cos θ / π, but for the ring's width: 1 − (5°)²/6, 1.3e-3
            double const mean = std::cos(0.5 * (a + b)) / std::numbers::pi;
            CHECK(row[5] == Approx(mean).margin(2e-3 * mean + 4.0 * row[5] / std::sqrt(power * 40000.0)));
            sum += row[4];
        }
        CHECK(sum == Approx(1.0).epsilon(1e-6)); // the wall ends at 89.999°
        CHECK(number_at(summary, {"detectors", name, "far_field", "beyond_W"}) == 0.0);
    }
    // what escapes is counted once, and stays in the ledger as what escapes
    CHECK(number_at(summary, {"detectors", "sphere", "power_W"}) ==
          number_at(summary, {"energy_W", "escaped"}));
}

TEST_CASE("azimuth runs from up × axis to up", "[detectors]") {
    Folder const folder;
    trace_into(folder.path() / "out",
               "[[source]]\nname = \"r\"\nrays = [[0, 0, 0, 1, 0.1, 1], [0, 0, 0, -0.1, 1, 1]]\n"
               "[[detector]]\nname = \"s\"\nsphere = true\n"
               "far_field = {axis = [0, 0, 1], up = [0, 1, 0], rings = 2, to_deg = 90, sectors = 4}\n");
    auto const rows = rows_in(folder.path() / "out" / "detectors" / "s.far_field.csv");
    REQUIRE(rows.size() == 8);
    for (std::size_t i = 0; i < 8; ++i)
        CHECK(rows[i][4] == (i == 4 || i == 5 ? 0.5 : 0.0)); // beyond 45°; azimuth 5.7° and 95.7°
}

TEST_CASE("the encircled energy of a uniform disk grows as the square of the radius", "[detectors]") {
    Folder const folder;
    Value const summary =
        trace_into(folder.path() / "out",
                   "[[source]]\nname = \"beam\"\nbeam = {from_mm = [3, -2, 0], toward = [0, 0, 1], "
                   "radius_mm = 4, pattern = \"sobol\", rays = 40000}\n" +
                       white_wall + "size_mm = [30, 30]\nspot = true\n");
    auto const rows = rows_in(folder.path() / "out" / "detectors" / "wall.spot.csv");
    REQUIRE(rows.size() == 100);
    for (auto const& row : rows) // the discrepancy of 40 000 Sobol points, some 3e-4 of the power, twice
        CHECK(row[1] * row[1] / 16.0 == Approx(row[0]).margin(1e-3));
    CHECK(number_at(summary, {"detectors", "wall", "encircled_mm", "50"}) == rows[49][1]);
    CHECK(number_at(summary, {"detectors", "wall", "encircled_mm", "100"}) == rows[99][1]);
}

TEST_CASE("a detector sees the colour of the source", "[detectors]") {
    auto const check = [](std::string const& spectrum, double x, double y) {
        std::string const beam =
            "[[source]]\nname = \"b\"\nbeam = {from_mm = [0, 0, 0], toward = [0, 0, 1]}\n";
        Value const summary = summarise(beam + spectrum + white_wall + "size_mm = [9, 9]\nspectrum = true\n");
        // 1e-4: the four digits that are printed; 80 bins of 5 nm give the fifth
        CHECK(number_at(summary, {"detectors", "wall", "colour", "xy", "0"}) == Approx(x).margin(1e-4));
        CHECK(number_at(summary, {"detectors", "wall", "colour", "xy", "1"}) == Approx(y).margin(1e-4));
    };
    check("spectrum = {illuminant = \"D65\", bins = 80}\n", 0.3127, 0.3290);
    check("spectrum = {black_body_K = 6500, bins = 80}\n", 0.3135, 0.3237);
    Value const green =
        summarise("[[source]]\nname = \"b\"\nbeam = {from_mm = [0, 0, 0], toward = [0, 0, 1]}\n"
                  "wavelengths_nm = [555]\n" +
                  white_wall + "size_mm = [9, 9]\nspectrum = true\n");
    CHECK(number_at(green, {"detectors", "wall", "colour", "XYZ_lm", "1"}) == Approx(683.0)); // of one watt
}

TEST_CASE("the optical path's histogram has the paths of a plate's beams", "[detectors]") {
    // a ray through 3 mm of n = 2, at normal incidence: T², and T² R² after two more passes, …; R = 1/9
    Folder const folder;
    Value const summary = trace_into(
        folder.path() / "out",
        "[medium]\nglass = {n = 2}\n[trace]\nmin_power = 1e-3\n[[object]]\nname = \"plate\"\nmedium = "
        "\"glass\"\n"
        "shape = {box = {size_mm = [9, 9, 3]}}\n[[source]]\nname = \"r\"\nrays = [[0, 0, -10, 0, 0, 1]]\n" +
            white_wall + "size_mm = [9, 9]\noptical_path = 2\n");
    auto const rows = rows_in(folder.path() / "out" / "detectors" / "wall.optical_path.csv");
    REQUIRE(rows.size() == 2);
    double const t2 = 64.0 / 81.0;
    CHECK(rows[0][0] == Approx(17.0 + 6.0));
    CHECK(rows[1][1] == Approx(17.0 + 18.0));
    CHECK(rows[0][2] == Approx(t2));
    CHECK(rows[1][2] == Approx(t2 / 81.0));
    CHECK(number_at(summary, {"detectors", "wall", "optical_path", "longest_mm"}) == Approx(35.0));
}

TEST_CASE("a named surface counts what arrives at it, from the side that is asked for", "[detectors]") {
    std::string const scene =
        "[medium]\nglass = {n = 2}\n[trace]\nmin_power = 1e-3\n[[object]]\nname = \"plate\"\nmedium = "
        "\"glass\"\n"
        "shape = {box = {size_mm = [9, 9, 3]}}\n[[source]]\nname = \"r\"\nrays = [[1, 2, -10, 0, 0, 1]]\n";
    auto const face = [](std::string const& name, std::string const& surface, std::string const& from) {
        return "[[detector]]\nname = \"" + name + "\"\nsurface = \"" + surface + "\"\nfrom = \"" + from +
               "\"\n";
    };
    Value const summary =
        summarise(scene + face("in", "plate.back", "outside") + face("out", "plate.front", "inside") +
                  face("both", "plate.back", "both") + face("none", "plate.left", "both"));
    auto const power = [&](char const* name) { return number_at(summary, {"detectors", name, "power_W"}); };
    double const t = 8.0 / 9.0, r = 1.0 / 9.0;
    CHECK(power("in") == 1.0);
    CHECK(power("out") == Approx(t + t * r * r)); // the next is below the cut
    CHECK(power("both") == Approx(1.0 + t * r + t * r * r * r));
    CHECK(power("none") == 0.0);
    CHECK(number_at(summary, {"detectors", "in", "centroid_mm", "0"}) == Approx(1.0));
    CHECK(number_at(summary, {"detectors", "in", "centroid_mm", "1"}) == Approx(2.0));
    CHECK(number_at(summary, {"energy_W", "detected"}) == 0.0);
    CHECK_THROWS_AS(summarise(scene + face("x", "plate.rear", "both")), InputError);
}

TEST_CASE("a sphere of some radius counts where light passes it, what starts outside it not", "[detectors]") {
    Folder const folder;
    trace_into(folder.path() / "out",
               "[[source]]\nname = \"r\"\nrays = [[3, 0, 0, 0, 0, 1], [9, 0, 0, -1, 0, 0]]\n"
               "[[detector]]\nname = \"s\"\nsphere = true\nradius_mm = 5\nfar_field = {rings = "
               "180}\noptical_path = 1\n");
    auto const rows = rows_in(folder.path() / "out" / "detectors" / "s.far_field.csv");
    for (std::size_t i = 0; i < rows.size(); ++i) // seen from the centre under asin 3/5 = 36.87°
        CHECK(rows[i][4] == (i == 36 ? 0.5 : 0.0));
    CHECK(rows_in(folder.path() / "out" / "detectors" / "s.optical_path.csv")[0][0] == Approx(4.0));
}

TEST_CASE("a bound is no wider than what was cut and lost, and holds the truth", "[detectors]") {
    std::string const scene =
        "[medium]\nglass = {n = 2}\n[[object]]\nname = \"plate\"\nmedium = \"glass\"\n"
        "shape = {box = {size_mm = [9, 9, 3]}}\n[[source]]\nname = \"r\"\n"
        "rays = [[0, 0, -10, 0, 0, 1]]\n[[detector]]\nname = \"sphere\"\nsphere = true\n" +
        white_wall + "size_mm = [9, 9]\n";
    double const truth = (8.0 / 9.0) / (1.0 + 1.0 / 9.0); // T² / (1 − R²)
    for (std::string const share : {"0.5", "1e-2", "1e-4", "1e-9"}) {
        Value const summary = summarise(scene, {"trace.min_power=" + share});
        double const lost =
            number_at(summary, {"energy_W", "cut"}) + number_at(summary, {"energy_W", "error"});
        for (auto const& [name, expected] : {std::pair{"wall", truth}, std::pair{"sphere", 1.0 - truth}}) {
            double const low = number_at(summary, {"detectors", name, "power_bound_W", "0"}),
                         high = number_at(summary, {"detectors", name, "power_bound_W", "1"});
            CAPTURE(share, name, low, high);
            CHECK(high - low <= lost * (1.0 + 1e-12) + 1e-15);
            CHECK(low <= expected + 1e-15);
            CHECK(high >= expected - 1e-15);
        }
    }
}

TEST_CASE("over 400 seeds the truth lies within one sigma as often as it should", "[detectors][slow]") {
    // rays that are all alike but for the draws of the roulette
    std::string const scene =
        "[medium]\nglass = {n = 2}\n[trace]\nbranch = \"roulette\"\nsplit_until = 1\n"
        "min_power = 0\n[[object]]\nname = \"plate\"\nmedium = \"glass\"\n"
        "shape = {box = {size_mm = [90, 90, 3]}}\n[[source]]\nname = \"r\"\n"
        "beam = {from_mm = [0, 0, -10], toward = [0.6, 0, 1], radius_mm = 1, rays = 2000}\n" +
        white_wall + "size_mm = [90, 90]\n";
    double const truth = number_at(
        summarise(scene, {"trace.branch=\"split\"", "source.r.beam.rays=1", "trace.min_power=1e-15"}),
        {"detectors", "wall", "power_W"});
    int within = 0;
    for (int seed = 1; seed <= 400; ++seed) {
        Value const summary = summarise(scene, {"trace.seed=" + std::to_string(seed)});
        double const sigma = number_at(summary, {"detectors", "wall", "sigma_W"});
        REQUIRE(sigma > 0.0);
        within += std::abs(number_at(summary, {"detectors", "wall", "power_W"}) - truth) <= sigma;
    }
    CAPTURE(within);
    CHECK(within >= 252); // 68.3 % ± 5 %: two standard errors of 400 draws
    CHECK(within <= 292);
}

TEST_CASE("keys that have no meaning for a kind of detector are refused", "[detectors]") {
    auto const refused = [](std::string const& detector) {
        CAPTURE(detector);
        CHECK_THROWS_AS(summarise(lamp + "[[detector]]\nname = \"d\"\n" + detector), InputError);
    };
    refused("");
    refused("size_mm = [1, 1]\n");
    refused("size_mm = [1, 1]\nat_mm = [0, 0, 0]\n");
    refused("sphere = false\n");
    refused("sphere = true\nsize_mm = [1, 1]\n");
    refused("sphere = true\npixels = [4, 4]\n");
    refused("sphere = true\nat_mm = [0, 0, 0]\n");
    refused("sphere = true\nspot = true\n");
    refused("surface = \"lamp\"\n");
    refused("sphere = true\nfar_field = {rings = 18000, sectors = 36000}\n");
    refused("sphere = true\nfar_field = {axis = [0, 0, 0]}\n");
    refused("sphere = true\nfar_field = {axis = [0, 0, 1], up = [0, 0, 2]}\n");
}
