// In: the tables [[detector]]. Out: detectors in the world.
#include "scene/read_sources.h"

#include "math/input_error.h"

#include <cmath>
#include <numbers>

namespace sahl {

namespace {

constexpr double most_pixels = 67108864.0; // 2²⁶: sums of 16 bytes each then fill 1 GiB

void refuse_keys_of(char const* kind, Fields const& fields, std::initializer_list<std::string_view> keys) {
    for (std::string_view const key : keys)
        if (fields.has(key))
            throw InputError(fields.place(key).text(), fields.called(key) + " has no meaning for " + kind,
                             "leave it out");
}

void need_keys(Fields const& fields, std::initializer_list<std::string_view> keys) {
    for (std::string_view const key : keys)
        if (!fields.has(key))
            throw InputError(fields.place().text(), "'" + std::string(key) + "' is missing in [[detector]]",
                             "a rectangle needs at_mm, facing and size_mm");
}

void read_rectangle(Fields const& fields, Affine const& group, DetectorSpec& detector) {
    refuse_keys_of("a rectangle", fields, {"radius_mm", "from"});
    need_keys(fields, {"at_mm", "facing"});
    dvec3 const facing = read_direction(fields, "facing", group);
    dvec3 const up = read_up(fields, "up", facing, group);
    detector.to_world = {dmat3(cross(up, facing), up, facing), group.point(metres(fields.numbers("at_mm")))};
    auto const size = fields.numbers("size_mm"), pixels = fields.numbers("pixels");
    if (pixels[0] != std::floor(pixels[0]) || pixels[1] != std::floor(pixels[1]))
        throw InputError(fields.place("pixels").text(), fields.called("pixels") + " holds a fraction",
                         "give two whole numbers");
    if (pixels[0] * pixels[1] > most_pixels)
        throw InputError(fields.place("pixels").text(),
                         fields.called("pixels") + " makes more than 2^26 of them",
                         "give fewer; 8192 × 8192 is the most");
    detector.size = {metres(size[0]), metres(size[1])};
    detector.columns = static_cast<std::uint32_t>(pixels[0]);
    detector.rows = static_cast<std::uint32_t>(pixels[1]);
    detector.absorbs = fields.truth("absorbs");
    detector.back = fields.truth("back");
}

void read_sphere(Fields const& fields, Affine const& group, DetectorSpec& detector) {
    detector.kind = DetectorKind::sphere;
    if (!fields.truth("sphere"))
        throw InputError(fields.place("sphere").text(), "this detector has no place",
                         "give size_mm, sphere = true or surface");
    refuse_keys_of("a sphere", fields, {"facing", "up", "pixels", "absorbs", "back", "from", "spot"});
    if (fields.has("radius_mm"))
        detector.radius = fields.number("radius_mm") / 1000.0;
    else
        refuse_keys_of("a sphere at infinity", fields, {"at_mm"});
    if (fields.has("at_mm"))
        detector.to_world.offset = group.point(metres(fields.numbers("at_mm")));
    detector.absorbs = false;
}

void read_surface(Fields const& fields, DetectorSpec& detector) {
    detector.kind = DetectorKind::surface;
    refuse_keys_of("a named surface", fields,
                   {"at_mm", "facing", "up", "radius_mm", "pixels", "absorbs", "back", "group"});
    detector.surface = fields.text("surface");
    detector.from = fields.choice<ArrivesFrom>(
        "from",
        {{"both", ArrivesFrom::both}, {"outside", ArrivesFrom::outside}, {"inside", ArrivesFrom::inside}});
    detector.absorbs = false;
}

FarField read_far_field(Value const& table, Affine const& group, DetectorSpec const& detector) {
    Fields const fields(table, keys::far_field);
    bool const flat = detector.kind == DetectorKind::rectangle;
    FarField far;
    far.axis = fields.has("axis") ? read_direction(fields, "axis", group)
               : flat             ? -detector.to_world.linear[2]
                                  : normalize(group.vector({0.0, 0.0, 1.0}));
    far.up = !fields.has("up") && !fields.has("axis") && flat ? detector.to_world.linear[1]
                                                              : read_up(fields, "up", far.axis, group);
    double const degrees = fields.has("to_deg")                    ? fields.number("to_deg")
                           : detector.kind == DetectorKind::sphere ? 180.0
                                                                   : 90.0;
    far.largest = degrees * (std::numbers::pi / 180.0);
    far.rings = static_cast<std::uint32_t>(fields.integer("rings"));
    far.sectors = static_cast<std::uint32_t>(fields.integer("sectors"));
    if (static_cast<double>(far.rings) * far.sectors > most_pixels)
        throw InputError(fields.place("rings").text(), "these are more than 2^26 bins of direction",
                         "give fewer rings or sectors");
    return far;
}

DetectorSpec read_detector(Value const& table, Groups const& groups) {
    Fields const fields(table, keys::detector);
    DetectorSpec detector;
    detector.name = fields.text("name");
    detector.place = table.place;
    check_name(detector.name, fields.place("name"));
    Affine const group = rigid_group_of(fields, groups);
    std::string const kind = fields.only_one_of({"size_mm", "sphere", "surface"});
    if (kind == "size_mm")
        read_rectangle(fields, group, detector);
    else if (kind == "sphere")
        read_sphere(fields, group, detector);
    else
        read_surface(fields, detector);
    detector.spot = fields.truth("spot");
    detector.spectrum = fields.truth("spectrum");
    detector.where = {fields.text("where"), fields.place("where")};
    if (fields.has("far_field"))
        detector.far_field = read_far_field(fields.at("far_field"), group, detector);
    if (fields.has("optical_path"))
        detector.path_bins = static_cast<std::uint32_t>(fields.integer("optical_path"));
    return detector;
}

} // namespace

std::vector<DetectorSpec> read_detectors(Array const& tables, Groups const& groups) {
    std::vector<DetectorSpec> detectors;
    for (Value const& table : tables)
        detectors.push_back(read_detector(table, groups));
    return detectors;
}

} // namespace sahl
