// What each kind of surface makes of a ray: shares, directions and events, at every angle and at the edges.
#include "optics/fresnel.h"
#include "optics/plate.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"
#include "trace/interact.h"

#include <algorithm>
#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

/// A plane face at z = 0 between air above and a medium below, met at an angle of incidence from above or
/// below.
struct Bench {
    Scene scene;
    WavelengthTable optics;
    Interface interface;
    double n_before, n_after;

    explicit Bench(Scene made, double n1, double n2)
        : scene(std::move(made)), optics(scene), n_before(n1), n_after(n2) {
        interface.normal = interface.facet_normal = {0.0, 0.0, 1.0};
        interface.medium_after = {1};
        if (!scene.surfaces.empty())
            interface.surface = SurfaceId{0};
    }
    Branches meet(double angle, std::uint64_t ray = 0) const {
        dvec3 const direction(std::sin(angle), 0.0, -std::cos(angle));
        return interact(scene, optics, interface, direction, {0}, {0}, {1, ray, 0});
    }
};

template <class... Surface>
Bench bench_with(double n1, double n2, Surface... surface) {
    Lab lab(n1);
    lab.medium(n2);
    (lab.surface(surface), ...);
    lab.rays({{{0, 0, 1}, {0, 0, -1}}});
    return Bench(build_scene(lab.experiment), n1, n2);
}

double all_shares(Branches const& branches) {
    double sum = branches.absorbed;
    for (Outgoing const& out : branches.outgoing)
        sum += out.share;
    return sum;
}

dvec3 mirrored(double angle) {
    return {std::sin(angle), 0.0, std::cos(angle)};
}

constexpr double angles[] = {0.0, 1e-8, 0.1, 0.5, 0.7, 0.8, 1.2, 1.5, 1.570796};

} // namespace

TEST_CASE("a clean boundary refracts and reflects by Fresnel, below the critical angle and above") {
    for (auto const& [n1, n2] : {std::pair{1.0, 1.5}, std::pair{1.5, 1.0}, std::pair{1.4, 1.4}})
        for (double angle : angles) {
            Branches const branches = bench_with(n1, n2).meet(angle);
            CAPTURE(n1, n2, angle);
            CHECK(std::abs(all_shares(branches) - 1.0) < 2e-15);
            CHECK(branches.absorbed == 0.0);
            REQUIRE(!branches.outgoing.empty());
            if (n1 * std::sin(angle) > n2) {
                CHECK(branches.ended == Event::total_internal);
                CHECK(branches.outgoing.size() == 1);
                CHECK(branches.outgoing.front().event == Event::total_internal);
                CHECK(branches.outgoing.front().share == 1.0);
                CHECK(length(branches.outgoing.front().direction - mirrored(angle)) < 1e-15);
                continue;
            }
            Outgoing const& refracted = branches.outgoing.front();
            auto const shares = fresnel_dielectric({std::cos(angle), std::sin(angle)}, n1, n2);
            REQUIRE(shares);
            CHECK(branches.ended == Event::refracted);
            CHECK((refracted.event == Event::refracted && refracted.crosses));
            CHECK(refracted.share == Approx(shares->transmittance()).epsilon(1e-9));
            CHECK(n2 * refracted.direction.x == Approx(n1 * std::sin(angle)).margin(1e-15));
            CHECK(refracted.direction.z < 0.0);
            CHECK(branches.outgoing.size() == (n1 == n2 ? 1 : 2)); // nothing reflects where indices are equal
            if (n1 != n2) {
                CHECK((branches.outgoing[1].event == Event::reflected && !branches.outgoing[1].crosses));
                CHECK(branches.outgoing[1].share == Approx(shares->reflectance()).epsilon(1e-9));
                CHECK(length(branches.outgoing[1].direction - mirrored(angle)) < 1e-15);
            }
        }
}

