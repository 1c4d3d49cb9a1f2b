// In: a quadric in its box. Out: its triangles, by cutting the box into cells and those into tetrahedra: an
// edge that is inside at one end and outside at the other crosses the surface at a root in closed form.
// A node near a crossing is moved onto it, along an edge, so that no triangle is thin for the grid's sake
// (after "snapMC", S. Raman and R. Wenger, 2008, which moves the crossing instead).
#include "geometry/quadric.h"
#include "geometry/singular_set.h"
#include "geometry/tessellate_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace sahl {

namespace {

constexpr unsigned most_cells = 256; // along a side: their nodes' values fill 136 MB
constexpr double near_a_node = 0.2;  // of an edge: cells keep their orientation up to a half

using Step = std::array<int, 3>;
/// The edges of a cell's six tetrahedra about its long diagonal (Kuhn), each once, from its lower node.
constexpr std::array<Step, 7> edge_steps{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}};
constexpr std::array<std::array<int, 3>, 6> axis_orders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}}; // the last three mirror

class QuadricGrid {
  public:
    QuadricGrid(QuadricBody const& body, unsigned cells)
        : quadric_(quadric_of(body)), half_(0.5 * body.clip), singular_(quadric_, length(half_)), out_(body) {
        double const longest = std::max({half_.x, half_.y, half_.z});
        for (int axis = 0; axis < 3; ++axis) {
            cells_[axis] = std::max(4, static_cast<int>(std::ceil(cells * half_[axis] / longest)));
            place_planes(axis);
        }
        values_.resize(static_cast<std::size_t>(cells_[0] + 1) * (cells_[1] + 1) * (cells_[2] + 1));
        for_all_nodes(
            [&](Step const& n, std::uint32_t number) { values_[number] = quadric_.value(on_grid(n)); });
    }

    Tessellation tessellate() {
        for_all_nodes([&](Step const& n, std::uint32_t) { look_at_edges(n); });
        if (!thin_.empty())
            return {{}, thin_};
        move_nodes();
        Step c;
        for (c[2] = 0; c[2] < cells_[2]; ++c[2])
            for (c[1] = 0; c[1] < cells_[1]; ++c[1])
                for (c[0] = 0; c[0] < cells_[0]; ++c[0])
                    cut_cell(c);
        emit();
        TriangleSoup soup = out_.take();
        if (soup.triangles.empty())
            return {{},
                    "this quadric encloses nothing within its box; make clip_mm larger, or turn the signs "
                    "of its coefficients"};
        return {std::move(soup), {}};
    }

  private:
    struct Corner {
        std::uint32_t from, to; // nodes; the same: at a node
        bool operator<(Corner const& other) const {
            return std::pair(from, to) < std::pair(other.from, other.to);
        }
        bool operator==(Corner const&) const = default;
    };
    struct Triangle {
        std::uint32_t face; // 0: the surface; 1 + 2 axis + (is the high side): a cap
        std::array<Corner, 3> corners;
    };

    void place_planes(int axis) {
        int const n = cells_[axis];
        double const h = half_[axis], step = 2.0 * h / n;
        double const middle = singular_.exists() ? singular_.nearest(dvec3(0.0))[axis] : 0.0;
        bool const aligned = singular_.exists() && std::abs(middle) < h - 0.5 * step;
        int const at = aligned ? std::clamp(static_cast<int>(std::round((middle + h) / step)), 1, n - 1) : 0;
        for (int i = 0; i <= n; ++i)
            planes_[axis].push_back(i == n     ? h
                                    : !aligned ? -h + i * step
                                    : i <= at  ? -h + (middle + h) * i / at
                                               : middle + (h - middle) * (i - at) / (n - at));
    }

