// What each kind of surface makes of a ray: shares, directions and events, at every angle and at the edges.
#include "optics/fresnel.h"
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
