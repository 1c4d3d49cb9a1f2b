#include "geometry/shape.h"

#include "math/overloaded.h"

#include <array>
#include <cmath>
#include <numbers>

namespace sahl {

namespace {

constexpr std::array<std::string_view, 1> one_face{"surface"};
constexpr std::array<std::string_view, 6> box_faces{"left", "right", "bottom", "top", "back", "front"};
constexpr std::array<std::string_view, 3> cylinder_faces{"side", "back", "front"};
constexpr std::array<std::string_view, 3> lens_faces{"front", "back", "edge"};
constexpr std::array<std::string_view, 5> prism_faces{"left", "right", "base", "near", "far"};

bool positive(double x) {
    return std::isfinite(x) && x > 0.0;
}

std::string mm(double metres) {
    std::string text = std::to_string(metres * 1e3);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
        text.pop_back();
    return text + " mm";
}

std::string must_be_positive(char const* key) {
    return std::string(key) + " must be a finite number above 0";
}

/// Height of a lens's surface above its vertex at distance `h` from the axis.
double sag(double radius, double h) {
    return radius == 0.0 ? 0.0 : h * h / (radius * (1.0 + std::sqrt(1.0 - (h / radius) * (h / radius))));
}

std::string lens_problem(Lens const& lens) {
    if (!positive(lens.thickness))
        return must_be_positive("thickness_mm");
    if (!positive(lens.diameter))
        return must_be_positive("diameter_mm");
    if (!std::isfinite(lens.r1) || !std::isfinite(lens.r2))
        return "r1_mm and r2_mm must be finite; 0 is a plane";
    double const h = lens.diameter / 2.0;
    for (auto const& [key, radius] : {std::pair{"r1_mm", lens.r1}, std::pair{"r2_mm", lens.r2}})
        if (radius != 0.0 && std::abs(radius) < h)
            return std::string("a surface of ") + key + " = " + mm(radius) +
                   " does not reach a rim of diameter " + mm(lens.diameter) + "; make diameter_mm at most " +
                   mm(2.0 * std::abs(radius));
    double const edge = lens.thickness + sag(lens.r2, h) - sag(lens.r1, h);
    if (edge < 0.0)
        return "its two surfaces cross before the rim: the edge would be " + mm(edge) +
               " thick; make thickness_mm at least " + mm(lens.thickness - edge) + ", or diameter_mm smaller";
    return {};
}

} // namespace

bool is_open(Shape const& shape) {
    return std::visit(Overloaded{[](Plane const&) { return true; }, [](Rectangle const&) { return true; },
                                 [](Disk const&) { return true; }, [](auto const&) { return false; }},
                      shape);
}

std::span<std::string_view const> face_names(Shape const& shape) {
    using Names = std::span<std::string_view const>;
    return std::visit(Overloaded{[](Box const&) { return Names(box_faces); },
                                 [](Cylinder const&) { return Names(cylinder_faces); },
                                 [](Lens const&) { return Names(lens_faces); },
                                 [](Prism const&) { return Names(prism_faces); },
                                 [](auto const&) { return Names(one_face); }},
                      shape);
}

std::string shape_problem(Shape const& shape) {
    return std::visit(Overloaded{
                          [](Sphere const& s) {
                              return positive(s.radius) ? std::string() : must_be_positive("radius_mm");
                          },
                          [](Box const& s) {
                              return positive(s.size.x) && positive(s.size.y) && positive(s.size.z)
                                         ? std::string()
                                         : "size_mm must be three finite numbers above 0";
                          },
                          [](Cylinder const& s) {
                              return !positive(s.radius)   ? must_be_positive("radius_mm")
                                     : !positive(s.length) ? must_be_positive("length_mm")
                                                           : std::string();
                          },
                          [](Lens const& s) { return lens_problem(s); },
                          [](Prism const& s) {
                              if (!(s.apex > 0.0 && s.apex < std::numbers::pi))
                                  return std::string("apex_deg must lie between 0 and 180");
                              return !positive(s.side)     ? must_be_positive("side_mm")
                                     : !positive(s.length) ? must_be_positive("length_mm")
                                                           : std::string();
                          },
                          [](Plane const&) { return std::string(); },
                          [](Rectangle const& s) {
                              return positive(s.size.x) && positive(s.size.y)
                                         ? std::string()
                                         : "size_mm must be two finite numbers above 0";
                          },
                          [](Disk const& s) {
                              if (!positive(s.radius))
                                  return must_be_positive("radius_mm");
                              return s.hole_radius >= 0.0 && s.hole_radius < s.radius
                                         ? std::string()
                                         : std::string(
                                               "hole_radius_mm must be at least 0 and below radius_mm");
                          },
                      },
                      shape);
}

} // namespace sahl
