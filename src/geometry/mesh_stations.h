// In: where a line crosses the triangles of one closed shell. Out: the places where it does, each one counted
// together, and how often the shell goes round the line before and after it.
#pragma once

#include "geometry/mesh_tree.h"

#include <vector>

namespace sahl {

/// Crossings of one shell at one place, and how often the shell goes round the line before and after it.
struct Station {
    MeshCrossing const* steepest = nullptr; // it tells best where the place is
    MeshCrossing const* into = nullptr;     // the steepest of each sense
    MeshCrossing const* out = nullptr;
    int turns_before = 0, turns_after = 0;
};

/// `first`…`last` are the crossings of one shell in the order of t.
template <class Iterator>
std::vector<Station> stations_of(Iterator first, Iterator last, double rounding) {
    std::vector<Station> stations;
    for (Iterator c = first; c != last; ++c) {
        bool const same_place =
            !stations.empty() && c->t - stations.back().steepest->t <=
                                     stations.back().steepest->blur(rounding) + c->blur(rounding);
        if (!same_place)
            stations.push_back({&*c});
        Station& here = stations.back();
        MeshCrossing const*& sense = c->enters ? here.into : here.out;
        if (!sense || c->slope > sense->slope)
            sense = &*c;
        if (c->slope > here.steepest->slope)
            here.steepest = &*c;
        here.turns_after += c->enters ? 1 : -1;
    }
    // far along the line is outside; each crossing counts, since the watertight test gives none twice
    int turns = 0;
    for (std::size_t k = stations.size(); k-- > 0;) {
        Station& here = stations[k];
        here.turns_before = turns - here.turns_after;
        here.turns_after = turns;
        turns = here.turns_before;
    }
    return stations;
}

} // namespace sahl
