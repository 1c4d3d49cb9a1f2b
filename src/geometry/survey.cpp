#include "geometry/survey.h"

#include "geometry/box_pairs.h"
#include "geometry/facet_error.h"
#include "math/sequences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace sahl {

namespace {

constexpr std::uint32_t most_points = 64;   // of one pair of objects, each with a line along every axis
constexpr std::size_t most_lines = 60'000;  // of a scene: about 0.1 s
constexpr std::size_t most_crossings = 64;  // of one line with one object
constexpr double step_shrinks_to = 0x1p-26; // of the region: where the search for the least gap ends

constexpr double parallel = 0.99; // cosine between faces that have a gap between them

/// Where a line crosses an object.
struct Crossed {
    Candidate at;
    dvec3 normal{0.0}; // of the facet
    double slope = 1.0;
    bool body_after = false; // inside the body, not a cavity of it
};
using Way = InlineVector<Crossed, most_crossings>;

bool in_body(Placed const& object, ShellSet const& inside) {
    Mesh const* const mesh = object.mesh();
    int turns = 0;
    for (ShellId const shell : inside)
        turns += mesh ? mesh->shells[shell.value - object.geometry.first_shell.value].sign : 1;
    return turns > 0;
}

/// All crossings of a line with one object, the first a little behind its start.
Way way_through(std::span<Placed const> objects, std::uint32_t index, dvec3 const& origin,
                dvec3 const& direction) {
    Placed const& object = objects[index];
    Bvh::Start start;
    object.start(origin, direction, index, start);
    ShellSet inside = start.inside;
    Way way;
    double from = 0.0;
    while (!way.full()) {
        Crossed crossed;
        object.next(origin, direction, inside, {from, INFINITY}, {}, 0, crossed.at);
        if (crossed.at.t == INFINITY)
            break;
        crossed.at.object = index;
        Crossing crossing;
        object.finish(crossed.at, origin, direction, from, crossing);
        crossed.normal = crossing.facet_normal;
        crossed.slope = std::abs(dot(crossing.facet_normal, direction));
        if (!crossing.open) {
            if (crossing.enters)
                inside.insert(crossing.shell);
            else
                inside.erase(crossing.shell);
        }
        crossed.body_after = in_body(object, inside);
        way.push_back(crossed);
        if (crossing.open || crossing.t < from)
            break;
        from = crossing.t;
    }
    return way;
}

constexpr std::uint32_t lines_that_follow =
    8; // of at most 192: faces that cross are near each other for fewer

/// Meshes' facet errors, found when they are first asked for.
class Facets {
  public:
    /// m, world; 0 for an exact shape.
    double at(Placed const& object, std::int32_t triangle) {
        Mesh const* const mesh = object.mesh();
        if (!mesh)
            return 0.0;
        auto const [known, is_new] = errors_.try_emplace(mesh);
        if (is_new)
            known->second = facet_errors(*mesh);
        dmat3 const& m = object.geometry.to_world.linear;
        return std::max({length(m[0]), length(m[1]), length(m[2])}) *
               known->second[static_cast<std::uint32_t>(triangle)];
    }

  private:
    std::map<Mesh const*, std::vector<double>> errors_;
};

/// What a line tells of two objects.
struct Surveyor {
    std::span<Placed const> objects;
    Touching const& touch;
    Bvh::Closeness& found;
    Facets& facets;
    std::uint32_t following = 0; // lines along which faces are no farther apart than their facets

    FaceId face_id(Candidate const& at) const {
        return {objects[at.object].geometry.first_face.value + objects[at.object].local_face(at.face)};
    }
    void take_overlap(Way const& one, Way const& other, dvec3 const& origin, dvec3 const& direction) const {
        for (std::size_t i = 0; i + 1 < one.size(); ++i)
            for (std::size_t j = 0; j + 1 < other.size(); ++j) {
                if (!one[i].body_after || !other[j].body_after)
                    continue;
                double const begin = std::max(one[i].at.t, other[j].at.t),
                             end = std::min(one[i + 1].at.t, other[j + 1].at.t);
                double const blur =
                    one[i].at.blur + other[j].at.blur + one[i + 1].at.blur + other[j + 1].at.blur;
                if (end - begin > 4.0 * blur && end - begin > found.overlap) {
                    found.overlap = end - begin;
                    found.overlap_at = origin + 0.5 * (begin + end) * direction;
                }
            }
    }
    /// Returns the least way between a surface of one and one of the other, ∞ where the line does not tell.
    double take_gap(Way const& one, Way const& other, double near, dvec3 const& origin,
                    dvec3 const& direction) {
        double least = INFINITY;
        bool follows = false;
        for (Crossed const& a : one)
            for (Crossed const& b : other) {
                double const along = std::abs(b.at.t - a.at.t), across = along * std::min(a.slope, b.slope);
                if (touch(a.at, b.at))
                    continue;
                bool const a_film = std::abs(dot(a.normal, b.normal)) > parallel; // and no corner
                follows = follows || (near > 0.0 && a_film && take_facets(a.at, b.at, across));
                if (across >= least)
                    continue;
                least = across;
                if (!a_film || along <= a.at.blur + b.at.blur || across >= std::min(near, found.gap))
                    continue;
                found.gap = across;
                found.gap_at = origin + 0.5 * (a.at.t + b.at.t) * direction;
                found.gap_one = face_id(a.at);
                found.gap_other = face_id(b.at);
            }
        following += follows;
        return least;
    }
    bool take_facets(Candidate const& a, Candidate const& b, double across) {
        double const error =
            facets.at(objects[a.object], a.primitive) + facets.at(objects[b.object], b.primitive);
        if (!(across < error))
            return false;
        if (across > found.facets) {
            found.facets = across;
            found.facets_one = face_id(a);
            found.facets_other = face_id(b);
        }
        return true;
    }
};

/// A pair of objects, and the lines through the region where their boxes meet.
class PairSurvey {
  public:
    PairSurvey(std::span<Placed const> objects, Touching const& touch, Facets& facets, std::uint32_t one,
               std::uint32_t other, double near)
        : objects_(objects), near_(near), surveyor_{objects, touch, found_, facets} {
        found_.one = one;
        found_.other = other;
        Placed const &a = objects[one], &b = objects[other];
        Bounds const first = a.bounded ? a.box : b.box, second = b.bounded ? b.box : a.box;
        double const margin =
            near + 1e-6 * (length(first.high - first.low) + length(second.high - second.low));
        region_ = {glm::max(first.low, second.low) - margin, glm::min(first.high, second.high) + margin};
    }

