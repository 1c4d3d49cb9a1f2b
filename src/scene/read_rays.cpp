// In: rays written out one by one, in the experiment or as CSV. Out: rays in the world, in metres.
#include "scene/read_sources.h"

#include "math/input_error.h"
#include "scene/read_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sahl {

namespace {

constexpr char const* columns = "x, y, z, dx, dy, dz in mm, and perhaps power";

/// Appends one ray; `place` is only made into text where there is something wrong.
template <class PlaceText>
void append(RayList& list, std::vector<double> const& row, Affine const& to_world, PlaceText place) {
    auto const refuse = [&](std::string const& problem, std::string const& remedy) {
        throw InputError(place(), problem, remedy);
    };
    if (row.size() != 6 && row.size() != 7)
        refuse("this ray has " + std::to_string(row.size()) + " numbers", "give " + std::string(columns));
    if (!std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); }))
        refuse("this ray has a number that is not finite", "give finite numbers");
    if (row.size() == 7 && row[6] <= 0.0)
        refuse("this ray has a power that is not above 0", "give a power above 0, or leave the ray out");
    if (!list.rays.empty() && (list.power > 0.0) != (row.size() == 7))
        refuse("some rays have a power and some have none", "give a power to all of them or to none");
    dvec3 direction(row[3], row[4], row[5]);
    double const largest = std::max({std::abs(row[3]), std::abs(row[4]), std::abs(row[5])});
    if (largest == 0.0)
        refuse("this ray has a direction of length 0", "give dx, dy, dz any other length");
    direction = to_world.vector(direction / largest);
    double const weight = row.size() == 7 ? row[6] : 1.0;
    list.rays.push_back(
        {to_world.point(dvec3(row[0], row[1], row[2]) / 1000.0), direction / length(direction), weight});
    list.power += row.size() == 7 ? weight : 0.0;
}

std::string_view trimmed(std::string_view text) {
    auto const first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t start = 0; start <= text.size();) {
        auto const end = std::min(text.find(separator, start), text.size());
        parts.push_back(trimmed(text.substr(start, end - start)));
        start = end + 1;
    }
    return parts;
}

bool to_number(std::string_view text, double& number) {
    if (!text.empty() && text.front() == '+')
        text.remove_prefix(1);
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

/// A line of names in place of numbers: they must be those of the columns, with or without their units.
bool is_header(std::vector<std::string_view> const& names) {
    static constexpr std::string_view known[] = {"x", "y", "z", "dx", "dy", "dz", "power"};
    static constexpr std::string_view with_unit[] = {"x_mm", "y_mm", "z_mm", "dx", "dy", "dz", "power_W"};
    bool fits = names.size() == 6 || names.size() == 7;
    for (std::size_t i = 0; fits && i < names.size(); ++i)
        fits = names[i] == known[i] || names[i] == with_unit[i];
    return fits;
}

} // namespace

RayList read_ray_list(Value const& list, Affine const& to_world) {
    auto const* rows = std::get_if<Array>(&list.data);
    if (!rows || rows->empty())
        throw InputError(list.place.text(), "'rays' in [[source]] is " + quoted_value(list),
                         "give a list of rays, [[x, y, z, dx, dy, dz], …]");
    RayList rays;
    for (Value const& row : *rows) {
        if (!has_kind(row, Kind::numbers))
            throw InputError(row.place.text(), "a ray is " + quoted_value(row),
                             "give " + std::string(columns));
        append(rays, numbers_in(std::get<Array>(row.data)), to_world, [&] { return row.place.text(); });
    }
    return rays;
}

RayList read_ray_file(std::filesystem::path const& path, Affine const& to_world) {
    RayList rays;
    std::string const text = file_text(path);
    std::vector<double> row;
    std::size_t line_number = 0;
    bool header_may_follow = true;
    for (std::size_t start = 0; start < text.size();) {
        auto const end = std::min(text.find('\n', start), text.size());
        auto const line = trimmed(std::string_view(text).substr(start, end - start));
        start = end + 1;
        auto const place = [&] { return path.string() + ":" + std::to_string(line_number); };
        ++line_number;
        if (line.empty() || line.front() == '#')
            continue;
        auto const fields = split(line, ',');
        if (std::exchange(header_may_follow, false) && is_header(fields))
            continue;
        row.clear();
        for (auto const field : fields)
            if (!to_number(field, row.emplace_back()))
                throw InputError(place(), "\"" + std::string(field) + "\" is no number",
                                 "give " + std::string(columns));
        append(rays, row, to_world, place);
    }
    if (rays.rays.empty())
        throw InputError(path.string(), "there are no rays in this file",
                         "give lines with " + std::string(columns));
    return rays;
}

} // namespace sahl
