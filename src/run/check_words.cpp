#include "run/check_words.h"

#include "math/overloaded.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace sahl {

namespace {

std::string mirror_words(Colour const& colour) {
    double const most = std::max({colour[0], colour[1], colour[2]});
    return most > 0.0 ? words("mirror of up to %.3g %%", 100.0 * most) : std::string("absorber");
}

} // namespace

std::string surface_words(Surface const& surface) {
    return std::visit(
        Overloaded{
            [](Metal const&) { return std::string("mirror (metal)"); },
            [](Absorber const&) { return std::string("absorber"); },
            [](Diffuse const& d) { return words("diffuser of %.3g %%", 100.0 * d.reflectance); },
            [](Paint const& p) {
                if (p.covers < 1.0)
                    return words("paint that covers %.3g %%", 100.0 * p.covers);
                return p.reflect > 0.0 ? words("paint that reflects %.3g %%", 100.0 * p.reflect)
                                       : std::string("paint (absorbs)");
            },
            [](Shares const& s) {
                return s.reflect == 0.0 && s.transmit == 0.0 ? std::string("absorber")
                       : s.transmit == 0.0                   ? words("mirror of %.3g %%", 100.0 * s.reflect)
                                           : words("reflects %.3g %%, transmits %.3g %%", 100.0 * s.reflect,
                                                   100.0 * s.transmit);
            },
            [](Tinted const& t) {
                return t.clear > 0.0 ? std::string("clear, tinted") : mirror_words(t.mirrored);
            },
            [](ThinWall const& t) {
                return t.clear > 0.0 ? std::string("thin wall") : mirror_words(t.mirrored);
            },
        },
        surface.kind);
}

std::string body_words(Scene const& scene, ObjectId body, bool opaque) {
    Body const& it = scene.bodies[body.value];
    std::string surface; // of all faces, where they are alike
    bool alike = true;
    for (Face const& face : faces_of(scene, body)) {
        std::string const one = face.surface ? surface_words(scene.surfaces[face.surface->value]) : "clear";
        alike = alike && (surface.empty() || surface == one);
        surface = surface.empty() ? one : surface;
    }
    std::string const medium = scene.media[it.medium.value].name;
    if (it.open)
        return "open surface: " + (alike ? surface : "several finishes");
    if (opaque)
        return "opaque body: " + (alike ? surface : "several finishes");
    if (alike)
        return "body of " + medium + (surface == "clear" ? "" : ", all faces: " + surface);
    return "body of " + medium + ", some faces with a finish";
}

std::string shape_words(Shape const& shape) {
    return std::visit(
        Overloaded{
            [](Sphere const& s) { return words("sphere of radius %.6g mm", s.radius * 1e3); },
            [](Box const& b) {
                return words("box of %.6g × %.6g × %.6g mm", b.size.x * 1e3, b.size.y * 1e3, b.size.z * 1e3);
            },
            [](Cylinder const& c) {
                return words("cylinder of radius %.6g mm, %.6g mm long", c.radius * 1e3, c.length * 1e3);
            },
            [](Lens const& l) {
                return words("lens of %.6g mm, %.6g mm thick", l.diameter * 1e3, l.thickness * 1e3);
            },
            [](Prism const& p) {
                return words("prism of sides of %.6g mm, %.6g mm long", p.side * 1e3, p.length * 1e3);
            },
            [](Cone const& c) {
                return words("cone of radii %.6g mm and %.6g mm, %.6g mm long", c.radius * 1e3,
                             c.top_radius * 1e3, c.length * 1e3);
            },
            [](CornerCube const& c) { return words("corner cube of side %.6g mm", c.side * 1e3); },
            [](QuadricBody const& q) {
                return words("quadric within %.6g × %.6g × %.6g mm", q.clip.x * 1e3, q.clip.y * 1e3,
                             q.clip.z * 1e3);
            },
            [](ConicMirror const& m) {
                return words("conic mirror of %.6g mm, conic constant %.6g", m.diameter * 1e3, m.conic);
            },
            [](Plane const&) { return std::string("plane"); },
            [](Rectangle const& r) {
                return words("rectangle of %.6g × %.6g mm", r.size.x * 1e3, r.size.y * 1e3);
            },
            [](Disk const& d) { return words("disk of radius %.6g mm", d.radius * 1e3); },
            [](auto const&) { return std::string("exact shape"); },
        },
        shape);
}

std::string words(char const* format, ...) {
    char line[600];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    return line;
}

std::string plural(std::uint64_t count, char const* one, char const* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

} // namespace sahl
