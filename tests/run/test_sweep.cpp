// Sweeps and goals: what is run, that it is the same however it is run, and that a sweep that was killed goes
// on.
#include "support/catch.h"
#include "support/experiments.h"

#include "math/input_error.h"
#include "run/run.h"
#include "run/sha256.h"
#include "run/sweep.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <unistd.h>

using namespace sahl;
namespace fs = std::filesystem;

namespace {

struct Scratch {
    fs::path path = fs::temp_directory_path() / ("sahl-test-sweep-" + std::to_string(::getpid()));
    Scratch() {
        fs::remove_all(path);
        fs::create_directories(path);
    }
    ~Scratch() { fs::remove_all(path); }
};

std::string const bench = R"(
medium.glass = {n = 1.6}
[[object]]
name = "prism"
shape = {prism = {apex_deg = 60, side_mm = 25, length_mm = 25}}
medium = "glass"
faces = {base = "wall"}
turn_deg = [0, 0, -25]
[surface]
wall = {absorb = true}
[[source]]
name = "laser"
beam = {from_mm = [-50, 0, 0], toward = [1, 0, 0], radius_mm = 0.5, pattern = "hexagonal", rays = 7}
wavelengths_nm = [500]
[[detector]]
name = "screen"
at_mm = [60, 0, 0]
facing = [-1, 0, 0]
size_mm = [400, 400]
[trace]
branch = "dominant"
)";

/// Of `bench` and what is added to it.
ExperimentSource experiment(Scratch const& scratch, std::string const& more,
                            std::vector<std::string> const& set = {}) {
    std::ofstream(scratch.path / "bench.toml") << bench << more;
    return load_experiment(scratch.path / "bench.toml", set);
}

std::string bytes_of(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    REQUIRE(in.good());
    return {std::istreambuf_iterator<char>(in), {}};
}

RunResult run(ExperimentSource const& source, fs::path const& out, unsigned threads = 2) {
    RunOptions options;
    options.out = out;
    options.threads = threads;
    return run_experiment(source, options);
}

std::string fault_of(Scratch const& scratch, std::string const& more) {
    try {
        run(experiment(scratch, more), scratch.path / "out");
    } catch (InputError const& error) {
        return error.what();
    }
    return {};
}

double number_in(Value const* value) {
    REQUIRE(value);
    return std::get<double>(value->data);
}

constexpr char const* two_keys = R"(
[sweep]
"object.prism.turn_deg[2]" = {from = -30, to = -20, steps = 3}
"source.laser.beam.rays" = [1, 7]
)";

} // namespace

TEST_CASE("a sweep of two keys runs the whole grid, the last key first") {
    Scratch const scratch;
    run(experiment(scratch, two_keys), scratch.path / "out");
    auto const columns = bench::read_sweep(scratch.path / "out" / "sweep.csv");
    CHECK(columns.at("object.prism.turn_deg[2]") == std::vector<double>{-30, -30, -25, -25, -20, -20});
    CHECK(columns.at("source.laser.beam.rays") == std::vector<double>{1, 7, 1, 7, 1, 7});
    CHECK(columns.at("rays") == std::vector<double>{1, 7, 1, 7, 1, 7});
    std::string const page = bytes_of(scratch.path / "out" / "report.html");
    std::size_t const swept =
        page.find(R"("sweep":{"keys":["object.prism.turn_deg[2]","source.laser.beam.rays"])");
    REQUIRE(swept != std::string::npos);
    std::string_view const row_begins = R"({"values":[)";
    std::size_t rows = 0;
    for (auto at = page.find(row_begins, swept); at != std::string::npos; at = page.find(row_begins, at + 1))
        ++rows;
    CHECK(rows == 6);
    CHECK(fs::exists(scratch.path / "out" / "runs" / "005" / "report.html"));
}

TEST_CASE("zipped keys go together, and need lists of one length") {
    Scratch const scratch;
    std::string const zip = "[sweep]\nmode = \"zip\"\n\"object.prism.medium\" = [\"N-BK7\", \"N-SF11\"]\n";
    run(experiment(scratch, zip + "\"source.laser.beam.rays\" = [1, 7]\n"), scratch.path / "out");
    std::string const csv = bytes_of(scratch.path / "out" / "sweep.csv");
    CHECK(csv.find("\nN-BK7,1,") != std::string::npos);
    CHECK(csv.find("\nN-SF11,7,") != std::string::npos);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 3);
    CHECK(fault_of(scratch, zip + "\"source.laser.beam.rays\" = [1, 7, 19]\n")
              .find("source.laser.beam.rays has 3 values, object.prism.medium has 2") != std::string::npos);
}