TEST_CASE("a metal reflects Fresnel's share and absorbs the rest, as seen from its own side's medium") {
    Metal const silver{{{587.6e-9, 0.05, 3.9}}};
    for (double n1 : {1.0, 1.5})
        for (double angle : angles) {
            Branches const branches = bench_with(n1, 1.0, silver).meet(angle);
            FresnelShares const shares = fresnel_metal({std::cos(angle), std::sin(angle)}, n1, {0.05, 3.9});
            REQUIRE(branches.outgoing.size() == 1);
            CHECK(branches.ended == Event::reflected);
            CHECK(branches.outgoing.front().share == Approx(shares.reflectance()).epsilon(1e-9));
            CHECK(branches.absorbed == Approx(shares.transmittance()).margin(1e-9));
            CHECK(std::abs(all_shares(branches) - 1.0) < 1e-14);
            CHECK(length(branches.outgoing.front().direction - mirrored(angle)) < 1e-15);
        }
}

TEST_CASE("constant shares go their ways, where refraction is impossible the transmitted share reflects") {
    for (auto const& [r, t] : {std::pair{0.3, 0.5}, std::pair{0.0, 1.0}, std::pair{1.0, 0.0},
                               std::pair{0.0, 0.0}, std::pair{0.1, 0.9}, std::pair{0.7, 0.3}})
        for (double n1 : {1.0, 1.5})
            for (double angle : angles) {
                Branches const branches = bench_with(n1, 1.0, Shares{r, t}).meet(angle);
                bool const total = n1 * std::sin(angle) > 1.0;
                CAPTURE(r, t, n1, angle);
                CHECK(std::abs(all_shares(branches) - 1.0) < 2e-16);
                CHECK(branches.absorbed >= -1e-16);
                CHECK(std::abs(branches.absorbed - (1.0 - r - t)) < 2e-16);
                if (t > 0.0 && total) {
                    REQUIRE(branches.outgoing.size() == 1);
                    CHECK(branches.ended == Event::total_internal);
                    CHECK(branches.outgoing.front().share == r + t);
                    CHECK_FALSE(branches.outgoing.front().crosses);
                    continue;
                }
                CHECK(branches.outgoing.size() == std::size_t(r > 0.0) + std::size_t(t > 0.0));
                CHECK(branches.ended == (t > 0.0   ? Event::refracted
                                         : r > 0.0 ? Event::reflected
                                                   : Event::absorbed));
                for (Outgoing const& out : branches.outgoing)
                    CHECK(out.share == (out.crosses ? t : r));
            }
}

TEST_CASE("an absorber ends all, paint reflects its share like a mirror") {
    for (double angle : angles) {
        Branches const black = bench_with(1.0, 1.5, Absorber{}).meet(angle);
        CHECK((black.outgoing.empty() && black.absorbed == 1.0 && black.ended == Event::absorbed));
        Paint paint;
        paint.reflect = 0.2;
        Branches const painted = bench_with(1.0, 1.5, paint).meet(angle);
        REQUIRE(painted.outgoing.size() == 1);
        CHECK(painted.outgoing.front().share == 0.2);
        CHECK(painted.absorbed == Approx(0.8));
        CHECK(length(painted.outgoing.front().direction - mirrored(angle)) < 1e-15);
    }
}

