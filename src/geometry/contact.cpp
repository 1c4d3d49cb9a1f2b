#include "geometry/contact.h"

#include "math/overloaded.h"
#include "math/sequences.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl {

namespace {

/// Ulps that placing a shape may cost: scaling, three rotations, a group or two and a translation round each
/// coordinate some ten times, and two shapes are compared.
constexpr double placement_ulps = 32.0;

double size_of(dmat3 const& m) {
    double largest = 0.0;
    for (int column = 0; column < 3; ++column)
        largest = std::max(largest, length(m[column]));
    return largest;
}

/// The one scale of a similarity; nothing for a map that shears or stretches by more than rounding.
std::optional<double> scale_of(dmat3 const& m) {
    dmat3 const gram = glm::transpose(m) * m;
    double const squared = gram[0][0];
    double const tolerance = placement_ulps * std::numeric_limits<double>::epsilon() * squared;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (std::abs(gram[i][j] - (i == j ? squared : 0.0)) > tolerance)
                return std::nullopt;
    return std::sqrt(squared);
}

/// x ↦ q(linear · x + shift)
Quadric moved(Quadric const& q, dmat3 const& linear, dvec3 const& shift) {
    dmat3 const turned = glm::transpose(linear);
    return {turned * q.a * linear, turned * (2.0 * (q.a * shift) + q.b), q.value(shift), dvec3(0.0)};
}

Revolved scaled(Revolved form, double scale) {
    form.curvature /= scale;
    double power = scale;
    for (double& term : form.terms)
        term /= power *= scale * scale;
    return form;
}

/// Do two surfaces with one vertex rise alike, along axes that agree or oppose, up to `reach` from it?
bool rise_alike(Revolved const& a, Revolved const& b, double sense, double reach, double allowed) {
    double const end = std::min({reach, a.reach(), b.reach()});
    constexpr int steps = 16;
    for (int i = 1; i <= steps; ++i)
        if (!(std::abs(a.sag(end * i / steps) - sense * b.sag(end * i / steps)) <= allowed))
            return false;
    return true;
}

} // namespace

std::optional<Carrier> seen_through(Carrier const& carrier, Affine const& map) {
    using Result = std::optional<Carrier>;
    return std::visit(
        Overloaded{
            [&](PlaneCarrier const& plane) {
                dvec3 const normal = glm::transpose(glm::inverse(map.linear)) * plane.normal;
                double const unit = 1.0 / length(normal);
                return Result(PlaneCarrier{unit * normal, unit * (plane.offset + dot(normal, map.offset))});
            },
            [&](SphereCarrier const& sphere) {
                auto const scale = scale_of(map.linear);
                return scale ? Result(SphereCarrier{map.point(sphere.centre), *scale * sphere.radius})
                             : std::nullopt;
            },
            [&](TubeCarrier const& tube) {
                auto const scale = scale_of(map.linear);
                return scale ? Result(TubeCarrier{map.point(tube.point), normalize(map.vector(tube.axis)),
                                                  *scale * tube.radius})
                             : std::nullopt;
            },
            [&](RevolvedCarrier const& sheet) {
                auto const scale = scale_of(map.linear);
                return scale ? Result(RevolvedCarrier{map.point(sheet.vertex),
                                                      normalize(map.vector(sheet.axis)),
                                                      scaled(sheet.form, *scale)})
                             : std::nullopt;
            },
            [&](QuadricCarrier const& quadric) {
                dmat3 const back = glm::inverse(map.linear);
                return Result(QuadricCarrier{moved(quadric.form, back, -(back * map.offset))});
            },
        },
        carrier);
}

Carriers carriers_of(Region const& region) {
    Carriers carriers;
    switch (region.kind) {
    case Region::Kind::half_space:
        carriers.push_back(PlaneCarrier{region.a, region.b});
        break;
    case Region::Kind::tube:
        carriers.push_back(TubeCarrier{dvec3(0.0), dvec3(0.0, 0.0, 1.0), region.b});
        break;
    case Region::Kind::sheet:
        carriers.push_back(carrier_of(*region.sheet, region.a));
        break;
    case Region::Kind::quadric:
        carriers.push_back(QuadricCarrier{moved(*region.quadric, dmat3(1.0), -region.a)});
        break;
    case Region::Kind::block:
        for (int axis = 0; axis < 3; ++axis)
            for (double const sign : {-1.0, 1.0}) {
                dvec3 normal(0.0);
                normal[axis] = sign;
                carriers.push_back(PlaneCarrier{normal, region.a[axis]});
            }
        break;
    default:
        carriers.push_back(SphereCarrier{region.a, region.b});
    }
    return carriers;
}

