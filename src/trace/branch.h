// In: nothing. Out: a branch of a ray's tree that waits to be traced, and the policies that choose among its
// children.
#pragma once

#include "geometry/bvh.h"
#include "scene/experiment.h"
#include "trace/interact.h"

#include <cstdint>

namespace sahl {

struct Branch {
    dvec3 origin{0.0}, direction{0.0};
    double power = 0.0;        // W
    double optical_path = 0.0; // m, from the source
    std::uint64_t place = 0;   // hash of the choices from the root: the key of its random numbers
    std::uint32_t ray = 0;     // within the group that is traced together
    std::int32_t parent = -1;
    std::optional<ObjectId> body; // whose medium it runs through
    MediumId medium;
    std::uint16_t depth = 0;
    Event born = Event::emitted;
    Event fate = Event::none; // cut_power, invalid: it ends where it begins
    ShellSet inside;
    LeftSheets left;
};

/// Splits, draws or drops: gives the branches that go on their power; a branch that is dropped stays, marked
/// as cut.
///   power    that arrives, after absorption on the way (W)
///   initial  of the source's ray (W)
void choose_one(Branches& branches, TraceOptions const& options, double power, double initial,
                std::uint16_t depth, Draw const& draw);
inline void choose(Branches& branches, TraceOptions const& options, double power, double initial,
                   std::uint16_t depth, Draw const& draw) {
    for (Outgoing& outgoing : branches.outgoing)
        outgoing.power = power * outgoing.share;
    if (options.branch != BranchPolicy::split && branches.outgoing.size() == 2)
        choose_one(branches, options, power, initial, depth, draw);
}

} // namespace sahl