TEST_CASE("the same sweep gives the same table whatever the threads") {
    Scratch const scratch;
    ExperimentSource const source = experiment(scratch, two_keys);
    for (char const* threads : {"1", "2", "7"})
        run(source, scratch.path / threads, static_cast<unsigned>(std::stoi(threads)));
    for (char const* file : {"sweep.csv", "runs/003/detectors/screen.csv"})
        for (char const* threads : {"2", "7"})
            CHECK(bytes_of(scratch.path / "1" / file) == bytes_of(scratch.path / threads / file));
}

TEST_CASE("a sweep that was killed keeps its complete runs, and one of something else does not") {
    Scratch const scratch;
    ExperimentSource const source = experiment(scratch, two_keys);
    fs::path const out = scratch.path / "out", partial = scratch.path / "out.partial";
    struct Killed {};
    RunOptions options;
    options.out = out;
    options.threads = 1;
    options.sweep_progress = [](std::size_t done, std::size_t) {
        if (done == 3)
            throw Killed{};
    };
    CHECK_THROWS_AS(run_experiment(source, options), Killed);
    CHECK_FALSE(fs::exists(out));
    REQUIRE(fs::exists(partial / "runs" / "002" / "summary.json"));
    fs::remove_all(partial / "runs" / "001"); // of what stands there any part may be complete
    std::ofstream(partial / "runs" / "002" / "mark") << "kept";
    SECTION("the same again") {
        run(source, out);
        CHECK(fs::exists(out / "runs" / "002" / "mark"));
        run(source, scratch.path / "whole");
        CHECK(bytes_of(out / "sweep.csv") == bytes_of(scratch.path / "whole" / "sweep.csv"));
        CHECK_FALSE(fs::exists(out / "unfinished.json"));
    }
    SECTION("another setting") {
        run(experiment(scratch, two_keys, {"trace.seed=2"}), out);
        CHECK_FALSE(fs::exists(out / "runs" / "002" / "mark"));
    }
    CHECK_FALSE(fs::exists(partial));
}

TEST_CASE("an unknown key or a value of the wrong kind in a sweep is found before anything is written") {
    Scratch const scratch;
    CHECK(fault_of(scratch, "[sweep]\n\"object.prsm.turn_deg[2]\" = [1]\n").find("prism") !=
          std::string::npos);
    CHECK(fault_of(scratch, "[sweep]\n\"source.laser.beam.rays\" = [7, 1.5]\n").find("bench.toml:") !=
          std::string::npos);
    CHECK(fault_of(scratch, "[sweep]\nmod = \"zip\"\n").find("mode") != std::string::npos);
    CHECK(fault_of(scratch, "[sweep]\n\"trace.seed\" = [1]\n[goal]\nmaximise = \"rays\"\nvary = {}\n")
              .find("beside a goal") != std::string::npos);
    CHECK_FALSE(fs::exists(scratch.path / "out"));
    CHECK_FALSE(fs::exists(scratch.path / "out.partial"));
}

TEST_CASE("a goal finds the least deviation of a prism") {
    Scratch const scratch;
    // The beam runs along +x: its deviation is least where the x of its direction is greatest.
    RunResult const result = run(experiment(scratch, R"(
[goal]
maximise = "detectors.screen.mean_direction[0]"
vary = {"object.prism.turn_deg[2]" = {from = -40, to = -10}}
)"),
                                 scratch.path / "out");
    double const degree = std::numbers::pi / 180.0;
    double const least = 2.0 * std::asin(1.6 * std::sin(30.0 * degree)) - 60.0 * degree; // n = 1.6, 60°
    auto const& direction =
        std::get<Array>(result.summary.find("detectors")->find("screen")->find("mean_direction")->data);
    double const deviation = std::atan2(-number_in(&direction[1]), number_in(&direction[0]));
    CHECK(std::abs(deviation - least) < 1e-7 * degree);
    Value const& goal = *result.summary.find("goal");
    // Of the angle no more is known: the change of the figure is below rounding, 1e-8 of a radian and a few
    CHECK(std::abs(number_in(goal.find("at")) + 0.5 * least / degree) < 1e-5);
    auto const table = bench::read_sweep(scratch.path / "out" / "goal.csv");
    CHECK(static_cast<std::int64_t>(table.at("object.prism.turn_deg[2]").size()) ==
          std::get<std::int64_t>(goal.find("runs")->data));
    CHECK(table.at("rays").size() < 60);
}

