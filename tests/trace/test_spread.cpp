// How many digits a path has lost: against the stability of periodic paths in closed form, and against
// derivatives of paths by differences in long double.
#include "support/catch.h"
#include "support/dice.h"
#include "support/lab.h"
#include "trace/spread.h"

#include <array>
#include <cmath>

using namespace sahl;
using namespace sahl::bench;

namespace {

using Long = long double;

/// Place and direction.
using State = std::array<Long, 6>;

/// On to a sphere about the origin and through it, by the textbook, in long double.
State through_sphere(State const& s, Long radius, Long n_before, Long n_after, bool leaves) {
    auto const dot3 = [](Long const* a, Long const* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    Long const* const direction =
        &s[3]; // of about unit length: what is not normalised is linear in all of it
    Long const half = dot3(s.data(), direction), squared = dot3(direction, direction),
               root = std::sqrt(half * half - squared * (dot3(s.data(), s.data()) - radius * radius));
    Long const t = (leaves ? -half + root : -half - root) / squared;
    State out;
    Long normal[3];
    for (std::size_t i = 0; i < 3; ++i) {
        out[i] = s[i] + t * direction[i];
        normal[i] = (leaves ? -1 : 1) * out[i] / radius;
    }
    Long const along = dot3(direction, normal), ratio = n_before / n_after;
    Long const factor = -ratio * along - std::sqrt(1 - ratio * ratio * (1 - along * along));
    for (std::size_t i = 0; i < 3; ++i)
        out[3 + i] = ratio * direction[i] + factor * normal[i];
    return out;
}

using Covariance = std::array<State, 6>;

/// What a map makes of a covariance, to first order; and a rounding of its own.
template <class Map>
Covariance carried(Map const& map, State const& at, Covariance const& before) {
    std::array<State, 6> by_column;
    for (std::size_t j = 0; j < 6; ++j) {
        State more = at, less = at;
        more[j] += 1e-6L;
        less[j] -= 1e-6L;
        State const above = map(more), below = map(less);
        for (std::size_t i = 0; i < 6; ++i)
            by_column[j][i] = (above[i] - below[i]) / 2e-6L;
    }
    Covariance after{};
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) {
            for (std::size_t k = 0; k < 6; ++k)
                for (std::size_t l = 0; l < 6; ++l)
                    after[i][j] += by_column[k][i] * before[k][l] * by_column[l][j];
            after[i][j] += i == j;
        }
    return after;
}

double digits_of(Covariance const& c) {
    Long const place = c[0][0] + c[1][1] + c[2][2], heading = c[3][3] + c[4][4] + c[5][5];
    return static_cast<double>(std::log10(std::max(place, heading) / 3) / 2);
}

/// Two mirrors that face each other along z, the path that goes to and fro between them: digits by segment.
std::vector<double> to_and_fro(Shape const& mirror, Affine const& one, Affine const& other, bool open,
                               std::uint32_t depth) {
    Lab lab;
    SurfaceId const silver = lab.surface(Shares{1.0, 0.0});
    for (Affine const& place : {one, other}) {
        if (open)
            lab.sheet("mirror " + std::to_string(lab.experiment.objects.size()), mirror, silver, place);
        else
            lab.body("mirror " + std::to_string(lab.experiment.objects.size()), mirror, lab.medium(1.5),
                     place)
                .surface = silver;
    }
    lab.rays({{dvec3(0.0), {0.0, 0.0, 1.0}}});
    lab.experiment.trace.max_depth = depth;
    lab.experiment.trace.digits_lost = true;
    std::vector<double> digits;
    Traced const traced = trace(lab);
    for (Segment const& segment : traced.segments())
        digits.push_back(segment.digits_lost);
    REQUIRE(digits.size() > depth);
    CHECK(traced.result.digits.most == *std::max_element(digits.begin(), digits.end()));
    return digits;
}

} // namespace

TEST_CASE("between two balls a path loses the logarithm of its stability's eigenvalue with each reflection",
          "[trace]") {
    // to and fro over the gap d between balls of radius R each reflection is the matrix (1, d; 2/R, 1 +
    // 2d/R), of determinant 1 and trace 2 + 2d/R
    for (double const gap : {0.1, 1.0, 7.0}) {
        double const radius = 1.0, half = 1.0 + gap / radius,
                     eigenvalue = half + std::sqrt(half * half - 1.0);
        double const shift = radius + 0.5 * gap;
        auto const digits =
            to_and_fro(Sphere{radius}, moved({0.0, 0.0, -shift}), moved({0.0, 0.0, shift}), false, 600);
        for (std::size_t k : {60, 100, 599})
            CHECK(digits[k] - digits[k - 10] == Approx(10.0 * std::log10(eigenvalue)).epsilon(1e-8));
    }
}

TEST_CASE("between two plane mirrors rounding adds up and grows no faster", "[trace]") {
    double const gap = 0.5;
    auto const digits =
        to_and_fro(Disk{1.0}, moved({0.0, 0.0, -0.5 * gap}), moved({0.0, 0.0, 0.5 * gap}), true, 2000);
    double place = 1.0, mixed = 0.0, heading = 1.0,
           way = 0.5 * gap; // of one axis across; the unit is the disks' radius
    for (std::size_t k = 0; k < 2000; ++k) {
        place += 2.0 * way * mixed + way * way * heading;
        mixed += way * heading;
        CAPTURE(k);
        REQUIRE(
            digits[k] ==
            Approx(std::max(0.0, 0.5 * std::log10(std::max(2.0 * place, 3.0 * heading) / 3.0))).margin(1e-9));
        place += 1.0;
        heading += 1.0;
        way = gap;
    }
}

