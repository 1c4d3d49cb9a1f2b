// In: an entry of a user's catalogue. Out: nothing, or an InputError where it cannot be traced with.
#pragma once

#include "materials/catalogue.h"

#include <string>

namespace sahl {

/// Throws InputError at `place` where the range is not two wavelengths above 0 in order, or where the index
/// is not a number above 0 at its ends or in its middle.
void check_entry(GlassEntry const& entry, std::string const& place);

} // namespace sahl
