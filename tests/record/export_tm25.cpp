// Rays on a detector as an IES TM-25 file: what our own reader makes of it are the log's rays, to float.
#include "support/catch.h"
#include "support/gltf.h"

#include "math/input_error.h"
#include "record/export_tm25.h"
#include "run/run.h"
#include "scene/read_sources.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace sahl;
using namespace sahl::bench;
namespace fs = std::filesystem;

namespace {

std::string const ball = R"(
title = "Kugel, größer"
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 5}}
medium = "N-BK7"
[[source]]
name = "beam"
beam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 4, pattern = "hexagonal", rays = 100}
power_W = 3
[[detector]]
name = "screen"
at_mm = [0, 0, 8]
facing = [0, 0, -1]
size_mm = [4, 4]
)";

std::string const second = R"(
[[detector]]
name = "behind"
at_mm = [0, 0, -11]
facing = [0, 0, 1]
size_mm = [40, 40]
)";

/// A run with its log, in a folder of its own.
struct Run {
    TemporaryFolder folder;
    Value summary;

    explicit Run(std::string const& text, std::vector<std::string> set = {}) : folder("tm25") {
        set.push_back("trace.log=true");
        RunOptions options;
        options.out = folder.path / "out";
        summary = run_experiment(load_experiment(folder.write("ball.toml", text), set), options).summary;
    }
    RayLogReader log() const { return RayLogReader(folder.path / "out"); }
    double figure(char const* detector, char const* key) const {
        return std::get<double>(summary.find("detectors")->find(detector)->find(key)->data);
    }
    std::string refused(std::string const& where) const {
        fs::path const file = folder.path / "no.tm25ray";
        try {
            export_tm25(log(), where, file);
        } catch (InputError const& error) {
            CHECK_FALSE(fs::exists(file));
            return error.what();
        }
        return {};
    }
};

bool same(dvec3 const& a, dvec3 const& b) {
    return glm::vec3(a) == glm::vec3(b);
}

} // namespace

TEST_CASE("rays on a detector go out as IES TM-25 and come in again as they were, to float", "[log]") {
    Run const run(ball);
    fs::path const file = run.folder.path / "screen.tm25ray";
    export_tm25(run.log(), "", file);
    RayList const read = read_ray_file(file, {});
    RayLogReader const log = run.log();
    std::vector<Segment> arrived;
    for (Segment const& segment : log.read(0, log.rows()))
        if (segment.ended == Event::detected)
            arrived.push_back(segment);
    REQUIRE(read.rays.size() == arrived.size());
    REQUIRE(arrived.size() > 100);
    for (std::size_t i = 0; i < arrived.size(); ++i) {
        Segment const& segment = arrived[i];
        dvec3 const end = 1e3 * (segment.origin + segment.length * segment.direction);
        CHECK(same(1e3 * read.rays[i].origin, end));
        // the file's floats, made a unit vector again: within half a unit of their last place
        CHECK(length(read.rays[i].direction - segment.direction) < 1.1e-7);
        CHECK(static_cast<float>(read.rays[i].weight) == static_cast<float>(segment.power_end));
    }
    REQUIRE(read.wavelength);
    CHECK(static_cast<float>(*read.wavelength * 1e9) == 587.5618F);
    CHECK(read.power == Approx(run.figure("screen", "power_W")).epsilon(1e-7));
    // written once more, it is the same file
    export_tm25(run.log(), "screen", run.folder.path / "again.tm25ray");
    auto const bytes = [&](char const* name) {
        std::ifstream in(run.folder.path / name, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    CHECK(bytes("screen.tm25ray") == bytes("again.tm25ray"));
    // the title, in characters of four bytes
    std::string const all = bytes("screen.tm25ray");
    std::uint32_t eighth = 0;
    std::memcpy(&eighth, all.data() + 288 + 4 * 9, 4);
    CHECK(eighth == 0xF6); // ö
}

TEST_CASE("light that was written as IES TM-25 goes on in another experiment", "[log]") {
    std::string const far = R"(
[[detector]]
name = "far"
at_mm = [0, 0, 9]
facing = [0, 0, -1]
size_mm = [20, 20]
)";
    Run const direct(ball + far, {"detector.screen.absorbs=false", "detector.screen.size_mm=[400, 400]"});
    fs::path const file = direct.folder.path / "screen.tm25ray";
    export_tm25(direct.log(), "screen", file);
    ExperimentSource const source = load_experiment(direct.folder.write(
        "further.toml", "[[source]]\nname = \"rays\"\nfile = \"screen.tm25ray\"\n" + far));
    Value const summary = run_experiment(source, {}).summary;
    for (char const* key : {"power_W", "rms_radius_mm"}) { // floats, over a millimetre
        double const further = std::get<double>(summary.find("detectors")->find("far")->find(key)->data);
        CHECK(further == Approx(direct.figure("far", key)).epsilon(1e-6));
    }
}

TEST_CASE("several wavelengths go out ray by ray, and what arrives at a face goes out too", "[log]") {
    Run const run(ball + second, {"source.beam.lines=[\"F\", \"C\"]"});
    fs::path const file = run.folder.path / "screen.tm25ray";
    export_tm25(run.log(), "screen", file);
    RayList const read = read_ray_file(file, {});
    CHECK(read.mixed);
    CHECK(read.power == Approx(run.figure("screen", "power_W")).epsilon(1e-7));
    export_tm25(run.log(), "ball", file);
    double arrives = 0.0;
    RayLogReader const log = run.log();
    for (Segment const& segment : log.read(0, log.rows()))
        if (segment.surface >= 0 &&
            log.header().surfaces[static_cast<std::size_t>(segment.surface)] == "ball")
            arrives += segment.power_end;
    CHECK(read_ray_file(file, {}).power == Approx(arrives).epsilon(1e-7));
}

TEST_CASE("a log that cannot give a detector's rays says why", "[log]") {
    {
        Run const run(ball + second);
        CHECK(run.refused("").find("screen, behind") != std::string::npos);
        CHECK(run.refused("scren").find("did you mean screen?") != std::string::npos);
    }
    CHECK(Run(ball, {"log.every=2"}).refused("").find("log.every = 1") != std::string::npos);
    CHECK(Run(ball, {"detector.screen.at_mm=[90, 0, 8]"}).refused("").find("no light came") !=
          std::string::npos);
    CHECK(Run(ball, {"detector.screen.at_mm=[90, 0, 8]"}).refused("screen").find("no light came to screen") !=
          std::string::npos);
}
