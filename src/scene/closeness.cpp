#include "scene/closeness.h"

#include <cmath>
#include <cstdio>

namespace sahl {

namespace {

std::string place(dvec3 const& at) {
    char text[120];
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) mm", at.x * 1e3, at.y * 1e3, at.z * 1e3);
    return text;
}

std::string size(double metres) {
    char text[40];
    if (metres < 1e-7)
        std::snprintf(text, sizeof text, "%.3g nm", metres * 1e9);
    else if (metres < 1e-4)
        std::snprintf(text, sizeof text, "%.3g µm", metres * 1e6);
    else
        std::snprintf(text, sizeof text, "%.4g mm", metres * 1e3);
    return text;
}

} // namespace

std::vector<std::string> contact_lines(Scene const& scene) {
    std::vector<std::string> lines;
    auto const name = [&](FaceId face) { return scene.faces[face.value].name; };
    for (auto const& [one, other] : scene.bvh->contacts())
        lines.push_back(name(one) + " touches " + name(other));
    for (Bvh::Tangency const& tangency : scene.bvh->tangencies())
        lines.push_back(name(tangency.one) + " touches " + name(tangency.other) + " at " +
                        place(tangency.at));
    for (Bvh::MadeFlush const& flush : scene.bvh->made_flush())
        lines.push_back(scene.bodies[flush.object].name +
                        " is made flush with what it touches: its float data lie off by up to " +
                        size(flush.farthest));
    return lines;
}

std::vector<std::string> overlap_warnings(Scene const& scene) {
    std::vector<std::string> warnings;
    for (Bvh::Closeness const& close : scene.bvh->closeness(0.0)) {
        Body const &one = scene.bodies[close.one], &other = scene.bodies[close.other];
        if (!(close.overlap > 0.0) || one.priority != other.priority || one.medium == other.medium)
            continue;
        warnings.push_back(one.name + " and " + other.name + " overlap at equal priority, by " +
                           size(close.overlap) + " at " + place(close.overlap_at) + ": " + other.name +
                           ", the later, is taken to be there; a priority would say so");
    }
    return warnings;
}

std::vector<std::string> near_warnings(Scene const& scene, double wavelength) {
    std::vector<std::string> warnings;
    for (Bvh::Closeness const& close : scene.bvh->closeness(wavelength))
        if (close.facets > 0.0)
            warnings.push_back(
                scene.faces[close.facets_one.value].name + " and " +
                scene.faces[close.facets_other.value].name +
                " follow each other, but facets of theirs do not lie on each other: between them are gaps "
                "and "
                "overlaps, of up to " +
                size(close.facets) +
                " where it was looked, and they are traced as such; no light is lost, but the gaps reflect: "
                "exact shapes on both sides, or the same triangles, would touch");
        else if (close.gap < wavelength)
            warnings.push_back(scene.faces[close.gap_one.value].name + " and " +
                               scene.faces[close.gap_other.value].name + " nearly touch: a gap of " +
                               size(close.gap) + " at " + place(close.gap_at) +
                               ", below a wavelength; it is traced as a gap, which light in part would pass");
    return warnings;
}

} // namespace sahl
