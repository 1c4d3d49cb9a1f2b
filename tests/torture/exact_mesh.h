// In: a mesh in its place and a line. Out: every triangle that the line crosses, decided in numbers wider
// than double; a tree of balls round the triangles and arithmetic in double with a bound on its error only
// leave out what is far off.
#pragma once

#include "geometry/mesh.h"
#include "torture/wide.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <vector>

namespace sahl::bench {

template <class T>
class ExactMesh {
  public:
    ExactMesh(Mesh const& mesh, Affine const& place);

    /// Calls take(t, triangle, turn, outward unit normal) for each crossing; both directions along the line.
    template <class Take>
    void cross_with(Wide3<T> const& origin, Wide3<T> const& direction, Take&& take) const;
    Wide3<T> onto(std::uint32_t triangle, Wide3<T> const& point) const;
    /// Triangles that lie side by side in one plane have the same number.
    std::uint32_t plane_of(std::uint32_t triangle) const { return plane_[triangle]; }

  private:
    struct Ball {
        dvec3 centre;
        double radius;
        std::uint32_t first, last; // in order_
        std::uint32_t next = 0;    // the ball after this one's part of the tree; its halves follow it
    };
    static constexpr std::uint32_t leaf = 4;
    void grow(std::uint32_t first, std::uint32_t last);
    void find_planes();
    bool far_off(std::uint32_t triangle, dvec3 const& origin, dvec3 const& direction) const;

    Mesh const& mesh_;
    double turned_;                   // −1 where the place mirrors
    std::vector<Wide3<T>> positions_; // world
    std::vector<dvec3> rough_;        // the same, rounded
    std::vector<std::uint32_t> order_, plane_;
    std::vector<Ball> balls_;
    double coordinates_ = 0.0; // the largest
};

template <class T>
ExactMesh<T>::ExactMesh(Mesh const& mesh, Affine const& place)
    : mesh_(mesh), turned_(glm::determinant(place.linear) < 0.0 ? -1.0 : 1.0) {
    WideAffine<T> const to_world(place);
    for (dvec3 const& p : mesh.soup.positions) {
        positions_.push_back(to_world.point(Wide3<T>(p)));
        rough_.push_back(narrow(positions_.back()));
        coordinates_ = std::max(coordinates_, length(rough_.back()));
    }
    order_.resize(mesh.soup.triangles.size());
    std::iota(order_.begin(), order_.end(), 0u);
    grow(0, static_cast<std::uint32_t>(order_.size()));
    find_planes();
}

template <class T>
void ExactMesh<T>::grow(std::uint32_t first, std::uint32_t last) {
    dvec3 low(INFINITY), high(-INFINITY);
    for (std::uint32_t k = first; k < last; ++k)
        for (std::uint32_t corner : mesh_.soup.triangles[order_[k]]) {
            low = glm::min(low, rough_[corner]);
            high = glm::max(high, rough_[corner]);
        }
    std::size_t const here = balls_.size();
    // wider than all that rounding to double may move
    balls_.push_back(
        {0.5 * (low + high), (0.5 + 1e-9) * length(high - low) + 1e-12 * coordinates_, first, last});
    if (last - first <= leaf) {
        balls_[here].next = static_cast<std::uint32_t>(balls_.size());
        return;
    }
    dvec3 const size = high - low;
    int const axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    auto const middle_of = [&](std::uint32_t t) {
        auto const& [a, b, c] = mesh_.soup.triangles[t];
        return rough_[a][axis] + rough_[b][axis] + rough_[c][axis];
    };
    std::uint32_t const middle = (first + last) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) { return middle_of(a) < middle_of(b); });
    grow(first, middle);
    grow(middle, last);
    balls_[here].next = static_cast<std::uint32_t>(balls_.size());
}

