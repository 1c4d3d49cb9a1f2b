// In: a curved tree. Out: walks of light through it, in and out and back inside, as a split tree has them,
// and what is lost on the way.
#pragma once

#include "geometry/curved_tree.h"
#include "math/random.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace sahl::bench {

struct CurvedWalk {
    std::uint64_t hits = 0, leaks = 0, recovered = 0;
    std::uint64_t crooked = 0; // crossings with numbers that are none, or not unit
    dvec3 lost_from{0.0}, lost_along{0.0};

    /// Until it leaves into the open, at most `most` crossings.
    void walk(CurvedTree const& tree, std::uint64_t ray, int most, double rounding) {
        Mesh const& mesh = tree.mesh();
        double const size = length(mesh.high - mesh.low);
        auto const turn = [&](int step, int place) {
            double const z =
                2.0 * uniform(ray, static_cast<std::uint64_t>(step), 2u + static_cast<unsigned>(place), 0) -
                1.0;
            double const angle =
                2.0 * std::numbers::pi *
                uniform(ray, static_cast<std::uint64_t>(step), 2u + static_cast<unsigned>(place), 1);
            return dvec3(std::sqrt(1.0 - z * z) * std::cos(angle), std::sqrt(1.0 - z * z) * std::sin(angle),
                         z);
        };
        dvec3 point = 0.5 * (mesh.low + mesh.high) + size * turn(0, 0);
        dvec3 direction = normalize(0.5 * (mesh.low + mesh.high) + 0.25 * size * turn(0, 1) - point);
        ShellSet inside;
        for (int step = 1; step < most; ++step) {
            auto const answer = tree.next(point, direction, {inside, {0}}, {0.0, INFINITY}, rounding);
            if (!answer.crossing) {
                if (!inside.empty()) {
                    ++leaks;
                    lost_from = point;
                    lost_along = direction;
                }
                return;
            }
            auto const& c = *answer.crossing;
            ++hits;
            recovered += c.recovered;
            bool const sound = std::abs(dot(c.normal, c.normal) - 1.0) < 1e-9 &&
                               std::abs(dot(c.geometric, c.geometric) - 1.0) < 1e-9 && std::isfinite(c.t) &&
                               std::isfinite(dot(c.point, c.point));
            crooked += !sound;
            if (!sound)
                return;
            point = c.point;
            dvec3 const facing = c.enters ? c.geometric : -c.geometric;
            bool const through =
                c.enters ? step < most / 2 || uniform(ray, static_cast<std::uint64_t>(step), 7, 0) < 0.7
                         : uniform(ray, static_cast<std::uint64_t>(step), 7, 0) < 0.2;
            dvec3 bent = through ? normalize(direction + 0.4 * turn(step, 2))
                                 : direction - 2.0 * dot(direction, facing) * facing;
            double const side = dot(bent, facing);
            if (through != (side < 0.0))
                bent -= 2.0 * side * facing;
            direction = normalize(bent);
            if (through) {
                ShellId const shell{mesh.shell_of(c.triangle)};
                inside.erase(shell);
                if (c.enters)
                    inside.insert(shell);
            }
        }
    }
};

} // namespace sahl::bench
