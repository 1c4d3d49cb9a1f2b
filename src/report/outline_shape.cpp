// In: an exact shape, where it stands, and a view. Out: its outline in that view: silhouette, edges, rims,
// profile.
#include "geometry/revolved.h"
#include "geometry/tessellate.h"
#include "math/overloaded.h"
#include "report/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace sahl::report {

namespace {

constexpr int steps = 72; // of a circle: a chord errs by a thousandth of the radius, less than a pixel
constexpr double turn = 2.0 * std::numbers::pi;

double cross_of(dvec2 const& a, dvec2 const& b) {
    return a.x * b.y - a.y * b.x;
}

/// The convex hull, counterclockwise (Andrew's monotone chain).
Polyline hull(Polyline points) {
    if (points.size() < 3)
        return points;
    std::sort(points.begin(), points.end(),
              [](auto a, auto b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    Polyline chain;
    for (int pass = 0; pass < 2; ++pass) {
        std::size_t const start = chain.size();
        for (dvec2 const& p : points) {
            while (chain.size() >= start + 2 &&
                   cross_of(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0.0)
                chain.pop_back();
            chain.push_back(p);
        }
        chain.pop_back(); // it begins the other half
        std::reverse(points.begin(), points.end());
    }
    return chain;
}

double twice_area(Polyline const& loop) {
    double sum = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += cross_of(loop[i] - loop[0], loop[(i + 1) % loop.size()] - loop[0]);
    return sum;
}

/// Does the loop cover less than a billionth of a square of its length, which no drawing shows?
bool is_flat(Polyline const& loop) {
    double way = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        way += length(loop[(i + 1) % loop.size()] - loop[i]);
    return std::abs(twice_area(loop)) <= 1e-9 * way * way;
}

/// So that overlapping loops add up under the nonzero rule.
Polyline counterclockwise(Polyline loop) {
    if (twice_area(loop) < 0.0)
        std::reverse(loop.begin(), loop.end());
    return loop;
}

struct Pen {
    Affine const& to_world;
    View const& view;
    Outline out;

    dvec2 at(dvec3 const& local) const { return view(to_world.point(local)); }
    Polyline at(std::vector<dvec3> const& local) const {
        Polyline line;
        for (dvec3 const& p : local)
            line.push_back(at(p));
        return line;
    }
    /// About the axis, `steps` points; the last is not the first again.
    Polyline circle(double z, double radius) const {
        Polyline loop;
        for (int i = 0; i < steps; ++i)
            loop.push_back(at(radius * dvec3(std::cos(turn * i / steps), std::sin(turn * i / steps), 0.0) +
                              dvec3(0, 0, z)));
        return loop;
    }
    /// The unit vector across the axis (in the shape's own frame) that the view shows furthest from the axis.
    dvec3 sideways() const {
        dvec2 const axis = view(to_world.linear[2]);
        dvec2 const normal(-axis.y, axis.x);
        dvec3 const side(dot(normal, view(to_world.linear[0])), dot(normal, view(to_world.linear[1])), 0.0);
        return length(side) > 0.0 ? normalize(side) : dvec3(1, 0, 0);
    }

    /// Nothing where the loop is seen on edge.
    void closed(std::vector<dvec3> const& corners) {
        Polyline loop = counterclockwise(at(corners));
        if (!is_flat(loop))
            out.area.push_back(std::move(loop));
    }
    void line(std::vector<dvec3> points) { out.lines.push_back(at(points)); }
    void ring(Polyline loop) {
        loop.push_back(loop.front());
        out.lines.push_back(std::move(loop));
    }
    /// A prism over a polygon: both ends in the same order.
    void extruded(std::vector<dvec3> const& near, std::vector<dvec3> const& far) {
        Polyline all = at(near);
        for (dvec3 const& p : far)
            all.push_back(at(p));
        out.area.push_back(hull(std::move(all)));
        for (std::size_t i = 0; i < near.size(); ++i) {
            std::size_t const next = (i + 1) % near.size();
            line({near[i], near[next]});
            line({far[i], far[next]});
            line({near[i], far[i]});
        }
    }

    void draw(Sphere const& s) {
        // the point of the ellipsoid's image that lies furthest along n: M Mᵀ n / |Mᵀ n|, M the view of the
        // linear part
        std::array<dvec3, 2> rows;
        for (int k = 0; k < 3; ++k) {
            dvec2 const column = view(to_world.linear[k]);
            rows[0][k] = column.x;
            rows[1][k] = column.y;
        }
        Polyline loop;
        for (int i = 0; i < steps; ++i) {
            dvec3 const back = std::cos(turn * i / steps) * rows[0] + std::sin(turn * i / steps) * rows[1];
            dvec3 const furthest = length(back) > 0.0 ? s.radius * normalize(back) : dvec3(0.0);
            loop.push_back(at(furthest));
        }
        out.area.push_back(std::move(loop));
    }
    void draw(Box const& s) {
        std::vector<dvec3> const c = box_corners(-0.5 * s.size, 0.5 * s.size);
        extruded({c[0], c[1], c[3], c[2]}, {c[4], c[5], c[7], c[6]});
    }
    void draw(Prism const& s) {
        double const half_base = s.side * std::sin(0.5 * s.apex),
                     half_height = 0.5 * s.side * std::cos(0.5 * s.apex);
        auto const end = [&](double z) {
            return std::vector<dvec3>{
                {-half_base, -half_height, z}, {half_base, -half_height, z}, {0.0, half_height, z}};
        };
        extruded(end(-0.5 * s.length), end(0.5 * s.length));
    }
    void draw(Cylinder const& s) {
        Polyline const back = circle(-0.5 * s.length, s.radius), front = circle(0.5 * s.length, s.radius);
        Polyline all = back;
        all.insert(all.end(), front.begin(), front.end());
        out.area.push_back(hull(std::move(all))); // its straight parts are the lines of the silhouette
        ring(back);
        ring(front);
    }
    void draw(Cone const& s) {
        Polyline const back = circle(-0.5 * s.length, s.radius), front = circle(0.5 * s.length, s.top_radius);
        Polyline all = back;
        all.insert(all.end(), front.begin(), front.end());
        out.area.push_back(hull(std::move(all)));
        for (auto const& [rim, radius] : {std::pair(back, s.radius), std::pair(front, s.top_radius)})
            if (radius > 0.0)
                ring(rim);
    }
    void draw(CornerCube const& s) {
        std::vector<dvec3> const c{{0, 0, 0}, {s.side, 0, 0}, {0, s.side, 0}, {0, 0, s.side}};
        out.area.push_back(hull(at(c)));
        for (std::size_t i = 0; i < c.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                line({c[i], c[j]});
    }
    void draw(QuadricBody const& s) {            // as a mesh: its silhouette has no simple form
        Tessellation pieces = tessellate(s, 96); // at most a pixel off at the width of a page
        if (!pieces.problem.empty())
            return draw(Box{s.clip});
        Mesh mesh;
        mesh.soup = std::move(pieces.soup);
        out = outline_of(mesh, to_world, view);
    }
    void draw(ConicMirror const& s) {
        double const h = 0.5 * s.diameter;
        Revolved const form = form_of(s);
        Polyline rim = circle(form.sag(h), h);
        ring(rim);
        if (s.hole_diameter > 0.0)
            ring(circle(form.sag(0.5 * s.hole_diameter), 0.5 * s.hole_diameter));
        dvec3 const side = sideways();
        for (double const sign : {-1.0, 1.0}) {
            std::vector<dvec3> profile;
            constexpr int parts = 24;
            for (int i = 0; i <= parts; ++i) {
                double const r = 0.5 * s.hole_diameter + (h - 0.5 * s.hole_diameter) * i / parts;
                profile.push_back(side * (sign * r) + dvec3(0, 0, form.sag(r)));
            }
            line(std::move(profile));
        }
    }
    void draw(Lens const& s) {
        double const h = 0.5 * s.diameter;
        Revolved const front = front_of(s), back = back_of(s);
        for (double const z : {front.sag(h), s.thickness + back.sag(h)}) {
            Polyline rim = circle(z, h);
            ring(rim);
            out.area.push_back(counterclockwise(std::move(rim)));
        }
        dvec3 const side = sideways();
        std::vector<dvec3> profile;
        constexpr int half = 24;
        for (int i = -half; i <= half; ++i)
            profile.push_back(side * (h * i / half) + dvec3(0, 0, front.sag(h * std::abs(i) / half)));
        for (int i = half; i >= -half; --i)
            profile.push_back(side * (h * i / half) +
                              dvec3(0, 0, s.thickness + back.sag(h * std::abs(i) / half)));
        closed(std::move(profile));
    }
    void draw(Plane const&) {
        dvec3 const normal = cross(to_world.linear[0], to_world.linear[1]);
        double const seen = std::abs(dot(normal, view.towards_viewer()));
        if (seen >
            1e-6 * length(normal)) // not on edge: within a thousandth of a pixel over the whole drawing it is
            return;
        dvec2 const a = view(to_world.linear[0]), b = view(to_world.linear[1]);
        out.endless = {view(to_world.offset), length(a) > length(b) ? a : b};
    }
    void draw(Rectangle const& s) {
        dvec2 const h = 0.5 * s.size;
        std::vector<dvec3> const corners{{-h.x, -h.y, 0}, {h.x, -h.y, 0}, {h.x, h.y, 0}, {-h.x, h.y, 0}};
        closed(corners);
        if (!out.area.empty())
            return;
        // on edge a single line, since dashes there and back would fill each other's gaps: the longer
        // diagonal
        bool const first = length(at(corners[2]) - at(corners[0])) > length(at(corners[3]) - at(corners[1]));
        line(first ? std::vector{corners[0], corners[2]} : std::vector{corners[1], corners[3]});
    }
    void draw(Disk const& s) {
        out.area.push_back(counterclockwise(circle(0.0, s.radius)));
        if (s.hole_radius <= 0.0)
            return;
        Polyline hole = counterclockwise(circle(0.0, s.hole_radius));
        std::reverse(hole.begin(), hole.end());
        out.area.push_back(std::move(hole));
    }
};

} // namespace

Outline outline_of(Shape const& shape, Affine const& to_world, View const& view) {
    Pen pen{to_world, view, {}};
    std::visit([&](auto const& s) { pen.draw(s); }, shape);
    return std::move(pen.out);
}

std::vector<dvec3> box_corners(dvec3 const& low, dvec3 const& high) {
    std::vector<dvec3> corners;
    for (int i = 0; i < 8; ++i)
        corners.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    return corners;
}

std::vector<dvec3> box_corners(Shape const& shape) {
    dvec3 const half =
        std::visit(Overloaded{
                       [](Sphere const& s) { return dvec3(s.radius); },
                       [](Box const& s) { return 0.5 * s.size; },
                       [](Cylinder const& s) { return dvec3(s.radius, s.radius, 0.5 * s.length); },
                       [](Lens const& s) { return dvec3(0.5 * s.diameter, 0.5 * s.diameter, s.thickness); },
                       [](Prism const& s) {
                           return dvec3(s.side * std::sin(0.5 * s.apex),
                                        0.5 * s.side * std::cos(0.5 * s.apex), 0.5 * s.length);
                       },
                       [](Cone const& s) {
                           double const h = std::max(s.radius, s.top_radius);
                           return dvec3(h, h, 0.5 * s.length);
                       },
                       [](CornerCube const& s) { return dvec3(s.side); },
                       [](QuadricBody const& s) { return 0.5 * s.clip; },
                       [](ConicMirror const& s) {
                           double const h = 0.5 * s.diameter;
                           return dvec3(h, h, std::abs(form_of(s).sag(h)));
                       },
                       [](Plane const&) { return dvec3(-1.0); },
                       [](Rectangle const& s) { return dvec3(0.5 * s.size, 0.0); },
                       [](Disk const& s) { return dvec3(s.radius, s.radius, 0.0); },
                   },
                   shape);
    return half.x < 0.0 ? std::vector<dvec3>() : box_corners(-half, half);
}

} // namespace sahl::report