TEST_CASE("digits lost through a ball lens are those of the path's derivative in long double", "[trace]") {
    Dice dice(5);
    for (int k = 0; k < 200; ++k) {
        double const radius = dice.log_between(1e-2, 1.0), n = dice.between(1.2, 2.5),
                     unit = dice.between(1.0, 3.0);
        dvec3 const target = 0.95 * radius * dice.uniform() * dice.direction();
        dvec3 const direction = dice.direction(), origin = target - 3.0 * radius * direction;
        // as differences see it lengths are in units too
        Long const r = radius / Long(unit);
        auto const enters = [&](State const& s) { return through_sphere(s, r, 1.0L, n, false); };
        auto const leaves = [&](State const& s) { return through_sphere(s, r, n, 1.0L, true); };
        State const start{origin.x / Long(unit), origin.y / Long(unit), origin.z / Long(unit),
                          direction.x,           direction.y,           direction.z};
        State const inside = enters(start), outside = leaves(inside);
        Covariance covariance{};
        for (std::size_t i = 0; i < 6; ++i)
            covariance[i][i] = 1.0L;
        Spread spread(unit);
        auto const go_through = [&](State const& from, State const& to, double before, double after,
                                    double sense) {
            auto const three = [](State const& state, std::size_t at) {
                return dvec3(static_cast<double>(state[at]), static_cast<double>(state[at + 1]),
                             static_cast<double>(state[at + 2]));
            };
            dvec3 const p = three(from, 0), q = three(to, 0), d = three(from, 3);
            dvec3 const normal = sense * normalize(q);
            dmat3 const turning = (sense / radius) * (dmat3(1.0) - glm::outerProduct(normal, normal));
            spread.go(unit * length(q - p), d, normal);
            spread.turn(d, {normal, turning, before, after}, Event::refracted);
        };
        go_through(start, inside, 1.0, n, 1.0);
        covariance = carried(enters, start, covariance);
        CHECK(spread.digits_lost() == Approx(digits_of(covariance)).margin(1e-8));
        go_through(inside, outside, n, 1.0, -1.0);
        covariance = carried(leaves, inside, covariance);
        CHECK(spread.digits_lost() == Approx(digits_of(covariance)).margin(1e-8));
    }
}

TEST_CASE("a path's digits are not followed unless that is asked for", "[trace]") {
    Lab lab;
    lab.body("ball", Sphere{0.3}, lab.medium(1.5));
    lab.rays({{{0.1, 0.0, -1.0}, {0.0, 0.0, 1.0}}});
    Traced const without = trace(lab);
    CHECK(without.result.digits.most < 0.0);
    lab.experiment.trace.digits_lost = true;
    Traced const with = trace(lab);
    REQUIRE(with.segments().size() == without.segments().size());
    std::uint64_t counted = 0;
    for (std::uint64_t const segments : with.result.digits.segments)
        counted += segments;
    CHECK(counted == with.segments().size());
    for (std::size_t i = 0; i < with.segments().size(); ++i) {
        CHECK(without.segments()[i].digits_lost == 0.0);
        CHECK(with.segments()[i].length == without.segments()[i].length);
    }
}

TEST_CASE("two paths through a pinball part as fast as their digits are lost", "[trace]") {
    // three mirrored balls, and a neighbour that starts a little aside
    Dice dice(9);
    int compared = 0;
    for (int k = 0; k < 8000 && compared < 40; ++k) {
        double const aside = 1e-13, angle = dice.between(0.0, 6.2831853);
        dvec3 const d(std::cos(angle), std::sin(angle), 0.0), across(-d.y, d.x, 0.0);
        std::array<std::vector<Segment>, 2> paths;
        for (std::size_t p = 0; p < 2; ++p) {
            Lab lab;
            SurfaceId const silver = lab.surface(Shares{1.0, 0.0});
            for (int b = 0; b < 3; ++b) {
                double const a = 2.0943951 * b;
                lab.body("ball " + std::to_string(b), Sphere{1.0}, lab.medium(1.5),
                         moved({2.0 * std::cos(a), 2.0 * std::sin(a), 0.0}))
                    .surface = silver;
            }
            lab.rays({{aside * static_cast<double>(p) * across, d}});
            lab.experiment.trace.max_depth = 12;
            lab.experiment.trace.digits_lost = true;
            paths[p] = trace(lab).segments();
        }
        if (paths[0].size() != paths[1].size() || paths[0].size() < 5)
            continue;
        std::size_t const last = paths[0].size() - 1;
        double const apart = length(paths[0][last].direction - paths[1][last].direction);
        if (apart > 1e-4) // no longer to first order
            continue;
        // the last segment's place is not compared: it escapes
        double const parted = std::log10(apart / aside);
        CHECK(paths[0][last].digits_lost == Approx(parted).margin(1.0));
        ++compared;
    }
    CHECK(compared >= 20);
}