template <class T>
void ExactMesh<T>::find_planes() {
    plane_.resize(mesh_.soup.triangles.size());
    std::iota(plane_.begin(), plane_.end(), 0u);
    auto const root = [&](std::uint32_t t) {
        while (plane_[t] != t)
            t = plane_[t];
        return t;
    };
    auto const normal_of = [&](std::uint32_t t) {
        auto const& [a, b, c] = mesh_.soup.triangles[t];
        return narrow(normalize(cross(positions_[b] - positions_[a], positions_[c] - positions_[a])));
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> at_edge;
    for (std::uint32_t t = 0; t < plane_.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            auto const& corners = mesh_.soup.triangles[t];
            auto const edge = std::minmax(corners[k], corners[(k + 1) % 3]);
            auto const [other, is_new] = at_edge.try_emplace(edge, t);
            if (!is_new &&
                length(normal_of(t) - normal_of(other->second)) < 1e-11) // no case has flatter edges
                plane_[root(t)] = root(other->second);
        }
    for (std::uint32_t t = 0; t < plane_.size(); ++t)
        plane_[t] = root(t);
}

template <class T>
bool ExactMesh<T>::far_off(std::uint32_t triangle, dvec3 const& origin, dvec3 const& direction) const {
    auto const& corners = mesh_.soup.triangles[triangle];
    dvec3 const a = rough_[corners[0]] - origin, b = rough_[corners[1]] - origin,
                c = rough_[corners[2]] - origin;
    double const la = length(a), lb = length(b), lc = length(c), shift = coordinates_ + length(origin);
    // roundings of the differences, of the cross and of the dot product
    auto const doubt = [&](double l, double m) { return 0x1p-48 * (l * m + shift * (l + m)); };
    double const u = dot(direction, cross(c, b)), v = dot(direction, cross(a, c)),
                 w = dot(direction, cross(b, a));
    bool const plus = u > doubt(lc, lb) || v > doubt(la, lc) || w > doubt(lb, la);
    bool const minus = u < -doubt(lc, lb) || v < -doubt(la, lc) || w < -doubt(lb, la);
    return plus && minus;
}

template <class T>
template <class Take>
void ExactMesh<T>::cross_with(Wide3<T> const& origin, Wide3<T> const& direction, Take&& take) const {
    dvec3 const o = narrow(origin), d = normalize(narrow(direction));
    double const margin = 1e-12 * (coordinates_ + length(o));
    for (std::uint32_t at = 0, end = static_cast<std::uint32_t>(balls_.size()); at < end;) {
        Ball const& ball = balls_[at];
        dvec3 const across = cross(ball.centre - o, d);
        double const reach = ball.radius + margin;
        bool const missed = dot(across, across) > reach * reach;
        if (!missed && ball.last - ball.first <= leaf)
            for (std::uint32_t k = ball.first; k < ball.last; ++k) {
                std::uint32_t const t = order_[k];
                if (far_off(t, o, d))
                    continue;
                auto const& corners = mesh_.soup.triangles[t];
                Wide3<T> const a = positions_[corners[0]] - origin, b = positions_[corners[1]] - origin,
                               c = positions_[corners[2]] - origin;
                T const u = dot(direction, cross(c, b)), v = dot(direction, cross(a, c)),
                        w = dot(direction, cross(b, a));
                if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0)))
                    continue;
                // a cavity's normals point into the cavity: who crosses along them leaves the body all the
                // same
                Wide3<T> const normal = T(turned_) * normalize(cross(b - a, c - a));
                T const along = dot(normal, direction);
                take(dot(normal, a) / along, t, along < 0 ? 1 : -1, normal);
            }
        at = missed ? ball.next : at + 1;
    }
}

template <class T>
Wide3<T> ExactMesh<T>::onto(std::uint32_t triangle, Wide3<T> const& point) const {
    auto const& corners = mesh_.soup.triangles[triangle];
    Wide3<T> const &a = positions_[corners[0]], &b = positions_[corners[1]], &c = positions_[corners[2]];
    Wide3<T> const normal = normalize(cross(b - a, c - a));
    return point - dot(normal, point - a) * normal;
}

} // namespace sahl::bench
