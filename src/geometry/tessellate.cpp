#include "geometry/tessellate.h"

#include "geometry/revolved.h"
#include "geometry/tessellate_parts.h"
#include "math/overloaded.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace sahl {

namespace {

/// A place on a meridian and the normal there, in the plane of r and z.
struct Meridian {
    double r, z;
    dvec2 normal;
};
using Profile = std::vector<Meridian>;

/// Of a turn that is cut into 6 · rings.
class Turner {
  public:
    Turner(Shape const& shape, std::size_t of_a_quarter) : out(shape), rings(of_a_quarter) {}

    std::uint32_t corner(Meridian const& m, std::size_t piece, std::size_t pieces) {
        double const angle =
            2.0 * std::numbers::pi * static_cast<double>(piece % pieces) / static_cast<double>(pieces);
        double const c = std::cos(angle), s = std::sin(angle);
        return out.corner({m.r * c, m.r * s, m.z}, {m.normal.x * c, m.normal.x * s, m.normal.y});
    }

    /// Counterclockwise seen from +z, where `upward`.
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, bool upward) {
        upward ? out.triangle(a, b, c) : out.triangle(a, c, b);
    }

    /// From the axis out: profile[i] is cut into 6 i pieces.
    void cap(Profile const& profile, bool upward) {
        std::vector<std::uint32_t> inner{corner(profile[0], 0, 1)}, outer;
        for (std::size_t ring = 1; ring < profile.size(); ++ring) {
            outer.clear();
            for (std::size_t k = 0; k < 6 * ring; ++k)
                outer.push_back(corner(profile[ring], k, 6 * ring));
            for (std::size_t sixth = 0; sixth < 6; ++sixth)
                for (std::size_t k = 0; k < ring; ++k) {
                    std::uint32_t const a = inner[(sixth * (ring - 1) + k) % inner.size()];
                    std::uint32_t const b = outer[sixth * ring + k],
                                        c = outer[(sixth * ring + k + 1) % outer.size()];
                    triangle(a, b, c, upward);
                    if (k + 1 < ring)
                        triangle(a, c, inner[(sixth * (ring - 1) + k + 1) % inner.size()], upward);
                }
            std::swap(inner, outer);
        }
    }

    /// A ring of 6 · rings pieces at each place of the profile. `upward`: with a profile that goes outwards,
    /// seen from +z; with one that goes down, from outside.
    void band(Profile const& profile, bool upward) {
        std::size_t const pieces = 6 * rings;
        std::vector<std::uint32_t> before, here;
        for (std::size_t i = 0; i < profile.size(); ++i) {
            here.clear();
            for (std::size_t k = 0; k < pieces; ++k)
                here.push_back(corner(profile[i], k, pieces));
            for (std::size_t k = 0; k < pieces && i > 0; ++k) {
                std::size_t const next = (k + 1) % pieces;
                triangle(before[k], here[k], here[next], upward);
                triangle(before[k], here[next], before[next], upward);
            }
            std::swap(before, here);
        }
    }

    /// A flat disk, or ring, at right angles to the axis, exact but for its rim.
    void flat(double radius, double hole, double z, bool upward) {
        dvec2 const normal(0.0, upward ? 1.0 : -1.0);
        if (hole > 0.0)
            return band({{hole, z, normal}, {radius, z, normal}}, upward);
        std::uint32_t const middle = corner({0.0, z, normal}, 0, 1);
        std::vector<std::uint32_t> rim;
        for (std::size_t k = 0; k < 6 * rings; ++k)
            rim.push_back(corner({radius, z, normal}, k, 6 * rings));
        for (std::size_t k = 0; k < rim.size(); ++k)
            triangle(middle, rim[k], rim[(k + 1) % rim.size()], upward);
    }

    /// The side of a cone's part, in rows as high as the pieces of its wider rim are long where its radius
    /// changes: between them normals would turn by more than the places do. The apex has a normal for each
    /// triangle.
    void side(double low, double low_radius, double high, double high_radius) {
        std::size_t const pieces = 6 * rings;
        double const widest = std::max(low_radius, high_radius), change = high_radius - low_radius;
        double const piece = 2.0 * std::numbers::pi * widest / static_cast<double>(pieces);
        auto const rows = static_cast<std::size_t>(std::ceil(std::abs(change) / piece));
        std::size_t const last = std::max<std::size_t>(rows, 1);
        dvec2 const normal = glm::normalize(dvec2(high - low, -change));
        Profile profile;
        for (std::size_t i = 0; i <= last; ++i) {
            double const share = static_cast<double>(i) / static_cast<double>(last);
            double const r = i == last ? low_radius : high_radius - share * change;
            double const z = i == last ? low : high - share * (high - low);
            if (r > 0.0)
                profile.push_back({r, z, normal});
        }
        if (profile.size() > 1)
            band(profile, true);
        if (high_radius == 0.0)
            tip({0.0, high, normal}, profile.front(), true);
        if (low_radius == 0.0)
            tip({0.0, low, normal}, profile.back(), false);
    }

