// The law of mean chords in a refracting ball. A ray with the impact parameter b has chords of 2√(R² − b²/n²)
// inside, all alike. With the reflectance ρ of its surface the share 1 − ρ enters and (1 − ρ) ρᵏ is still
// inside for chord k: these shares sum to 1, whatever ρ is. So power times length, summed over all segments
// inside, and per unit of power that falls on the ball, is one chord; over a parallel beam that fills the
// ball, b² uniform in [0, R²], its mean is
//   L = ∫₀¹ 2R √(1 − v/n²) dv = (4n²/3) [1 − (1 − n⁻²)^{3/2}] R.
// It holds for s, for p and for their mean at each surface alike.
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

double mean_path_mm(double n, double radius_mm) {
    return 4.0 * n * n / 3.0 * (1.0 - std::pow(1.0 - 1.0 / (n * n), 1.5)) * radius_mm;
}

std::string ball(double n, double absorption_per_mm) {
    return text("[medium]\nglass = {n = ", n, ", absorption_per_mm = ", absorption_per_mm,
                "}\n[[object]]\nname = 'ball'\nmedium = 'glass'\nshape = {sphere = {radius_mm = 5}}\n");
}

} // namespace

// Quadrature in v = b²/R²: the integrand is regular up to v = n² > 1, and 24 nodes of Gauss leave less than
// 1e-15 of it. What is cut, 1e-13 of each ray, would have gone on for 1/(1 − ρ) more chords: at the outermost
// node, 1 − v = 1e-3, about ten.
TEST_CASE("light that fills a glass ball runs the mean chord in it, whatever Fresnel's shares are") {
    for (double const n : {1.333, 1.5168, 2.0}) {
        std::string rays;
        for (Node const& node : gauss_legendre(24))
            rays += text("[", 5.0 * std::sqrt(node.x), ", 0, -20, 0, 0, 1, ", node.weight, "], ");
        Run const run = bench::run(ball(n, 0.0) + "[[source]]\nname = 'beam'\nrays = [" + rays + "]\n",
                                   {"trace.min_power=1e-13", "trace.max_depth=2000"});
        long double sum = 0.0L;
        for (Segment const& segment : run.segments)
            if (run.names.media[segment.medium] == "glass" && segment.length > 0.0)
                sum += static_cast<long double>(segment.power_start) * segment.length;
        CAPTURE(n);
        CHECK(std::abs(1e3 * static_cast<double>(sum) - mean_path_mm(n, 5.0)) < 1e-11 * mean_path_mm(n, 5.0));
    }
}

// Weak absorption measures the same path: 1 − exp(−αL) = αL (1 − …), with α times a few chords below 1e-4.
// The beam's sampling: chords vary by σ = 0.08 of their mean, so independent points would err by 0.08/√16384
// = 6e-4; four of that, and the low discrepancy of the pattern only helps.
TEST_CASE("weak absorption in a glass ball measures the mean chord") {
    double const n = 1.5168, alpha = 1e-6;
    Value const summary =
        summarise(ball(n, alpha) + "[[source]]\nname = 'beam'\nbeam = {from_mm = [0, 0, -20], "
                                   "toward = [0, 0, 1], radius_mm = 5, pattern = 'sobol', rays = 16384}\n",
                  {"trace.max_depth=200"});
    double const path_mm = number_at(summary, {"absorbed_W", "ball", "bulk"}) / alpha;
    CHECK(std::abs(path_mm / mean_path_mm(n, 5.0) - 1.0) < 2.4e-3 + 1e-4);
}