/// That of a sphere or a plane is theirs, whatever shape it belongs to.
Carrier carrier_of(RevolvedSheet const& sheet, dvec3 const& vertex) {
    Revolved const& form = sheet.form();
    if (form.terms.empty() && form.curvature == 0.0)
        return PlaneCarrier{{0.0, 0.0, 1.0}, vertex.z};
    if (form.terms.empty() && form.conic == 0.0)
        return SphereCarrier{vertex + dvec3(0.0, 0.0, 1.0 / form.curvature), std::abs(1.0 / form.curvature)};
    return RevolvedCarrier{vertex, {0.0, 0.0, 1.0}, form};
}

Carrier sheet_carrier() {
    return PlaneCarrier{{0.0, 0.0, 1.0}, 0.0};
}

namespace {

/// Do two quadrics coincide within `reach` of the origin? Wherever lines along the axes meet the first, the
/// second must pass within `distance`, besides what rounds where it is evaluated. Two that differ have a
/// curve in common at most.
bool coincide(Quadric const& one, Quadric const& other, double reach, double distance) {
    constexpr std::uint32_t lines =
        1024; // along each axis at most: the surface may be small in what is looked at
    constexpr std::uint32_t enough = 24; // meetings; nine numbers say what a quadric is
    std::uint32_t met = 0;
    for (std::uint32_t k = 0; k < lines && met < enough; ++k)
        for (int axis = 0; axis < 3; ++axis) {
            dvec2 const at = sobol_2d(k, static_cast<std::uint64_t>(axis));
            dvec3 origin(0.0), direction(0.0);
            origin[(axis + 1) % 3] = reach * (2.0 * at.x - 1.0);
            origin[(axis + 2) % 3] = reach * (2.0 * at.y - 1.0);
            direction[axis] = 1.0;
            QuadricRoots const roots = roots_of(one, origin, direction, 0.0);
            for (double const t : {roots.one, roots.two}) {
                if (!roots.any || !(std::abs(t) <= reach))
                    continue;
                dvec3 point = origin + t * direction;
                settle(one, point);
                dvec3 const size = glm::abs(point);
                double const terms =
                    std::abs(other.c) + dot(glm::abs(other.b), size) +
                    dot(size, dmat3(glm::abs(other.a[0]), glm::abs(other.a[1]), glm::abs(other.a[2])) * size);
                double const allowed = distance * length(other.gradient(point)) +
                                       placement_ulps * std::numeric_limits<double>::epsilon() * terms;
                if (!(std::abs(other.value(point)) <= allowed))
                    return false;
                ++met;
            }
        }
    return met >= 9; // else it hardly reaches here
}

/// The same surface as a quadric; nothing where it is none (aspheric), or flat.
std::optional<Quadric> as_quadric(Carrier const& carrier) {
    using Result = std::optional<Quadric>;
    auto const about = [](dmat3 const& a, dvec3 const& b, dvec3 const& origin) { // xᵀ a x + b·x from there
        return Result(moved(Quadric{a, b, 0.0, dvec3(0.0)}, dmat3(1.0), -origin));
    };
    return std::visit(
        Overloaded{
            [](PlaneCarrier const&) { return Result(); },
            [&](SphereCarrier const& s) {
                double const far = length(s.centre); // no cancellation where it passes the origin
                return Result(
                    Quadric{dmat3(1.0), -2.0 * s.centre, (far - s.radius) * (far + s.radius), dvec3(0.0)});
            },
            [&](TubeCarrier const& t) {
                auto q = about(dmat3(1.0) - glm::outerProduct(t.axis, t.axis), dvec3(0.0), t.point);
                q->c -= t.radius * t.radius;
                return q;
            },
            [&](RevolvedCarrier const& r) {
                if (!r.form.terms.empty() || r.form.curvature == 0.0)
                    return Result();
                double const c = r.form.curvature;
                return about(c * dmat3(1.0) + c * r.form.conic * glm::outerProduct(r.axis, r.axis),
                             -2.0 * r.axis, r.vertex);
            },
            [](QuadricCarrier const& q) { return Result(q.form); },
        },
        carrier);
}

} // namespace