    void tip(Meridian const& apex, Meridian const& rim, bool upward) {
        std::size_t const pieces = 6 * rings;
        for (std::size_t k = 0; k < pieces; ++k) {
            std::uint32_t const first = corner(apex, 2 * k + 1, 2 * pieces);
            corner(rim, k, pieces);
            corner(rim, k + 1, pieces);
            triangle(first, first + 1, first + 2, upward);
        }
    }

    void polygon(std::vector<dvec3> const& corners, dvec3 const& normal) {
        std::vector<std::uint32_t> numbers;
        for (dvec3 const& place : corners)
            numbers.push_back(out.corner(place, normal));
        for (std::size_t i = 2; i < numbers.size(); ++i)
            out.triangle(numbers[0], numbers[i - 1], numbers[i]);
    }

    SoupBuilder out;
    std::size_t rings;
};

/// r at equal lengths along the surface's meridian, both ends included. A meridian may be steep at its rim,
/// where equal steps of r would be long ones along it; steps of r = to · sin φ are not.
std::vector<double> equal_lengths(Revolved const& form, double from, double to, std::size_t pieces) {
    std::size_t const samples = 64 * pieces + 1024;
    double const begin = std::asin(from / to), end = 0.5 * std::numbers::pi;
    auto const r_at = [&](double share) { return to * std::sin(begin + (end - begin) * share); };
    std::vector<double> way{0.0};
    dvec2 before(from, form.sag(from));
    for (std::size_t i = 1; i <= samples; ++i) {
        double const r = i == samples ? to : r_at(static_cast<double>(i) / static_cast<double>(samples));
        dvec2 const here(r, form.sag(r));
        way.push_back(way.back() + length(here - before));
        before = here;
    }
    std::vector<double> radii{from};
    std::size_t at = 0;
    for (std::size_t i = 1; i < pieces; ++i) {
        double const wanted = way.back() * static_cast<double>(i) / static_cast<double>(pieces);
        while (way[at + 1] < wanted)
            ++at;
        double const part = (wanted - way[at]) / (way[at + 1] - way[at]);
        radii.push_back(r_at((static_cast<double>(at) + part) / static_cast<double>(samples)));
    }
    radii.push_back(to);
    return radii;
}

/// sense +1: the normal points to +z.
Profile profile_of(RevolvedSheet const& sheet, double vertex, double from, std::size_t pieces, double sense) {
    Profile profile;
    for (double const r : equal_lengths(sheet.form(), from, sheet.aperture(), pieces)) {
        double const z = sheet.form().sag(r);
        dvec3 const normal = sense * sheet.normal({r, 0.0, z});
        profile.push_back({r, vertex + z, {normal.x, normal.z}});
    }
    return profile;
}

void add(Turner& to, Sphere const& s) {
    Profile upper, lower;
    for (std::size_t i = 0; i <= to.rings; ++i) {
        double const angle = 0.5 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(to.rings);
        dvec2 const normal = i == to.rings ? dvec2(1.0, 0.0) : dvec2(std::sin(angle), std::cos(angle));
        upper.push_back({s.radius * normal.x, s.radius * normal.y, normal});
        lower.push_back({s.radius * normal.x, -s.radius * normal.y, {normal.x, -normal.y}});
    }
    to.cap(upper, true);
    to.cap(lower, false);
}

void add(Turner& to, Box const& s) {
    dvec3 const h = 0.5 * s.size;
    for (std::uint32_t face = 0; face < 6; ++face) {
        int const axis = static_cast<int>(face / 2), u = (axis + 1) % 3, v = (axis + 2) % 3;
        double const sign = face % 2 == 0 ? -1.0 : 1.0;
        std::vector<dvec3> corners;
        for (auto const& [a, b] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
            dvec3 p;
            p[axis] = sign * h[axis];
            p[u] = a * h[u];
            p[v] = b * h[v];
            corners.push_back(p);
        }
        if (sign < 0.0)
            std::reverse(corners.begin(), corners.end());
        dvec3 normal(0.0);
        normal[axis] = sign;
        to.out.begin_face(face);
        to.polygon(corners, normal);
    }
}

