#include "geometry/mesh_tree.h"

#include "geometry/mesh_stations.h"
#include "geometry/triangle.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <tuple>
#include <utility>

namespace sahl {

namespace {

/// Corners by triangle, anticlockwise seen from outside the volume that the shell encloses.
std::vector<TriangleCorners> corners_of(Mesh const& mesh) {
    std::vector<TriangleCorners> corners;
    corners.reserve(mesh.soup.triangles.size());
    for (std::size_t t = 0; t < mesh.soup.triangles.size(); ++t) {
        auto [a, b, c] = mesh.soup.triangles[t];
        if (mesh.shells[mesh.triangle_shell[t]].sign < 0)
            std::swap(b, c);
        corners.push_back({mesh.soup.positions[a], mesh.soup.positions[b], mesh.soup.positions[c]});
    }
    return corners;
}

std::vector<Bounds> bounds_of(std::vector<TriangleCorners> const& triangles) {
    std::vector<Bounds> bounds;
    bounds.reserve(triangles.size());
    for (auto const& [a, b, c] : triangles)
        bounds.push_back({glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))});
    return bounds;
}

/// How far behind its start a line is searched, in multiples of the rounding: a crossing that grazes at 1e-6
/// rad and lies within the rounding of the start along its normal.
constexpr double far_behind = 1e6;

/// A line that passes an edge within so many roundings may meet both its triangles at one place, though
/// Embree does not propose the one that it meets at a slope of down to their inverse.
constexpr double edge_roundings = 1e5;

/// The first place from the start on where a ray leaves or enters a shell. Where that does not fit what the
/// ray is in, t tells where, and the crossing is one of that place that would fit.
MeshAnswer change_of(std::vector<Station> const& stations, bool inside, double from, double rounding) {
    for (Station const& station : stations) {
        MeshCrossing const& there = *station.steepest;
        MeshCrossing const* const fitting = inside ? station.out : station.into;
        std::optional<MeshCrossing> const crossing = fitting ? std::optional(*fitting) : std::nullopt;
        bool const at_start = (there.t - from) * there.slope <= rounding;
        bool const fits = (station.turns_before > 0) == inside && station.turns_before >= 0;
        if (!at_start && !fits) // it should have been crossed before: a hole
            return {crossing, there.t};
        if ((station.turns_after > 0) != inside && crossing)
            return {crossing, INFINITY};
    }
    return {std::nullopt, inside ? from : INFINITY}; // a closed shell is left somewhere
}

/// Is `c × b` positive for a line moved from (0, 0) by a little in x, and by much less in y? So a line
/// through an edge passes on one side of it, the same for both its triangles, and a line through a vertex
/// through one of them (H. Edelsbrunner, E. P. Mücke, Simulation of Simplicity, ACM Trans. Graph. 9 (1990)
/// 66).
bool is_positive(double product, dvec2 const& b, dvec2 const& c) {
    return product != 0.0 ? product > 0.0 : c.y != b.y ? c.y > b.y : b.x > c.x;
}

} // namespace

/// A line made ready for the watertight test: sheared so that it runs along the third of its permuted axes
/// (S. Woop, C. Benthin, I. Wald, Watertight Ray/Triangle Intersection, JCGT 2 (2013) 65). An edge that two
/// triangles share gives both the same number with the opposite sign, exactly.
struct MeshTree::Line {
    dvec3 origin, direction;
    int kx, ky, kz;
    double shear_x, shear_y, shear_z;

    Line(dvec3 const& from, dvec3 const& along) : origin(from), direction(along) {
        dvec3 const size = glm::abs(along);
        kz = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        kx = (kz + 1) % 3;
        ky = (kx + 1) % 3;
        if (along[kz] < 0.0)
            std::swap(kx, ky); // keeps the winding
        shear_x = along[kx] / along[kz];
        shear_y = along[ky] / along[kz];
        shear_z = 1.0 / along[kz];
    }
};

