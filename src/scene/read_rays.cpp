// In: rays written out one by one, in the experiment or as CSV. Out: rays in the world, in metres.
#include "scene/read_sources.h"

#include "math/input_error.h"

#include <algorithm>
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
    if (path.extension() == ".tm25ray")
        return read_tm25(path, to_world);
    RayList rays;
    read_csv(path, columns, is_header,
             [&](CsvRow const& row) { append(rays, row.numbers, to_world, [&] { return row.place; }); });
    if (rays.rays.empty())
        throw InputError(path.string(), "there are no rays in this file",
                         "give lines with " + std::string(columns));
    return rays;
}

} // namespace sahl
