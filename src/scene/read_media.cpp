// In: the tables [medium.NAME]. Out: media with their index and absorption, an id for each that is referred
// to.
#include "scene/read_media.h"

#include "math/input_error.h"
#include "math/nearest_name.h"
#include "scene/read_catalogues.h"
#include "scene/read_table.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

Medium read_glass(Fields const& fields, std::span<GlassEntry const> own) {
    std::string const name = fields.text("glass");
    if (GlassEntry const* const entry = find_entry(own, name, fields.place("glass")))
        return entry->medium;
    throw InputError(fields.place("glass").text(), "there is no glass \"" + name + "\" in the catalogue",
                     similar_entries(own, name));
}

Dispersion read_sellmeier(Value const& table) {
    Fields const fields(table, keys::sellmeier);
    Sellmeier formula{fields.numbers("B"), fields.numbers("C_um2"), 0.0};
    if (formula.b.empty() || formula.b.size() != formula.c_um2.size())
        throw InputError(fields.place("C_um2").text(),
                         "B has " + std::to_string(formula.b.size()) + " numbers and C_um2 has " +
                             std::to_string(formula.c_um2.size()),
                         "give as many of each, at least one");
    return formula;
}

Dispersion read_cauchy(Value const& table) {
    Fields const fields(table, keys::cauchy);
    return Cauchy{fields.number("A"), fields.number("B_um2"), fields.number("C_um4")};
}

/// [[nm, x], …] in m, x multiplied by `factor`; wavelengths > 0 and x not below `least` (nor equal to it if
/// `above`).
std::vector<std::pair<double, double>> read_spectral_table(Value const& list, double factor, bool above) {
    auto points = ascending_pairs(list);
    if (points.empty())
        throw InputError(list.place.text(), "this list is empty", "give at least one row [nm, value]");
    for (std::size_t i = 0; i < points.size(); ++i) {
        auto& [wavelength, x] = points[i];
        if (wavelength <= 0.0 || x < 0.0 || (above && x == 0.0))
            throw InputError(std::get<Array>(list.data)[i].place.text(), "this row has a number out of range",
                             above ? "give wavelengths in nm and indices, both above 0"
                                   : "give wavelengths in nm above 0 and absorption in 1/mm of at least 0");
        wavelength *= 1e-9;
        x *= factor;
    }
    return points;
}

Medium read_index(Fields const& fields, std::span<GlassEntry const> own) {
    for (auto const& [one, other] : {std::pair{"nd", "vd"}, std::pair{"vd", "nd"}})
        if (fields.has(one) && !fields.has(other))
            throw InputError(fields.place(one).text(), fields.called(one) + " stands without " + other,
                             "give both");
    std::string const kind = fields.only_one_of({"glass", "n", "nd", "sellmeier", "cauchy", "table"});
    if (kind == "glass")
        return read_glass(fields, own);
    Medium medium;
    if (kind == "n")
        medium.index = ConstantIndex{fields.number("n")};
    else if (kind == "nd")
        medium.index = AbbeIndex{fields.number("nd"), fields.number("vd")};
    else if (kind == "sellmeier")
        medium.index = read_sellmeier(fields.at("sellmeier"));
    else if (kind == "cauchy")
        medium.index = read_cauchy(fields.at("cauchy"));
    else {
        auto points = read_spectral_table(fields.at("table"), 1.0, true);
        medium.range = {points.front().first, points.back().first};
        medium.index = TabulatedIndex{std::move(points)};
    }
    return medium;
}

void read_absorption(Fields const& fields, Medium& medium) {
    constexpr double per_m_in_per_mm = 1000.0;
    if (fields.has("absorption") && fields.has("absorption_per_mm"))
        throw InputError(fields.place("absorption_per_mm").text(),
                         "absorption and absorption_per_mm stand side by side", "keep one of the two");
    if (fields.has("absorption_per_mm")) {
        // The wavelength of a single point has no meaning: one point holds everywhere.
        medium.absorption = {{587.5618e-9, fields.number("absorption_per_mm") * per_m_in_per_mm}};
        return;
    }
    if (!fields.has("absorption"))
        return;
    Value const& value = fields.at("absorption");
    if (auto const* truth = std::get_if<bool>(&value.data)) {
        if (!*truth)
            medium.absorption.clear();
        else if (!fields.has("glass"))
            throw InputError(value.place.text(),
                             fields.called("absorption") + " is true, but only glass has some to turn on",
                             "give absorption_per_mm or absorption = [[nm, 1/mm], …]");
        return;
    }
    if (!has_kind(value, Kind::pairs))
        throw InputError(value.place.text(), fields.called("absorption") + " is " + quoted_value(value),
                         "give [[nm, 1/mm], …], or false for none");
    medium.absorption = read_spectral_table(value, per_m_in_per_mm, false);
}

} // namespace

