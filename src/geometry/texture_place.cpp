#include "geometry/texture_place.h"

#include "math/overloaded.h"

#include <cmath>
#include <numbers>

namespace sahl {

namespace {

using std::numbers::pi;

/// The coordinate axis that a vector is most nearly along, with its sign.
dvec3 main_axis(dvec3 const& v) {
    dvec3 const a = glm::abs(v);
    if (a.z >= a.x && a.z >= a.y)
        return {0.0, 0.0, v.z < 0.0 ? -1.0 : 1.0};
    return a.y >= a.x ? dvec3(0.0, v.y < 0.0 ? -1.0 : 1.0, 0.0) : dvec3(v.x < 0.0 ? -1.0 : 1.0, 0.0, 0.0);
}

/// Lengths along an axis of the picture, out of the three of a shape.
double extent(dvec3 const& axis, dvec3 const& lengths) {
    return dot(glm::abs(axis), lengths);
}

/// lengths   m, of a repetition, along x, y and z
TexturePlace flat(dvec3 const& point, dvec3 const& normal, dvec3 const& lengths,
                  std::optional<dvec2> const& size) {
    dvec3 const n = main_axis(normal);
    dvec3 const up = n.y > 0.0 ? dvec3(0, 0, -1) : n.y < 0.0 ? dvec3(0, 0, 1) : dvec3(0, 1, 0);
    dvec3 const across = cross(up, n);
    dvec2 const one = size.value_or(dvec2(extent(across, lengths), extent(up, lengths)));
    TexturePlace place{{}, across / one.x, up / one.y};
    place.uv = 0.5 + place.moved(point);
    return place;
}

/// Once round the z axis, u = ½ on the side of +x; `up` and its place are set by the caller.
TexturePlace round_z(dvec3 const& p) {
    double const from_axis = p.x * p.x + p.y * p.y;
    TexturePlace place;
    place.uv.x = 0.5 + std::atan2(p.y, p.x) / (2.0 * pi);
    if (from_axis > 0.0)
        place.across = dvec3(-p.y, p.x, 0.0) / (2.0 * pi * from_axis);
    return place;
}

TexturePlace on_sphere(dvec3 const& p) {
    double const from_axis = std::sqrt(p.x * p.x + p.y * p.y);
    TexturePlace place = round_z(p);
    place.uv.y = 0.5 + std::atan2(p.z, from_axis) / pi;
    if (from_axis > 0.0)
        place.up = dvec3(-p.z * p.x / from_axis, -p.z * p.y / from_axis, from_axis) / (pi * dot(p, p));
    return place;
}

TexturePlace on_side(dvec3 const& p, double height) {
    TexturePlace place = round_z(p);
    place.uv.y = 0.5 + p.z / height;
    place.up = dvec3(0.0, 0.0, 1.0 / height);
    return place;
}

/// The lengths of a shape, of which a picture has one repetition.
dvec3 lengths_of(Shape const& shape) {
    return std::visit(
        Overloaded{[](Sphere const& s) { return dvec3(2.0 * s.radius); }, [](Box const& b) { return b.size; },
                   [](Cylinder const& c) { return dvec3(2.0 * c.radius, 2.0 * c.radius, c.length); },
                   [](Cone const& c) {
                       double const width = 2.0 * std::max(c.radius, c.top_radius);
                       return dvec3(width, width, c.length);
                   },
                   [](Lens const& l) { return dvec3(l.diameter); },
                   [](Prism const& p) { return dvec3(p.side, p.side, p.length); },
                   [](CornerCube const& c) { return dvec3(c.side); },
                   [](QuadricBody const& q) { return q.clip; }, [](Plane const&) { return dvec3(1.0); },
                   [](Rectangle const& r) { return dvec3(r.size, 1.0); },
                   [](Disk const& d) { return dvec3(2.0 * d.radius); },
                   [](ConicMirror const& m) { return dvec3(m.diameter); }},
        shape);
}

} // namespace

std::optional<TexturePlace> texture_place(Mesh const& mesh, std::uint32_t triangle, dvec3 const& point) {
    TriangleSoup const& soup = mesh.soup;
    if (triangle >= soup.texture_coordinates.size())
        return std::nullopt;
    auto const& corner = soup.triangles[triangle];
    dvec3 const p0 = soup.positions[corner[0]];
    dvec3 const e1 = soup.positions[corner[1]] - p0, e2 = soup.positions[corner[2]] - p0;
    dvec3 const n = cross(e1, e2);
    // of the shares of the second and the third corner: 1 along one edge, 0 along the other
    dvec3 const share1 = cross(e2, n) / dot(n, n), share2 = cross(n, e1) / dot(n, n);
    auto const& uv = soup.texture_coordinates[triangle];
    dvec2 const d1 = dvec2(uv[1]) - dvec2(uv[0]), d2 = dvec2(uv[2]) - dvec2(uv[0]);
    TexturePlace place{{}, d1.x * share1 + d2.x * share2, d1.y * share1 + d2.y * share2};
    place.uv = dvec2(uv[0]) + place.moved(point - p0);
    return place;
}

TexturePlace texture_place(Shape const& shape, std::size_t face, dvec3 const& point, dvec3 const& normal,
                           std::optional<dvec2> const& size) {
    if (std::holds_alternative<Sphere>(shape))
        return on_sphere(point);
    if (face == 0 && (std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Cone>(shape)))
        return on_side(point, lengths_of(shape).z);
    return flat(point, normal, lengths_of(shape), size);
}

} // namespace sahl
