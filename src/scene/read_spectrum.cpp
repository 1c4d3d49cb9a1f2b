// In: the key spectrum of a source. Out: wavelengths in m with their weights.
#include "scene/read_sources.h"

#include "math/input_error.h"
#include "optics/colour.h"
#include "scene/read_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace sahl {

namespace {

constexpr double conversion = 1e-15; // four roundings, relative
constexpr int steps_in_bin = 16;     // of the midpoint rule that a bin's power is found by

/// Power for each wavelength (m), and where it is cut.
struct Spectrum {
    std::function<double(double)> power;
    double from = 380e-9, to = 780e-9; // m
    std::uint64_t bins = 40;
};

using Pairs = std::vector<std::pair<double, double>>;

std::function<double(double)> linear_between(Pairs pairs) { // nm
    return [pairs = std::move(pairs)](double wavelength) {
        double nm = wavelength * 1e9;
        for (double const end : {pairs.front().first, pairs.back().first})
            if (std::abs(nm - end) < conversion * end) // nm to m and back
                nm = end;
        auto const above = std::lower_bound(pairs.begin(), pairs.end(), nm,
                                            [](auto const& pair, double x) { return pair.first < x; });
        if (above == pairs.end())
            return 0.0;
        if (above->first == nm)
            return above->second;
        if (above == pairs.begin())
            return 0.0;
        auto const below = above - 1;
        double const share = (nm - below->first) / (above->first - below->first);
        return below->second + share * (above->second - below->second);
    };
}

bool is_header(std::vector<std::string_view> const& names) {
    return names.size() == 2 && (names[0] == "nm" || names[0] == "wavelength_nm" || names[0] == "wavelength");
}

Pairs read_file(std::filesystem::path const& path) {
    Pairs pairs;
    read_csv(path, "wavelength in nm, power per nm", is_header, [&](CsvRow const& row) {
        if (row.numbers.size() != 2)
            throw InputError(row.place, "this line has " + std::to_string(row.numbers.size()) + " numbers",
                             "give wavelength in nm, power per nm");
        double const nm = row.numbers[0], power = row.numbers[1];
        if (!(std::isfinite(nm) && std::isfinite(power) && power >= 0.0))
            throw InputError(row.place, "this is no spectral power",
                             "give finite numbers, the power 0 or more");
        if (!(nm > (pairs.empty() ? 0.0 : pairs.back().first)))
            throw InputError(row.place, "wavelengths do not ascend", "give them in nm, from the shortest on");
        pairs.emplace_back(nm, power);
    });
    if (pairs.size() < 2)
        throw InputError(path.string(), "there is no spectrum in this file",
                         "give at least two lines with wavelength in nm, power per nm");
    return pairs;
}

void use_table(Spectrum& spectrum, Pairs pairs) {
    spectrum.from = pairs.front().first * 1e-9;
    spectrum.to = pairs.back().first * 1e-9;
    spectrum.power = linear_between(std::move(pairs));
}

void use_illuminant(Spectrum& spectrum, std::string const& name, Place const& place) {
    if (name != "D65")
        throw InputError(place.text(), "there is no illuminant \"" + name + "\"",
                         "give \"D65\", a file that ends in .csv, or {black_body_K = …}");
    spectrum.power = illuminant_d65;
}

Spectrum read_table(Value const& table, std::filesystem::path const& folder) {
    Fields const fields(table, keys::spectrum);
    Spectrum spectrum;
    std::string const kind = fields.only_one_of({"illuminant", "black_body_K", "file", "table"});
    if (kind == "illuminant")
        use_illuminant(spectrum, fields.text(kind), fields.place(kind));
    else if (kind == "black_body_K")
        spectrum.power = [kelvin = fields.number(kind)](double x) { return black_body(x, kelvin); };
    else if (kind == "file")
        use_table(spectrum, read_file(existing_file(folder, fields.text(kind), fields.place(kind))));
    else {
        Pairs pairs = ascending_pairs(fields.at(kind));
        for (auto const& [nm, power] : pairs)
            if (!(nm > 0.0 && power >= 0.0))
                throw InputError(fields.place(kind).text(), "this is no spectrum",
                                 "give wavelengths above 0 and powers of 0 or more");
        if (pairs.size() < 2)
            throw InputError(fields.place(kind).text(), "a spectrum of less than two points has no width",
                             "give at least two, or wavelengths_nm");
        use_table(spectrum, std::move(pairs));
    }
    if (fields.has("from_nm"))
        spectrum.from = fields.number("from_nm") * 1e-9;
    if (fields.has("to_nm"))
        spectrum.to = fields.number("to_nm") * 1e-9;
    if (!(spectrum.from < spectrum.to))
        throw InputError(table.place.text(), "this spectrum ends before it begins",
                         "give a to_nm above from_nm");
    spectrum.bins = static_cast<std::uint64_t>(fields.integer("bins"));
    return spectrum;
}

Spectrum read_spectrum(Fields const& source, std::filesystem::path const& folder) {
    Value const& value = source.at("spectrum");
    auto const* const word = std::get_if<std::string>(&value.data);
    if (!word) {
        if (!std::holds_alternative<Table>(value.data))
            throw InputError(value.place.text(), source.called("spectrum") + " is " + quoted_value(value),
                             "give \"D65\", \"lamp.csv\" or a table such as {black_body_K = 3000}");
        return read_table(value, folder);
    }
    Spectrum spectrum;
    if (word->ends_with(".csv"))
        use_table(spectrum, read_file(existing_file(folder, *word, value.place)));
    else
        use_illuminant(spectrum, *word, value.place);
    return spectrum;
}

/// To twelve digits of its value in nm: equal bins of two sources, and wavelengths that are written out, are
/// then the same number, whatever way they came by.
double rounded(double wavelength) {
    char text[32];
    std::snprintf(text, sizeof text, "%.12g", wavelength * 1e9);
    return std::strtod(text, nullptr) * 1e-9;
}

} // namespace

Pairs binned_spectrum(Fields const& source, std::filesystem::path const& folder) {
    Spectrum const spectrum = read_spectrum(source, folder);
    Pairs wavelengths;
    double const width = (spectrum.to - spectrum.from) / static_cast<double>(spectrum.bins);
    for (std::uint64_t bin = 0; bin < spectrum.bins; ++bin) {
        double const start = spectrum.from + width * static_cast<double>(bin);
        double power = 0.0;
        for (int step = 0; step < steps_in_bin; ++step)
            power += spectrum.power(start + width * (step + 0.5) / steps_in_bin);
        if (power > 0.0)
            wavelengths.emplace_back(rounded(start + 0.5 * width), power);
    }
    if (wavelengths.empty())
        throw InputError(source.place("spectrum").text(), "this spectrum is dark from from_nm to to_nm",
                         "give a range in which it has power");
    return wavelengths;
}

void weigh_by_spectrum(Fields const& source, std::filesystem::path const& folder, Pairs& wavelengths) {
    Spectrum const spectrum = read_spectrum(source, folder);
    for (auto& [wavelength, weight] : wavelengths) {
        weight = spectrum.power(wavelength);
        if (!(weight > 0.0))
            throw InputError(source.place("spectrum").text(),
                             "this spectrum is dark at one of the wavelengths beside it",
                             "leave that wavelength out");
    }
}

} // namespace sahl
