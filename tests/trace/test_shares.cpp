// The powers of a source's rays: their exact sum is the source's power, whatever the numbers are.
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"

#include <numeric>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// The sum over an experiment's rays, in the unit that its ledger counts in, and what it should be.
void check_sum(Experiment const& experiment) {
    Scene const scene = build_scene(experiment);
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    SumUnit const unit = SumUnit::for_total(emission.power());
    ExactSum sum, expected;
    int dark = 0;
    for (std::uint64_t i = 0; i < emission.rays(); ++i) {
        double const power = emission.ray(i).power;
        dark += !(power >= 0.0);
        sum.add(power, unit);
    }
    for (SourceSpec const& source : scene.sources)
        expected.add(source.power, unit);
    CHECK(dark == 0);
    CHECK(sum == expected);
}

std::vector<std::pair<double, double>> colours(Dice& dice, std::uint64_t count) {
    std::vector<std::pair<double, double>> made;
    for (std::uint64_t i = 0; i < count; ++i)
        made.emplace_back((400.0 + static_cast<double>(i)) * 1e-9, dice.log_between(1e-6, 1.0));
    return made;
}

} // namespace

TEST_CASE("the powers of all rays add up to that of the source, to the last bit", "[sources]") {
    Dice dice(71);
    for (int k = 0; k < 60; ++k) {
        Lab lab;
        PointEmitter lamp{dvec3(0.0), {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, 1.0, 1 + dice.below(3000)};
        SourceSpec& source = lab.source(lamp);
        source.power = dice.log_between(1e-9, 1e9);
        source.wavelengths = colours(dice, 1 + dice.below(9));
        CAPTURE(k, lamp.rays, source.power, source.wavelengths.size());
        check_sum(lab.experiment);
    }
}

TEST_CASE("so do those of a Gaussian beam and of rays with powers of their own", "[sources]") {
    Dice dice(72);
    for (int k = 0; k < 60; ++k) {
        Lab lab;
        if (k % 2 == 0) {
            Beam beam{dvec3(0.0), {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, 0.01,
                      dvec2(0.0), 0.004,           Pattern::sobol,  1 + dice.below(3000)};
            lab.source(beam).power = dice.log_between(1e-3, 1e3);
        } else {
            std::vector<RaySpec> rays;
            for (std::uint64_t i = 0; i <= dice.below(3000); ++i)
                rays.push_back({dvec3(0.0), dice.direction(), dice.log_between(1e-12, 1.0)});
            lab.rays(std::move(rays)).power = dice.log_between(1e-3, 1e3);
        }
        lab.experiment.sources.back().wavelengths = colours(dice, 1 + dice.below(5));
        CAPTURE(k);
        check_sum(lab.experiment);
    }
}

TEST_CASE("several sources keep their powers side by side", "[sources]") {
    Dice dice(73);
    Lab lab;
    for (double power : {1.0, 1e-7, 0.3})
        lab.source(PointEmitter{dvec3(0.0), {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, 1.0, 777}).power = power;
    check_sum(lab.experiment);
}

TEST_CASE("a faint source's rays with weights of their own are whole units of the ledger", "[sources]") {
    Dice dice(74);
    Lab lab;
    lab.source(PointEmitter{dvec3(0.0), {0.0, 0.0, 1.0}, {0.0, 1.0, 0.0}, 1.0, 7}).power = 1e6;
    std::vector<RaySpec> rays;
    for (int i = 0; i < 1000; ++i)
        rays.push_back({dvec3(0.0), dice.direction(), dice.log_between(1e-3, 1.0)});
    lab.rays(std::move(rays)).power = 3e-7;
    check_sum(lab.experiment);
    Scene const scene = build_scene(lab.experiment);
    Emission const emission(scene.sources, WavelengthTable(scene), 1);
    SumUnit const finer{SumUnit::for_total(emission.power()).exponent - 30};
    ExactSum sum;
    for (std::uint64_t i = emission.first_rays()[1]; i < emission.rays(); ++i)
        sum.add(emission.ray(i).power, finer);
    CHECK(std::abs(sum.value(finer) - 3e-7) <= std::ldexp(1.0, finer.exponent + 30)); // one unit
}

TEST_CASE("rays of equal weight differ by a rounding at most", "[sources]") {
    std::vector<EqualShare> const shares = equal_shares(1.0, {0.25, 0.75}, 1000, SumUnit{});
    for (std::size_t colour : {std::size_t{0}, std::size_t{1}}) {
        double const ideal = (colour == 0 ? 0.25 : 0.75) / 1000.0;
        for (std::uint64_t ray : {std::uint64_t{0}, std::uint64_t{500}, std::uint64_t{999}})
            CHECK(std::abs(shares[colour].of(ray) / ideal - 1.0) < 5e-16); // two last places
    }
}
