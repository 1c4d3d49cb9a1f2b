// In: the experiments clad-rod and bent-guide. Out: that their imported guides carry the light that closed
// forms say: a square rod's acceptance, and what leaves a bend at its outer wall.
#include "support/catch.h"
#include "support/experiments.h"
#include "support/textbook.h"

#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

struct Sweep {
    std::vector<double> value, power, cut; // of each run; W
};

Sweep sweep_of(std::string const& name, std::string const& key, std::string const& detector,
               std::vector<std::string> const& set) {
    Folder const out;
    run_experiment_of(name, out.path() / "out", set);
    auto columns = read_sweep(out.path() / "out" / "sweep.csv");
    return {columns[key], columns["detectors." + detector + ".power_W"], columns["energy_W.cut"]};
}

/// What a clear plate with parallel faces lets through of unpolarised light, all reflections between them
/// counted, with the mean of s and p at each.
double plate(double n, double incidence) {
    double const reflected = mean_reflectance(1.0, n, incidence);
    return (1.0 - reflected) / (1.0 + reflected);
}

Sweep clad_rod(double azimuth_deg) {
    return sweep_of("clad-rod", "group.lamp.turn_deg[1]", "screen",
                    {"group.lamp.turn_deg[2]=" + text(azimuth_deg)});
}

double const core = 1.492, cladding = 1.402;
double const aperture = std::sqrt(core * core - cladding * cladding); // numerical, 0.5104

/// Light in a bend turns about its axis on a constant least distance `b`: as a share of the outer wall's
/// radius that is the sine of incidence there, and it comes to that wall each 2 acos(sine).
double through_the_bend(double n, double sine) {
    double const incidence = std::asin(sine), half_step = std::acos(sine);
    if (n * sine >= 1.0)
        return 1.0;
    double const times = std::floor((0.5 * std::numbers::pi - half_step) / (2.0 * half_step)) + 1.0;
    return std::pow(mean_reflectance(n, 1.0, incidence), times);
}

} // namespace

TEST_CASE("a clad rod carries what comes within its acceptance angle, but for Fresnel at its ends") {
    Sweep const sweep = clad_rod(0.0);
    REQUIRE(sweep.value.size() == 33);
    for (std::size_t i = 0; i < sweep.value.size(); ++i) {
        double const angle = radians(std::abs(sweep.value[i]));
        CAPTURE(sweep.value[i]);
        if (std::sin(angle) < aperture) // all that is missing are branches cut for their weakness
            CHECK(std::abs(sweep.power[i] + 0.5 * sweep.cut[i] - plate(core, angle)) <=
                  0.5 * sweep.cut[i] + 1e-12);
        else if (sweep.value[i] > 33.0) // at the walls 8 times, and less than a fifth is reflected each time
            CHECK(sweep.power[i] < 1e-4);
    }
}

TEST_CASE("askew a square rod accepts steeper light than a round one, each pair of walls for itself",
          "[slow]") {
    // at 45° between the walls each sees sin θ / √2
    Sweep const sweep = clad_rod(45.0);
    for (std::size_t i = 0; i < sweep.value.size(); ++i) {
        double const angle = radians(std::abs(sweep.value[i]));
        CAPTURE(sweep.value[i]);
        REQUIRE(std::sin(angle) / std::numbers::sqrt2 < aperture);
        CHECK(std::abs(sweep.power[i] + 0.5 * sweep.cut[i] - plate(core, angle)) <=
              0.5 * sweep.cut[i] + 1e-12);
    }
}

TEST_CASE("a bend loses light at its outer wall below n = 1 + d/r, and nothing above") {
    double const inner = 10.0, outer = 15.0, low = 10.05, high = 14.95; // mm; where the beam comes in
    Sweep const sweep = sweep_of("bent-guide", "medium.plastic.n", "exit", {});
    REQUIRE(sweep.value.size() == 13);
    std::vector<Node> const nodes = gauss_legendre(32);
    for (std::size_t i = 0; i < sweep.value.size(); ++i) {
        double const n = sweep.value[i], entrance = 4.0 * n / ((n + 1.0) * (n + 1.0));
        CAPTURE(n);
        if (n >= 1.0 + (outer - inner) / inner) {
            CHECK(std::abs(sweep.power[i] - entrance) < 1e-12);
            continue;
        }
        int const pieces = 400; // the integrand has steps, where the light comes to the wall once more
        double share = 0.0;
        for (int piece = 0; piece < pieces; ++piece)
            for (Node const& node : nodes)
                share += node.weight / pieces *
                         through_the_bend(n, (low + (high - low) * (piece + node.x) / pieces) / outer);
        // 64 chords for a quarter of a circle lie up to 7.5e-5 of the radius inside it: so much smaller is
        // the sine of incidence that is needed, and 15 mm / 4.9 mm times that the share of a beam that has
        // it. As much again for the 10 000 rays: their places across fill as many intervals, one each.
        CHECK(std::abs(sweep.power[i] - entrance * share) < 2.0 * (15.0 / 4.9) * 7.5e-5);
    }
}

TEST_CASE("as OBJ and as glTF a bent guide carries the same light") {
    std::vector<std::string> const one_index{"sweep={\"medium.plastic.n\"=[1.4]}"};
    std::vector<std::string> as_gltf = one_index;
    as_gltf.emplace_back("object.guide.model=" SAHL_SOURCE_DIR "/models/bent-guide.glb");
    as_gltf.emplace_back("object.guide.length_unit=m");
    Sweep const obj = sweep_of("bent-guide", "medium.plastic.n", "exit", one_index);
    Sweep const gltf = sweep_of("bent-guide", "medium.plastic.n", "exit", as_gltf);
    REQUIRE(obj.power.size() == 1);
    REQUIRE(gltf.power.size() == 1);
    // glTF rounds places and normals to floats, 6e-8 of their size; of a beam of 4.9 mm within 15 mm three
    // times that share finds its wall total that did not before, and all other reflectances move by some 1e-7
    CHECK(std::abs(obj.power[0] - gltf.power[0]) < 1e-6);
}
