#include "geometry/shape.h"

#include "geometry/revolved.h"
#include "math/overloaded.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

namespace sahl {

namespace {

constexpr std::array<std::string_view, 1> one_face{"surface"};
constexpr std::array<std::string_view, 6> box_faces{"left", "right", "bottom", "top", "back", "front"};
constexpr std::array<std::string_view, 3> cylinder_faces{"side", "back", "front"};
constexpr std::array<std::string_view, 3> lens_faces{"front", "back", "edge"};
constexpr std::array<std::string_view, 4> corner_faces{"x", "y", "z", "front"};
constexpr std::array<std::string_view, 2> quadric_faces{"surface", "caps"};
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

/// That a surface does not go as far as a rim of this diameter, and how far it goes.
std::string too_short(std::string const& what, Revolved const& form, double diameter) {
    double const reach = form.reach();
    if (0.5 * diameter <= reach)
        return {};
    double millimetres = 2e3 * reach; // as many digits as are printed, rounded down
    millimetres = std::floor(millimetres * 1e6 * (1.0 + 1e-15)) * 1e-6;
    return what + " does not reach a rim of diameter " + mm(diameter) + "; make diameter_mm at most " +
           mm(1e-3 * millimetres);
}

bool all_finite(std::vector<double> const& values) {
    return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// The least thickness up to the rim; exact there, between the rim and the axis by samples.
double least_thickness(Lens const& lens) {
    Revolved const front = front_of(lens), back = back_of(lens);
    bool const spherical =
        front.conic == 0.0 && back.conic == 0.0 && front.terms.empty() && back.terms.empty();
    int const steps = spherical ? 1 : 1000; // between two spheres the rim is where they come nearest
    double least = lens.thickness;
    for (int i = 1; i <= steps; ++i) {
        double const r = 0.5 * lens.diameter * i / steps;
        least = std::min(least, lens.thickness + back.sag(r) - front.sag(r));
    }
    return least;
}

std::string cone_problem(Cone const& cone) {
    for (auto const& [key, radius] :
         {std::pair{"radius_mm", cone.radius}, {"top_radius_mm", cone.top_radius}})
        if (!std::isfinite(radius) || radius < 0.0)
            return std::string(key) + " must be a finite number of at least 0";
    if (cone.radius == 0.0 && cone.top_radius == 0.0)
        return "radius_mm and top_radius_mm are both 0; make one of them larger";
    return positive(cone.length) ? std::string() : must_be_positive("length_mm");
}

std::string quadric_problem(QuadricBody const& body) {
    auto const& c = body.coefficients;
    if (!std::all_of(c.begin(), c.end(), [](double x) { return std::isfinite(x); }))
        return "coefficients must be ten finite numbers";
    return positive(body.clip.x) && positive(body.clip.y) && positive(body.clip.z)
               ? std::string()
               : "clip_mm must be three finite numbers above 0";
}

std::string mirror_problem(ConicMirror const& mirror) {
    if (!std::isfinite(mirror.radius) || !std::isfinite(mirror.conic))
        return "radius_mm and conic must be finite; radius_mm = 0 is a plane";
    if (!positive(mirror.diameter))
        return must_be_positive("diameter_mm");
    if (!(mirror.hole_diameter >= 0.0 && mirror.hole_diameter < mirror.diameter))
        return "hole_diameter_mm must be at least 0 and below diameter_mm";
    return too_short("a mirror of radius_mm = " + mm(mirror.radius) + " and this conic", form_of(mirror),
                     mirror.diameter);
}

std::string lens_problem(Lens const& lens) {
    if (!positive(lens.thickness))
        return must_be_positive("thickness_mm");
    if (!positive(lens.diameter))
        return must_be_positive("diameter_mm");
    if (!std::isfinite(lens.r1) || !std::isfinite(lens.r2))
        return "r1_mm and r2_mm must be finite; 0 is a plane";
    if (!std::isfinite(lens.conic1) || !std::isfinite(lens.conic2))
        return "conic1 and conic2 must be finite";
    if (!all_finite(lens.aspheric1) || !all_finite(lens.aspheric2))
        return "aspheric1 and aspheric2 must be lists of finite numbers";
    if (std::max(lens.aspheric1.size(), lens.aspheric2.size()) > most_aspheric_terms)
        return "aspheric1 and aspheric2 may have " + std::to_string(most_aspheric_terms) +
               " coefficients; leave out what is beyond r^" + std::to_string(2 * most_aspheric_terms + 2);
    for (auto const& [key, radius, form] :
         {std::tuple{"r1_mm", lens.r1, front_of(lens)}, std::tuple{"r2_mm", lens.r2, back_of(lens)}}) {
        std::string const with = form.conic == 0.0 ? "" : " and this conic";
        std::string problem =
            too_short("a surface of " + (key + (" = " + mm(radius))) + with, form, lens.diameter);
        if (!problem.empty())
            return problem;
    }
    double const edge = least_thickness(lens);
    if (!(edge >= 0.0))
        return "its two surfaces cross before the rim: the edge would be " + mm(edge) +
               " thick; make thickness_mm at least " + mm(lens.thickness - edge) + ", or diameter_mm smaller";
    return {};
}

} // namespace

bool is_open(Shape const& shape) {
    return std::visit(Overloaded{[](Plane const&) { return true; }, [](Rectangle const&) { return true; },
                                 [](Disk const&) { return true; }, [](ConicMirror const&) { return true; },
                                 [](auto const&) { return false; }},
                      shape);
}

std::span<std::string_view const> face_names(Shape const& shape) {
    using Names = std::span<std::string_view const>;
    return std::visit(Overloaded{[](Box const&) { return Names(box_faces); },
                                 [](Cylinder const&) { return Names(cylinder_faces); },
                                 [](Cone const&) { return Names(cylinder_faces); },
                                 [](CornerCube const&) { return Names(corner_faces); },
                                 [](QuadricBody const&) { return Names(quadric_faces); },
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
                          [](Cone const& s) { return cone_problem(s); },
                          [](CornerCube const& s) {
                              return positive(s.side) ? std::string() : must_be_positive("side_mm");
                          },
                          [](QuadricBody const& s) { return quadric_problem(s); },
                          [](ConicMirror const& s) { return mirror_problem(s); },
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
