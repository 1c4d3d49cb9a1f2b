// The torture suite, thinned: no event is wrong, in any case, in the round variant and in some with other
// radii, triangulations, angles and places. With 1e6 rays a case: tests/benchmarks/next_hit.
#include "support/catch.h"
#include "torture/cases.h"
#include "torture/follow.h"
#include "torture/ours.h"

#include <algorithm>

using namespace sahl::bench;
using sahl::dvec3;

namespace {

using Adder = void (*)(std::vector<TortureCase>&, std::uint64_t);

void judge_case(TortureCase const& torture, Finder& method, std::uint64_t seed, std::uint64_t rays) {
    auto const drawn =
        std::max<std::uint64_t>(1, static_cast<std::uint64_t>(torture.share * static_cast<double>(rays)));
    Verdict const verdict = judge(torture, method, seed, drawn);
    CAPTURE(torture.name, torture.of, seed, verdict.events, verdict.stories);
    CHECK(verdict.wrong == 0);
    // what rounding leaves open: at most one ray in 1e5, here none or one
    CHECK(static_cast<double>(verdict.ambiguous) <= std::max(1.0, 1e-5 * static_cast<double>(verdict.rays)));
    CHECK(verdict.rays == drawn);
    CHECK(verdict.worst_shift <= 16.0); // of right hits from the exact place, in ulp of the coordinates
}

void check(Adder add, std::uint64_t variant, std::uint64_t rays, decltype(ours)* way = ours) {
    std::vector<TortureCase> cases;
    add(cases, variant);
    for (TortureCase const& torture : cases)
        judge_case(torture, *way(torture), variant + 1, rays);
}

} // namespace

TEST_CASE("rays through edges, corners and vertices meet what they should", "[torture]") {
    for (std::uint64_t variant : {0, 1, 2})
        check(add_edge_cases, variant, 2000);
}

TEST_CASE("rays that graze, or come near the critical angle or along the normal, meet what they should",
          "[torture]") {
    for (std::uint64_t variant : {0, 1})
        check(add_grazing_cases, variant, 2000);
}

TEST_CASE("bodies that touch, nest and overlap are met as they should be", "[torture]") {
    for (std::uint64_t variant : {0, 1, 2})
        check(add_contact_cases, variant, 1500);
}

TEST_CASE("paths of ten thousand events go where they should", "[torture]") {
    for (std::uint64_t variant : {0, 1})
        check(add_endless_cases, variant, 10'000);
}

TEST_CASE("thin, far, large and small bodies, and rays born on them, are met as they should be",
          "[torture]") {
    for (std::uint64_t variant : {0, 1})
        check(add_extreme_cases, variant, 2000);
}

TEST_CASE("meshes and exact shapes in one scene are met as they should be", "[torture]") {
    for (std::uint64_t variant : {0, 1, 2})
        check(add_mixed_cases, variant, 1500);
}

TEST_CASE("what works by itself works together", "[torture]") {
    for (std::uint64_t variant : {0, 1, 2})
        check(add_combined_cases, variant, 1500);
}

TEST_CASE("bodies of flat faces are met as their triangles by curved patches too", "[torture][curved]") {
    std::size_t judged = 0;
    for (Adder const add : {add_edge_cases, add_grazing_cases, add_contact_cases, add_endless_cases,
                            add_extreme_cases, add_mixed_cases, add_combined_cases}) {
        std::vector<TortureCase> cases;
        add(cases, 0);
        for (TortureCase const& torture : cases) {
            if (!is_flat_faced(torture))
                continue;
            ++judged;
            for (sahl::Curving const curving : {sahl::Curving::quadratic, sahl::Curving::fitted})
                judge_case(torture, *ours_curved(torture, curving), 1, 200);
        }
    }
    CHECK(judged > 20);
}

TEST_CASE("rays that are asked about with others meet what they should", "[torture]") {
    for (Adder const add : {add_edge_cases, add_grazing_cases, add_contact_cases, add_extreme_cases,
                            add_mixed_cases, add_combined_cases})
        for (auto const make : {ours_in_packets, ours_in_turn})
            check(add, 3, 500, make);
}

TEST_CASE("the judge of the torture suite sees a body that is not merged with what it touches", "[torture]") {
    std::vector<TortureCase> cases;
    add_contact_cases(cases, 0);
    std::uint64_t wrong = 0;
    for (TortureCase const& torture : cases)
        if (torture.name == "block on block" && torture.of == "mesh")
            wrong += judge(torture, *ours_without_contact(torture), 1, 1000).wrong;
    CHECK(wrong > 100);
}
