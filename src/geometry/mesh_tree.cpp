#include "geometry/mesh_tree.h"

#include "geometry/mesh_stations.h"
#include "math/products.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace sahl {

namespace {

std::vector<Bounds> triangle_bounds(Mesh const& mesh) {
    std::vector<Bounds> bounds;
    bounds.reserve(mesh.soup.triangles.size());
    for (auto const& [a, b, c] : mesh.soup.triangles) {
        dvec3 const &p = mesh.soup.positions[a], &q = mesh.soup.positions[b], &r = mesh.soup.positions[c];
        bounds.push_back({glm::min(p, glm::min(q, r)), glm::max(p, glm::max(q, r))});
    }
    return bounds;
}

/// How far behind its start a line is searched, in multiples of the rounding: a crossing that grazes at 1e-6
/// rad and lies within the rounding of the start along its normal.
constexpr double far_behind = 1e6;

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
    : mesh_(std::move(mesh)), tree_(triangle_bounds(*mesh_)) {}

dvec3 MeshTree::normal(std::uint32_t triangle) const {
    auto const& [a, b, c] = mesh_->soup.triangles[triangle];
    auto const& p = mesh_->soup.positions;
    double const sign = mesh_->shells[mesh_->triangle_shell[triangle]].sign;
    return sign * normalize(precise_cross(p[b] - p[a], p[c] - p[a]));
}

dvec3 MeshTree::onto(std::uint32_t triangle, dvec3 const& point) const {
    auto const& corners = mesh_->soup.triangles[triangle];
    dvec3 const& a = mesh_->soup.positions[corners[0]];
    dvec3 const ab = mesh_->soup.positions[corners[1]] - a, ac = mesh_->soup.positions[corners[2]] - a;
    dvec3 const normal = precise_cross(ab, ac), from = point - a;
    double const squared = dot(normal, normal);
    double const v = dot(cross(from, ac), normal) / squared, w = dot(cross(ab, from), normal) / squared;
    if (v >= 0.0 && w >= 0.0 && v + w <= 1.0)
        return point - dot(normal, from) / squared * normal;
    double const v_in = std::max(v, 0.0), w_in = std::max(w, 0.0), sum = std::max(v_in + w_in, 1.0);
    return a + (v_in * ab + w_in * ac) / sum;
}

/// A triangle seen along a line.
struct MeshTree::Projected {
    std::array<dvec3, 3> corners; // from the line's origin
    std::array<dvec2, 3> flat;    // across the line
    double u, v, w;               // twice the signed areas between the line and each edge

