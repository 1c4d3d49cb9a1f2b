// In: paths of catalogues, names of glasses. Out: glasses.
#include "scene/read_catalogues.h"

#include "materials/catalogue_files.h"
#include "math/input_error.h"
#include "scene/read_file.h"
#include "scene/read_table.h"

#include <algorithm>

namespace sahl {
namespace {

/// The one that is meant, nullptr where there is none.
GlassEntry const* only_one(std::span<GlassEntry const> catalogue, std::string_view name, Place const& place) {
    auto const found = glasses_called(catalogue, name);
    if (found.size() < 2)
        return found.empty() ? nullptr : found.front();
    std::vector<std::string> names;
    for (GlassEntry const* const entry : found)
        names.push_back(entry->full_name());
    bool const distinct = std::adjacent_find(names.begin(), names.end()) == names.end();
    throw InputError(place.text(), "more than one glass is called \"" + std::string(name) + "\"",
                     distinct
                         ? "write " + listed(names) + ": one of these"
                         : "rename one of them, or one of the catalogues' files: all are " + names.front());
}

} // namespace

std::vector<GlassEntry> read_catalogue_file(std::filesystem::path const& path) {
    constexpr std::uintmax_t most = std::uintmax_t(1) << 26; // the largest of the makers' has about 1 MB
    std::error_code error;
    std::uintmax_t const size = std::filesystem::file_size(path, error);
    if (!error && size > most)
        throw InputError(path.string(), "this catalogue has more than 64 MiB", "split it");
    std::string const text = file_text(path), stem = path.stem().string();
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    if (ending == ".agf")
        return read_agf(text, path.string(), stem);
    if (ending == ".yml" || ending == ".yaml")
        return {read_material_page(text, path.string(), stem)};
    throw InputError(path.string(), "a catalogue does not end in \"" + ending + "\"",
                     "Zemax catalogues (.agf) and refractiveindex.info pages (.yml, .yaml) are understood");
}

std::vector<GlassEntry> read_catalogues(Value const* list, std::filesystem::path const& folder) {
    std::vector<GlassEntry> glasses;
    if (!list)
        return glasses;
    for (Value const& item : std::get<Array>(list->data)) {
        auto read = read_catalogue_file(existing_file(folder, std::get<std::string>(item.data), item.place));
        std::move(read.begin(), read.end(), std::back_inserter(glasses));
    }
    return glasses;
}

GlassEntry const* find_entry(std::span<GlassEntry const> own, std::string_view name, Place const& place) {
    if (GlassEntry const* const entry = only_one(own, name, place))
        return entry;
    return only_one(glass_catalogue(), name, place);
}

std::string similar_entries(std::span<GlassEntry const> own, std::string_view name) {
    std::vector<GlassEntry> all(own.begin(), own.end());
    all.insert(all.end(), glass_catalogue().begin(), glass_catalogue().end());
    std::string text;
    for (std::string const& similar : similar_glasses(all, name))
        text += (text.empty() ? "did you mean '" : ", '") + similar + "'";
    return text.empty() ? text : text + "?";
}

} // namespace sahl
