// In: a question to the catalogue. Out: the glasses and metals that answer it, with their figures.
#pragma once

#include "scene/value.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace sahl {

struct GlassQuestion {
    std::string name; // a name, a part of one, or a pattern with * and ?; empty: all
    std::vector<std::filesystem::path> catalogues; // the user's own, beside the built-in one
    double wavelength_nm = 587.5618;               // in standard air, > 0
    double thickness_mm = 10.0;                    // > 0
    std::optional<double> nd, vd;                  // the nearest to these are asked for
    std::size_t most = 10;                         // with nd or vd
};

/// Keys: at_nm, thickness_mm, `glasses` and `metals`, lists whose entries' keys docs/glass.md names. Glasses
/// stand in the order of the catalogue; with nd or vd the nearest first. Throws InputError, with names that
/// are near, where nothing has the name.
Value glass_report(GlassQuestion const& question);

/// The report for a person: one glass or metal as a card, several as a table, all as lists of names by maker.
std::string glass_text(Value const& report);

} // namespace sahl