    template <class Visit>
    void for_all_nodes(Visit visit) {
        Step n;
        for (n[2] = 0; n[2] <= cells_[2]; ++n[2])
            for (n[1] = 0; n[1] <= cells_[1]; ++n[1])
                for (n[0] = 0; n[0] <= cells_[0]; ++n[0])
                    visit(n, number_of(n));
    }
    std::uint32_t number_of(Step const& n) const {
        return static_cast<std::uint32_t>((n[2] * (cells_[1] + 1) + n[1]) * (cells_[0] + 1) + n[0]);
    }
    Step step_of(std::uint32_t number) const {
        int const n = static_cast<int>(number), row = n / (cells_[0] + 1);
        return {n % (cells_[0] + 1), row % (cells_[1] + 1), row / (cells_[1] + 1)};
    }
    dvec3 on_grid(Step const& n) const { return {planes_[0][n[0]], planes_[1][n[1]], planes_[2][n[2]]}; }
    dvec3 place_of(std::uint32_t node) const {
        auto const found = moved_.find(node);
        return found == moved_.end() ? on_grid(step_of(node)) : found->second;
    }
    bool inside(std::uint32_t node) const { return values_[node] <= 0.0; }

    /// Of an edge whose ends are on either side: the share of it, from a on, where it crosses.
    double crossing(dvec3 const& a, double at_a, dvec3 const& b, double at_b) const {
        if (at_a == 0.0 || at_b == 0.0)
            return at_a == 0.0 ? 0.0 : 1.0;
        dvec3 const d = b - a;
        double const square = dot(d, quadric_.a * d), linear = at_b - at_a - square;
        double const root = std::sqrt(std::max(0.0, linear * linear - 4.0 * square * at_a));
        double const q = -0.5 * (linear + std::copysign(root, linear));
        double const one = q / square, other = q == 0.0 ? 0.0 : at_a / q;
        double const t = one > 0.0 && one < 1.0 ? one : other;
        return std::clamp(t, 0.0, 1.0);
    }

    void look_at_edges(Step const& n) {
        std::uint32_t const a = number_of(n);
        for (Step const& step : edge_steps) {
            Step const m{n[0] + step[0], n[1] + step[1], n[2] + step[2]};
            if (m[0] > cells_[0] || m[1] > cells_[1] || m[2] > cells_[2])
                continue;
            std::uint32_t const b = number_of(m);
            if (inside(a) == inside(b)) {
                look_for_thin(on_grid(n), values_[a], on_grid(m), values_[b]);
                continue;
            }
            double const t = crossing(on_grid(n), values_[a], on_grid(m), values_[b]);
            dvec3 const place = on_grid(n) + t * (on_grid(m) - on_grid(n));
            propose(n, m, t, place);
            propose(m, n, 1.0 - t, place);
        }
    }

    /// A node may be moved within those faces of the box alone that it lies in.
    void propose(Step const& n, Step const& towards, double t, dvec3 const& place) {
        for (int axis = 0; axis < 3; ++axis)
            if (n[axis] != towards[axis] && (n[axis] == 0 || n[axis] == cells_[axis]))
                return;
        if (t > near_a_node)
            return;
        auto const [found, is_new] = nearest_.try_emplace(number_of(n), t, place);
        if (!is_new && t < found->second.first)
            found->second = {t, place};
    }
    void move_nodes() {
        for (auto const& [node, proposal] : nearest_) {
            moved_[node] = proposal.second;
            values_[node] = 0.0;
        }
    }

    /// An edge that the surface crosses twice, in opposite directions, shows something thinner than a cell,
    /// unless that is where it runs out.
    void look_for_thin(dvec3 const& a, double at_a, dvec3 const& b, double at_b) {
        dvec3 const d = b - a;
        double const square = dot(d, quadric_.a * d), linear = at_b - at_a - square;
        double const turn = -0.5 * linear / square, discriminant = linear * linear - 4.0 * square * at_a;
        bool const twice = at_a * square > 0.0 && turn > 0.0 && turn < 1.0 && discriminant > 0.0;
        if (!twice || at_b == 0.0 || !thin_.empty())
            return;
        double const apart = 0.5 * std::sqrt(discriminant) / std::abs(square);
        dvec3 const one = quadric_.gradient(a + (turn - apart) * d),
                    two = quadric_.gradient(a + (turn + apart) * d);
        dvec3 const middle = a + turn * d;
        bool const runs_out =
            singular_.exists() && length(singular_.nearest(middle) - middle) < 2.0 * length(d);
        if (dot(one, two) < 0.0 && !runs_out)
            thin_ = "this quadric, or what is left of its box, is in places thinner than the cells that its "
                    "box is cut into; give a greater fineness";
    }

