// In: a lens and a ball as exact shapes and as meshes with float data. Out: the order in which curved methods
// come to the shape, what they leave at the fineness that is asked of them, and the optical path.
#include "run/export_model.h"
#include "run/run.h"
#include "support/bench.h"
#include "support/catch.h"
#include "support/gltf.h"

#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double index = 1.5168;

struct Optic {
    std::string shape;
    double radius_mm; // of the beam: 80 % of the aperture
};

std::string bench_with(std::string const& object, double radius_mm) {
    return text("title = 'bench'\n[medium]\nglass = {n = ", index,
                "}\n[[object]]\nname = 'body'\nmedium = 'glass'\n", object,
                "\n[[source]]\nname = 'beam'\nbeam = {from_mm = [0.013, 0.029, -20], toward = [0, 0, 1], "
                "radius_mm = ",
                radius_mm, ", pattern = 'hexagonal', rays = 1500}\n");
}

struct Leaving {
    dvec3 direction;
    double path; // m, optical, to a plane behind the body
};

std::vector<Leaving> leaving(std::string const& experiment, std::string const& method) {
    Run const run = bench::run(experiment, {"trace.min_power=0.5", "trace.method=" + method});
    std::vector<Leaving> all;
    for (std::uint64_t ray = 0; ray <= run.segments.back().ray; ++ray) {
        Rows const path = direct_path(rows_of(run, ray));
        REQUIRE(path.size() == 3);
        constexpr double plane = 0.03; // m
        dvec3 const &start = path[0].origin, &in = path[1].origin, &out = path[2].origin;
        all.push_back({path[2].direction, length(in - start) + index * length(out - in) +
                                              (plane - out.z) / path[2].direction.z});
    }
    return all;
}

struct Errors {
    double direction = 0.0; // rad, RMS
    double path = 0.0;      // m, RMS about the mean
};

Errors between(std::vector<Leaving> const& one, std::vector<Leaving> const& other) {
    REQUIRE(one.size() == other.size());
    double turns = 0.0, sum = 0.0, squares = 0.0;
    auto const n = static_cast<double>(one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        dvec3 const turn = one[i].direction - other[i].direction;
        double const off = one[i].path - other[i].path;
        turns += dot(turn, turn);
        sum += off;
        squares += off * off;
    }
    return {std::sqrt(turns / n), std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)))};
}

/// Against the shape, its mesh of that many segments round the rim.
Errors errors_of(Optic const& lens, unsigned segments, std::string const& method) {
    TemporaryFolder const folder("curved-orders");
    std::string const exact = bench_with("shape = " + lens.shape, lens.radius_mm);
    export_model(load_experiment(folder.write("exact.toml", exact)), segments, folder.path / "body.glb");
    std::string const model = "model = '" + (folder.path / "body.glb").string() + "'";
    return between(leaving(exact, "auto"), leaving(bench_with(model, lens.radius_mm), method));
}

Errors of_model(Optic const& lens, std::string const& model, std::string const& method) {
    return between(
        leaving(bench_with("shape = " + lens.shape, lens.radius_mm), "auto"),
        leaving(bench_with("model = '" SAHL_SOURCE_DIR "/models/" + model + "'", lens.radius_mm), method));
}

Optic const ball{"{sphere = {radius_mm = 5}}", 4.0};
Optic const singlet{"{lens = {r1_mm = 50, r2_mm = -50, thickness_mm = 10, diameter_mm = 30}}", 12.0};
Optic const asphere{"{lens = {r1_mm = 20, r2_mm = 0, thickness_mm = 8, diameter_mm = 25, conic1 = -0.7, "
                    "aspheric1 = [1e-6, -2e-9]}}",
                    10.0};

double order(double coarse, double fine, double ratio) {
    return std::log(coarse / fine) / std::log(ratio);
}

} // namespace

TEST_CASE("fitted surfaces of a ball, a singlet and an asphere converge with the fourth order", "[curved]") {
    struct Step {
        Optic const& lens;
        unsigned coarse, fine;
    };
    for (Step const& step : {Step{ball, 16, 32}, Step{singlet, 24, 48}, Step{asphere, 24, 48}}) {
        double const coarse = errors_of(step.lens, step.coarse, "fitted").direction,
                     fine = errors_of(step.lens, step.fine, "fitted").direction;
        double const found =
            order(coarse, fine, static_cast<double>(step.fine) / static_cast<double>(step.coarse));
        WARN(step.lens.shape << ": " << coarse << ", " << fine << " rad, order " << found);
        CHECK(found > 3.5);
    }
}

TEST_CASE("fitted meshes with float data bend light as their shapes do, to what is promised", "[curved]") {
    double const of_ball = of_model(ball, "ball-20480.glb", "fitted").direction;
    Errors const of_singlet = of_model(singlet, "singlet-4104.glb", "fitted");
    double const of_asphere = errors_of(asphere, 290, "fitted").direction;
    WARN("fitted: ball " << of_ball << ", singlet " << of_singlet.direction << ", asphere " << of_asphere
                         << " rad; optical path of the singlet " << of_singlet.path * 1e9 << " nm, RMS");
    CHECK(of_ball < 3e-8);
    CHECK(of_singlet.direction < 5e-9);
    CHECK(of_asphere < 5e-9);        // of 15 288 triangles over an f/1.6
    CHECK(of_singlet.path < 0.1e-9); // m
}
