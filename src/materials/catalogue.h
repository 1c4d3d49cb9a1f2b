// In: a name. Out: the medium or metal that the built-in catalogue, or a list of a user's own, has under it.
#pragma once

#include "materials/medium.h"
#include "materials/surface.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

/// One entry of a catalogue of glasses, crystals and fluids.
struct GlassEntry {
    std::string maker, name; // "SCHOTT", "N-BK7"; a catalogue of a user's own may have no maker
    Medium medium;
    double nd = 0.0, vd = 0.0; // as the maker prints them; 0: not given
    std::string formula;       // "formula 2", as its source calls it
    std::vector<double> coefficients;

    /// "SCHOTT:N-BK7"
    std::string full_name() const { return maker.empty() ? name : maker + ":" + name; }
};

/// All built-in entries, in the order of the catalogue. "air" is 1 exactly, "vacuum" is 1/n_air.
std::vector<GlassEntry> const& glass_catalogue();

/// Those that "N-BK7" or "SCHOTT:N-BK7" names, whatever the case of the letters. More than one: makers share
/// the name.
std::vector<GlassEntry const*> glasses_called(std::span<GlassEntry const> catalogue, std::string_view name);

/// Up to `most` full names that may have been meant: first those that `name` is a part of, then the nearest
/// by letters.
std::vector<std::string> similar_glasses(std::span<GlassEntry const> catalogue, std::string_view name,
                                         std::size_t most = 6);

/// The built-in glass of this name. Nothing where there is none, or where makers share the name.
std::optional<Medium> find_glass(std::string_view name);

/// By "silver", "aluminium", "gold", "copper". Nothing where there is none.
std::optional<Metal> find_metal(std::string_view name);
std::vector<std::string> metal_names();

} // namespace sahl
