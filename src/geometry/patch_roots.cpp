#include "geometry/patch_roots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace sahl {

namespace {

constexpr std::size_t degree = 5; // of places: heights of degree 4 along a direction of degree 1
/// Coefficients as the line sees them: across it in two directions, in m. Rows by the third corner's
/// exponent, in each the second's.
using Net = std::array<dvec2, (degree + 1) * (degree + 2) / 2>;

constexpr std::size_t slot(std::size_t j, std::size_t k) {
    return k * (2 * degree + 3 - k) / 2 + j;
}

/// A part of the patch: weights of the second and third corner at its own corners, and its coefficients.
struct Part {
    std::array<dvec2, 3> corners;
    Net net;
    int depth = 0;
};

double cross(dvec2 const& a, dvec2 const& b) {
    return a.x * b.y - a.y * b.x;
}

/// Weights of a part's second and third corner, from the patch's.
dvec2 within(std::array<dvec2, 3> const& corners, dvec2 const& place) {
    dvec2 const a = corners[1] - corners[0], b = corners[2] - corners[0], from = place - corners[0];
    double const whole = cross(a, b);
    return {cross(from, b) / whole, cross(a, from) / whole};
}

double least_weight(dvec2 const& weights) {
    return std::min({1.0 - weights.x - weights.y, weights.x, weights.y});
}

struct LineFrame {
    dvec3 start, direction; // of t = 0
    dvec3 one, other;       // unit, across it
    dvec2 seen(dvec3 const& point) const { return {dot(one, point - start), dot(other, point - start)}; }
};

Part whole_of(Patch const& patch, LineFrame const& line) {
    std::array<dvec2, 3> corner, up;
    for (std::size_t k = 0; k < 3; ++k) {
        dvec3 const direction = patch.direction(k);
        corner[k] = line.seen(patch.place(k)) / static_cast<double>(degree);
        up[k] = dvec2(dot(line.one, direction), dot(line.other, direction)) / static_cast<double>(degree);
    }
    auto const height = [&](std::size_t j, std::size_t k) {
        return static_cast<double>(patch.height[k * (11 - k) / 2 + j]);
    };
    Part part{{dvec2(0.0), {1.0, 0.0}, {0.0, 1.0}}, {}, 0};
    std::size_t n = 0;
    for (std::size_t k = 0; k <= degree; ++k)
        for (std::size_t j = 0; j + k <= degree; ++j) {
            std::size_t const i = degree - j - k;
            dvec2 place(0.0);
            if (i > 0)
                place += static_cast<double>(i) * (corner[0] + height(j, k) * up[0]);
            if (j > 0)
                place += static_cast<double>(j) * (corner[1] + height(j - 1, k) * up[1]);
            if (k > 0)
                place += static_cast<double>(k) * (corner[2] + height(j, k - 1) * up[2]);
            part.net[n++] = place;
        }
    return part;
}

/// With the first corner last: corners (second, third, first).
Part turned(Part const& part) {
    Part other{{part.corners[1], part.corners[2], part.corners[0]}, {}, part.depth};
    for (std::size_t k = 0; k <= degree; ++k)
        for (std::size_t j = 0; j + k <= degree; ++j)
            other.net[slot(j, k)] = part.net[slot(degree - j - k, j)];
    return other;
}

/// The same polynomial over a triangle whose first corner is elsewhere.
void move_first_corner(Part& part, dvec2 const& corner) {
    dvec2 const weights = within(part.corners, corner);
    double const u = 1.0 - weights.x - weights.y;
    Net const before = part.net;
    // de Casteljau's steps for each exponent of the first corner
    for (std::size_t k = 0; k <= degree; ++k)
        for (std::size_t j = 0; j + k <= degree; ++j) {
            std::size_t const steps = degree - j - k;
            std::array<dvec2, 21> row{};
            std::size_t n = 0;
            for (std::size_t c = 0; c <= steps; ++c)
                for (std::size_t b = 0; b + c <= steps; ++b)
                    row[n++] = before[slot(j + b, k + c)];
            for (std::size_t left = steps; left > 0; --left) {
                std::size_t to = 0, from = 0;
                for (std::size_t c = 0; c < left; ++c) {
                    for (std::size_t b = 0; b + c < left; ++b) {
                        std::size_t const at = from + b;
                        row[to++] =
                            u * row[at] + weights.x * row[at + 1] + weights.y * row[at + left + 1 - c];
                    }
                    from += left + 1 - c;
                }
            }
            part.net[slot(j, k)] = row[0];
        }
    part.corners[0] = corner;
}

/// Over a triangle whose sides lie this weight farther out.
Part grown(Part part, double slack) {
    std::array<dvec2, 3> const corners = part.corners;
    dvec2 const centre = (corners[0] + corners[1] + corners[2]) / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
        move_first_corner(part, corners[k] + 3.0 * slack * (corners[k] - centre));
        part = turned(part);
    }
    return part;
}