TEST_CASE("a goal finds the focus of a ball, and where a beam has a given height") {
    Scratch const scratch;
    std::string const ball = R"(
medium.glass = {n = 1.5}
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 10}}
medium = "glass"
[[source]]
name = "beam"
rays = [[-50, 0.001, 0, 1, 0, 0], [-50, -0.001, 0, 1, 0, 0]]
wavelengths_nm = [500]
[[detector]]
name = "screen"
at_mm = [20, 0, 0]
facing = [-1, 0, 0]
size_mm = [4, 4]
[trace]
branch = "dominant"
)";
    auto const at = [&](std::string const& goal) {
        std::ofstream(scratch.path / "ball.toml") << ball << goal;
        RunResult const result = run(load_experiment(scratch.path / "ball.toml"), scratch.path / "out");
        return number_in(result.summary.find("goal")->find("at"));
    };
    // Paraxial focus at n R / (2 (n − 1)) = 15 mm; rays at h = 1 µm cross before it by order h²/R = 1e-7 mm
    CHECK(std::abs(at("[goal]\nminimise = \"detectors.screen.rms_radius_mm\"\n"
                      "vary = {\"detector.screen.at_mm[0]\" = {from = 11, to = 25}}\n") -
                   15.0) < 1e-6);
    // From the focus on the radius grows as 1 µm × (x − 15 mm) / (15 mm): 0.5 µm is reached at 22.5 mm
    CHECK(std::abs(at("[goal]\nreach = \"detectors.screen.rms_radius_mm\"\nvalue = 0.0005\n"
                      "vary = {\"detector.screen.at_mm[0]\" = {from = 16, to = 30}}\n") -
                   22.5) < 1e-6);
}

TEST_CASE("a goal at an end of its search, or at a jump, is come to with a warning") {
    Scratch const scratch;
    std::string const lamp = R"(
[[source]]
name = "beam"
rays = [[0, 0, 0, 0, 0, 1]]
[[detector]]
name = "screen"
at_mm = [0, 0, 20]
facing = [0, 0, -1]
size_mm = [4, 4]
)";
    auto const warnings = [&](std::string const& goal) {
        std::ofstream(scratch.path / "lamp.toml") << lamp << goal;
        RunResult const result = run(load_experiment(scratch.path / "lamp.toml"), scratch.path / "out");
        return to_json(*result.summary.find("warnings"));
    };
    std::string const path = "\"detectors.screen.mean_optical_path_mm\"\n",
                      vary = "vary = {\"detector.screen.at_mm[2]\" = {from = 11, to = 25}}\n";
    CHECK(warnings("[goal]\nminimise = " + path + vary).find("at the end of the search") !=
          std::string::npos);
    CHECK(warnings("[goal]\nreach = " + path + "value = 17\n" + vary) == "[]");
    CHECK(warnings("[goal]\nreach = \"detectors.screen.power_W\"\nvalue = 0.5\n"
                   "vary = {\"detector.screen.at_mm[0]\" = {from = -1, to = 9}}\n")
              .find("jumps over 0.5") != std::string::npos);
}

TEST_CASE("a goal that cannot be come to says why and writes nothing") {
    Scratch const scratch;
    std::string const vary = "vary = {\"object.prism.turn_deg[2]\" = {from = -40, to = -10}}\n";
    CHECK(fault_of(scratch, "[goal]\nminimise = \"detectors.screen.powr_W\"\n" + vary).find("power_W") !=
          std::string::npos);
    CHECK(fault_of(scratch, "[goal]\nreach = \"energy_W.emitted\"\nvalue = 3\n" + vary)
              .find("does not pass 3.0") != std::string::npos);
    CHECK(fault_of(scratch, "[goal]\nreach = \"energy_W.emitted\"\n" + vary).find("value") !=
          std::string::npos);
    CHECK_FALSE(fs::exists(scratch.path / "out"));
}

TEST_CASE("a catalogue that changes makes another experiment, and no resumed sweep") {
    Scratch const scratch;
    auto const write = [&](char const* index) {
        std::ofstream(scratch.path / "my.agf")
            << "NM MINE 2 0 1.5 50\nCD " << index << " 0 0 0 0 0\nLD 0.3 2\n";
    };
    auto const source = [&] {
        return experiment(scratch, "[sweep]\n\"object.prism.turn_deg[2]\" = [-25, -20]\n",
                          {"catalogues=[\"my.agf\"]", "object.prism.medium=\"MINE\""});
    };
    write("1.25");
    std::string const sum = experiment_sha256(source()), identity = sweep_identity(source());
    CHECK(experiment_sha256(source()) == sum);
    write("1.26");
    CHECK(experiment_sha256(source()) != sum);
    CHECK(sweep_identity(source()) != identity);
    ExperimentSource const plain = experiment(scratch, "");
    CHECK(experiment_sha256(plain) == sha256(plain.text)); // without one: of the file
}
