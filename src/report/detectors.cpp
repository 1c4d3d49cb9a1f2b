#include "report/detectors.h"

#include "report/html.h"

#include <algorithm>
#include <array>

namespace sahl::report {

namespace {

struct Figure {
    char const* key;
    char const* name;
    char const* unit;
};

constexpr std::array<Figure, 8> figures{{{"power_W", "power", "W"},
                                         {"sigma_W", "standard error", "W"},
                                         {"hits", "hits", ""},
                                         {"centroid_mm", "centroid", "mm"},
                                         {"rms_radius_mm", "RMS radius", "mm"},
                                         {"peak_W_per_mm2", "peak", "W/mm²"},
                                         {"mean_direction", "mean direction", ""},
                                         {"mean_optical_path_mm", "mean optical path", "mm"}}};

std::string with_unit(std::string value, char const* unit) {
    return *unit == 0 || value == "–" ? value : value + " " + unit;
}

/// "between a and b W": the light that was cut might have reached the detector.
std::string bound(Value const& detector) {
    Value const* const found = at(detector, {"power_bound_W"});
    auto const* list = found ? std::get_if<Array>(&found->data) : nullptr;
    if (!list || list->size() != 2)
        return {};
    auto const low = number_at((*list)[0], {}), high = number_at((*list)[1], {});
    if (low && high)
        return *low == *high ? "nothing was cut"
                             : "between " + figure(*low, 8) + " and " + figure(*high, 8) + " W";
    return low && *low > 0.0 ? "at least " + figure(*low, 8) + " W" : "";
}

std::string numbers_html(Value const& detector) {
    std::string out = "<dl>";
    for (Figure const& f : figures) {
        Value const* const value = at(detector, {f.key});
        bool const is_power = f.key == std::string_view("power_W");
        bool const no_scatter = f.key == std::string_view("sigma_W") && number_at(detector, {f.key}) == 0.0;
        if ((!value && !is_power) || no_scatter)
            continue;
        out += "<dt>" + std::string(f.name) + "</dt><dd>" + with_unit(shown(value), f.unit);
        if (std::string const text = is_power ? bound(detector) : ""; !text.empty())
            out += " <span class=\"note\">" + text + "</span>";
        out += "</dd>";
    }
    return out + "</dl>\n";
}

/// The same figures by wavelength or by source, where there is more than one of them.
std::string split_html(Value const& detector, char const* key, char const* heading) {
    auto const entries = entries_at(detector, key);
    if (entries.size() < 2)
        return {};
    HtmlTable table{{heading, "power (W)", "hits", "centroid (mm)", "RMS radius (mm)", "mean direction"}, {}};
    for (auto const& [name, entry] : entries)
        table.rows.push_back({escaped(name), shown(at(*entry, {"power_W"})), shown(at(*entry, {"hits"})),
                              shown(at(*entry, {"centroid_mm"})), shown(at(*entry, {"rms_radius_mm"})),
                              shown(at(*entry, {"mean_direction"}))});
    return html_of(table);
}

} // namespace

std::optional<std::string> picture_of(std::string const& detector, std::vector<std::string> const& pictures) {
    auto const same = [](char in_file, char in_name) {
        bool const replaced = static_cast<unsigned char>(in_name) < 0x20 ||
                              std::string_view("/\\:*?\"<>|").find(in_name) != std::string_view::npos;
        return in_file == (replaced ? '_' : in_name);
    };
    for (std::string const& picture : pictures) {
        std::string const file = picture.substr(picture.find_last_of('/') + 1);
        auto const ending = std::min(file.find_last_of('.'), file.size());
        if (std::equal(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(ending), detector.begin(),
                       detector.end(), same))
            return picture;
    }
    return std::nullopt;
}

std::string picture_html(std::string const& detector, std::string const& picture) {
    return "<img src=\"" + relative_url(picture) + "\" alt=\"Light on the detector " + escaped(detector) +
           "\"/>";
}

std::string detectors_html(PageInput const& input) {
    std::string out;
    for (auto const& [name, detector] : entries_at(input.summary, "detectors")) {
        out += "<article class=\"detector-card\"><h3>" + escaped(name) + "</h3>\n<div class=\"beside\">";
        if (auto const picture = picture_of(name, input.pictures))
            out += picture_html(name, *picture);
        out += "<div>" + numbers_html(*detector) + "</div></div>\n" +
               split_html(*detector, "by_wavelength", "wavelength (nm)") +
               split_html(*detector, "by_source", "source") + "</article>\n";
    }
    return out;
}

} // namespace sahl::report
