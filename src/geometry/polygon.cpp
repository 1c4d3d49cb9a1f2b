// In: the corners of a polygon. Out: triangles that fill it, ear by ear.
#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Twice the area times the mean normal.
dvec3 area_vector(std::span<dvec3 const> corners) {
    dvec3 sum(0.0);
    for (std::size_t i = 2; i < corners.size(); ++i)
        sum += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
    return sum;
}

/// Triangles that all have corner `apex`.
void add_fan(std::uint32_t apex, std::uint32_t size, Triangles& triangles) {
    for (std::uint32_t i = 1; i + 1 < size; ++i)
        triangles.push_back({apex, (apex + i) % size, (apex + i + 1) % size});
}

bool fan_fills(std::span<dvec3 const> corners, std::uint32_t apex, dvec3 const& normal) {
    std::size_t const size = corners.size();
    for (std::size_t i = 1; i + 1 < size; ++i) {
        dvec3 const &a = corners[apex], &b = corners[(apex + i) % size], &c = corners[(apex + i + 1) % size];
        if (!(dot(cross(b - a, c - a), normal) > 0.0))
            return false;
    }
    return true;
}

/// Without the coordinate in which the normal is largest; a positive area is to the left.
std::vector<dvec2> projected(std::span<dvec3 const> corners, dvec3 const& normal) {
    dvec3 const size = glm::abs(normal);
    int const drop = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    int u = (drop + 1) % 3, v = (drop + 2) % 3;
    if (normal[drop] < 0.0)
        std::swap(u, v);
    std::vector<dvec2> flat;
    flat.reserve(corners.size());
    for (dvec3 const& c : corners)
        flat.push_back({c[u], c[v]});
    return flat;
}