TEST_CASE("a diffuse surface is Lambertian whatever the incidence, and keeps its share of the power") {
    constexpr int count = 20'000;
    for (double angle : {0.0, 0.7, 1.5}) {
        Bench const bench = bench_with(1.0, 1.5, Diffuse{0.97});
        double mean = 0.0, mean_square = 0.0;
        dvec3 sum(0.0);
        for (std::uint64_t ray = 0; ray < count; ++ray) {
            Branches const branches = bench.meet(angle, ray);
            REQUIRE(branches.outgoing.size() == 1);
            Outgoing const& out = branches.outgoing.front();
            REQUIRE((out.event == Event::scattered && branches.ended == Event::scattered && !out.crosses));
            REQUIRE((out.share == 0.97 && out.direction.z >= 0.0 &&
                     std::abs(length(out.direction) - 1.0) < 4e-16));
            CHECK(std::abs(all_shares(branches) - 1.0) < 2e-16);
            mean += out.direction.z / count;
            mean_square += out.direction.z * out.direction.z / count;
            sum += out.direction / static_cast<double>(count);
        }
        // density 2c: mean 2/3, variance 1/18; mean of c² 1/2, variance 1/12; sideways none, variance 1/4
        CHECK(std::abs(mean - 2.0 / 3.0) < 4.0 * std::sqrt(1.0 / 18.0 / count));
        CHECK(std::abs(mean_square - 0.5) < 4.0 * std::sqrt(1.0 / 12.0 / count));
        CHECK(std::abs(sum.x) < 4.0 * std::sqrt(0.25 / count));
        CHECK(std::abs(sum.y) < 4.0 * std::sqrt(0.25 / count));
    }
    Branches const none = bench_with(1.0, 1.5, Diffuse{0.0}).meet(0.3);
    CHECK((none.outgoing.empty() && none.absorbed == 1.0 && none.ended == Event::absorbed));
}

TEST_CASE("an interpolated normal never sends light to the wrong side of its triangle") {
    Dice dice(1);
    for (auto const& [n1, n2] : {std::pair{1.0, 1.5}, std::pair{1.5, 1.0}}) {
        Bench bench = bench_with(n1, n2);
        for (int k = 0; k < 20'000; ++k) {
            dvec3 const tilt = normalize(dvec3(0.0, 0.0, 1.0) + dice.between(0.0, 0.3) * dice.direction());
            bench.interface.normal = tilt;
            double const grazing = dice.log_between(1e-6, 1.57), azimuth = dice.between(0.0, 6.28);
            dvec3 const direction(std::cos(grazing) * std::cos(azimuth),
                                  std::cos(grazing) * std::sin(azimuth), -std::sin(grazing));
            Branches const branches =
                interact(bench.scene, bench.optics, bench.interface, direction, {0}, {0}, {1, 0, 0});
            REQUIRE(std::abs(all_shares(branches) - 1.0) < 4e-15);
            for (Outgoing const& out : branches.outgoing)
                REQUIRE((out.crosses ? out.direction.z < 0.0 : out.direction.z > 0.0));
        }
    }
}

TEST_CASE("a tinted boundary takes its share of what refracts, of its colour's band, and nothing of what "
          "reflects") {
    double const pi = std::numbers::pi;
    Colour const colour{0.2, 0.8, 0.4}; // the bench's 587.6 nm are in the red band
    Bench const clear = bench_with(1.0, 1.5), tinted = bench_with(1.0, 1.5, Tinted{1.0, colour, {}});
    Bench const clear_out = bench_with(1.5, 1.0), tinted_out = bench_with(1.5, 1.0, Tinted{1.0, colour, {}});
    for (double angle : {0.0, 0.3, 0.9, 1.4, 0.5 * pi - 1e-6})
        for (auto const& [plain, with] : {std::pair(&clear, &tinted), std::pair(&clear_out, &tinted_out)}) {
            Branches const a = plain->meet(angle), b = with->meet(angle);
            REQUIRE(a.outgoing.size() == b.outgoing.size());
            for (std::size_t i = 0; i < a.outgoing.size(); ++i) {
                CHECK(b.outgoing[i].direction == a.outgoing[i].direction);
                CHECK(b.outgoing[i].event == a.outgoing[i].event);
                CHECK(b.outgoing[i].share == a.outgoing[i].share * (a.outgoing[i].crosses ? 0.2 : 1.0));
            }
            CHECK(std::abs(all_shares(b) - 1.0) < 2e-15);
            CHECK(b.ended == a.ended);
        }
}