/// Halves on either side of the line from the first corner to the middle of the side opposite; the new corner
/// comes first.
std::pair<Part, Part> halves_of(Part const& part) {
    dvec2 const middle = 0.5 * (part.corners[1] + part.corners[2]);
    Part near_second{{part.corners[0], part.corners[1], middle}, {}, part.depth + 1},
        near_third{{part.corners[0], middle, part.corners[2]}, {}, part.depth + 1};
    for (std::size_t size = 0; size <= degree;
         ++size) { // along each row with one exponent of the first corner
        std::array<dvec2, degree + 1> row{};
        for (std::size_t k = 0; k <= size; ++k)
            row[k] = part.net[slot(size - k, k)];
        for (std::size_t step = 0; step <= size; ++step) {
            near_second.net[slot(size - step, step)] = row[0];
            near_third.net[slot(step, size - step)] = row[size - step];
            for (std::size_t k = 0; k + step < size; ++k)
                row[k] = 0.5 * (row[k] + row[k + 1]);
        }
    }
    return {turned(turned(near_second)), turned(near_third)};
}

/// By the box of the coefficients along the part's longest side as the line sees it: of one that is seen at a
/// grazing angle little is left across that.
bool may_hold_the_line(Net const& net, double margin) {
    dvec2 const &a = net[0], &b = net[degree], &c = net[slot(0, degree)];
    dvec2 along(1.0, 0.0);
    double longest = 0.0;
    for (dvec2 const& side : {b - a, c - b, a - c})
        if (double const squared = dot(side, side); squared > longest) {
            longest = squared;
            along = side;
        }
    if (longest > 0.0)
        along /= std::sqrt(longest);
    dvec2 low(INFINITY), high(-INFINITY);
    for (dvec2 const& p : net) {
        dvec2 const seen(dot(along, p), cross(along, p));
        low = glm::min(low, seen);
        high = glm::max(high, seen);
    }
    return low.x <= margin && low.y <= margin && high.x >= -margin && high.y >= -margin;
}

/// Do tangents by the second weight and tangents by the third, wherever taken, never run alike? Then no two
/// places are seen at one.
bool is_one_to_one(Net const& net) {
    std::array<dvec2, 15> by_second, by_third;
    std::size_t n = 0;
    dvec2 second(0.0), third(0.0);
    for (std::size_t k = 0; k < degree; ++k)
        for (std::size_t j = 0; j + k < degree; ++j, ++n) {
            by_second[n] = net[slot(j + 1, k)] - net[slot(j, k)];
            by_third[n] = net[slot(j, k + 1)] - net[slot(j, k)];
            second += by_second[n];
            third += by_third[n];
        }
    double const area = cross(second, third);
    double own = INFINITY, across = 0.0, own_third = INFINITY, across_third = 0.0;
    double const sense = area < 0.0 ? -1.0 : 1.0;
    for (std::size_t m = 0; m < n; ++m) {
        own = std::min(own, sense * cross(by_second[m], third));
        across = std::max(across, std::abs(cross(second, by_second[m])));
        own_third = std::min(own_third, sense * cross(second, by_third[m]));
        across_third = std::max(across_third, std::abs(cross(by_third[m], third)));
    }
    return own > 0.0 && own_third > 0.0 && own * own_third > across * across_third;
}

