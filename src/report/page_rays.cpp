// In: paths and what their numbers stand for. Out: both as columns. See page_data.h.
#include "report/colour.h"
#include "report/page_data.h"

#include <algorithm>

namespace sahl::report {

namespace {

template <class Column>
auto column(PagePaths const& paths, Column const& of) {
    std::vector<std::decay_t<decltype(of(paths.segments.front()))>> values;
    values.reserve(paths.segments.size());
    for (Segment const& s : paths.segments)
        values.push_back(of(s));
    return values;
}

std::vector<double> vectors(PagePaths const& paths, dvec3 Segment::*what, double scale) {
    std::vector<double> values;
    values.reserve(3 * paths.segments.size());
    for (Segment const& s : paths.segments)
        for (int axis = 0; axis < 3; ++axis)
            values.push_back(scale * (s.*what)[axis]);
    return values;
}

/// How a wavelength is written: nm to the ten places that an experiment may say.
double in_nm(double metres) {
    return std::round(metres * 1e9 * 1e10) / 1e10;
}

} // namespace

void write_names(JsonText& json, LogHeader const& names) {
    auto const list = [&](char const* key, std::vector<std::string> const& texts) {
        json.key(key).open('[');
        for (std::string const& text : texts)
            json.value(text);
        json.close(']');
    };
    json.key("names").open('{');
    list("sources", names.sources);
    list("surfaces", names.surfaces);
    list("media", names.media);
    std::vector<double> nm;
    for (double const w : names.wavelengths_m)
        nm.push_back(in_nm(w));
    json.array("wavelengths_nm", nm).array("refractive_index", names.refractive_index);
    json.key("colours").open('['); // on light pages and on dark ones
    for (double const w : names.wavelengths_m) {
        Rgb const colour = spectral_colour(w);
        json.open('[').value(hex(on_white(colour))).value(hex(on_black(colour))).close(']');
    }
    json.close(']');
    json.entry("every", names.every).entry("min_power", names.min_power).entry("where", names.where);
    json.close('}');
}

void write_rays(JsonText& json, PagePaths const& paths, LogHeader const& names) {
    std::vector<double> numbers;       // of the rays
    std::vector<std::uint32_t> begins; // of each its first segment, and their number
    std::vector<std::uint16_t> source, wavelength;
    for (std::size_t i = 0; i < paths.segments.size(); ++i) {
        Segment const& s = paths.segments[i];
        if (i > 0 && s.ray == paths.segments[i - 1].ray)
            continue;
        numbers.push_back(static_cast<double>(s.ray));
        begins.push_back(static_cast<std::uint32_t>(i));
        source.push_back(s.source);
        auto const nearest =
            std::min_element(names.wavelengths_m.begin(), names.wavelengths_m.end(), [&](double a, double b) {
                return std::abs(a - s.wavelength) < std::abs(b - s.wavelength);
            });
        wavelength.push_back(static_cast<std::uint16_t>(nearest - names.wavelengths_m.begin()));
    }
    begins.push_back(static_cast<std::uint32_t>(paths.segments.size()));
    json.key("rays").open('{').entry("shown", paths.rays);
    json.array("number", numbers)
        .array("begin", begins)
        .array("source", source)
        .array("wavelength", wavelength);
    json.array("index", column(paths, [](Segment const& s) { return s.index; }));
    json.array("parent", column(paths, [](Segment const& s) { return s.parent; }));
    json.array("depth", column(paths, [](Segment const& s) { return s.depth; }));
    json.array("born", column(paths, [](Segment const& s) { return static_cast<std::uint8_t>(s.born); }));
    json.array("ended", column(paths, [](Segment const& s) { return static_cast<std::uint8_t>(s.ended); }));
    json.array("surface", column(paths, [](Segment const& s) { return s.surface; }));
    json.array("medium", column(paths, [](Segment const& s) { return s.medium; }));
    if (std::any_of(paths.segments.begin(), paths.segments.end(),
                    [](Segment const& s) { return s.primitive >= 0; }))
        json.array("primitive", column(paths, [](Segment const& s) { return s.primitive; }));
    json.array("at", vectors(paths, &Segment::origin, 1e3))
        .array("toward", vectors(paths, &Segment::direction, 1.0));
    json.array("length", column(paths, [](Segment const& s) { return s.length * 1e3; }));
    json.array("optical_path", column(paths, [](Segment const& s) { return s.optical_path * 1e3; }));
    json.array("power_start", column(paths, [](Segment const& s) { return s.power_start; }));
    if (std::any_of(paths.segments.begin(), paths.segments.end(),
                    [](Segment const& s) { return s.power_end != s.power_start; }))
        json.array("power_end", column(paths, [](Segment const& s) { return s.power_end; }));
    json.close('}');
}

} // namespace sahl::report
