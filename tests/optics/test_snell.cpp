// Directions of reflected and refracted rays: Snell's law to 4 ulp, unit length, and hardly any drift.
#include "optics/snell.h"
#include "support/catch.h"
#include "support/dice.h"
#include "support/quad.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double ulp = std::numeric_limits<double>::epsilon(); // of 1

/// A direction that meets `normal` at an angle of incidence with that sine and cosine.
dvec3 incident(Dice& dice, dvec3 const& normal, double sine, double cosine) {
    return normalize(sine * perpendicular_to(normal, dice.direction()) - cosine * normal);
}

double sine_to(dvec3 const& direction, dvec3 const& normal) {
    return length(cross(direction, normal));
}

} // namespace

TEST_CASE("reflection keeps the tangential part and turns the normal one") {
    Dice dice(1);
    for (int k = 0; k < 10'000; ++k) {
        dvec3 const normal = dice.direction();
        double const angle = dice.log_between(1e-12, 1.57);
        dvec3 const d = incident(dice, normal, std::cos(angle), std::sin(angle)), r = reflect(d, normal);
        REQUIRE(std::abs(length(r) - 1.0) <= 2.0 * ulp);
        REQUIRE(std::abs(dot(r, normal) + dot(d, normal)) <= 4.0 * ulp);
        REQUIRE(length(cross(r - d, normal)) <= 4.0 * ulp);
    }
}

TEST_CASE("refraction obeys Snell's law to 4 ulp, in one plane, at unit length") {
    Dice dice(2);
    double worst_sine = 0.0, worst_length = 0.0, worst_plane = 0.0;
    for (int k = 0; k < 100'000; ++k) {
        double const n1 = dice.between(1.0, 4.0), n2 = dice.between(1.0, 4.0);
        double const small =
            dice.log_between(1e-17, std::numbers::pi / 2); // from the normal, or from the surface
        dvec3 const normal = dice.direction();
        dvec3 const d = k % 2 ? incident(dice, normal, std::sin(small), std::cos(small))
                              : incident(dice, normal, std::cos(small), std::sin(small));
        auto const out = refract(d, normal, n1, n2);
        if (!out)
            continue;
        worst_length = std::max(worst_length, std::abs(length(*out) - 1.0));
        worst_sine =
            std::max(worst_sine, std::abs(n1 * sine_to(d, normal) - n2 * sine_to(*out, normal)) / n2);
        worst_plane = std::max(worst_plane, std::abs(dot(*out, cross(d, normal))));
        REQUIRE(dot(*out, normal) <= ulp);
    }
    CHECK(worst_length <= 2.0 * ulp);
    CHECK(worst_sine <= 4.0 * 2.0 * ulp); // 4 ulp of the larger sine, and as much for measuring it
    CHECK(worst_plane <= 8.0 * ulp);
}

TEST_CASE("what refract() sends through, Fresnel's equations transmit") {
    Dice dice(3);
    for (int k = 0; k < 50'000; ++k) {
        double const n1 = dice.between(1.0, 4.0), n2 = n1 * dice.between(0.25, 1.0);
        double const angle = std::asin(n2 / n1) + dice.sign() * dice.log_between(1e-17, 1e-6);
        dvec3 const normal = dice.direction();
        dvec3 const d = incident(dice, normal, std::sin(angle), std::cos(angle));
        Incidence const incidence = Approach(d, normal).incidence;
        REQUIRE(refract(d, normal, n1, n2).has_value() == fresnel_dielectric(incidence, n1, n2).has_value());
    }
}

TEST_CASE("at the normal nothing turns, and equal indices turn nothing") {
    Dice dice(4);
    for (int k = 0; k < 1000; ++k) {
        dvec3 const normal = dice.direction(), d = dice.direction();
        auto const straight = refract(-normal, normal, dice.between(1.0, 4.0), dice.between(1.0, 4.0));
        REQUIRE(straight);
        REQUIRE(length(*straight + normal) <= 2.0 * ulp);
        double const n = dice.between(1.0, 4.0);
        auto const same = refract(d, dot(d, normal) > 0.0 ? -normal : normal, n, n);
        REQUIRE(same);
        REQUIRE(length(*same - d) <= 4.0 * ulp);
    }
}

TEST_CASE("ten thousand refractions through parallel faces turn a ray by two ulp each at most") {
    // in and out of plates of random indices: n sin is the same in all of them
    Dice dice(5);
    for (int ray = 0; ray < 20; ++ray) {
        dvec3 const normal = dice.direction();
        double const angle = dice.between(0.01, 1.4);
        dvec3 const first = incident(dice, normal, std::sin(angle), std::cos(angle));
        dvec3 direction = first;
        double n = 1.0;
        for (int k = 0; k < 10'000; ++k) {
            double const next = k % 2 ? 1.0 : dice.between(1.0, 4.0);
            auto const out = refract(direction, normal, n, next);
            REQUIRE(out);
            direction = *out;
            n = next;
        }
        CHECK(std::abs(length(direction) - 1.0) <= 2.0 * ulp);
        // a normal is a unit vector to half an ulp, always the same one here: that adds up, and no more
        CHECK(length(direction - first) <= 10'000 * 2.0 * ulp);
    }
}

TEST_CASE("ten thousand reflections and refractions keep a direction's length") {
    Dice dice(6);
    dvec3 direction = dice.direction();
    for (int k = 0; k < 10'000; ++k) {
        dvec3 normal = dice.direction();
        if (dot(normal, direction) > 0.0)
            normal = -normal;
        auto const out = refract(direction, normal, dice.between(1.0, 2.0), dice.between(1.0, 2.0));
        direction = out ? *out : reflect(direction, normal);
    }
    CHECK(std::abs(length(direction) - 1.0) <= 2.0 * ulp);
}
