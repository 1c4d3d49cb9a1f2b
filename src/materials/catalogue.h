// In: a name. Out: the medium or metal that the built-in catalogue has under it.
#pragma once

#include "materials/medium.h"
#include "materials/surface.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

/// One entry of the catalogue of glasses, crystals and fluids.
struct GlassEntry {
    std::string maker, name; // "SCHOTT", "N-BK7"
    Medium medium;
    double nd = 0.0, vd = 0.0; // as the maker prints them; 0: not given
};

/// All entries, in the order of the catalogue.
std::vector<GlassEntry> const& glass_catalogue();

/// By "N-BK7" or "SCHOTT:N-BK7", whatever the case of the letters; "air" is 1 exactly, "vacuum" is 1/n_air.
/// Nothing where there is none.
std::optional<Medium> find_glass(std::string_view name);

/// By "silver", "aluminium", "gold", "copper". Nothing where there is none.
std::optional<Metal> find_metal(std::string_view name);

/// The names in the two lists, for messages.
std::vector<std::string> glass_names();
std::vector<std::string> metal_names();

} // namespace sahl