    Corner corner_between(std::uint32_t in, std::uint32_t out) const {
        return values_[in] == 0.0 ? Corner{in, in} : Corner{std::min(in, out), std::max(in, out)};
    }

    void cut_cell(Step const& c) {
        std::array<std::uint32_t, 8> nodes;
        int in = 0;
        for (int i = 0; i < 8; ++i) {
            nodes[i] = number_of({c[0] + (i & 1), c[1] + (i >> 1 & 1), c[2] + (i >> 2)});
            in += inside(nodes[i]);
        }
        if (in == 0)
            return;
        bool border = false;
        for (int axis = 0; axis < 3; ++axis)
            border = border || c[axis] == 0 || c[axis] + 1 == cells_[axis];
        if (in == 8 && !border)
            return;
        for (std::size_t order = 0; order < 6; ++order) {
            auto const [x, y, z] = axis_orders[order];
            (void)z;
            std::array<std::uint32_t, 4> tet{nodes[0], nodes[1 << x], nodes[(1 << x) | (1 << y)], nodes[7]};
            if (order >= 3) // so that all have their volume positive
                std::swap(tet[1], tet[2]);
            cut(tet);
            if (border)
                cap(tet);
        }
    }

    void cut(std::array<std::uint32_t, 4> const& tet) {
        std::array<std::uint32_t, 4> sorted{}; // those inside first, by an even permutation
        std::size_t in = 0;
        for (std::uint32_t const node : tet)
            in += inside(node);
        if (in == 0 || in == 4)
            return;
        constexpr std::array<std::array<std::size_t, 4>, 12> even{{{0, 1, 2, 3},
                                                                   {0, 2, 3, 1},
                                                                   {0, 3, 1, 2},
                                                                   {1, 0, 3, 2},
                                                                   {1, 2, 0, 3},
                                                                   {1, 3, 2, 0},
                                                                   {2, 0, 1, 3},
                                                                   {2, 1, 3, 0},
                                                                   {2, 3, 0, 1},
                                                                   {3, 0, 2, 1},
                                                                   {3, 1, 0, 2},
                                                                   {3, 2, 1, 0}}};
        for (auto const& order : even) {
            for (std::size_t i = 0; i < 4; ++i)
                sorted[i] = tet[order[i]];
            if (std::is_partitioned(sorted.begin(), sorted.end(), [&](auto n) { return inside(n); }))
                break;
        }
        auto const [a, b, c, d] = sorted;
        auto const k = [&](std::uint32_t i, std::uint32_t o) { return corner_between(i, o); };
        if (in == 1) {
            add(0, k(a, b), k(a, c), k(a, d));
        } else if (in == 3) {
            add(0, k(a, d), k(b, d), k(c, d));
        } else {
            add(0, k(a, c), k(a, d), k(b, d));
            add(0, k(a, c), k(b, d), k(b, c));
        }
    }

    /// What of a tetrahedron's sides lies in the box's faces, and inside.
    void cap(std::array<std::uint32_t, 4> const& tet) {
        constexpr std::array<std::array<std::size_t, 3>, 4> sides{
            {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}}; // seen from outside
        for (auto const& side : sides) {
            std::array<Step, 3> const steps{step_of(tet[side[0]]), step_of(tet[side[1]]),
                                            step_of(tet[side[2]])};
            for (int axis = 0; axis < 3; ++axis) {
                int const at = steps[0][axis];
                if (steps[1][axis] != at || steps[2][axis] != at || (at != 0 && at != cells_[axis]))
                    continue;
                cut_cap(1U + 2U * static_cast<std::uint32_t>(axis) + (at != 0),
                        {tet[side[0]], tet[side[1]], tet[side[2]]});
            }
        }
    }
    void cut_cap(std::uint32_t face, std::array<std::uint32_t, 3> const& nodes) {
        std::vector<Corner> polygon;
        for (std::size_t i = 0; i < 3; ++i) {
            std::uint32_t const a = nodes[i], b = nodes[(i + 1) % 3];
            if (inside(a))
                polygon.push_back({a, a});
            if (inside(a) != inside(b))
                polygon.push_back(inside(a) ? corner_between(a, b) : corner_between(b, a));
        }
        for (std::size_t i = 2; i < polygon.size(); ++i)
            add(face, polygon[0], polygon[i - 1], polygon[i]);
    }

