// Detectors of every kind in whole experiments, against closed forms.
#include "math/input_error.h"
#include "run/run.h"
#include "scene/read_table.h"
#include "support/bench.h"
#include "support/catch.h"

#include <algorithm>
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

TEST_CASE("a named surface counts also where another body or a mirror decides what happens", "[detectors]") {
    auto const scene = [](double second) {
        return "[medium]\nfirst = {n = 2, absorption_per_mm = 0.1}\nsecond = {n = " + std::to_string(second) +
               ", absorption_per_mm = 0.1}\n[trace]\nmin_power = 1e-3\n"
               "[[object]]\nname = \"a\"\nmedium = \"first\"\nshape = {box = {size_mm = [9, 9, 3]}}\n"
               "[[object]]\nname = \"b\"\nmedium = \"second\"\nshape = {box = {size_mm = [9, 9, 3]}}\n"
               "move_mm = [0, 0, 3]\n"
               "[[source]]\nname = \"r\"\nrays = [[1, 2, -1, 0, 0, 1]]\n" // inside the first
               "[[detector]]\nname = \"out\"\nsurface = \"a.front\"\nfrom = \"inside\"\noptical_path = 1\n"
               "[[detector]]\nname = \"in\"\nsurface = \"b.back\"\nfrom = \"outside\"\n"
               "[[detector]]\nname = \"end\"\nsurface = \"b.front\"\nfrom = \"inside\"\n";
    };
    auto const power = [](Value const& summary, char const* name) {
        return number_at(summary, {"detectors", name, "power_W"});
    };
    double const arrives = std::exp(-0.25); // 2.5 mm of the first
    Value const unlike = summarise(scene(1.0), {"trace.max_depth=0"});
    CHECK(power(unlike, "out") == Approx(arrives));
    CHECK(power(unlike, "in") == Approx(arrives));
    CHECK(number_at(unlike, {"detectors", "out", "optical_path", "longest_mm"}) == Approx(5.0));

    Value const mirrored = summarise(
        scene(1.0) + "[surface]\nsilver = {reflect = 1}\n[[object]]\nname = \"m\"\nsurface = \"silver\"\n"
                     "shape = {disk = {radius_mm = 4}}\nmove_mm = [0, 0, 1.5]\n",
        {"trace.max_depth=0"});
    CHECK(power(mirrored, "out") == Approx(arrives));
    CHECK(power(mirrored, "end") == 0.0);

    std::string const one_medium = scene(2.0); // no event, and yet it is where the light comes by
    std::string same = one_medium;
    same.replace(same.find("medium = \"second\""), 17, "medium = \"first\"");
    Value const silent = summarise(same, {"trace.max_depth=0"});
    CHECK(power(silent, "out") == Approx(arrives));
    CHECK(power(silent, "in") == Approx(arrives));
    CHECK(power(silent, "end") == Approx(std::exp(-0.55)));
    CHECK(number_at(silent, {"detectors", "out", "optical_path", "longest_mm"}) == Approx(5.0));
}

