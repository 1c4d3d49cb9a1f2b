// What pilots say of polarisation and of dispersion beforehand, held against closed forms.
#include "run/check.h"
#include "run/pilots.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

#include <algorithm>
#include <fstream>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double n = 1.6;

/// Plates 1 mm thick at Brewster's angle to light along +z, parallel or the second one crossed.
std::string plates(int count, bool crossed, char const* source, bool detector) {
    std::string experiment = text("[medium]\nglass = {n = ", n,
                                  "}\n[[source]]\nname = 'laser'\nbeam = {from_mm = "
                                  "[0.1, 0.2, -500], toward = [0, 0, 1]}\n",
                                  source, "\n");
    double const tilt = degrees(std::atan(n));
    for (int i = 0; i < count; ++i)
        experiment += text("[[object]]\nname = 'plate ", i,
                           "'\nmedium = 'glass'\nshape = {box = {size_mm = [900, 900, 1]}}\n"
                           "turn_deg = [",
                           tilt, ", 0, ", i == 1 && crossed ? 90 : 0, "]\nmove_mm = [0, 0, ",
                           i * (crossed ? 2000 : 3), "]\n");
    if (detector)
        experiment +=
            "[[detector]]\nname = 'screen'\nat_mm = [0, 0, 5000]\nfacing = [0, 0, -1]\nsize_mm = [50, 50]\n";
    return experiment + "[trace]\nmin_power = 1e-9\ntolerance_power = 1e-6\n";
}

std::vector<std::string> warnings_of(Value const& summary) {
    std::vector<std::string> warnings;
    for (Value const& warning : std::get<Array>(summary.find("warnings")->data))
        warnings.push_back(std::get<std::string>(warning.data));
    return warnings;
}

double shift_of(Value const& summary, std::string const& what) {
    for (Value const& move : std::get<Array>(summary.find("pilots")->find("polarisation")->data))
        if (std::get<std::string>(move.find("what")->data) == what)
            return number_at(move, {"share"});
    FAIL("the pilots tell nothing of " << what);
    return 0.0;
}

double shift_of_screen(std::string const& experiment) {
    return shift_of(summarise(experiment), "detector screen");
}

Value check_of(std::string const& experiment, std::vector<std::string> const& set = {}) {
    Folder const folder;
    std::ofstream(folder.path() / "e.toml") << experiment;
    return check_experiment(load_experiment(folder.path() / "e.toml", set));
}

} // namespace

// Of one plate at Brewster's angle s passes by (1 − r) / (1 + r), p whole; the mean of s and p at each
// surface, m = r / 2, gives (1 − m) / (1 + m) instead. Of two in line the same with 1 + 3 r, and of two that
// are crossed each passes whole at one of them. What pilots cut is below 1e-4 of it.
TEST_CASE("pilots tell how far a detector's power would move, as the closed forms for plates say") {
    double const r = reflectances(1.0, n, std::atan(n)).first, mean = 0.5 * r;
    double const one = (1.0 - r) / (1.0 + r), one_mean = (1.0 - mean) / (1.0 + mean);
    auto const moves = [](double truth, double traced) {
        return Approx((truth - traced) / traced).margin(1e-4);
    };
    CHECK(shift_of_screen(plates(1, false, "", true)) == moves(0.5 * (1.0 + one), one_mean));
    CHECK(shift_of_screen(plates(2, false, "", true)) ==
          moves(0.5 * (1.0 + (1.0 - r) / (1.0 + 3.0 * r)), (1.0 - mean) / (1.0 + 3.0 * mean)));
    CHECK(shift_of_screen(plates(2, true, "", true)) == moves(one, one_mean * one_mean));
    CHECK(shift_of_screen(plates(1, false, "polarisation = {stokes = [1, 1, 0, 0], axis = [1, 0, 0]}",
                                 true)) == moves(one, one_mean));
    CHECK(shift_of_screen(plates(1, false, "polarisation = {stokes = [1, 1, 0, 0], axis = [0, 1, 0]}",
                                 true)) == moves(1.0, one_mean));
}

