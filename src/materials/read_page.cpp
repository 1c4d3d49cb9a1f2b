// In: a page of the refractiveindex.info database, in the YAML that it is written in. Out: one material.
// Of YAML it needs maps, one list of maps, and blocks of text; what is beside that is refused, not guessed.
#include "materials/catalogue_files.h"

#include "materials/entry_check.h"
#include "materials/formulas.h"
#include "materials/text_lines.h"
#include "math/input_error.h"

#include <algorithm>
#include <optional>

namespace sahl {
namespace {

constexpr double um_to_metres = 1e-6;
constexpr double pi = 3.14159265358979323846;

/// One entry of DATA: what stands under its keys, and the rows of its block of text.
struct Part {
    TextLine line{};
    std::string_view type, range, coefficients;
    std::vector<TextLine> rows;
};

struct Page {
    std::vector<Part> parts;
    bool index_is_absolute = false, wavelength_is_vacuum = false;
};

struct KeyLine {
    std::size_t indent = 0;
    bool starts_item = false; // "- key: value"
    std::string_view key, value;
};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
        text.remove_suffix(1);
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front())
        text = text.substr(1, text.size() - 2);
    return text;
}

/// Nothing for a line without a key.
std::optional<KeyLine> key_line(std::string_view text) {
    KeyLine line;
    line.indent = std::min(text.find_first_not_of(' '), text.size());
    text.remove_prefix(line.indent);
    if (text.starts_with("- ")) {
        line.starts_item = true;
        text.remove_prefix(2);
    }
    auto const colon = text.find(':');
    if (text.empty() || text.front() == '#' || colon == text.npos ||
        (colon + 1 < text.size() && text[colon + 1] != ' '))
        return std::nullopt;
    line.key = trimmed(text.substr(0, colon));
    line.value = trimmed(text.substr(colon + 1));
    return line;
}

bool begins_block(std::string_view value) {
    return value.starts_with('|') || value.starts_with('>');
}

std::size_t indent_of(std::string_view text) {
    return std::min(text.find_first_not_of(' '), text.size());
}

bool truth(std::string_view value) {
    return value == "true" || value == "True" || value == "yes";
}

void take(Page& page, std::string_view section, KeyLine const& key, TextLine const& line,
          std::string const& file) {
    if (section == "SPECS" || section == "CONDITIONS") {
        if (key.key == "n_is_absolute")
            page.index_is_absolute = truth(key.value);
        if (key.key == "wavelength_is_vacuum")
            page.wavelength_is_vacuum = truth(key.value);
    }
    if (section != "DATA")
        return;
    if (key.starts_item)
        page.parts.emplace_back().line = line;
    if (page.parts.empty())
        throw InputError(place_of(file, line), "this stands in no entry of DATA",
                         "begin each entry with \"- type: …\"");
    Part& part = page.parts.back();
    if (key.key == "type")
        part.type = key.value;
    else if (key.key == "wavelength_range" || key.key == "range")
        part.range = key.value;
    else if (key.key == "coefficients")
        part.coefficients = key.value;
}

Page parse(std::string_view text, std::string const& file) {
    Page page;
    std::string_view section;
    auto const lines = lines_of(text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        auto const key = key_line(lines[i].text);
        if (!key) {
            if (section == "DATA" && !words_of(lines[i].text).empty() &&
                trimmed(lines[i].text).front() != '#')
                throw InputError(place_of(file, lines[i]), "this is no key with a value",
                                 "write pages as the refractiveindex.info database does");
            continue;
        }
        if (key->indent == 0 && !key->starts_item)
            section = key->key;
        else
            take(page, section, *key, lines[i], file);
        if (!begins_block(key->value))
            continue;
        std::size_t const within = key->indent + (key->starts_item ? 2 : 0);
        while (i + 1 < lines.size() &&
               (words_of(lines[i + 1].text).empty() || indent_of(lines[i + 1].text) > within)) {
            ++i;
            if (section == "DATA" && key->key == "data" && !words_of(lines[i].text).empty())
                page.parts.back().rows.push_back(lines[i]);
        }
    }
    return page;
}