MeshTree::MeshTree(std::shared_ptr<Mesh const> mesh)
    : mesh_(std::move(mesh)), corners_(corners_of(*mesh_)), triangles_(corners_) {}

BoxTree const& MeshTree::boxes() const {
    // in a thread of its own: one that traces would, while Embree builds, take up other rays and come here
    // again
    std::call_once(boxes_built_,
                   [this] { std::thread([this] { boxes_.emplace(bounds_of(corners_)); }).join(); });
    return *boxes_;
}

dvec3 MeshTree::normal(std::uint32_t triangle) const {
    return normal_of(corners_[triangle]);
}

dvec3 MeshTree::onto(std::uint32_t triangle, dvec3 const& point) const {
    return onto_triangle(corners_[triangle], point);
}

/// A triangle seen along a line.
struct MeshTree::Projected {
    std::array<dvec3, 3> corners; // from the line's origin
    std::array<dvec2, 3> flat;    // across the line
    double u, v, w;               // twice the signed areas between the line and each edge

    Projected(Line const& line, TriangleCorners const& triangle) {
        for (std::size_t i = 0; i < 3; ++i) {
            corners[i] = triangle[i] - line.origin;
            dvec3 const& p = corners[i];
            flat[i] = {p[line.kx] - line.shear_x * p[line.kz], p[line.ky] - line.shear_y * p[line.kz]};
        }
        auto const& [a, b, c] = flat;
        u = c.x * b.y - c.y * b.x;
        v = a.x * c.y - a.y * c.x;
        w = b.x * a.y - b.y * a.x;
    }
    /// Does the line pass through the triangle, and then into what it bounds? Never through none or both of
    /// two that share an edge.
    std::optional<bool> passed() const {
        auto const& [a, b, c] = flat;
        bool const positive = is_positive(u, b, c);
        if (is_positive(v, c, a) != positive || is_positive(w, a, b) != positive)
            return std::nullopt;
        return positive;
    }
    /// Does the line pass some edge, or its end, within `distance`? Beyond the ends of an edge it may say so
    /// too.
    bool close_to_border(double distance) const {
        auto const& [a, b, c] = flat;
        double const squared = distance * distance;
        return u * u <= squared * dot(c - b, c - b) || v * v <= squared * dot(a - c, a - c) ||
               w * w <= squared * dot(b - a, b - a);
    }
    /// Does the line pass through the triangle seen with this sense (±1), or no farther than `distance` from
    /// it?
    bool near(double sense, double distance) const {
        auto const& [a, b, c] = flat;
        return sense * u >= -distance * length(c - b) && sense * v >= -distance * length(a - c) &&
               sense * w >= -distance * length(b - a);
    }
};

std::optional<MeshCrossing> MeshTree::meet(Line const& line, std::uint32_t triangle) const {
    Projected const seen(line, corners_[triangle]);
    auto const enters = seen.passed();
    if (!enters)
        return std::nullopt;
    MeshCrossing crossing = crossing_of(line, seen, triangle);
    crossing.enters = *enters;
    return crossing;
}

MeshCrossing MeshTree::crossing_of(Line const& line, Projected const& seen, std::uint32_t triangle) const {
    MeshCrossing crossing;
    double const sum = seen.u + seen.v + seen.w;
    bool const turned = mesh_->shells[mesh_->shell_of(triangle)].sign < 0;
    crossing.uv = sum == 0.0 ? dvec2(0.0) : (turned ? dvec2(seen.w, seen.v) : dvec2(seen.v, seen.w)) / sum;
    crossing.triangle = triangle;
    // t from the plane, whose normal has its digits in needles too; within the corners' range, where the line
    // runs along the plane
    auto const& [a, b, c] = corners_[triangle];
    dvec3 const normal = precise_cross(b - a, c - a);
    double const along = dot(normal, line.direction), by_length = 1.0 / length(normal);
    auto const t_of = [&](std::size_t corner) { return line.shear_z * seen.corners[corner][line.kz]; };
    auto const [low, high] = std::minmax({t_of(0), t_of(1), t_of(2)});
    crossing.t = along != 0.0 ? std::clamp(dot(normal, seen.corners[0]) / along, low, high) : low;
    crossing.slope = std::abs(along) * by_length;
    crossing.range = high - low;
    crossing.per_metre = std::abs(line.shear_z);
    crossing.enters = along < 0.0;
    crossing.normal = by_length * normal;
    return crossing;
}

