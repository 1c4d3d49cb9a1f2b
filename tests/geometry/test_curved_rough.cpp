// Curved meshes as a scanner leaves them: the surface through them is rough, and closed.
#include "support/catch.h"
#include "support/curved.h"
#include "support/curved_walk.h"

using namespace sahl;
using namespace sahl::bench;

TEST_CASE("no light is lost in a rough curved mesh, and nothing that is met is not a number", "[curved]") {
    for (double const noise :
         {0.0, 1e-3, 0.05, 0.15, 0.3}) // of an edge; at the last many triangles are folded
        for (PatchKind const kind : {PatchKind::quadratic, PatchKind::fitted, PatchKind::apart}) {
            CurvedTree const tree(noisy_ball(5e-3, 12, noise), kind);
            CurvedWalk count;
            for (std::uint64_t ray = 0; count.hits < 3000; ++ray)
                count.walk(tree, ray, 40, 1e-16);
            CAPTURE(noise, static_cast<int>(kind));
            CHECK(count.leaks == 0);
            CHECK(count.crooked == 0);
            CHECK(count.recovered <= 30); // one in a hundred: what is recovered is counted, and said
        }
}

TEST_CASE("neighbouring patches have their common side to the last bit, rough or not", "[curved]") {
    for (double const noise : {0.0, 0.02, 0.3}) {
        CurvedTree const tree(noisy_ball(5e-3, 6, noise), PatchKind::fitted);
        auto const& triangles = tree.fans().triangles;
        std::size_t compared = 0;
        double gap = 0.0;
        for (std::uint32_t t = 0; t < triangles.size(); ++t)
            for (std::size_t k = 0; k < 3; ++k) {
                std::uint32_t const other = triangles[t].beside[k];
                if (other == SmoothTriangle::none)
                    continue;
                auto const place = [&](std::uint32_t triangle, std::uint32_t from, std::uint32_t to,
                                       double along) {
                    auto const& fans = triangles[triangle].fans;
                    auto const weight = [&](std::size_t corner) {
                        return fans[corner] == from ? 1.0 - along : fans[corner] == to ? along : 0.0;
                    };
                    return point_on(tree.patch(triangle), weight(1), weight(2)).place;
                };
                std::uint32_t const from = triangles[t].fans[(k + 1) % 3],
                                    to = triangles[t].fans[(k + 2) % 3];
                for (double const along : {0.0, 0.2, 0.5, 0.9, 1.0}) {
                    gap = std::max(gap, length(place(t, from, to, along) - place(other, from, to, along)));
                    ++compared;
                }
            }
        if (noise < 0.1) // beyond, folds are creases: there a side is nobody's in common
            CHECK(compared == 5 * 3 * triangles.size());
        CHECK(2 * compared > 5 * 3 * triangles.size());
        CHECK(gap < 1e-17); // m; an ulp of the coordinates is 9e-19
    }
}
