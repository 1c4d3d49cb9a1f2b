// In: an entry of a user's catalogue. Out: nothing, or why it cannot be traced with.
#include "materials/entry_check.h"

#include "math/input_error.h"

#include <cmath>

namespace sahl {

void check_entry(GlassEntry const& entry, std::string const& place) {
    auto const [from, to] = entry.medium.range;
    constexpr double longest = 1.0; // m: no light
    if (!(from > 0.0 && to >= from && to < longest))
        throw InputError(place, "the range of wavelengths of \"" + entry.name + "\" is not one",
                         "give two wavelengths in µm, both above 0, the shorter first");
    for (auto const& [wavelength, alpha] : entry.medium.absorption)
        if (!(std::isfinite(alpha) && alpha >= 0.0))
            throw InputError(place, "the absorption of \"" + entry.name + "\" is not finite",
                             "correct its figures");
    for (double const wavelength : {from, (from + to) / 2, to}) {
        double const n = refractive_index(entry.medium.index, wavelength);
        if (!(std::isfinite(n) && n > 0.0))
            throw InputError(place,
                             "\"" + entry.name + "\" has no real index at " +
                                 std::to_string(std::lround(wavelength * 1e9)) + " nm, within its own range",
                             "correct its coefficients or its range");
    }
}

} // namespace sahl
