#include "geometry/mesh_tree.h"

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

/// Crossings of one shell at one place, and how often the shell goes round the line before and after it.
struct Station {
    double t = 0.0, slope = 0.0;
    MeshCrossing const* into = nullptr; // the steepest
    MeshCrossing const* out = nullptr;
    int turns_before = 0, turns_after = 0;
};

/// `first`…`last` are the crossings of one shell in the order of t.
template <class Iterator>
std::vector<Station> stations_of(Iterator first, Iterator last, double rounding) {
    std::vector<Station> stations;
    for (Iterator c = first; c != last; ++c) {
        bool const same_place =
            !stations.empty() &&
            (c->t - stations.back().t) <= rounding / stations.back().slope + rounding / c->slope;
        if (!same_place)
            stations.push_back({c->t, c->slope});
        Station& here = stations.back();
        MeshCrossing const*& sense = c->enters ? here.into : here.out;
        if (!sense || c->slope > sense->slope)
            sense = &*c;
        if (c->slope > here.slope) { // the steepest tells best where the place is
            here.t = c->t;
            here.slope = c->slope;
        }
        here.turns_after += c->enters ? 1 : -1;
    }
    // far along the line is outside; each crossing counts, since the watertight test gives none twice
    int turns = 0;
    for (std::size_t k = stations.size(); k-- > 0;) {
        Station& here = stations[k];
        here.turns_before = turns - here.turns_after;
        here.turns_after = turns;
        turns = here.turns_before;
    }
    return stations;
}

/// Is `c × b` positive for a line moved from (0, 0) by a little in x, and by much less in y? So a line
/// through an edge passes on one side of it, the same for both its triangles, and a line through a vertex
/// through one of them (H. Edelsbrunner, E. P. Mücke, Simulation of Simplicity, ACM Trans. Graph. 9 (1990)
/// 66).
bool is_positive(double product, double bx, double by, double cx, double cy) {
    return product != 0.0 ? product > 0.0 : cy != by ? cy > by : bx > cx;
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

std::optional<MeshCrossing> MeshTree::meet(Line const& line, std::uint32_t triangle) const {
    auto const& corners = mesh_->soup.triangles[triangle];
    auto const& p = mesh_->soup.positions;
    dvec3 const a = p[corners[0]] - line.origin, b = p[corners[1]] - line.origin,
                c = p[corners[2]] - line.origin;
    double const ax = a[line.kx] - line.shear_x * a[line.kz], ay = a[line.ky] - line.shear_y * a[line.kz];
    double const bx = b[line.kx] - line.shear_x * b[line.kz], by = b[line.ky] - line.shear_y * b[line.kz];
    double const cx = c[line.kx] - line.shear_x * c[line.kz], cy = c[line.ky] - line.shear_y * c[line.kz];
    double const u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    bool const positive = is_positive(u, bx, by, cx, cy);
    if (is_positive(v, cx, cy, ax, ay) != positive || is_positive(w, ax, ay, bx, by) != positive)
        return std::nullopt;
    double const sum = u + v + w;
    MeshCrossing crossing;
    crossing.uv = sum != 0.0 ? dvec2(v, w) / sum : dvec2(0.0);
    crossing.triangle = triangle;
    // t from the plane, whose normal has its digits in needles too; within the corners' range, where the line
    // runs along the plane
    dvec3 const& corner = p[corners[0]];
    dvec3 const normal = precise_cross(p[corners[1]] - corner, p[corners[2]] - corner);
    double const along = dot(normal, line.direction);
    auto const [low, high] =
        std::minmax({line.shear_z * a[line.kz], line.shear_z * b[line.kz], line.shear_z * c[line.kz]});
    crossing.t = along != 0.0 ? std::clamp(dot(normal, a) / along, low, high) : low;
    crossing.slope = std::abs(along) / length(normal);
    crossing.enters = positive == (mesh_->shells[mesh_->triangle_shell[triangle]].sign > 0);
    return crossing;
}

std::vector<MeshCrossing> MeshTree::all(dvec3 const& origin, dvec3 const& direction, double from,
                                        double rounding) const {
    Line const line(origin, direction);
    std::vector<MeshCrossing> crossings;
    double const start = from - far_behind * rounding / length(direction);
    tree_.visit(origin, direction, {start, INFINITY}, [&](std::uint32_t triangle, double to) {
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
    double const start = reach.from - far_behind * rounding / length(direction);
    tree_.visit(origin, direction, {start, reach.to}, [&](std::uint32_t triangle, double to) {
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
        return std::min(to, best->t + 2.0 * rounding / best->slope);
    });
    double const horizon = best ? best->t + 2.0 * rounding / best->slope : INFINITY;
    for (MeshCrossing const& c : unfit)
        doubtful = doubtful || c.t - 2.0 * rounding / c.slope <= horizon;
    if (doubtful)
        return settle(all(origin, direction, reach.from, rounding), inside, reach, rounding);
    bool in_some = false;
    for (std::uint32_t shell = 0; shell < mesh_->shells.size() && !best; ++shell)
        in_some = in_some || inside[shell];
    return {best, !best && in_some && reach.to == INFINITY ? reach.from : INFINITY};
}

MeshAnswer MeshTree::settle(std::vector<MeshCrossing> crossings, InsideShells inside, Reach reach,
                            double rounding) const {
    MeshAnswer answer;
    auto const shell_of = [&](MeshCrossing const& c) { return mesh_->triangle_shell[c.triangle]; };
    for (auto first = crossings.begin(); first != crossings.end();) {
        std::uint32_t const shell = shell_of(*first);
        auto const last =
            std::find_if(first, crossings.end(), [&](auto const& c) { return shell_of(c) != shell; });
        bool const state = inside[shell];
        bool found = false;
        for (Station const& station : stations_of(first, last, rounding)) {
            bool const at_start = (station.t - reach.from) * station.slope <= rounding;
            bool const fits = (station.turns_before > 0) == state && station.turns_before >= 0;
            if (!at_start && !fits) { // it should have been crossed before: a hole
                answer.contradiction = std::min(answer.contradiction, station.t);
                found = true;
                break;
            }
            if ((station.turns_after > 0) == state)
                continue;
            if (MeshCrossing const* const crossing = state ? station.out : station.into) {
                found = true;
                if (crossing->t <= reach.to && (!answer.crossing || crossing->t < answer.crossing->t))
                    answer.crossing = *crossing;
            }
            break;
        }
        if (state && !found) // a closed shell is left somewhere
            answer.contradiction = reach.from;
        first = last;
    }
    return answer;
}

std::vector<bool> MeshTree::inside(dvec3 const& origin, dvec3 const& direction, double rounding) const {
    std::vector<bool> states(mesh_->shells.size(), false);
    std::vector<MeshCrossing> const crossings = all(origin, direction, 0.0, rounding);
    auto const shell_of = [&](MeshCrossing const& c) { return mesh_->triangle_shell[c.triangle]; };
    for (auto first = crossings.begin(); first != crossings.end();) {
        auto const last = std::find_if(first, crossings.end(),
                                       [&](auto const& c) { return shell_of(c) != shell_of(*first); });
        Station const station = stations_of(first, last, rounding).front();
        states[shell_of(*first)] =
            (station.t * station.slope <= rounding ? station.turns_after : station.turns_before) > 0;
        first = last;
    }
    return states;
}

} // namespace sahl