    Projected(Line const& line, Mesh const& mesh, std::uint32_t triangle) {
        for (std::size_t i = 0; i < 3; ++i) {
            corners[i] = mesh.soup.positions[mesh.soup.triangles[triangle][i]] - line.origin;
            dvec3 const& p = corners[i];
            flat[i] = {p[line.kx] - line.shear_x * p[line.kz], p[line.ky] - line.shear_y * p[line.kz]};
        }
        auto const& [a, b, c] = flat;
        u = c.x * b.y - c.y * b.x;
        v = a.x * c.y - a.y * c.x;
        w = b.x * a.y - b.y * a.x;
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
    Projected const seen(line, *mesh_, triangle);
    auto const& [a, b, c] = seen.flat;
    bool const positive = is_positive(seen.u, b, c);
    if (is_positive(seen.v, c, a) != positive || is_positive(seen.w, a, b) != positive)
        return std::nullopt;
    MeshCrossing crossing = crossing_of(line, seen, triangle);
    crossing.enters = positive == (mesh_->shells[mesh_->triangle_shell[triangle]].sign > 0);
    return crossing;
}

MeshCrossing MeshTree::crossing_of(Line const& line, Projected const& seen, std::uint32_t triangle) const {
    MeshCrossing crossing;
    double const sum = seen.u + seen.v + seen.w;
    crossing.uv = sum != 0.0 ? dvec2(seen.v, seen.w) / sum : dvec2(0.0);
    crossing.triangle = triangle;
    // t from the plane, whose normal has its digits in needles too; within the corners' range, where the line
    // runs along the plane
    auto const& corners = mesh_->soup.triangles[triangle];
    auto const& p = mesh_->soup.positions;
    dvec3 const normal = precise_cross(p[corners[1]] - p[corners[0]], p[corners[2]] - p[corners[0]]);
    double const along = dot(normal, line.direction);
    auto const t_of = [&](std::size_t corner) { return line.shear_z * seen.corners[corner][line.kz]; };
    auto const [low, high] = std::minmax({t_of(0), t_of(1), t_of(2)});
    crossing.t = along != 0.0 ? std::clamp(dot(normal, seen.corners[0]) / along, low, high) : low;
    crossing.slope = std::abs(along) / length(normal);
    crossing.range = high - low;
    crossing.enters = (along < 0.0) == (mesh_->shells[mesh_->triangle_shell[triangle]].sign > 0);
    return crossing;
}

std::vector<MeshCrossing> MeshTree::all(Line const& line, double from, double rounding) const {
    std::vector<MeshCrossing> crossings;
    double const start = from - far_behind * rounding / length(line.direction);
    tree_.visit(line.origin, line.direction, {start, INFINITY}, [&](std::uint32_t triangle, double to) {
        if (auto const c = meet(line, triangle); c && (c->t - from) * c->slope >= -rounding)
            crossings.push_back(*c);
        return to;
    });
    std::sort(crossings.begin(), crossings.end(), [&](MeshCrossing const& a, MeshCrossing const& b) {
        auto const shell = [&](MeshCrossing const& c) { return mesh_->triangle_shell[c.triangle]; };
        return std::tuple(shell(a), a.t, a.triangle) < std::tuple(shell(b), b.t, b.triangle);
    });
    return crossings;
}

MeshAnswer MeshTree::next(dvec3 const& origin, dvec3 const& direction, InsideShells inside, Reach reach,
                          double rounding) const {
    Line const line(origin, direction);
    std::optional<MeshCrossing> best;
    bool doubtful = false; // something other than one plain crossing lies at the start or before the best
    std::vector<MeshCrossing> unfit;
    bool in_some = false;
    for (std::uint32_t shell = 0; shell < mesh_->shells.size(); ++shell)
        in_some = in_some || inside[shell];
    double const start = reach.from - far_behind * rounding / length(direction);
    double const end = in_some ? INFINITY : reach.to; // what the ray is in must be left somewhere
    tree_.visit(origin, direction, {start, end}, [&](std::uint32_t triangle, double to) {
        auto const c = meet(line, triangle);
        if (!c)
            return to;
        double const distance = (c->t - reach.from) * c->slope;
        bool const fits = c->enters != inside[mesh_->triangle_shell[triangle]];
        if (distance < -rounding)
            return to;
        if (distance <= rounding) { // at the start
            doubtful = doubtful || fits || (c->t - reach.from) * length(direction) > far_behind * rounding;
            return to;
        }
        if (!fits) {
            unfit.push_back(*c);
            return to;
        }
        if (!best || std::pair(c->t, c->triangle) < std::pair(best->t, best->triangle))
            best = c;
        return std::min(to, best->t + 2.0 * best->blur(rounding));
    });
    double const horizon = best ? best->t + 2.0 * best->blur(rounding) : INFINITY;
    for (MeshCrossing const& c : unfit)
        doubtful = doubtful || c.t - 2.0 * c.blur(rounding) <= horizon;
    for (std::uint32_t shell = 0; in_some && shell < mesh_->shells.size(); ++shell)
        doubtful = doubtful || (inside[shell] && !(best && mesh_->triangle_shell[best->triangle] == shell));
    if (!doubtful)
        return {best, INFINITY};
    return settle(line, inside, reach, rounding);
}

MeshAnswer MeshTree::settle(Line const& line, InsideShells inside, Reach reach, double rounding) const {
    MeshAnswer answer;
    std::vector<MeshCrossing> const crossings = all(line, reach.from, rounding);
    auto first = crossings.begin();
    for (std::uint32_t shell = 0; shell < mesh_->shells.size(); ++shell) {
        auto const last = std::find_if(first, crossings.end(), [&](MeshCrossing const& c) {
            return mesh_->triangle_shell[c.triangle] != shell;
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
    tree_.visit(line.origin, line.direction, {start, reach.to}, [&](std::uint32_t triangle, double to) {
        if (mesh_->triangle_shell[triangle] != shell)
            return to;
        Projected const seen(line, *mesh_, triangle);
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
    auto const shell_of = [&](MeshCrossing const& c) { return mesh_->triangle_shell[c.triangle]; };
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
