#include "geometry/made_flush.h"

#include "geometry/mesh_weld.h"
#include "math/products.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>

namespace sahl {

namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;

/// In the world.
struct WorldPlane {
    dvec3 normal, on_it;
    double off(dvec3 const& point) const { return dot(normal, point - on_it); }
};

/// A mesh's places: vertices that differ in their normals alone have one.
struct Places {
    std::vector<std::uint32_t> of_vertex, first; // first: a vertex at each
    std::uint32_t offset = 0;                    // number of the first place among those of all objects
};

/// The vertices of all meshes in contact, by place, and what each must lie on.
class Flush {
  public:
    Flush(std::span<Placed const> objects, std::span<PlacedFit const> fits);
    std::vector<FlushMesh> result();

  private:
    using Corners = std::array<std::uint32_t, 3>; // places

    Mesh const& mesh(std::uint32_t object) const { return *objects_[object].mesh(); }
    void take_places(std::uint32_t object);
    Corners corners(std::uint32_t object, std::uint32_t triangle) const;
    std::uint32_t find(std::uint32_t place);
    void join(std::uint32_t a, std::uint32_t b) { // the earlier object's place stands for both
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    void join_corners(PlacedFit const& fit);
    Corners whole(Corners corners) { // sorted, places that are one alike
        for (std::uint32_t& place : corners)
            place = find(place);
        std::sort(corners.begin(), corners.end());
        return corners;
    }
    bool turn_diagonal(PlacedFit const& fit);
    void find_whole_triangles(std::span<PlacedFit const> fits);
    void bind_to_shape(PlacedFit const& fit);
    void bind_to_plane(PlacedFit const& fit);
    void bind(Corners const& places, std::uint32_t plane);
    dvec3 settled(std::uint32_t place) const;
    double area(PlacedFit const& fit) const;
    dvec3 cross_of(Corners const& c) const {
        return precise_cross(at_[c[1]] - at_[c[0]], at_[c[2]] - at_[c[0]]);
    }

    std::span<Placed const> objects_;
    std::vector<Places> places_; // by object
    std::vector<dvec3> at_;      // world, by place
    std::vector<std::uint32_t> parent_;
    std::vector<std::vector<std::uint32_t>> planes_of_; // by representative of places that are one
    std::vector<WorldPlane> planes_;
    using Triangles = std::map<Corners, std::uint32_t>;  // of an object, by places that are one
    std::map<std::uint32_t, Triangles> whole_triangles_; // by object, those in contact
    std::map<std::uint32_t, std::map<std::uint32_t, Corners>>
        turned_; // by object and triangle: its vertices now
};

Flush::Flush(std::span<Placed const> objects, std::span<PlacedFit const> fits)
    : objects_(objects), places_(objects.size()) {
    auto const is_shape = [&](PlacedFit const& fit) { return objects_[fit.other].exact(); };
    for (PlacedFit const& fit : fits) {
        take_places(fit.one);
        if (!is_shape(fit))
            take_places(fit.other);
    }
    parent_.resize(at_.size());
    for (std::uint32_t i = 0; i < parent_.size(); ++i)
        parent_[i] = i;
    planes_of_.resize(at_.size());
    for (PlacedFit const& fit : fits)
        if (!is_shape(fit))
            join_corners(fit);
    find_whole_triangles(fits);
    std::vector<PlacedFit> flat;
    for (PlacedFit const& fit : fits)
        if (is_shape(fit))
            bind_to_shape(fit);
        else if (!fit.fit.same_corners && !turn_diagonal(fit) && !fit.fit.other_diagonal)
            flat.push_back(fit);
    // large triangles know best where their plane is
    std::stable_sort(flat.begin(), flat.end(),
                     [&](PlacedFit const& a, PlacedFit const& b) { return area(a) > area(b); });
    for (PlacedFit const& fit : flat)
        bind_to_plane(fit);
}

void Flush::take_places(std::uint32_t object) {
    Places& places = places_[object];
    if (!places.of_vertex.empty())
        return;
    auto const& positions = mesh(object).soup.positions;
    auto const bits = [&](std::size_t i) {
        return std::array{std::bit_cast<std::uint64_t>(positions[i].x),
                          std::bit_cast<std::uint64_t>(positions[i].y),
                          std::bit_cast<std::uint64_t>(positions[i].z)};
    };
    places.of_vertex = number_kinds(positions.size(), bits, places.first);
    places.offset = static_cast<std::uint32_t>(at_.size());
    for (std::uint32_t const vertex : places.first)
        at_.push_back(objects_[object].geometry.to_world.point(positions[vertex]));
}

Flush::Corners Flush::corners(std::uint32_t object, std::uint32_t triangle) const {
    Places const& places = places_[object];
    auto const& [a, b, c] = mesh(object).soup.triangles[triangle];
    return {places.offset + places.of_vertex[a], places.offset + places.of_vertex[b],
            places.offset + places.of_vertex[c]};
}

std::uint32_t Flush::find(std::uint32_t place) {
    while (parent_[place] != place)
        place = parent_[place] = parent_[parent_[place]];
    return place;
}

void Flush::join_corners(PlacedFit const& fit) {
    double const scale = length(objects_[fit.one].geometry.to_world.linear[0]); // m of the world per local m
    Corners const others = corners(fit.other, fit.fit.other);
    for (std::uint32_t const place : corners(fit.one, fit.fit.one)) {
        auto const apart = [&](std::uint32_t other) { return length(at_[other] - at_[place]); };
        std::uint32_t const nearest =
            *std::min_element(others.begin(), others.end(),
                              [&](std::uint32_t a, std::uint32_t b) { return apart(a) < apart(b); });
        if (apart(nearest) <= fit.fit.corner_tolerance * scale)
            join(place, nearest);
    }
}

void Flush::find_whole_triangles(std::span<PlacedFit const> fits) {
    for (PlacedFit const& fit : fits) {
        whole_triangles_[fit.one].try_emplace(whole(corners(fit.one, fit.fit.one)), fit.fit.one);
        if (!objects_[fit.other].exact())
            whole_triangles_[fit.other].try_emplace(whole(corners(fit.other, fit.fit.other)), fit.fit.other);
    }
}

/// Four places that one mesh joins by one diagonal and the other by the other: if they lie on no plane, if
/// only by rounding, the same diagonal alone makes both surfaces one. The later mesh's is turned.
bool Flush::turn_diagonal(PlacedFit const& fit) {
    Corners const one = whole(corners(fit.one, fit.fit.one)),
                  other = whole(corners(fit.other, fit.fit.other));
    auto const in = [](Corners const& c, std::uint32_t place) {
        return std::find(c.begin(), c.end(), place) != c.end();
    };
    InlineVector<std::uint32_t, 3> shared;
    std::uint32_t only_one = none, only_other = none;
    for (std::uint32_t const place : one)
        in(other, place) ? shared.push_back(place) : void(only_one = place);
    for (std::uint32_t const place : other)
        only_other = in(one, place) ? only_other : place;
    if (shared.size() != 2)
        return false;
    for (int k = 0; k < 2; ++k) { // the other mesh's diagonal runs from `kept`, the first one's from `left`
        std::uint32_t const kept = shared[k ? 1 : 0], left = shared[k ? 0 : 1];
        auto const find_in = [&](std::uint32_t object, std::uint32_t corner) {
            Corners key{corner, only_one, only_other};
            std::sort(key.begin(), key.end());
            auto const& triangles = whole_triangles_[object];
            auto const found = triangles.find(key);
            return found == triangles.end() ? none : found->second;
        };
        std::uint32_t const partner = find_in(fit.other, kept);
        if (partner == none || find_in(fit.one, left) == none)
            continue;
        auto& turned = turned_[fit.other];
        if (turned.count(fit.fit.other) || turned.count(partner))
            return true; // by the fit of another of these triangles
        auto const& triangles = mesh(fit.other).soup.triangles;
        Corners mine = triangles[fit.fit.other], next = triangles[partner];
        auto const vertex_at = [&](Corners& vertices, std::uint32_t place) -> std::uint32_t& {
            Places const& places = places_[fit.other];
            return *std::find_if(vertices.begin(), vertices.end(), [&](std::uint32_t vertex) {
                return find(places.offset + places.of_vertex[vertex]) == place;
            });
        };
        std::uint32_t const across = vertex_at(next, only_one), back = vertex_at(mine, left);
        vertex_at(mine, only_other) = across;
        vertex_at(next, kept) = back;
        turned.emplace(fit.fit.other, mine);
        turned.emplace(partner, next);
        return true;
    }
    return false;
}

void Flush::bind(Corners const& places, std::uint32_t plane) {
    for (std::uint32_t const place : places) {
        auto& list = planes_of_[find(place)];
        if (std::find(list.begin(), list.end(), plane) == list.end())
            list.push_back(plane);
    }
}

void Flush::bind_to_shape(PlacedFit const& fit) {
    Placed const& shape = objects_[fit.other];
    Corners const triangle = corners(fit.one, fit.fit.one);
    std::optional<WorldPlane> nearest; // a quadric's caps are several
    double least = INFINITY;
    for (Carrier const& carrier : shape.carriers(fit.fit.other)) {
        auto const seen = seen_through(carrier, shape.geometry.to_world);
        auto const* const plane = seen ? std::get_if<PlaneCarrier>(&*seen) : nullptr;
        if (!plane)
            continue;
        WorldPlane const here{plane->normal, plane->offset * plane->normal};
        double farthest = 0.0;
        for (std::uint32_t const place : triangle)
            farthest = std::max(farthest, std::abs(here.off(at_[place])));
        if (farthest < least) {
            least = farthest;
            nearest = here;
        }
    }
    if (!nearest)
        return;
    WorldPlane const& wanted = *nearest;
    auto const same = [&](WorldPlane const& p) {
        return p.normal == wanted.normal && p.on_it == wanted.on_it;
    };
    auto const known = std::find_if(planes_.begin(), planes_.end(), same);
    auto const number = static_cast<std::uint32_t>(known - planes_.begin());
    if (known == planes_.end())
        planes_.push_back(wanted);
    bind(triangle, number);
}

double Flush::area(PlacedFit const& fit) const {
    return std::max(length(cross_of(corners(fit.one, fit.fit.one))),
                    length(cross_of(corners(fit.other, fit.fit.other))));
}

void Flush::bind_to_plane(PlacedFit const& fit) {
    Corners const one = corners(fit.one, fit.fit.one), other = corners(fit.other, fit.fit.other);
    double const scale = length(objects_[fit.one].geometry.to_world.linear[0]); // m of the world per local m
    auto const holds = [&](WorldPlane const& plane) {
        auto const on = [&](std::uint32_t p) {
            return std::abs(plane.off(at_[p])) <= 2.0 * fit.fit.tolerance * scale;
        };
        return std::all_of(one.begin(), one.end(), on) && std::all_of(other.begin(), other.end(), on);
    };
    // planes that its corners lie on already, those of exact shapes, and the latest
    std::uint32_t plane = none;
    for (Corners const& triangle : {one, other})
        for (std::uint32_t const place : triangle)
            for (std::uint32_t const p : planes_of_[find(place)])
                if (plane == none && holds(planes_[p]))
                    plane = p;
    constexpr std::size_t looked_through = 256; // more would make the search slow; they meet at corners
    for (std::uint32_t p = 0; plane == none && p < std::min(planes_.size(), looked_through); ++p)
        if (holds(planes_[p]))
            plane = p;
    if (plane == none) {
        dvec3 const by_one = cross_of(one), by_other = cross_of(other);
        bool const first = length(by_one) >= length(by_other);
        plane = static_cast<std::uint32_t>(planes_.size());
        planes_.push_back({normalize(first ? by_one : by_other), at_[first ? one[0] : other[0]]});
    }
    bind(one, plane);
    bind(other, plane);
}

/// The nearest point on all planes of a place, by steps at right angles to those that came before.
dvec3 Flush::settled(std::uint32_t place) const {
    dvec3 point = at_[place];
    InlineVector<dvec3, 3> taken;
    for (std::uint32_t const number : planes_of_[place]) {
        if (taken.full())
            break;
        WorldPlane const& plane = planes_[number];
        dvec3 step = plane.normal;
        for (dvec3 const& before : taken)
            step -= dot(step, before) * before;
        double const size = length(step);
        if (size < 1e-3) // as good as parallel: it would move the point far along the other
            continue;
        step /= size;
        for (int k = 0; k < 2; ++k) // again: the first leaves the rounding of a large step
            point -= plane.off(point) / dot(step, plane.normal) * step;
        taken.push_back(step);
    }
    return point;
}

std::vector<FlushMesh> Flush::result() {
    std::vector<FlushMesh> changed;
    for (std::uint32_t object = 0; object < objects_.size(); ++object) {
        Places const& places = places_[object];
        Placed const& placed = objects_[object];
        if (places.of_vertex.empty())
            continue;
        double const rounding = placing_tolerance(placed.geometry.to_world, {}, placed.extent) *
                                length(placed.geometry.to_world.linear[0]);
        std::vector<std::optional<dvec3>> moved(places.first.size());
        double farthest = 0.0;
        for (std::uint32_t p = 0; p < moved.size(); ++p) {
            std::uint32_t const whole = find(places.offset + p);
            if (whole == places.offset + p && planes_of_[whole].empty())
                continue;
            dvec3 const target = settled(whole);
            double const distance = length(target - at_[places.offset + p]);
            if (distance > 0.25 * rounding) // what lies there already keeps the file's own digits
                moved[p] = placed.to_local.point(target);
            farthest = std::max(farthest, distance);
        }
        auto const turned = turned_.find(object);
        if (turned == turned_.end() &&
            std::none_of(moved.begin(), moved.end(), [](auto const& m) { return m.has_value(); }))
            continue;
        Mesh copy = mesh(object);
        if (turned != turned_.end())
            for (auto const& [triangle, vertices] : turned->second)
                copy.soup.triangles[triangle] = vertices;
        for (std::uint32_t vertex = 0; vertex < copy.soup.positions.size(); ++vertex)
            if (auto const& to = moved[places.of_vertex[vertex]]) {
                copy.soup.positions[vertex] = *to;
                copy.low = glm::min(copy.low, *to);
                copy.high = glm::max(copy.high, *to);
            }
        changed.push_back({object, std::make_shared<Mesh const>(std::move(copy)), farthest});
    }
    return changed;
}

} // namespace

std::vector<FlushMesh> made_flush(std::span<Placed const> objects, std::span<PlacedFit const> fits) {
    return Flush(objects, fits).result();
}

} // namespace sahl
