#include "report/rays.h"

#include "report/colour.h"
#include "report/html.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace sahl::report {

namespace {

constexpr double faintest = 0.08, strongest = 0.80;
constexpr double decades = 3.0; // of power from strongest to faintest
constexpr int levels = 12;      // of opacity
constexpr std::size_t most_swatches = 12;

/// Wavelengths that differ by less than a nanometre share a colour, those that cannot be seen are all grey.
int nanometres(double wavelength) {
    double const nm = wavelength * 1e9;
    return nm >= 380.0 && nm <= 780.0 ? static_cast<int>(std::lround(nm)) : 0;
}

int opacity_level(double power, double most_power) {
    if (!(power > 0.0) || !(most_power > 0.0))
        return 0;
    double const share = 1.0 + std::log10(power / most_power) / decades;
    return static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * levels));
}

std::string opacity_of(int level) {
    return coordinate(faintest + (strongest - faintest) * level / levels);
}

std::string class_of(int nm) {
    return "w" + std::to_string(nm);
}

} // namespace

std::string rays_svg(std::vector<Segment const*> const& segments, Frame const& frame) {
    double most_power = 0.0;
    for (Segment const* s : segments)
        most_power = std::max(most_power, s->power_start);
    std::map<std::pair<int, int>, std::string> paths; // by opacity, then colour
    for (Segment const* s : segments) {
        auto const inside = clipped(frame, frame.view(s->origin), frame.view(s->direction), s->length);
        if (!inside)
            continue;
        dvec2 const a = frame.pixel(inside->first), b = frame.pixel(inside->second);
        if (length(b - a) < 0.05) // of a pixel: seen from its end, or cut where it is born
            continue;
        paths[{opacity_level(s->power_start, most_power), nanometres(s->wavelength)}] +=
            "M" + coordinate(a.x) + " " + coordinate(a.y) + "L" + coordinate(b.x) + " " + coordinate(b.y);
    }
    std::string out = "<g class=\"rays\">\n";
    for (auto const& [key, path] : paths)
        out += "<path class=\"" + class_of(key.second) + "\" stroke-opacity=\"" + opacity_of(key.first) +
               "\" d=\"" + path + "\"/>\n";
    return out + "</g>\n";
}

std::string ray_colours_css(std::vector<Segment const*> const& segments) {
    std::set<int> all;
    for (Segment const* s : segments)
        all.insert(nanometres(s->wavelength));
    std::string light, dark;
    for (int const nm : all) {
        Rgb const colour = spectral_colour(1e-9 * nm);
        light += "." + class_of(nm) + "{color:" + hex(on_white(colour)) + "}";
        dark += "." + class_of(nm) + "{color:" + hex(on_black(colour)) + "}";
    }
    return light + "\n@media (prefers-color-scheme: dark){" + dark + "}\n";
}

std::string wavelength_legend(std::vector<Segment const*> const& segments) {
    std::set<double> all;
    for (Segment const* s : segments)
        if (std::isfinite(s->wavelength))
            all.insert(s->wavelength);
    if (all.empty())
        return {};
    bool const few = all.size() <= most_swatches;
    std::vector<double> const shown_ones =
        few ? std::vector<double>(all.begin(), all.end()) : std::vector<double>{*all.begin(), *all.rbegin()};
    std::string out;
    for (double const wavelength : shown_ones)
        out += std::string(out.empty() || few ? "" : "<span>to</span>") + "<span><span class=\"swatch " +
               class_of(nanometres(wavelength)) + "\"></span>" + figure(wavelength * 1e9, 7) + " nm</span>";
    return "<p class=\"legend\">" + out + (few ? "" : "<span>" + count(all.size()) + " wavelengths</span>") +
           "</p>\n";
}

} // namespace sahl::report
