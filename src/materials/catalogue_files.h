// In: the text of a catalogue of a user's own. Out: its glasses, or an InputError with the line.
#pragma once

#include "materials/catalogue.h"

#include <string>
#include <string_view>
#include <vector>

namespace sahl {

/// A Zemax AGF file: one glass for each NM line, with what its CD, LD and IT lines say. Indices are those at
/// the file's own reference temperature and relative to air; temperature (TD) is not modelled. IT lines
/// become absorption: α = −ln(T)/thickness; a transmittance printed as 0 is taken as 10⁻⁶. UTF-16 is
/// understood. `maker` is what stands before the colon in full names. Throws InputError, with `file` and the
/// line, where a number is none, a formula is not one of 1 to 13, or an index is not real within its range.
std::vector<GlassEntry> read_agf(std::string_view text, std::string const& file, std::string const& maker);

/// A page of the refractiveindex.info database (YAML): formula 1 to 9, or tabulated n, k and nk; `name` is
/// the name it gets. n_is_absolute and wavelength_is_vacuum are obeyed; formula 6 is absolute. Throws
/// InputError as read_agf does.
GlassEntry read_material_page(std::string_view text, std::string const& file, std::string const& name);

} // namespace sahl