void add_round(Turner& to, double radius, double top_radius, double length) {
    double const h = 0.5 * length;
    to.side(-h, radius, h, top_radius);
    to.out.begin_face(1);
    if (radius > 0.0)
        to.flat(radius, 0.0, -h, false);
    to.out.begin_face(2);
    if (top_radius > 0.0)
        to.flat(top_radius, 0.0, h, true);
}

void add(Turner& to, Lens const& s) {
    double const h = 0.5 * s.diameter;
    RevolvedSheet const front(front_of(s), h), back(back_of(s), h);
    auto const surface = [&](RevolvedSheet const& sheet, double vertex, bool upward) {
        bool const flat = sheet.form().curvature == 0.0 && sheet.form().terms.empty();
        if (flat)
            to.flat(h, 0.0, vertex, upward);
        else
            to.cap(profile_of(sheet, vertex, 0.0, to.rings, upward ? 1.0 : -1.0), upward);
    };
    surface(front, 0.0, false);
    to.out.begin_face(1);
    surface(back, s.thickness, true);
    to.out.begin_face(2);
    to.band({{h, s.thickness + back.form().sag(h), {1.0, 0.0}}, {h, front.form().sag(h), {1.0, 0.0}}}, true);
}

void add(Turner& to, Prism const& s) {
    double const half = 0.5 * s.apex, c = std::cos(half), i = std::sin(half);
    double const x = s.side * i, y = 0.5 * s.side * c, z = 0.5 * s.length;
    dvec3 const left(-x, -y, 0.0), right(x, -y, 0.0), top(0.0, y, 0.0), far(0.0, 0.0, z);
    to.polygon({left - far, left + far, top + far, top - far}, {-c, i, 0.0});
    to.out.begin_face(1);
    to.polygon({right + far, right - far, top - far, top + far}, {c, i, 0.0});
    to.out.begin_face(2);
    to.polygon({left - far, right - far, right + far, left + far}, {0.0, -1.0, 0.0});
    to.out.begin_face(3);
    to.polygon({left - far, top - far, right - far}, {0.0, 0.0, -1.0});
    to.out.begin_face(4);
    to.polygon({left + far, right + far, top + far}, {0.0, 0.0, 1.0});
}

void add(Turner& to, CornerCube const& s) {
    dvec3 const o(0.0), x(s.side, 0, 0), y(0, s.side, 0), z(0, 0, s.side);
    to.polygon({o, z, y}, {-1.0, 0.0, 0.0});
    to.out.begin_face(1);
    to.polygon({o, x, z}, {0.0, -1.0, 0.0});
    to.out.begin_face(2);
    to.polygon({o, y, x}, {0.0, 0.0, -1.0});
    to.out.begin_face(3);
    to.polygon({x, y, z}, dvec3(1.0 / std::sqrt(3.0)));
}

void add(Turner& to, ConicMirror const& s) {
    RevolvedSheet const sheet(form_of(s), 0.5 * s.diameter);
    double const hole = 0.5 * s.hole_diameter;
    if (s.radius == 0.0)
        return to.flat(0.5 * s.diameter, hole, 0.0, true);
    if (hole == 0.0)
        return to.cap(profile_of(sheet, 0.0, 0.0, to.rings, 1.0), true);
    double const share = 1.0 - hole / sheet.aperture();
    auto const pieces = static_cast<std::size_t>(std::ceil(share * static_cast<double>(to.rings)));
    to.band(profile_of(sheet, 0.0, hole, pieces, 1.0), true);
}

} // namespace

Tessellation tessellate(Shape const& shape, unsigned turn) {
    if (std::holds_alternative<Plane>(shape))
        return {{}, "a plane has no end and no triangles; make it a rectangle or a disk"};
    if (auto const* const quadric = std::get_if<QuadricBody>(&shape))
        return tessellate_quadric(*quadric, (turn + 2) / 3);
    Turner to(shape, (turn + 5) / 6);
    std::visit(
        Overloaded{
            [&](Cylinder const& s) { add_round(to, s.radius, s.radius, s.length); },
            [&](Cone const& s) { add_round(to, s.radius, s.top_radius, s.length); },
            [&](Rectangle const& s) {
                dvec2 const h = 0.5 * s.size;
                to.polygon({{-h.x, -h.y, 0}, {h.x, -h.y, 0}, {h.x, h.y, 0}, {-h.x, h.y, 0}}, {0.0, 0.0, 1.0});
            },
            [&](Disk const& s) { to.flat(s.radius, s.hole_radius, 0.0, true); }, [](Plane const&) {},
            [](QuadricBody const&) {}, [&](auto const& s) { add(to, s); }},
        shape);
    return {to.out.take(), {}};
}

} // namespace sahl
