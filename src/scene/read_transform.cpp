// In: scale, turns, moves and matrices as written. Out: affine maps and directions; quarter turns are exact.
#include "scene/read_transform.h"

#include "math/input_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sahl {

namespace {

constexpr double radians_per_degree = std::numbers::pi / 180.0;

/// angle_deg in [0, 90]; each half of it by the function that is exact at its end.
double sin_of_first_quadrant(double angle_deg) {
    if (angle_deg == 30.0)
        return 0.5;
    return angle_deg <= 45.0 ? std::sin(angle_deg * radians_per_degree)
                             : std::cos((90.0 - angle_deg) * radians_per_degree);
}

Affine read_matrix(Fields const& fields) {
    auto const m = fields.numbers("matrix");
    if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
        throw InputError(fields.place("matrix").text(),
                         fields.called("matrix") + " has a last row other than 0, 0, 0, 1",
                         "write it column by column: the 4th, 8th, 12th and 16th numbers are 0, 0, 0, 1");
    return {dmat3(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]),
            metres(std::vector{m[12], m[13], m[14]})};
}

dvec3 read_scale(Fields const& fields) {
    if (!fields.has("scale"))
        return dvec3(1.0);
    Value const& value = fields.at("scale");
    auto const* list = std::get_if<Array>(&value.data);
    bool const fits =
        list ? list->size() == 3 &&
                   std::all_of(list->begin(), list->end(), [](Value const& item) { return item.is_number(); })
             : value.is_number();
    dvec3 const scale = !fits ? dvec3(0.0) : list ? vector_of(numbers_in(*list)) : dvec3(number_in(value));
    for (int i = 0; i < 3; ++i)
        if (!std::isfinite(scale[i]) || scale[i] == 0.0)
            throw InputError(value.place.text(), fields.called("scale") + " is " + quoted_value(value),
                             "give a number other than 0, or three of them");
    return scale;
}

} // namespace

double sin_of_deg(double angle_deg) {
    double const within = std::fmod(angle_deg, 360.0); // exact
    double const angle = std::abs(within);
    double const sine = angle <= 90.0    ? sin_of_first_quadrant(angle)
                        : angle <= 180.0 ? sin_of_first_quadrant(180.0 - angle)
                        : angle <= 270.0 ? -sin_of_first_quadrant(angle - 180.0)
                                         : -sin_of_first_quadrant(360.0 - angle);
    return (within < 0.0 ? -sine : sine) + 0.0; // + 0: no negative zero
}

double cos_of_deg(double angle_deg) {
    double const angle = std::abs(std::fmod(angle_deg, 360.0));
    double const cosine = angle <= 90.0    ? sin_of_first_quadrant(90.0 - angle)
                          : angle <= 180.0 ? -sin_of_first_quadrant(angle - 90.0)
                          : angle <= 270.0 ? -sin_of_first_quadrant(270.0 - angle)
                                           : sin_of_first_quadrant(angle - 270.0);
    return cosine + 0.0;
}

dmat3 turn(dvec3 const& angles_deg) {
    dvec3 s, c;
    for (int i = 0; i < 3; ++i) {
        s[i] = sin_of_deg(angles_deg[i]);
        c[i] = cos_of_deg(angles_deg[i]);
    }
    dmat3 const x(1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x); // column by column
    dmat3 const y(c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y);
    dmat3 const z(c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1);
    return z * y * x;
}

Affine read_transform(Fields const& fields) {
    bool const matrix = fields.has("matrix");
    for (auto const key : {"scale", "turn_deg", "move_mm"})
        if (matrix && fields.has(key))
            throw InputError(fields.place(key).text(), fields.called(key) + " stands beside a matrix",
                             "give either matrix or scale, turn_deg and move_mm");
    if (!matrix) {
        dvec3 const scale = read_scale(fields);
        dmat3 const stretch(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
        return {turn(vector_of(fields.numbers("turn_deg"))) * stretch, metres(fields.numbers("move_mm"))};
    }
    Affine const map = read_matrix(fields);
    double const volume = std::abs(glm::determinant(map.linear));
    double const box = length(map.linear[0]) * length(map.linear[1]) * length(map.linear[2]);
    if (!(volume > 1e-12 * box)) // flat to within the rounding of twelve digits
        throw InputError(fields.place("matrix").text(), fields.called("matrix") + " flattens space",
                         "give one whose determinant is not 0");
    return map;
}

dvec3 vector_of(std::vector<double> const& three) {
    return {three[0], three[1], three[2]};
}

dvec3 metres(std::vector<double> const& three_mm) {
    return vector_of(three_mm) / 1000.0;
}

dvec3 read_direction(Fields const& fields, std::string_view key, Affine const& map) {
    dvec3 direction = vector_of(fields.numbers(key));
    double const largest = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (largest == 0.0)
        throw InputError(fields.place(key).text(), fields.called(key) + " is a direction of length 0",
                         "give a direction of any other length, for instance [0, 0, 1]");
    direction = map.vector(direction / largest);
    return direction / length(direction);
}

dvec3 read_up(Fields const& fields, std::string_view key, dvec3 const& axis, Affine const& map) {
    if (!fields.has(key))
        return perpendicular_to(axis);
    dvec3 const up = read_direction(fields, key, map);
    if (length(cross(axis, up)) <= 1e-12) // the bound of perpendicular_to
        throw InputError(fields.place(key).text(),
                         fields.called(key) + " is parallel to the direction it belongs to",
                         "turn it away from that direction, or leave it out");
    return perpendicular_to(axis, up);
}

} // namespace sahl
