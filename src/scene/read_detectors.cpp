// In: the tables [[detector]]. Out: detectors in the world.
#include "scene/read_sources.h"

#include "math/input_error.h"

#include <cmath>

namespace sahl {

namespace {

constexpr double most_pixels = 67108864.0; // 2²⁶: sums of 16 bytes each then fill 1 GiB

DetectorSpec read_detector(Value const& table, Groups const& groups) {
    Fields const fields(table, keys::detector);
    DetectorSpec detector;
    detector.name = fields.text("name");
    detector.place = table.place;
    check_name(detector.name, fields.place("name"));
    Affine const group = rigid_group_of(fields, groups);
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