MediaBook::MediaBook(Value const* definitions, std::vector<GlassEntry> own) : own_(std::move(own)) {
    if (!definitions)
        return;
    for (auto const& [name, table] : std::get<Table>(definitions->data)) {
        check_name(name, table.place);
        Fields const fields(table, keys::medium);
        Medium medium = read_index(fields, own_);
        read_absorption(fields, medium);
        medium.name = name;
        defined_.push_back({std::move(medium), table.place, {}});
    }
}

MediumId MediaBook::give(Entry& entry) {
    if (entry.id < 0) {
        entry.id = static_cast<int>(media_.size());
        media_.push_back(entry.medium);
        places_.push_back(entry.place);
    }
    return {static_cast<std::uint32_t>(entry.id)};
}

MediumId MediaBook::refer(std::string_view name, Place const& place) {
    for (Entry& entry : defined_)
        if (entry.medium.name == name)
            return give(entry);
    GlassEntry const* const found = find_entry(own_, name, place);
    if (!found)
        refuse(name, place);
    for (Entry& entry : from_catalogue_)
        if (entry.catalogue_name == found->full_name())
            return give(entry);
    from_catalogue_.push_back({found->medium, place, found->full_name()});
    Medium& medium = from_catalogue_.back().medium;
    // Two makers may give their glasses one name, but summaries and logs have each once.
    if (std::any_of(media_.begin(), media_.end(), [&](Medium const& m) { return m.name == medium.name; }))
        medium.name = found->full_name();
    return give(from_catalogue_.back());
}

void MediaBook::refuse(std::string_view name, Place const& place) const {
    std::vector<std::string> defined;
    for (Entry const& entry : defined_)
        defined.push_back(entry.medium.name);
    std::string const nearest = nearest_name(name, defined);
    bool const near = !nearest.empty() && 2 * edit_distance(name, nearest) <= name.size();
    throw InputError(place.text(),
                     "there is no medium \"" + std::string(name) + "\", here or in the catalogue",
                     near ? did_you_mean(name, defined) : similar_entries(own_, name));
}

namespace {

std::string nanometres(double metres) {
    return quoted_value({std::round(metres * 1e13) / 1e4, {}}) + " nm";
}

} // namespace

std::optional<std::string> range_warning(std::string const& what, std::pair<double, double> range,
                                         std::vector<double> const& wavelengths) {
    auto const [low, high] = range;
    std::vector<double> outside;
    for (double const wavelength : wavelengths)
        if (high > 0.0 && (wavelength < low || wavelength > high))
            outside.push_back(wavelength);
    if (outside.empty())
        return {};
    std::string at = nanometres(outside.front());
    if (outside.size() > 1)
        at = std::to_string(outside.size()) + " wavelengths from " + at + " to " + nanometres(outside.back());
    return what + " is used at " + at + ", but its index is stated from " + nanometres(low) + " to " +
           nanometres(high) + " only";
}

std::vector<std::string> check_media(MediaBook const& book, std::vector<double> const& wavelengths) {
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < book.media().size(); ++i) {
        Medium const& medium = book.media()[i];
        for (double const wavelength : wavelengths) {
            double const n = refractive_index(medium.index, wavelength);
            if (!(std::isfinite(n) && n > 0.0))
                throw InputError(book.places()[i].text(),
                                 "medium \"" + medium.name + "\" has no real index at " +
                                     nanometres(wavelength),
                                 "correct its formula, or use another wavelength");
        }
        if (auto warning = range_warning(book.places()[i].text() + ": medium \"" + medium.name + "\"",
                                         medium.range, wavelengths))
            warnings.push_back(std::move(*warning));
    }
    return warnings;
}

} // namespace sahl