TEST_CASE("a warning names the detector, the way and the figure, and below the tolerance there is none") {
    std::string const experiment = plates(2, false, "", true);
    auto const warnings = warnings_of(summarise(experiment));
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].starts_with("detector screen: with s and p kept apart its power would rise by about"));
    double const percent = 100.0 * shift_of_screen(experiment);
    CHECK(std::stod(warnings[0].substr(warnings[0].find("about") + 6)) == Approx(percent).epsilon(0.05));
    CHECK(warnings_of(summarise(experiment, {"trace.tolerance_power=0.5"})).empty());
    CHECK(warnings_of(summarise(experiment, {"trace.polarised=false"})).empty());
    auto const checked = warnings_of(check_of(experiment));
    CHECK(std::find(checked.begin(), checked.end(), warnings[0]) != checked.end());
}

TEST_CASE("without a detector pilots tell of what escapes and of what is absorbed") {
    double const r = reflectances(1.0, n, std::atan(n)).first, mean = 0.5 * r;
    Value const summary = summarise(plates(1, false, "", false));
    double const truth = 0.5 * (1.0 + (1.0 - r) / (1.0 + r)), traced = (1.0 - mean) / (1.0 + mean);
    CHECK(shift_of(summary, "light that escapes refracted at plate 0.front") ==
          Approx(truth - traced).epsilon(1e-4));
    auto const warnings = warnings_of(summary);
    CHECK(std::any_of(warnings.begin(), warnings.end(), [](std::string const& warning) {
        return warning.starts_with("light that escapes refracted at plate 0.front") &&
               warning.find("of what is emitted") != std::string::npos;
    }));
    // one surface alone, met by unpolarised light, sorts it and nothing asks how
    CHECK(warnings_of(
              summarise("[surface]\nm = {metal = 'silver'}\n[[object]]\nname = 'mirror'\nsurface = 'm'\n"
                        "shape = {rectangle = {size_mm = [9, 9]}}\n[[source]]\nname = 'laser'\n"
                        "beam = {from_mm = [-5, 0, 5], toward = [1, 0, -1]}\n"))
              .empty());
}

namespace {

std::string prism(char const* glass) {
    return text(
        "[[object]]\nname = 'prism'\nmedium = ", glass,
        "\nshape = {prism = {apex_deg = 30, side_mm = 30, length_mm = 30}}\n[[source]]\nname = 'lamp'\n"
        "beam = {from_mm = [-50, 0, 0], toward = [1, 0, 0]}\nlines = ['F', 'd', 'C']\n",
        "[trace]\nmin_power = 0.02\npolarised = false\n");
}

} // namespace

// The prism's left face leans by 15°, and so does its right one; through both, by Snell at each.
TEST_CASE("dispersion is the angle between the wavelengths' ways, and a note says where there is none") {
    double const turn = number_at(summarise(prism("'N-SF11'")), {"pilots", "dispersion", "lamp", "turn_rad"});
    auto const leaves = [](double index) {
        double const lean = radians(15.0), apex = radians(30.0);
        return std::asin(index * std::sin(apex - std::asin(std::sin(lean) / index)));
    };
    Run const run = bench::run(prism("'N-SF11'"));
    double const direct =
        leaves(index_of(run, "N-SF11", 486.1327)) - leaves(index_of(run, "N-SF11", 656.2725));
    // ways that are reflected within turn further apart; no less than the direct one
    CHECK(direct > 0.005);
    CHECK(turn >= direct * (1.0 - 1e-9));
    CHECK(turn < 20.0 * direct);

    Value const flat = check_of("[medium]\ng = {n = 1.5}\n" + prism("'g'"));
    CHECK(number_at(flat, {"pilots", "dispersion", "lamp", "turn_rad"}) == 0.0);
    auto const& notes = std::get<Array>(flat.find("notes")->data);
    CHECK(std::any_of(notes.begin(), notes.end(), [](Value const& note) {
        return std::get<std::string>(note.data).starts_with(
            "source lamp: its 3 wavelengths take the same ways");
    }));
    CHECK(std::get<Table>(summarise(plates(1, false, "", true)).find("pilots")->find("dispersion")->data)
              .empty());
}