/// > 0 where c is to the left of the way from a to b: twice the area of the triangle.
double turn(dvec2 const& a, dvec2 const& b, dvec2 const& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Points sorted into the cells of a grid, about one a cell.
class Grid {
  public:
    Grid() = default;
    Grid(std::vector<dvec2> const& points, std::vector<std::uint32_t> const& members) {
        if (members.empty())
            return;
        dvec2 high(-std::numeric_limits<double>::infinity());
        for (std::uint32_t const i : members) {
            low_ = glm::min(low_, points[i]);
            high = glm::max(high, points[i]);
        }
        double const number = static_cast<double>(members.size());
        dvec2 const size = glm::max(high - low_, dvec2(std::numeric_limits<double>::min()));
        double const wanted = std::clamp(std::sqrt(number * (size.x / size.y)), 1.0, number);
        columns_ = static_cast<std::size_t>(wanted);
        rows_ = std::max<std::size_t>(members.size() / columns_, 1);
        per_length_ = dvec2(static_cast<double>(columns_), static_cast<double>(rows_)) / size;
        begin_.assign(columns_ * rows_ + 1, 0);
        for (std::uint32_t const i : members)
            ++begin_[cell(points[i]) + 1];
        for (std::size_t c = 1; c < begin_.size(); ++c)
            begin_[c] += begin_[c - 1];
        members_.resize(members.size());
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (std::uint32_t const i : members)
            members_[next[cell(points[i])]++] = i;
    }

    /// Does `wanted` hold for a member in the cells that the box touches? Adds the work that it was.
    template <class Wanted>
    bool any_near(dvec2 const& low, dvec2 const& high, std::uint64_t& work, Wanted const& wanted) const {
        if (members_.empty())
            return false;
        std::size_t const left = column(low.x), right = column(high.x), top = row(high.y);
        for (std::size_t y = row(low.y); y <= top; ++y) {
            // the cells of a row stand side by side, and so do their members
            std::uint32_t const first = begin_[y * columns_ + left], last = begin_[y * columns_ + right + 1];
            work += last - first + 1;
            for (std::uint32_t m = first; m < last; ++m)
                if (wanted(members_[m]))
                    return true;
        }
        return false;
    }

  private:
    static std::size_t clamped(double place, std::size_t count) {
        return place > 0.0 ? static_cast<std::size_t>(std::min(place, static_cast<double>(count - 1))) : 0;
    }
    std::size_t column(double x) const { return clamped((x - low_.x) * per_length_.x, columns_); }
    std::size_t row(double y) const { return clamped((y - low_.y) * per_length_.y, rows_); }
    std::size_t cell(dvec2 const& p) const { return row(p.y) * columns_ + column(p.x); }

    dvec2 low_{std::numeric_limits<double>::infinity()};
    dvec2 per_length_{0.0};
    std::size_t columns_ = 1, rows_ = 1;
    std::vector<std::uint32_t> begin_, members_;
};

/// The outline that is left, as ears are cut from it.
class Outline {
  public:
    Outline(std::vector<dvec2> points, Triangles& triangles, std::uint64_t& patience);

    bool cut();

  private:
    std::uint32_t size() const { return static_cast<std::uint32_t>(points_.size()); }
    double area(std::uint32_t i) const { return turn(points_[before_[i]], points_[i], points_[after_[i]]); }
    bool at_end() const { return left_ <= 3 || work_ >= patience_; }
    void sort_hollow_corners();
    bool spoils(std::uint32_t other, std::uint32_t i) const;
    bool is_ear(std::uint32_t i);
    void cut_off(std::uint32_t i);
    bool cut_flat_corner();
    void try_all();

    std::vector<dvec2> points_;
    std::size_t left_;
    Triangles& triangles_;
    std::vector<std::uint32_t> before_, after_;
    std::vector<bool> gone_, hollow_;           // hollow: not convex; once convex, a corner stays so
    std::vector<std::uint32_t> hollow_corners_; // those in the grid
    std::size_t hollow_left_ = 0;
    std::vector<std::uint32_t> to_try_;      // in this round
    std::vector<std::uint32_t> to_try_next_; // each ear's neighbours wait for a round: fewer slivers
    std::vector<bool> waits_;
    std::uint64_t work_ = 0;
    std::uint64_t& patience_;
    std::uint32_t start_ = 0;
    Grid grid_;
};

Outline::Outline(std::vector<dvec2> points, Triangles& triangles, std::uint64_t& patience)
    : points_(std::move(points)), left_(points_.size()), triangles_(triangles), patience_(patience) {
    before_.resize(size());
    after_.resize(size());
    gone_.assign(size(), false);
    hollow_.assign(size(), false);
    waits_.assign(size(), false);
    for (std::uint32_t i = 0; i < size(); ++i) {
        before_[i] = i == 0 ? size() - 1 : i - 1;
        after_[i] = i + 1 == size() ? 0 : i + 1;
    }
    for (std::uint32_t i = 0; i < size(); ++i) {
        hollow_[i] = !(area(i) > 0.0);
        if (hollow_[i])
            hollow_corners_.push_back(i);
    }
    sort_hollow_corners();
}

/// Again whenever half of them are no more, so that the rest are found as fast as at first.
void Outline::sort_hollow_corners() {
    std::erase_if(hollow_corners_, [&](std::uint32_t i) { return gone_[i] || !hollow_[i]; });
    hollow_left_ = hollow_corners_.size();
    grid_ = Grid(points_, hollow_corners_);
}

/// Lies `other` in the triangle of i and its neighbours, or on its border? Where outlines touch, several
/// corners are at one place: those at the triangle's own corners spoil nothing.
bool Outline::spoils(std::uint32_t other, std::uint32_t i) const {
    if (gone_[other] || !hollow_[other])
        return false;
    dvec2 const &a = points_[before_[i]], &b = points_[i], &c = points_[after_[i]], &p = points_[other];
    return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

bool Outline::is_ear(std::uint32_t i) {
    if (!(area(i) > 0.0))
        return false;
    dvec2 const &a = points_[before_[i]], &b = points_[i], &c = points_[after_[i]];
    return !grid_.any_near(glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c), work_,
                           [&](std::uint32_t other) { return spoils(other, i); });
}

void Outline::cut_off(std::uint32_t i) {
    std::uint32_t const before = before_[i], after = after_[i];
    triangles_.push_back({before, i, after});
    gone_[i] = true;
    hollow_left_ -= hollow_[i];
    after_[before] = after;
    before_[after] = before;
    --left_;
    start_ = after;
    for (std::uint32_t const neighbour : {before, after}) {
        if (hollow_[neighbour] && area(neighbour) > 0.0) {
            hollow_[neighbour] = false;
            --hollow_left_;
        }
        if (!waits_[neighbour]) {
            waits_[neighbour] = true;
            to_try_next_.push_back(neighbour);
        }
    }
}

/// A corner on the straight line between its neighbours: its triangle has no area.
bool Outline::cut_flat_corner() {
    std::uint32_t i = start_;
    for (std::size_t step = 0; step < left_; ++step, i = after_[i]) {
        ++work_;
        if (area(i) == 0.0) {
            cut_off(i);
            return true;
        }
    }
    return false;
}

void Outline::try_all() {
    for (std::uint32_t i = start_, step = 0; step < left_; ++step, i = after_[i])
        to_try_next_.push_back(i);
    work_ += left_;
}

bool Outline::cut() {
    for (std::uint32_t i = 0; i < size(); ++i)
        to_try_.push_back(i);
    std::size_t left_at_last_sweep = 0;
    while (!at_end()) {
        for (std::uint32_t const i : to_try_)
            if (!at_end() && !gone_[i] && !waits_[i] && is_ear(i))
                cut_off(i);
        if (hollow_left_ < hollow_corners_.size() / 2)
            sort_hollow_corners();
        if (to_try_next_.empty() && left_ != left_at_last_sweep) {
            left_at_last_sweep = left_; // rounding may have hidden an ear that is one by now
            try_all();
        } else if (to_try_next_.empty() && !cut_flat_corner()) {
            break;
        }
        to_try_.swap(to_try_next_);
        to_try_next_.clear();
        for (std::uint32_t const i : to_try_)
            waits_[i] = false;
    }
    patience_ -= std::min(patience_, work_);
    bool const whole = left_ == 3;
    for (std::uint32_t apex = start_, i = after_[apex]; after_[i] != apex; i = after_[i])
        triangles_.push_back({apex, i, after_[i]});
    return whole;
}

} // namespace

bool cut_polygon(std::span<dvec3 const> corners, Triangles& triangles, std::uint64_t& patience) {
    std::uint32_t const size = static_cast<std::uint32_t>(corners.size());
    dvec3 const normal = area_vector(corners);
    constexpr std::uint32_t fans_up_to = 16; // corners: beyond, slivers with one corner in common are costly
    bool const flat = size == 3 || normal == dvec3(0.0);
    for (std::uint32_t apex = 0; apex < std::min(size, 2u); ++apex)
        if (flat || (size <= fans_up_to && fan_fills(corners, apex, normal))) {
            add_fan(apex, size, triangles);
            return true;
        }
    return Outline(projected(corners, normal), triangles, patience).cut();
}

} // namespace sahl