    void add(std::uint32_t face, Corner const& a, Corner const& b, Corner const& c) {
        if (!(a == b || b == c || c == a))
            triangles_.push_back({face, {a, b, c}});
    }

    /// Two triangles back to back enclose nothing: both are left out.
    std::vector<Triangle> without_films() const {
        std::map<std::array<Corner, 3>, std::pair<int, Triangle>> sums;
        for (Triangle const& triangle : triangles_) {
            auto key = triangle.corners;
            int const turns = (key[1] < key[0]) + (key[2] < key[0]) + (key[2] < key[1]); // of the sorting
            std::sort(key.begin(), key.end());
            auto& [sum, kept] = sums[key];
            sum += turns % 2 == 0 ? 1 : -1;
            if (sum != 0)
                kept = triangle;
        }
        std::vector<Triangle> left;
        for (auto const& [key, entry] : sums)
            if (entry.first != 0)
                left.push_back(entry.second);
        return left;
    }

    dvec3 place_of(Corner const& corner) const {
        dvec3 const a = place_of(corner.from);
        if (corner.from == corner.to)
            return a;
        dvec3 const b = place_of(corner.to);
        return a + crossing(a, values_[corner.from], b, values_[corner.to]) * (b - a);
    }

    void emit() {
        std::map<std::pair<std::uint32_t, Corner>, std::uint32_t> numbers;
        for (Triangle const& triangle : without_films()) {
            std::array<dvec3, 3> places;
            for (std::size_t i = 0; i < 3; ++i)
                places[i] = place_of(triangle.corners[i]);
            dvec3 const flat = cross(places[1] - places[0], places[2] - places[0]);
            std::array<std::uint32_t, 3> corners;
            for (std::size_t i = 0; i < 3; ++i) {
                auto const [normal, shared] = normal_at(triangle.face, places[i], flat);
                auto const known = numbers.find({triangle.face, triangle.corners[i]});
                corners[i] =
                    shared && known != numbers.end() ? known->second : out_.corner(places[i], normal);
                if (shared)
                    numbers[{triangle.face, triangle.corners[i]}] = corners[i];
            }
            out_.begin_face(triangle.face == 0 ? 0 : 1);
            out_.triangle(corners[0], corners[1], corners[2]);
        }
    }
    /// And whether it is the corner's, not that of this triangle alone: a singular place has none.
    std::pair<dvec3, bool> normal_at(std::uint32_t face, dvec3 const& place, dvec3 const& flat) const {
        if (face > 0) {
            dvec3 normal(0.0);
            normal[static_cast<int>((face - 1) / 2)] = face % 2 == 0 ? 1.0 : -1.0;
            return {normal, true};
        }
        bool const singular =
            singular_.exists() && length(singular_.nearest(place) - place) <= 1e-9 * length(half_);
        dvec3 const steepest = singular ? flat : quadric_.gradient(place);
        return {length(steepest) > 0.0 ? normalize(steepest) : dvec3(0.0, 0.0, 1.0), !singular};
    }

    Quadric quadric_;
    dvec3 half_;
    SingularSet singular_;
    SoupBuilder out_;
    std::array<int, 3> cells_{};
    std::array<std::vector<double>, 3> planes_;
    std::vector<double> values_;
    std::unordered_map<std::uint32_t, std::pair<double, dvec3>> nearest_;
    std::unordered_map<std::uint32_t, dvec3> moved_;
    std::vector<Triangle> triangles_;
    std::string thin_;
};

} // namespace

Tessellation tessellate_quadric(QuadricBody const& body, unsigned cells) {
    if (cells > most_cells)
        return {{},
                "the box of a quadric is cut into at most " + std::to_string(most_cells) +
                    " cells along a side; give a fineness of at most " + std::to_string(3 * most_cells)};
    return QuadricGrid(body, cells).tessellate();
}

} // namespace sahl
