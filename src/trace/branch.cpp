#include "trace/branch.h"

#include "math/random.h"

namespace sahl {

namespace {

constexpr std::uint32_t roulette_draw = 0; // interactions draw from 1 on

} // namespace

void choose_one(Branches& branches, TraceOptions const& options, double power, double initial,
                std::uint16_t depth, Draw const& draw) {
    auto& out = branches.outgoing;
    if (options.branch == BranchPolicy::dominant) {
        out[out[0].share >= out[1].share ? 1 : 0].fate = Event::cut_power;
        return;
    }
    if (depth < options.split_depth || power > options.split_until * initial)
        return;
    // one branch, drawn by share, carries all that is not absorbed: unbiased, and each ray's ledger closes
    double const total = out[0].share + out[1].share;
    bool const first = uniform(draw.seed, draw.ray, draw.place, roulette_draw) * total < out[0].share;
    out.erase(first ? out.begin() + 1 : out.begin());
    out[0].power = power * (1.0 - branches.absorbed);
}

} // namespace sahl
