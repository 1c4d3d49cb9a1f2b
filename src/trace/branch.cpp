#include "trace/branch.h"

#include "math/random.h"

namespace sahl {

namespace {

constexpr std::uint32_t roulette_draw = 0; // interactions draw from 1 on

} // namespace

void choose(Branches& branches, TraceOptions const& options, double power, double initial, std::uint16_t depth,
            Draw const& draw, InlineVector<double, 2>& powers, InlineVector<Event, 2>& fates) {
    auto& out = branches.outgoing;
    bool const both = out.size() == 2;
    bool const split = options.branch == BranchPolicy::split || !both ||
                       (options.branch == BranchPolicy::roulette && (depth < 2 || power > options.split_until * initial));
    if (!split && options.branch == BranchPolicy::roulette) {
        // one branch, drawn by share, carries all that is not absorbed: unbiased, and each ray's ledger closes
        double const total = out[0].share + out[1].share;
        bool const first = uniform(draw.seed, draw.ray, draw.place, roulette_draw) * total < out[0].share;
        out.erase(first ? out.begin() + 1 : out.begin());
        powers.push_back(power * (1.0 - branches.absorbed));
        fates.push_back(Event::none);
        return;
    }
    for (Outgoing const& outgoing : out) {
        powers.push_back(power * outgoing.share);
        fates.push_back(Event::none);
    }
    if (!split && options.branch == BranchPolicy::dominant)
        fates[out[0].share >= out[1].share ? 1 : 0] = Event::cut_power;
}

} // namespace sahl