    Bvh::Closeness search(std::uint32_t points) {
        std::array<double, 3> least{INFINITY, INFINITY, INFINITY};
        std::array<dvec2, 3> nearest{};
        for (std::uint32_t k = 0; k < points; ++k)
            for (int axis = 0; axis < 3; ++axis) {
                dvec2 const at = sobol_2d(k, static_cast<std::uint64_t>(axis));
                double const gap = line(axis, at);
                if (gap < least[static_cast<std::size_t>(axis)]) {
                    least[static_cast<std::size_t>(axis)] = gap;
                    nearest[static_cast<std::size_t>(axis)] = at;
                }
            }
        if (surveyor_.following < lines_that_follow)
            found_.facets = 0.0;
        // bodies that overlap or touch meet somewhere at a corner: no gap is meant there
        bool const goes_on =
            near_ > 0.0 && found_.overlap == 0.0 && !surveyor_.touch.objects(found_.one, found_.other);
        for (int axis = 0; goes_on && axis < 3; ++axis)
            if (least[static_cast<std::size_t>(axis)] < INFINITY)
                go_down(axis, nearest[static_cast<std::size_t>(axis)], least[static_cast<std::size_t>(axis)]);
        return found_;
    }

  private:
    /// Along an axis, `at` in [0, 1]² of the region's other two.
    double line(int axis, dvec2 const& at) {
        dvec3 const size = region_.high - region_.low;
        int const u = (axis + 1) % 3, v = (axis + 2) % 3;
        dvec3 origin = region_.low, direction(0.0);
        origin[axis] -= 0.01 * size[axis] + near_; // in front of it
        origin[u] += at.x * size[u];
        origin[v] += at.y * size[v];
        direction[axis] = 1.0;
        Way const one = way_through(objects_, found_.one, origin, direction);
        if (one.empty())
            return INFINITY;
        Way const other = way_through(objects_, found_.other, origin, direction);
        surveyor_.take_overlap(one, other, origin, direction);
        return surveyor_.take_gap(one, other, near_, origin, direction);
    }

    /// By steps across the axis, halved where none leads down.
    void go_down(int axis, dvec2 at, double least) {
        for (double step = 0.125; step > step_shrinks_to && least > 0.0;) {
            dvec2 best = at;
            for (dvec2 const& way : {dvec2(1, 0), dvec2(-1, 0), dvec2(0, 1), dvec2(0, -1)}) {
                dvec2 const to = glm::clamp(at + step * way, dvec2(0.0), dvec2(1.0));
                if (double const gap = line(axis, to); gap < least) {
                    least = gap;
                    best = to;
                }
            }
            if (best == at)
                step *= 0.5;
            at = best;
        }
    }

    std::span<Placed const> objects_;
    double near_;
    Bvh::Closeness found_;
    Surveyor surveyor_;
    Bounds region_;
};

} // namespace

std::vector<Bvh::Closeness> survey(std::span<Placed const> objects, Touching const& touch, double near) {
    auto const pairs = neighbours(objects, near);
    auto const points = static_cast<std::uint32_t>(
        std::clamp<std::size_t>(most_lines / (3 * std::max<std::size_t>(pairs.size(), 1)), 1, most_points));
    std::vector<Bvh::Closeness> close;
    Facets facets;
    for (auto const& [one, other] : pairs) {
        auto const is_sheet = [&](std::uint32_t i) {
            return objects[i].geometry.open || std::holds_alternative<Shape>(objects[i].met_by);
        };
        if (is_sheet(one) && is_sheet(other))
            continue;
        Bvh::Closeness const found =
            PairSurvey(objects, touch, facets, one, other, touch.at_a_point(one, other) ? 0.0 : near)
                .search(points);
        if (found.overlap > 0.0 || found.gap < near || found.facets > 0.0)
            close.push_back(found);
    }
    return close;
}

} // namespace sahl