TEST_CASE("what comes by wavelength adds up, however near to each other the wavelengths are", "[detectors]") {
    std::string const beam = "beam = {from_mm = [0, 0, 0], toward = [0, 0, 1]}\n";
    auto const sum = [](Value const& summary, std::size_t count) {
        auto const& table =
            std::get<Table>(summary.find("detectors")->find("wall")->find("by_wavelength")->data);
        CHECK(table.size() == count);
        double power = 0.0;
        std::vector<std::string> names;
        for (auto const& [name, figures] : table) {
            CHECK(std::find(names.begin(), names.end(), name) == names.end());
            names.push_back(name);
            power += number_in(*figures.find("power_W"));
        }
        return power;
    };
    std::string const wall = white_wall + "size_mm = [9, 9]\n";
    // bins and a list that mean the same wavelengths
    Value const alike = summarise("[[source]]\nname = \"a\"\n" + beam +
                                  "spectrum = \"D65\"\n[[source]]\nname = "
                                  "\"b\"\n" +
                                  beam +
                                  "spectrum = {illuminant = \"D65\", from_nm = 380, to_nm = "
                                  "580, bins = 20}\n[[source]]\nname = \"c\"\n" +
                                  beam + "wavelengths_nm = [395, 415, 455]\n" + wall);
    CHECK(sum(alike, 40) == Approx(3.0));
    Value const near =
        summarise("[[source]]\nname = \"a\"\n" + beam + "wavelengths_nm = [500, 500.00000000001]\n" + wall);
    CHECK(sum(near, 2) == Approx(1.0));
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

namespace {

/// How many of 400 seeds have the truth within one sigma of the power on "wall".
int within_one_sigma(std::string const& scene, double truth) {
    int within = 0;
    for (int seed = 1; seed <= 400; ++seed) {
        Value const summary = summarise(scene, {"trace.seed=" + std::to_string(seed)});
        double const sigma = number_at(summary, {"detectors", "wall", "sigma_W"});
        REQUIRE(sigma > 0.0);
        within += std::abs(number_at(summary, {"detectors", "wall", "power_W"}) - truth) <= sigma;
    }
    return within;
}

} // namespace

TEST_CASE("over 400 seeds the truth lies within one sigma as often as it should", "[detectors][slow]") {
    // 68.3 % ± 5 %: two standard errors of 400 draws
    SECTION("of rays that are all alike but for the draws of the roulette") {
        std::string const scene =
            "[medium]\nglass = {n = 2}\n[trace]\nbranch = \"roulette\"\nsplit_until = 1\n"
            "min_power = 0\n[[object]]\nname = \"plate\"\nmedium = \"glass\"\n"
            "shape = {box = {size_mm = [90, 90, 3]}}\n[[source]]\nname = \"r\"\n"
            "beam = {from_mm = [0, 0, -10], toward = [0.6, 0, 1], radius_mm = 1, rays = 2000}\n" +
            white_wall + "size_mm = [90, 90]\n";
        double const truth = number_at(
            summarise(scene, {"trace.branch=\"split\"", "source.r.beam.rays=1", "trace.min_power=1e-15"}),
            {"detectors", "wall", "power_W"});
        int const within = within_one_sigma(scene, truth);
        CAPTURE(within);
        CHECK(within >= 252);
        CHECK(within <= 292);
    }
    SECTION("of rays that hit a ball here and there, most of them beside the detector") {
        std::string const scene =
            "[medium]\nglass = {n = 1.5}\n[trace]\nbranch = \"roulette\"\nsplit_until = 1\nmin_power = 0\n"
            "[[object]]\nname = \"ball\"\nmedium = \"glass\"\nshape = {sphere = {radius_mm = 6}}\n"
            "[[source]]\nname = \"r\"\nbeam = {from_mm = [0, 0, -20], toward = [0.1, 0.2, 1], radius_mm = 5, "
            "pattern = \"hexagonal\", rays = 6000}\n"
            "[[detector]]\nname = \"wall\"\nat_mm = [3, 0, 40]\nfacing = [0, 0, -1]\nsize_mm = [12, 12]\n";
        double const truth = number_at(summarise(scene, {"trace.branch=\"split\"", "trace.min_power=1e-15"}),
                                       {"detectors", "wall", "power_W"});
        int const within = within_one_sigma(scene, truth);
        CAPTURE(within);
        CHECK(within >= 252);
        CHECK(within <= 292);
    }
    SECTION("of light that a white wall scatters") { // split, but where it goes is drawn
        std::string const scene =
            "surface.white = {diffuse = 0.8}\n[[object]]\nname = \"screen\"\nsurface = \"white\"\n"
            "shape = {rectangle = {size_mm = [500, 500]}}\n[[source]]\nname = \"r\"\n"
            "beam = {from_mm = [0, 0, -5], toward = [0, 0, 1], radius_mm = 1e-9, rays = 300}\n"
            "[[detector]]\nname = \"wall\"\nat_mm = [0, 0, -10]\nfacing = [0, 0, 1]\nsize_mm = [20, 20]\n";
        // the form factor of a square, seen from the point below its middle, half its side away
        double const truth = 0.8 * 4.0 / std::numbers::pi * std::sqrt(0.5) * std::atan(std::sqrt(0.5));
        int const within = within_one_sigma(scene, truth);
        CAPTURE(within);
        CHECK(within >= 252);
        CHECK(within <= 292);
    }
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