std::vector<MeshCrossing> MeshTree::all(Line const& line, double from, double rounding) const {
    std::vector<MeshCrossing> crossings;
    double const start = from - far_behind * rounding / length(line.direction);
    boxes().visit(line.origin, line.direction, {start, INFINITY}, [&](std::uint32_t triangle, double to) {
        if (auto const c = meet(line, triangle); c && (c->t - from) * c->slope >= -rounding)
            crossings.push_back(*c);
        return to;
    });
    std::sort(crossings.begin(), crossings.end(), [&](MeshCrossing const& a, MeshCrossing const& b) {
        auto const shell = [&](MeshCrossing const& c) { return mesh_->shell_of(c.triangle); };
        return std::tuple(shell(a), a.t, a.triangle) < std::tuple(shell(b), b.t, b.triangle);
    });
    return crossings;
}

MeshAnswer MeshTree::next(dvec3 const& origin, dvec3 const& direction, InsideShells inside, Reach reach,
                          double rounding) const {
    std::size_t const shells = mesh_->shells.size();
    bool in_some = false;
    for (std::uint32_t shell = 0; shell < shells; ++shell)
        in_some = in_some || inside[shell];
    auto const is_in = [&](std::uint32_t triangle) {
        return shells == 1 ? in_some : inside[mesh_->triangle_shell[triangle]];
    };
    Line const line(origin, direction);
    double const unit = length(direction), blur = triangles_.blur() / unit;
    MeshCrossing best;
    best.t = INFINITY;
    bool doubtful = false;                            // something but plain crossings lies at the start
    double unfit = INFINITY;                          // t of the nearest crossing that contradicts `inside`
    double const end = in_some ? INFINITY : reach.to; // what the ray is in must be left somewhere
    constexpr double no = INFINITY;
    double const edge = edge_roundings * rounding;
    double doubt = INFINITY; // t where a triangle is grazed, or its border passed closely
    auto const visitor = [&](Proposal const& proposal) {
        bool const in = is_in(proposal.triangle);
        if (proposal.sense != 0 && (proposal.sense < 0) == in) {
            if (proposal.t > reach.from + blur) // otherwise it is the one that the ray started on
                unfit = std::min(unfit, proposal.t - blur);
            return no;
        }
        Projected const seen(line, corners_[proposal.triangle]);
        auto const enters = seen.passed();
        if (!enters) {
            doubt = std::min(doubt, proposal.t - blur);
            return no;
        }
        MeshCrossing c = crossing_of(line, seen, proposal.triangle);
        c.enters = *enters;
        if (proposal.sense == 0 || seen.close_to_border(edge))
            doubt = std::min(doubt, c.t);
        double const distance = (c.t - reach.from) * c.slope;
        if (distance <= rounding) { // at the start, or behind it
            bool const far = (c.t - reach.from) * unit > far_behind * rounding;
            doubtful = doubtful || (distance >= -rounding && (c.enters != in || far));
            return no;
        }
        if (c.enters == in) {
            unfit = std::min(unfit, c.t - 2.0 * c.blur(rounding));
            return no;
        }
        if (std::pair(c.t, c.triangle) < std::pair(best.t, best.triangle))
            best = c;
        return best.t + 2.0 * best.blur(rounding);
    };
    triangles_.visit(origin, direction, unit, {reach.from, end}, visitor);
    bool const nothing = best.t == INFINITY;
    double const first_doubt = std::min(unfit, doubt);
    doubtful = doubtful || (nothing ? in_some || first_doubt < INFINITY
                                    : first_doubt <= best.t + 2.0 * best.blur(rounding));
    if (in_some && !mesh_->closed()) // through a hole another shell may be met than the one that was left
        for (std::uint32_t shell = 0; shell < shells; ++shell)
            doubtful = doubtful || (inside[shell] && mesh_->shell_of(best.triangle) != shell);
    if (doubtful)
        return next_exact(origin, direction, inside, reach, rounding);
    return nothing ? MeshAnswer{} : MeshAnswer{best, INFINITY};
}

