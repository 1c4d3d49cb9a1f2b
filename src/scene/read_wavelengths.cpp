// In: the keys wavelengths_nm, lines, weights and spectrum of a source. Out: wavelengths in m with their
// weights.
#include "scene/read_sources.h"

#include "math/input_error.h"

#include <algorithm>
#include <array>

namespace sahl {

namespace {

/// Spectral lines in nm in standard air: those of the SCHOTT optical glass data sheets (Hg, Cd, H, He, Na,
/// Cs).
constexpr std::array<std::pair<std::string_view, double>, 13> lines{{{"i", 365.0146},
                                                                     {"h", 404.6561},
                                                                     {"g", 435.8343},
                                                                     {"F'", 479.9914},
                                                                     {"F", 486.1327},
                                                                     {"e", 546.0740},
                                                                     {"d", 587.5618},
                                                                     {"D", 589.2938},
                                                                     {"C'", 643.8469},
                                                                     {"C", 656.2725},
                                                                     {"r", 706.5188},
                                                                     {"s", 852.1100},
                                                                     {"t", 1013.9800}}};

/// Below are soft X-rays, above is microwaves: numbers there were meant in another unit.
constexpr double shortest_nm = 10.0, longest_nm = 1e7;

double line_nm(Value const& name) {
    auto const& word = std::get<std::string>(name.data);
    std::vector<std::string> names;
    for (auto const& [line, nm] : lines) {
        if (line == word)
            return nm;
        names.emplace_back(line);
    }
    throw InputError(name.place.text(), "there is no spectral line \"" + word + "\"",
                     "give some of " + listed(names) + ", or wavelengths_nm");
}

void check_wavelength(Value const& value) {
    double const nm = number_in(value);
    if (nm >= shortest_nm && nm <= longest_nm)
        return;
    std::string remedy = "give wavelengths in nm, from 10 to 1e7";
    for (auto const& [unit, in_nm] : {std::pair{"µm", 1e3}, std::pair{"m", 1e9}})
        if (nm * in_nm >= shortest_nm && nm * in_nm <= longest_nm) {
            remedy = "wavelengths are in nm: if this is in " + std::string(unit) + ", multiply it by " +
                     (in_nm == 1e3 ? "1000" : "1e9");
            break;
        }
    throw InputError(value.place.text(), "a wavelength of " + quoted_value(value) + " nm is no light",
                     remedy);
}

} // namespace

std::vector<std::pair<double, double>> read_wavelengths(Fields const& source,
                                                        std::filesystem::path const& folder) {
    if (source.has("wavelengths_nm") && source.has("lines"))
        throw InputError(source.place("lines").text(), "wavelengths_nm and lines stand side by side",
                         "keep one of the two");
    if (source.has("spectrum") && source.has("weights"))
        throw InputError(source.place("weights").text(), "weights and spectrum stand side by side",
                         "keep one of the two: a spectrum gives the weights");
    std::vector<std::pair<double, double>> wavelengths;
    std::string_view const key = source.has("lines") ? "lines" : "wavelengths_nm";
    if (!source.has(key) && source.has("spectrum"))
        return binned_spectrum(source, folder);
    if (!source.has(key))
        wavelengths.emplace_back(587.5618 * 1e-9, 1.0);
    else
        for (Value const& item : std::get<Array>(source.at(key).data)) {
            if (key == "wavelengths_nm")
                check_wavelength(item);
            double const wavelength = (key == "lines" ? line_nm(item) : number_in(item)) * 1e-9;
            for (auto const& [before, weight] : wavelengths)
                if (before == wavelength)
                    throw InputError(item.place.text(),
                                     "the wavelength " + quoted_value(item) + " stands here twice",
                                     "keep one, with the weight of both");
            wavelengths.emplace_back(wavelength, 1.0);
        }
    if (wavelengths.empty())
        throw InputError(source.place(key).text(), source.called(key) + " is empty", "give at least one");
    if (source.has("spectrum"))
        weigh_by_spectrum(source, folder, wavelengths);
    if (!source.has("weights"))
        return wavelengths;
    auto const weights = source.numbers("weights");
    if (weights.size() != wavelengths.size())
        throw InputError(source.place("weights").text(),
                         "there are " + std::to_string(weights.size()) + " weights for " +
                             std::to_string(wavelengths.size()) + " wavelengths",
                         "give one for each");
    for (std::size_t i = 0; i < weights.size(); ++i)
        wavelengths[i].second = weights[i];
    return wavelengths;
}

} // namespace sahl
