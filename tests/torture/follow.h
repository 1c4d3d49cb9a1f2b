// In: a case of the torture suite and a method. Out: how many events of its paths are right, wrong, or not to
// be told apart by rounding. Every event is judged by itself, from where the method then stands: the point
// that it holds, moved onto the surface that it says it is on, and its direction.
#pragma once

#include "torture/finder.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sahl::bench {

struct Verdict {
    std::uint64_t rays = 0, events = 0, wrong = 0, ambiguous = 0, lost = 0; // lost: of the wrong ones
    std::vector<std::string> stories; // of the first wrong and ambiguous ones
    double worst_shift =
        0.0; // of right hits from the exact place, along the normal, in ulp of the coordinates

    double wrong_per_million() const {
        return events ? 1e6 * static_cast<double>(wrong) / static_cast<double>(events) : 0.0;
    }
};

/// Rays first … first + rays of the case as `seed` draws them. A wrong event ends its path.
Verdict judge(TortureCase const& torture, Finder& method, std::uint64_t seed, std::uint64_t rays);

/// The same paths with nobody to judge them: events, and what they add up to, so that none is left out.
struct Walked {
    std::uint64_t events = 0;
    double sum = 0.0;
};
Walked walk(TortureCase const& torture, Finder& method, std::vector<TortureRay> const& rays,
            std::vector<std::vector<std::uint32_t>> const& inside);

/// The rays of a case, and which bodies each is in.
std::vector<TortureRay> rays_of(TortureCase const& torture, std::uint64_t seed, std::uint64_t rays);
std::vector<std::vector<std::uint32_t>> insides_of(TortureCase const& torture,
                                                   std::vector<TortureRay> const& rays);

} // namespace sahl::bench
