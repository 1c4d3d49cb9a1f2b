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
    for (auto const key : {"conic1", "conic2"})
        if (fields.number(key) != 0.0)
            throw InputError(fields.place(key).text(), "this version does not trace conic surfaces of lenses",
                             "make it 0, or give the lens as a model");
    for (auto const key : {"aspheric1", "aspheric2"}) {
        auto const terms = fields.numbers(key);
        if (std::any_of(terms.begin(), terms.end(), [](double term) { return term != 0.0; }))
            throw InputError(fields.place(key).text(),
                             "this version does not trace aspheric surfaces of lenses",
                             "leave it out, or give the lens as a model");
    }
    return Lens{metres(fields.number("r1_mm")), metres(fields.number("r2_mm")),
                metres(fields.number("thickness_mm")), metres(fields.number("diameter_mm"))};
}

Shape read_prism(Value const& table) {
    Fields const fields(table, keys::prism);
    return Prism{fields.number("apex_deg") * (std::numbers::pi / 180.0), metres(fields.number("side_mm")),
                 metres(fields.number("length_mm"))};
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

constexpr std::array<std::pair<std::string_view, ReadSizes>, 8> traced{{
    {"sphere", read_sphere},
    {"box", read_box},
    {"cylinder", read_cylinder},
    {"lens", read_lens},
    {"prism", read_prism},
    {"plane", read_plane},
    {"rectangle", read_rectangle},
    {"disk", read_disk},
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