MeshAnswer MeshTree::next_exact(dvec3 const& origin, dvec3 const& direction, InsideShells inside, Reach reach,
                                double rounding) const {
    Line const line(origin, direction);
    MeshAnswer answer;
    std::vector<MeshCrossing> const crossings = all(line, reach.from, rounding);
    auto first = crossings.begin();
    for (std::uint32_t shell = 0; shell < mesh_->shells.size(); ++shell) {
        auto const last = std::find_if(first, crossings.end(), [&](MeshCrossing const& c) {
            return mesh_->shell_of(c.triangle) != shell;
        });
        MeshAnswer of_shell =
            change_of(stations_of(first, last, rounding), inside[shell], reach.from, rounding);
        first = last;
        if (of_shell.contradiction < INFINITY) {
            bool const nothing = of_shell.contradiction <= reach.from;
            double const end = nothing ? INFINITY : of_shell.contradiction;
            if (auto const face = just_missed(line, shell, inside[shell], {reach.from, end}, rounding))
                of_shell.crossing = face;
            if (of_shell.crossing) { // within rounding all fits
                of_shell.crossing->recovered = true;
                of_shell.contradiction = INFINITY;
            }
        }
        answer.contradiction = std::min(answer.contradiction, of_shell.contradiction);
        auto const& c = of_shell.crossing;
        if (c && c->t <= reach.to && (!answer.crossing || c->t < answer.crossing->t))
            answer.crossing = c;
    }
    return answer;
}

std::optional<MeshCrossing> MeshTree::just_missed(Line const& line, std::uint32_t shell, bool inside,
                                                  Reach reach, double rounding) const {
    std::optional<MeshCrossing> best;
    double const start = reach.from - far_behind * rounding / length(line.direction);
    boxes().visit(line.origin, line.direction, {start, reach.to}, [&](std::uint32_t triangle, double to) {
        if (mesh_->shell_of(triangle) != shell)
            return to;
        Projected const seen(line, corners_[triangle]);
        MeshCrossing c = crossing_of(line, seen, triangle);
        double const sense =
            (inside == (mesh_->shells[shell].sign > 0)) ? -1.0 : 1.0; // of a triangle that fits
        bool const fits = c.enters != inside && (c.t - reach.from) * c.slope >= -rounding && c.t <= reach.to;
        if (fits && seen.near(sense, rounding) && (!best || c.t < best->t))
            best = c;
        return to;
    });
    return best;
}

std::vector<bool> MeshTree::inside(dvec3 const& origin, dvec3 const& direction, double rounding) const {
    std::vector<bool> states(mesh_->shells.size(), false);
    std::vector<MeshCrossing> const crossings = all(Line(origin, direction), 0.0, rounding);
    auto const shell_of = [&](MeshCrossing const& c) { return mesh_->shell_of(c.triangle); };
    for (auto first = crossings.begin(); first != crossings.end();) {
        auto const last = std::find_if(first, crossings.end(),
                                       [&](auto const& c) { return shell_of(c) != shell_of(*first); });
        Station const station = stations_of(first, last, rounding).front();
        MeshCrossing const& there = *station.steepest;
        states[shell_of(*first)] =
            (there.t * there.slope <= rounding ? station.turns_after : station.turns_before) > 0;
        first = last;
    }
    return states;
}

} // namespace sahl