struct Search {
    Patch const& patch;
    LineFrame const& line;
    double size; // m: what rounding is a share of
    double slack;
    PatchRoots roots{};
    int parts = 0; // looked in so far

    /// Newton's method from where a part's corners say.
    std::optional<PatchRoot> settle(Part const& part) const {
        dvec2 at = guess(part);
        double last = INFINITY;
        for (int pass = 0; pass < 16; ++pass) {
            PatchPoint const point = point_on(patch, at.x, at.y);
            dvec2 const off = line.seen(point.place);
            dvec2 const by_v{dot(line.one, point.by_v), dot(line.other, point.by_v)},
                by_w{dot(line.one, point.by_w), dot(line.other, point.by_w)};
            double const area = cross(by_v, by_w);
            dvec2 const step = -dvec2(cross(off, by_w), cross(by_v, off)) / area;
            double const change = std::abs(step.x) + std::abs(step.y);
            if (!(change < 4.0))
                return std::nullopt;
            double const away = std::abs(off.x) + std::abs(off.y);
            if (away <= 4e-16 * size || (pass > 2 && away >= last && away <= 1e-13 * size)) {
                dvec3 const from = point.place - line.start;
                return PatchRoot{dot(from, line.direction) / dot(line.direction, line.direction), at.x, at.y,
                                 point.outward()};
            }
            last = away;
            at += step;
        }
        return std::nullopt;
    }

    static dvec2 guess(Part const& part) {
        dvec2 const &first = part.net[0], second = part.net[degree] - first,
                    third = part.net[slot(0, degree)] - first;
        double const area = cross(second, third);
        dvec2 const at = dvec2(cross(third, first), cross(first, second)) / area;
        dvec2 const inside = least_weight(at) > -0.5 ? at : dvec2(1.0 / 3.0); // false for no number
        return part.corners[0] + inside.x * (part.corners[1] - part.corners[0]) +
               inside.y * (part.corners[2] - part.corners[0]);
    }

    void keep(PatchRoot const& root) {
        constexpr double same = 1e-9; // weight: on a side of two parts it is found in both
        for (PatchRoot const& other : roots)
            if (std::abs(other.v - root.v) + std::abs(other.w - root.w) < same)
                return;
        if (!roots.full())
            roots.push_back(root);
    }

    void look_in(Part const& part) {
        constexpr int most_parts = 5000; // a line within a flat patch meets all of it, and nothing
        if (++parts > most_parts || !may_hold_the_line(part.net, 1e-15 * size))
            return;
        constexpr int deepest = 40; // a millionth of the patch's sides
        bool const once = is_one_to_one(part.net);
        if (once || part.depth == deepest) {
            auto const root = settle(part);
            constexpr double beside = 1e-9; // weight, of a part: rounding
            if (root && least_weight({root->v, root->w}) >= -slack &&
                least_weight(within(part.corners, {root->v, root->w})) >= -beside) {
                keep(*root);
                if (once)
                    return;
            }
        }
        if (part.depth == deepest)
            return;
        auto const [one, other] = halves_of(part);
        look_in(one);
        look_in(other);
    }
};

} // namespace

PatchRoots roots_of(Patch const& patch, dvec3 const& origin, dvec3 const& direction, double slack) {
    double const base = dot(patch.corner - origin, direction) / dot(direction, direction);
    LineFrame line{origin + base * direction, direction, {}, {}};
    dvec3 const unit = normalize(direction);
    line.one = perpendicular_to(unit);
    line.other = cross(unit, line.one);
    Search search{patch, line, length(patch.to_second) + length(patch.to_third) + 0.25 * length(line.start),
                  slack};
    Part const whole = whole_of(patch, line);
    // by the slack the coefficients move by no more than five differences of theirs
    if (may_hold_the_line(whole.net, 20.0 * slack * search.size))
        search.look_in(grown(whole, slack));
    for (PatchRoot& root : search.roots)
        root.t += base;
    return search.roots;
}

} // namespace sahl
