// In: the table `shape` of an object. Out: an exact shape in metres; geometry judges whether it can exist.
#include "scene/read_shape.h"

#include "math/input_error.h"
#include "scene/read_transform.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace sahl {

namespace {

using ReadSizes = Shape (*)(Value const&);

Shape read_sphere(Value const& table) {
    return Sphere{metres(Fields(table, keys::sphere).number("radius_mm"))};
}

Shape read_box(Value const& table) {
    return Box{metres(Fields(table, keys::box).numbers("size_mm"))};
}

Shape read_cylinder(Value const& table) {
    Fields const fields(table, keys::cylinder);
    return Cylinder{metres(fields.number("radius_mm")), metres(fields.number("length_mm"))};
}

Shape read_lens(Value const& table) {
    Fields const fields(table, keys::lens);
    auto const terms = [&](char const* key) {
        std::vector<double> list = fields.numbers(key);
        double power = 1e3; // mm^−(2i+1) in m^−(2i+1)
        for (double& term : list)
            term *= power *= 1e6;
        return list;
    };
    return Lens{metres(fields.number("r1_mm")),
                metres(fields.number("r2_mm")),
                metres(fields.number("thickness_mm")),
                metres(fields.number("diameter_mm")),
                fields.number("conic1"),
                fields.number("conic2"),
                terms("aspheric1"),
                terms("aspheric2")};
}

Shape read_prism(Value const& table) {
    Fields const fields(table, keys::prism);
    return Prism{fields.number("apex_deg") * (std::numbers::pi / 180.0), metres(fields.number("side_mm")),
                 metres(fields.number("length_mm"))};
}

Shape read_cone(Value const& table) {
    Fields const fields(table, keys::cone);
    return Cone{metres(fields.number("radius_mm")), metres(fields.number("top_radius_mm")),
                metres(fields.number("length_mm"))};
}

Shape read_corner_cube(Value const& table) {
    return CornerCube{metres(Fields(table, keys::corner_cube).number("side_mm"))};
}

Shape read_quadric(Value const& table) {
    Fields const fields(table, keys::quadric);
    auto const given = fields.numbers("coefficients");
    QuadricBody body{{}, metres(fields.numbers("clip_mm"))};
    if (given.size() != body.coefficients.size())
        throw InputError(fields.place("coefficients").text(),
                         std::to_string(given.size()) + " coefficients instead of 10",
                         "give those of xx, yy, zz, xy, xz, yz, x, y, z, 1");
    // lengths in m: a length in mm is a thousand times as large a number
    for (std::size_t i = 0; i < given.size(); ++i)
        body.coefficients[i] = given[i] * (i < 6 ? 1e6 : i < 9 ? 1e3 : 1.0);
    return body;
}

Shape read_conic_mirror(Value const& table) {
    Fields const fields(table, keys::conic_mirror);
    return ConicMirror{metres(fields.number("radius_mm")), fields.number("conic"),
                       metres(fields.number("diameter_mm")), metres(fields.number("hole_diameter_mm"))};
}

Shape read_plane(Value const& table) {
    Fields const no_keys(table, keys::plane);
    return Plane{};
}

Shape read_rectangle(Value const& table) {
    auto const size = Fields(table, keys::rectangle).numbers("size_mm");
    return Rectangle{{metres(size[0]), metres(size[1])}};
}

Shape read_disk(Value const& table) {
    Fields const fields(table, keys::disk);
    return Disk{metres(fields.number("radius_mm")), metres(fields.number("hole_radius_mm"))};
}

constexpr std::array<std::pair<std::string_view, ReadSizes>, 12> traced{{
    {"sphere", read_sphere},
    {"box", read_box},
    {"cylinder", read_cylinder},
    {"lens", read_lens},
    {"prism", read_prism},
    {"plane", read_plane},
    {"rectangle", read_rectangle},
    {"disk", read_disk},
    {"cone", read_cone},
    {"corner_cube", read_corner_cube},
    {"quadric", read_quadric},
    {"conic_mirror", read_conic_mirror},
}};

} // namespace

Shape read_shape(Value const& table) {
    Fields const fields(table, keys::shape);
    std::string const name =
        fields.only_one_of({"sphere", "box", "cylinder", "lens", "prism", "plane", "rectangle", "disk",
                            "cone", "corner_cube", "quadric", "conic_mirror"});
    std::vector<std::string> names;
    for (auto const& [known, read_sizes] : traced) {
        if (known == name) {
            Value const& sizes = fields.at(name);
            Shape const shape = read_sizes(sizes);
            std::string const problem = shape_problem(shape);
            if (!problem.empty())
                throw InputError(sizes.place.text(), "shape " + name + ": " + problem, "");
            return shape;
        }
        names.emplace_back(known);
    }
    throw InputError(fields.place(name).text(), "this version does not trace the shape " + name,
                     "it traces " + listed(names) + "; give another as a model");
}

} // namespace sahl
