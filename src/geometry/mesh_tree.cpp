#include "geometry/mesh_tree.h"

#include "geometry/mesh_query.h"
#include "geometry/mesh_stations.h"
#include "geometry/sheared_line.h"
#include "geometry/triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <thread>
#include <tuple>
#include <type_traits>
#include <utility>

namespace sahl {

namespace {

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

} // namespace

MeshTree::MeshTree(std::shared_ptr<Mesh const> mesh)
    : mesh_(std::move(mesh)), corners_(outward(*mesh_)), triangles_(all_corners()) {}

std::vector<MeshTree::Corners> MeshTree::outward(Mesh const& mesh) {
    std::vector<Corners> triangles;
    triangles.reserve(mesh.soup.triangles.size());
    for (std::size_t t = 0; t < mesh.soup.triangles.size(); ++t) {
        auto const& vertices = mesh.soup.triangles[t];
        auto const& positions = mesh.soup.positions;
        triangles.push_back(
            {{positions[vertices[0]], positions[vertices[1]], positions[vertices[2]]}, vertices});
        if (mesh.shells[mesh.triangle_shell[t]].sign < 0)
            std::swap(triangles.back().at[1], triangles.back().at[2]);
    }
    return triangles;
}

std::vector<TriangleCorners> MeshTree::all_corners() const {
    std::vector<TriangleCorners> triangles;
    triangles.reserve(corners_.size());
    for (Corners const& corners_of_one : corners_)
        triangles.push_back(corners_of_one.at);
    return triangles;
}

BoxTree const& MeshTree::boxes() const {
    // in a thread of its own: one that traces would, while Embree builds, take up other rays and come here
    // again
    std::call_once(boxes_built_,
                   [this] { std::thread([this] { boxes_.emplace(bounds_of(all_corners())); }).join(); });
    return *boxes_;
}

dvec3 MeshTree::normal(std::uint32_t triangle) const {
    return normal_of(corners(triangle));
}

dvec3 MeshTree::onto(std::uint32_t triangle, dvec3 const& point) const {
    return onto_triangle(corners(triangle), point);
}

std::optional<MeshCrossing> MeshTree::meet(ShearedLine const& line, std::uint32_t triangle) const {
    SeenTriangle const seen(line, corners(triangle));
    auto const enters = seen.passed();
    if (!enters)
        return std::nullopt;
    MeshCrossing crossing = crossing_of(line, seen, triangle);
    crossing.enters = *enters;
    return crossing;
}

MeshCrossing MeshTree::crossing_of(ShearedLine const& line, SeenTriangle const& seen,
                                   std::uint32_t triangle) const {
    MeshCrossing crossing;
    double const sum = seen.u + seen.v + seen.w;
    bool const turned = mesh_->shells[mesh_->shell_of(triangle)].sign < 0;
    crossing.uv = sum == 0.0 ? dvec2(0.0) : (turned ? dvec2(seen.w, seen.v) : dvec2(seen.v, seen.w)) / sum;
    crossing.triangle = triangle;
    // t from the plane, whose normal has its digits in needles too; within the corners' range, where the line
    // runs along the plane
    auto const [a, b, c] = corners(triangle);
    dvec3 const normal = precise_cross(b - a, c - a);
    double const along = dot(normal, line.direction), by_length = 1.0 / length(normal);
    auto const t_of = [&](std::size_t corner) { return line.shear_z * seen.corners[corner][line.kz]; };
    auto const [low, high] = std::minmax({t_of(0), t_of(1), t_of(2)});
    crossing.slope = std::abs(along) * by_length;
    crossing.t = along != 0.0 ? dot(normal, seen.corners[0]) / along : low;
    if (crossing.slope < 0.5 * TriangleTree::sure_slope * length(line.direction))
        crossing.t = std::clamp(crossing.t, low, high);
    crossing.range = high - low;
    crossing.per_metre = std::abs(line.shear_z);
    crossing.enters = along < 0.0;
    crossing.normal = by_length * normal;
    return crossing;
}

std::vector<MeshCrossing> MeshTree::all(ShearedLine const& line, double from, double rounding) const {
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

bool MeshTree::may_hide(dvec3 const& origin, dvec3 const& direction, Reach reach, double lift) const {
    auto const in_box = [&](double t) {
        dvec3 const p = origin + t * direction, out = glm::max(mesh_->low - p, p - mesh_->high);
        return std::max({out.x, out.y, out.z}) <= lift;
    };
    return reach.to < INFINITY && in_box(reach.from) && in_box(reach.to);
}

MeshAnswer MeshTree::next(dvec3 const& origin, dvec3 const& direction, InsideShells inside, Reach reach,
                          double rounding) const {
    double const unit = length(direction);
    MeshQuery query(*this, origin, direction, unit, inside, reach.from, rounding, triangles_.blur() / unit);
    bool const cut = !query.in_some() && !may_hide(origin, direction, reach, triangles_.lift());
    double const end = cut ? reach.to : INFINITY;
    double looked_to = INFINITY;
    triangles_.visit(origin, direction, unit, {reach.from, end}, [&](Proposal const& proposal) {
        double const to = query.take(proposal.triangle, proposal.t, proposal.sense);
        looked_to = std::min(looked_to, to);
        return to;
    });
    MeshAnswer answer;
    bool const sure = query.settle(looked_to, answer.crossing) && (answer.crossing || looked_to == INFINITY);
    return sure ? answer : next_exact(origin, direction, inside, reach, rounding);
}

namespace {

/// A query's place, until it is made by hand.
struct QueryRoom {
    union {
        MeshQuery query;
    };
    QueryRoom() {}
};
static_assert(std::is_trivially_destructible_v<MeshQuery>);

/// What a packet's lines ask, made only for those that meet something: many meet nothing, and a query is
/// large.
class Queries {
  public:
    Queries() {} // by hand: the compiler's own would clear all
    MeshQuery* of(std::size_t line) { return made_ >> line & 1u ? &rooms_[line].query : nullptr; }
    MeshQuery* make(std::size_t line, MeshQuery const& query) {
        made_ |= 1u << line;
        return ::new (&rooms_[line].query) MeshQuery(query);
    }

  private:
    static_assert(TriangleTree::most_together <= 32);
    std::array<QueryRoom, TriangleTree::most_together> rooms_;
    std::uint32_t made_ = 0; // a bit for each
};

void settle(MeshQuery const& query, double looked_to, SeenAhead& seen) {
    seen.known = query.settle(looked_to, seen.crossing) && (seen.crossing || looked_to == INFINITY);
}

} // namespace

void MeshTree::next_together(Lines const& asked, std::span<SeenAhead> seen) const {
    TriangleTree::Lines const& lines = asked.lines;
    Queries queries;
    std::array<double, TriangleTree::most_together> looked_to;
    triangles_.visit_together(lines, [&](std::size_t i, Proposal const& proposal) {
        MeshQuery* query = queries.of(i);
        if (!query) {
            looked_to[i] = INFINITY;
            query = queries.make(i, MeshQuery(*this, lines.start(i), lines.along(i), lines.unit[i],
                                              InsideShells{*asked.inside[i], asked.first}, 0.0,
                                              asked.rounding[i], triangles_.blur() / lines.unit[i]));
        }
        double const to = query->take(proposal.triangle, proposal.t, proposal.sense);
        looked_to[i] = std::min(looked_to[i], to);
        return to;
    });
    for (std::size_t i = 0; i < lines.count; ++i) {
        MeshQuery const* const query = queries.of(i);
        if (!query) { // what it is in must be left
            seen[i].known = !InsideShells{*asked.inside[i], asked.first}.any_of(mesh_->shells.size());
            seen[i].crossing.reset();
            continue;
        }
        settle(*query, looked_to[i], seen[i]);
    }
}

void MeshTree::next_in_turn(Lines const& asked, std::span<SeenAhead* const> seen) const {
    TriangleTree::Lines const& lines = asked.lines;
    struct Room : QueryRoom {
        SeenAhead* seen = nullptr; // of the line that has a query here
        double looked_to;
    };
    std::array<Room, 2> rooms; // for the line that is looked for now, and the last
    Room* now = &rooms[0];
    Room* last = &rooms[1];
    auto const settle_in = [](Room& room) {
        if (room.seen)
            settle(room.query, room.looked_to, *room.seen);
        room.seen = nullptr;
    };
    for (std::size_t i = 0; i < lines.count; ++i) { // until something is proposed: what it is in must be left
        seen[i]->known = !InsideShells{*asked.inside[i], asked.first}.any_of(mesh_->shells.size());
        seen[i]->crossing.reset();
    }
    triangles_.visit_in_turn(
        lines,
        [&](std::size_t) {
            std::swap(now, last);
            settle_in(*now);
        },
        [&](std::size_t i, Proposal const& proposal) {
            Room& room = *now;
            if (!room.seen) {
                ::new (&room.query) MeshQuery(*this, lines.start(i), lines.along(i), lines.unit[i],
                                              InsideShells{*asked.inside[i], asked.first}, 0.0,
                                              asked.rounding[i], triangles_.blur() / lines.unit[i]);
                room.seen = seen[i];
                room.looked_to = INFINITY;
            }
            double const to = room.query.take(proposal.triangle, proposal.t, proposal.sense);
            room.looked_to = std::min(room.looked_to, to);
            return to;
        });
    settle_in(*last);
    settle_in(*now);
}

MeshAnswer MeshTree::next_exact(dvec3 const& origin, dvec3 const& direction, InsideShells inside, Reach reach,
                                double rounding) const {
    ShearedLine const line(origin, direction);
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

std::optional<MeshCrossing> MeshTree::just_missed(ShearedLine const& line, std::uint32_t shell, bool inside,
                                                  Reach reach, double rounding) const {
    std::optional<MeshCrossing> best;
    double const start = reach.from - far_behind * rounding / length(line.direction);
    boxes().visit(line.origin, line.direction, {start, reach.to}, [&](std::uint32_t triangle, double to) {
        if (mesh_->shell_of(triangle) != shell)
            return to;
        SeenTriangle const seen(line, corners(triangle));
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
    std::vector<MeshCrossing> const crossings = all(ShearedLine(origin, direction), 0.0, rounding);
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