/// The rows of a table, each of `columns` numbers, in the order of wavelength, which must not occur twice.
std::vector<std::vector<double>> table_of(Part const& part, std::size_t columns, std::string const& file) {
    std::vector<std::vector<double>> rows;
    for (TextLine const& line : part.rows) {
        auto row = numbers_of(words_of(line.text), place_of(file, line));
        bool const negative = std::any_of(row.begin(), row.end(), [](double x) { return x < 0.0; });
        if (row.size() != columns || negative || row[0] == 0.0)
            throw InputError(place_of(file, line), "this is no row of " + std::string(part.type),
                             "write " + std::to_string(columns) +
                                 " numbers, a wavelength in µm above 0 first, and none negative");
        rows.push_back(std::move(row));
    }
    if (rows.empty())
        throw InputError(place_of(file, part.line), "this table is empty", "give it rows under \"data: |\"");
    std::stable_sort(rows.begin(), rows.end(), [](auto const& a, auto const& b) { return a[0] < b[0]; });
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end()); // some pages print a row twice
    for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i][0] == rows[i - 1][0])
            throw InputError(place_of(file, part.line), "a wavelength occurs twice, with different figures",
                             "keep one of the two rows");
    return rows;
}

void take_index_table(GlassEntry& entry, std::vector<std::vector<double>> const& rows) {
    TabulatedIndex table;
    for (auto const& row : rows)
        table.points.emplace_back(row[0] * um_to_metres, row[1]);
    entry.medium.range = {table.points.front().first, table.points.back().first};
    entry.medium.index = std::move(table);
}

/// α = 4πk/λ
void take_extinction(GlassEntry& entry, std::vector<std::vector<double>> const& rows, std::size_t column) {
    for (auto const& row : rows)
        entry.medium.absorption.emplace_back(row[0] * um_to_metres,
                                             4 * pi * row[column] / (row[0] * um_to_metres));
}

void take_formula(GlassEntry& entry, Part const& part, int number, std::string const& file) {
    std::string const place = place_of(file, part.line);
    entry.coefficients = numbers_of(words_of(part.coefficients), place);
    auto const index = page_formula(number, entry.coefficients);
    if (!index)
        throw InputError(place,
                         "this is no " + std::string(part.type) + " with " +
                             std::to_string(entry.coefficients.size()) + " coefficients",
                         "give a formula from 1 to 9 and as many coefficients as it has");
    auto const range = numbers_of(words_of(part.range), place);
    if (range.size() != 2)
        throw InputError(place, "wavelength_range is not two numbers", "give both ends in µm");
    entry.medium.range = {range[0] * um_to_metres, range[1] * um_to_metres};
    entry.medium.index = *index;
}

/// Whether the part gives an index; what it gives goes to the entry.
bool take_part(GlassEntry& entry, Part const& part, std::string const& file) {
    constexpr std::string_view formula = "formula ";
    if (part.type == "tabulated k") {
        take_extinction(entry, table_of(part, 2, file), 1);
        return false;
    }
    entry.formula = std::string(part.type);
    if (part.type == "tabulated n" || part.type == "tabulated nk") {
        auto const rows = table_of(part, part.type == "tabulated n" ? 2 : 3, file);
        take_index_table(entry, rows);
        if (part.type == "tabulated nk")
            take_extinction(entry, rows, 2);
    } else if (part.type.starts_with(formula) && part.type.size() == formula.size() + 1)
        take_formula(entry, part, part.type.back() - '0', file);
    else
        throw InputError(place_of(file, part.line),
                         "there is no type \"" + std::string(part.type.substr(0, 40)) + "\"",
                         "formula 1 to 9, tabulated n, tabulated k and tabulated nk are understood");
    return true;
}

} // namespace

GlassEntry read_material_page(std::string_view bytes, std::string const& file, std::string const& name) {
    std::string const text = without_byte_order(bytes);
    Page const page = parse(text, file);
    GlassEntry entry;
    entry.name = entry.medium.name = name;
    int indices = 0;
    for (Part const& part : page.parts) {
        bool const had_absorption = !entry.medium.absorption.empty();
        std::size_t const before = entry.medium.absorption.size();
        indices += take_part(entry, part, file) ? 1 : 0;
        if (had_absorption && entry.medium.absorption.size() > before)
            throw InputError(place_of(file, part.line), "this page gives k more than once", "keep one table");
    }
    if (indices != 1)
        throw InputError(file,
                         indices == 0 ? "this page gives no refractive index"
                                      : "this page gives more than one refractive index",
                         "DATA needs one entry that is a formula, tabulated n or tabulated nk");
    auto& absorption = entry.medium.absorption;
    if (std::none_of(absorption.begin(), absorption.end(), [](auto const& p) { return p.second > 0.0; }))
        absorption.clear();
    bool const gas =
        std::holds_alternative<GasIndex>(entry.medium.index); // divides by the index of air itself
    if (page.wavelength_is_vacuum || (page.index_is_absolute && !gas))
        entry.medium.index =
            AbsoluteIndex{std::make_shared<AnyDispersion const>(AnyDispersion{entry.medium.index}),
                          page.index_is_absolute && !gas, page.wavelength_is_vacuum};
    check_entry(entry, file);
    return entry;
}

} // namespace sahl
