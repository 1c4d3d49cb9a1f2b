// In: the energy ledger of a summary. Out: whether it closes, and a bar and a table of where the power went.
#pragma once

#include "scene/value.h"

#include <array>
#include <optional>
#include <string>

namespace sahl::report {

inline constexpr std::array<char const*, 5> ledger_terms{"detected", "absorbed", "escaped", "cut", "error"};

/// Per cent of the bar for each term: its part of the sum of all, 0 for a term that is absent or negative.
/// Nothing where no term is above 0.
std::optional<std::array<double, 5>> bar_widths(Value const& summary);

/// Is the remainder, as a share of what was emitted, within options.limit_ledger (1e-12 where that is not
/// stated)? Nothing where the summary has no ledger.
std::optional<bool> ledger_closes(Value const& summary);

/// How many events are counted, `recovered` apart, which ends no segment.
double events_of(Value const& summary);

/// Are leaks and invalid segments, as a share of the events, within options.limit_leak (1e-6)? Nothing where
/// no events are counted.
std::optional<bool> leaks_within_limit(Value const& summary);

/// A tick or a flag with what it says, the bar, the table, and where light was absorbed. Empty without a
/// ledger.
std::string ledger_html(Value const& summary);

} // namespace sahl::report