TEST_CASE("a tinted boundary of metal mirrors its colour, and one in part mixes both") {
    Bench const metal = bench_with(1.0, 1.5, Tinted{0.0, {1, 1, 1}, {0.7, 0.2, 0.1}});
    Branches const all = metal.meet(0.4);
    REQUIRE(all.outgoing.size() == 1);
    CHECK(all.outgoing[0].share == 0.7);
    CHECK(all.absorbed == Approx(0.3).epsilon(1e-15));
    CHECK(all.ended == Event::reflected);

    Bench const part = bench_with(1.0, 1.5, Tinted{0.75, {1, 1, 1}, {0.2, 0.0, 0.0}});
    Branches const mixed = part.meet(0.0);
    REQUIRE(mixed.outgoing.size() == 2);
    CHECK(mixed.outgoing[0].share == Approx(0.75 * 0.96).epsilon(1e-14));
    CHECK(mixed.outgoing[1].share == Approx(0.75 * 0.04 + 0.2).epsilon(1e-14));
    CHECK(mixed.absorbed == Approx(0.05).epsilon(1e-13));
}

TEST_CASE("a thin wall reflects 2R / (1 + R) of each polarisation, lets the rest through straight on, and "
          "tints it") {
    auto const wall_of = [](double n, double n_around, Colour const& colour) {
        Lab lab(n_around);
        MediumId const wall = lab.medium(n);
        lab.surface(ThinWall{wall, 1.0, colour, {}});
        lab.rays({{{0, 0, 1}, {0, 0, -1}}});
        Bench bench(build_scene(lab.experiment), n_around, n_around);
        bench.interface.medium_after = {0};
        return bench;
    };
    Bench const clear = wall_of(1.5, 1.0, {1, 1, 1}), tinted = wall_of(1.5, 1.0, {0.25, 1, 1});
    for (double angle : {0.0, 0.2, std::atan(1.5), 1.2, 1.5, 0.5 * std::numbers::pi - 1e-7}) {
        auto const one = fresnel_dielectric({std::cos(angle), std::sin(angle)}, 1.0, 1.5);
        auto const both = [](double r) { return 2.0 * r / (1.0 + r); };
        double const expected = 0.5 * (both(one->r_s) + both(one->r_p));
        Branches const a = clear.meet(angle), b = tinted.meet(angle);
        CAPTURE(angle);
        REQUIRE(a.outgoing.size() == 2);
        CHECK(a.outgoing[0].direction == dvec3(std::sin(angle), 0.0, -std::cos(angle)));
        CHECK(a.outgoing[0].crosses);
        CHECK(std::abs(a.outgoing[1].share - expected) < 1e-14);
        CHECK(a.absorbed == 0.0);
        CHECK(std::abs(all_shares(a) - 1.0) < 1e-14);
        CHECK(b.outgoing[0].share == 0.25 * a.outgoing[0].share);
        CHECK(b.outgoing[1].share == a.outgoing[1].share);
        CHECK(std::abs(all_shares(b) - 1.0) < 1e-14);
    }
    // between a denser medium and itself a wall of less index is not entered beyond the critical angle
    Branches const total = wall_of(1.0, 1.5, {1, 1, 1}).meet(0.9);
    REQUIRE(total.outgoing.size() == 1);
    CHECK(total.outgoing[0].event == Event::total_internal);
    CHECK(total.outgoing[0].share == 1.0);
}

TEST_CASE("a thin wall does to light what a thick plate does, all its reflections taken together") {
    // at normal incidence, where s and p are alike: unpolarised tracing of a plate averages them at each
    // surface
    Lab lab;
    lab.body("plate", Box{{1.0, 1.0, 0.01}}, lab.medium(1.7));
    lab.rays({{{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}}});
    lab.experiment.trace.min_power = 1e-18;
    Traced const plate = trace(lab);
    double through = 0.0, back = 0.0;
    for (Segment const& segment : plate.segments())
        if (segment.ended == Event::escaped)
            (segment.direction.z > 0.0 ? through : back) += segment.power_end;
    auto const wall = fresnel_plate({1.0, 0.0}, 1.0, 1.7, 1.0);
    REQUIRE(wall);
    CHECK(std::abs(wall->transmittance() - through) < 1e-15);
    CHECK(std::abs(wall->reflectance() - back) < 1e-15);
}