bool coincide(Carrier const& one, Affine const& one_to_world, Carrier const& other,
              Affine const& other_to_world, double reach) {
    Affine const to_one = inverse(one_to_world), other_to_one = compose(to_one, other_to_world);
    auto const seen = seen_through(other, other_to_one);
    bool const alike = one.index() == other.index() && seen && !std::holds_alternative<QuadricCarrier>(one);
    if (!alike) {
        auto const a = as_quadric(one), b = as_quadric(other);
        if (!a || !b)
            return false;
        dmat3 const back = glm::inverse(other_to_one.linear);
        return coincide(*a, moved(*b, back, -(back * other_to_one.offset)), reach,
                        placing_tolerance(one_to_world, other_to_world, reach));
    }
    double const ulp = placement_ulps * std::numeric_limits<double>::epsilon();
    double const distance = placing_tolerance(one_to_world, other_to_world, reach);
    return std::visit(Overloaded{
                          [&](PlaneCarrier const& a) {
                              auto const& b = std::get<PlaneCarrier>(*seen);
                              double const sign = dot(a.normal, b.normal) < 0.0 ? -1.0 : 1.0;
                              return length(a.normal - sign * b.normal) * reach <= distance &&
                                     std::abs(a.offset - sign * b.offset) <= distance;
                          },
                          [&](SphereCarrier const& a) {
                              auto const& b = std::get<SphereCarrier>(*seen);
                              double const allowed = distance + ulp * (a.radius + length(a.centre));
                              return length(a.centre - b.centre) <= allowed &&
                                     std::abs(a.radius - b.radius) <= allowed;
                          },
                          [&](TubeCarrier const& a) {
                              auto const& b = std::get<TubeCarrier>(*seen);
                              dvec3 const between = b.point - a.point;
                              double const allowed = distance + ulp * (a.radius + length(between));
                              return length(cross(a.axis, b.axis)) * (reach + length(between)) <= allowed &&
                                     length(cross(a.axis, between)) <= allowed &&
                                     std::abs(a.radius - b.radius) <= allowed;
                          },
                          [&](RevolvedCarrier const& a) {
                              auto const& b = std::get<RevolvedCarrier>(*seen);
                              double const sense = dot(a.axis, b.axis) < 0.0 ? -1.0 : 1.0;
                              return length(a.vertex - b.vertex) <= distance &&
                                     length(a.axis - sense * b.axis) * reach <= distance &&
                                     rise_alike(a.form, b.form, sense, reach, distance);
                          },
                          [](QuadricCarrier const&) { return false; }, // above
                      },
                      one);
}

double placing_tolerance(Affine const& one_to_world, Affine const& other_to_world, double reach) {
    Affine const to_one = inverse(one_to_world);
    double const coordinates =
        reach + length(to_one.offset) + size_of(to_one.linear) * length(other_to_world.offset);
    return placement_ulps * std::numeric_limits<double>::epsilon() * coordinates;
}

std::optional<dvec3> tangent_point(Carrier const& one, Affine const& one_to_world, Carrier const& other,
                                   Affine const& other_to_world, double reach) {
    if (std::holds_alternative<SphereCarrier>(other) && !std::holds_alternative<SphereCarrier>(one))
        return tangent_point(other, other_to_world, one, one_to_world,
                             reach * size_of(one_to_world.linear) / size_of(other_to_world.linear));
    auto const* const ball = std::get_if<SphereCarrier>(&one);
    auto const seen = seen_through(other, compose(inverse(one_to_world), other_to_world));
    if (!ball || !seen || !scale_of(one_to_world.linear))
        return std::nullopt;
    double const allowed =
        placing_tolerance(one_to_world, other_to_world, reach) +
        placement_ulps * std::numeric_limits<double>::epsilon() * (ball->radius + length(ball->centre));
    if (auto const* const plane = std::get_if<PlaneCarrier>(&*seen)) {
        double const height = dot(plane->normal, ball->centre) - plane->offset;
        if (std::abs(std::abs(height) - ball->radius) > allowed)
            return std::nullopt;
        return one_to_world.point(ball->centre - height * plane->normal);
    }
    auto const* const second = std::get_if<SphereCarrier>(&*seen);
    if (!second)
        return std::nullopt;
    dvec3 const between = second->centre - ball->centre;
    double const distance = length(between);
    bool const outside = std::abs(distance - ball->radius - second->radius) <= allowed;
    bool const inside = std::abs(distance - std::abs(ball->radius - second->radius)) <= allowed;
    if (distance <= allowed || !(outside || inside))
        return std::nullopt;
    double const sense = outside || ball->radius > second->radius ? 1.0 : -1.0;
    return one_to_world.point(ball->centre + sense * ball->radius / distance * between);
}

} // namespace sahl
