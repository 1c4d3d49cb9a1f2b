// In: paths of catalogues, names of glasses. Out: a user's own glasses, and the one that a name means.
#pragma once

#include "materials/catalogue.h"
#include "scene/value.h"

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace sahl {

/// The glasses of a Zemax AGF file (.agf) or a page of the refractiveindex.info database (.yml, .yaml). The
/// file's name without its ending is what stands before the colon in the glasses' full names, or the name of
/// the page's one material. Throws InputError with file and line, and for more than 64 MiB.
std::vector<GlassEntry> read_catalogue_file(std::filesystem::path const& path);

/// Those of a list of paths relative to `folder`; none where there is no list.
std::vector<GlassEntry> read_catalogues(Value const* list, std::filesystem::path const& folder);

/// The glass that a name means: one of `own`, or else a built-in one; nullptr where there is none. Throws
/// InputError, with the full names, where a name has several glasses.
GlassEntry const* find_entry(std::span<GlassEntry const> own, std::string_view name, Place const& place);

/// "did you mean 'SCHOTT:N-BK7', …?": full names that may have been meant; empty where nothing is known.
std::string similar_entries(std::span<GlassEntry const> own, std::string_view name);

} // namespace sahl
