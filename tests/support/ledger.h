// In: a log's rows. Out: the energy ledger, summed anew from them alone.
#pragma once

#include "trace/segment.h"

#include <span>
#include <vector>

namespace sahl::bench {

/// In extended precision, so that the sums add no rounding of their own.
struct Ledger {
    long double emitted = 0, detected = 0, absorbed = 0, escaped = 0, cut = 0, error = 0;
    long double remainder() const { return emitted - detected - absorbed - escaped - cut - error; }
};

/// Of whole trees in the order of the log. Absorbed is what is lost along each segment, and what arrives at
/// each interaction and does not leave it.
inline Ledger ledger_of(std::span<Segment const> rows) {
    Ledger ledger;
    std::vector<long double> leaves(rows.size(), 0.0L); // by row: what its children start with
    std::size_t root = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].parent < 0) {
            root = i;
            ledger.emitted += rows[i].power_start;
        } else {
            leaves[root + static_cast<std::size_t>(rows[i].parent)] += rows[i].power_start;
        }
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        Segment const& row = rows[i];
        ledger.absorbed += static_cast<long double>(row.power_start) - row.power_end;
        switch (row.ended) {
        case Event::detected:
            ledger.detected += row.power_end;
            break;
        case Event::escaped:
            ledger.escaped += row.power_end;
            break;
        case Event::cut_power:
        case Event::cut_depth:
            ledger.cut += row.power_end;
            break;
        case Event::leak:
        case Event::invalid:
            ledger.error += row.power_end;
            break;
        default:
            ledger.absorbed += row.power_end - leaves[i];
        }
    }
    return ledger;
}

} // namespace sahl::bench
