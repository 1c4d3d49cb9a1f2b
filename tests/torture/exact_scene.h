// In: a scene and a ray that starts in free space or on a known face. Out: the next boundary between two
// media, in numbers wider than double: the judge of the torture suite. It holds no state of a ray but what it
// is in.
#pragma once

#include "geometry/solid.h"
#include "torture/exact_mesh.h"
#include "torture/exact_shape.h"
#include "torture/exact_sheet.h"
#include "torture/scene.h"

#include <optional>
#include <utility>
#include <vector>

namespace sahl::bench {

using Turns = std::vector<int>; // by part: how often its surface goes round a place

template <class T>
struct ExactEvent {
    enum class Kind { boundary, nothing, unclear } kind = Kind::nothing;
    T t = 0;
    T slope = 0;
    Wide3<T> normal; // unit
    std::uint32_t before = 0, after = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        places;                      // part and face (of a mesh: number of the plane)
    Turns turns_before, turns_after; // at the boundary's two sides
    bool mirror = false;             // an open surface in place of the boundary
    bool total = false;              // internal reflection
};

/// Where a ray starts: on a face of a part, or in the open.
template <class T>
struct ExactStart {
    Wide3<T> origin, direction;
    std::optional<std::uint32_t> part;
};

template <class T>
class ExactScene {
  public:
    explicit ExactScene(TortureCase const& scene);

    /// The bodies that the ray is in just after its start.
    Turns turns_at(ExactStart<T> const& start) const;
    ExactEvent<T> next(ExactStart<T> const& start, Turns const& turns) const;
    /// All boundaries along the line, the last one followed by `nothing` (or `unclear`).
    std::vector<ExactEvent<T>> line(ExactStart<T> const& start, Turns turns) const;
    /// The point moved along the normal onto a face; of a mesh: a triangle.
    Wide3<T> onto(std::uint32_t part, std::uint32_t face, Wide3<T> const& point) const;
    std::uint32_t medium_of(Turns const& turns) const;
    /// A face's number as in ExactEvent::places.
    std::uint32_t face_number(std::uint32_t part, std::uint32_t face) const;
    double coordinates() const { return coordinates_; } // m, the largest

  private:
    struct Crossing {
        T t, slope;
        std::uint32_t part, face;
        int turn;
        Wide3<T> normal;
    };
    struct Part {
        std::optional<ExactShape<T>> shape;
        std::optional<ExactSheet<T>> sheet;
        std::optional<ExactMesh<T>> mesh;
        WideAffine<T> to_world;
    };
    /// Those ahead of the start, in order.
    std::vector<Crossing> ahead(ExactStart<T> const& start) const;
    ExactEvent<T> next_of(std::vector<Crossing> const& crossings, std::size_t& k, Wide3<T> const& direction,
                          Turns const& turns) const;
    bool never_left(std::vector<Crossing> const& crossings, std::size_t k, Turns const& turns) const;
    bool is_total(ExactEvent<T> const& event, Wide3<T> const& direction) const;

    TortureCase const& scene_;
    std::vector<Part> parts_;
    double coordinates_ = 0.0;
};

template <class T>
ExactScene<T>::ExactScene(TortureCase const& scene) : scene_(scene) {
    for (TorturePart const& part : scene.parts) {
        Part made{{}, {}, {}, WideAffine<T>(part.place)};
        double extent = 0.0;
        if (auto const* mesh = std::get_if<MeshRef>(&part.geometry)) {
            made.mesh.emplace(**mesh, part.place);
            extent = length(glm::max(glm::abs((*mesh)->low), glm::abs((*mesh)->high)));
        } else if (part.mirror) {
            made.sheet.emplace(std::get<Shape>(part.geometry));
            extent = made.sheet->extent();
        } else {
            made.shape.emplace(std::get<Shape>(part.geometry));
            Solid const solid(std::get<Shape>(part.geometry)); // for its size alone
            extent = length(glm::max(glm::abs(solid.low()), glm::abs(solid.high())));
        }
        coordinates_ =
            std::max(coordinates_, length(part.place.offset) + length(part.place.linear[0]) * extent);
        parts_.push_back(std::move(made));
    }
}

template <class T>
std::vector<typename ExactScene<T>::Crossing> ExactScene<T>::ahead(ExactStart<T> const& start) const {
    double const coordinates = coordinates_ + length(narrow(start.origin));
    // No line goes through an edge or a corner exactly: this one is moved aside, by far more than the
    // rounding of numbers of type T, far less than that of double.
    double const shift = (roundoff<T> < 0x1p-100 ? 0x1p24 : 0x1p8) * roundoff<T> * coordinates;
    T const at_start = T(4.0 * shift);
    Wide3<T> const origin = start.origin + Wide3<T>(shift * dvec3(0.5377, -0.8339, 0.3188));
    std::vector<Crossing> crossings;
    std::vector<LocalCrossing<T>> local;
    for (std::uint32_t p = 0; p < parts_.size(); ++p) {
        Part const& part = parts_[p];
        auto const add = [&](T t, std::uint32_t face, int turn, Wide3<T> const& normal) {
            if (scene_.parts[p].mirror)
                turn = 0;
            T const slope = absolute_of(dot(normal, start.direction));
            bool const touching =
                start.part && *start.part != p && absolute_of(t) * slope <= T(scene_.contact);
            if (t * slope > at_start && !touching)
                crossings.push_back({t, slope, p, face, turn, normal});
        };
        if (part.mesh) {
            part.mesh->cross_with(origin, start.direction,
                                  [&](T t, std::uint32_t triangle, int turn, auto const& n) {
                                      add(t, part.mesh->plane_of(triangle), turn, n);
                                  });
        } else if (part.sheet) {
            if (auto const t = part.sheet->meet(part.to_world.point_back(origin),
                                                part.to_world.vector_back(start.direction)))
                add(*t, 0, 0, part.to_world.normal({0, 0, 1}));
        } else {
            local.clear();
            part.shape->cross_with(part.to_world.point_back(origin),
                                   part.to_world.vector_back(start.direction), local);
            for (LocalCrossing<T> const& c : local)
                add(c.t, c.face, c.turn, part.to_world.normal(c.normal));
        }
    }
    std::sort(crossings.begin(), crossings.end(), [](auto const& a, auto const& b) { return a.t < b.t; });
    return crossings;
}

template <class T>
Turns ExactScene<T>::turns_at(ExactStart<T> const& start) const {
    Turns turns(parts_.size(), 0);
    for (Crossing const& c : ahead(start)) // far along the line is outside of all
        if (!scene_.parts[c.part].torn)    // of what has holes that tells nothing: rays start outside of it
            turns[c.part] -= c.turn;
    return turns;
}

template <class T>
std::uint32_t ExactScene<T>::medium_of(Turns const& turns) const {
    std::uint32_t medium = 0;
    std::optional<int> priority;
    for (std::uint32_t p = 0; p < turns.size(); ++p)
        if (turns[p] > 0 && (!priority || scene_.parts[p].priority >= *priority)) {
            priority = scene_.parts[p].priority;
            medium = scene_.parts[p].medium;
        }
    return medium;
}

template <class T>
bool ExactScene<T>::is_total(ExactEvent<T> const& event, Wide3<T> const& direction) const {
    Wide3<T> const across = cross(normalize(direction), event.normal);
    T const n1 = scene_.indices[event.before], n2 = scene_.indices[event.after];
    return n1 * n1 * dot(across, across) >= n2 * n2;
}

template <class T>
ExactEvent<T> ExactScene<T>::next(ExactStart<T> const& start, Turns const& turns) const {
    std::size_t first = 0;
    return next_of(ahead(start), first, start.direction, turns);
}

template <class T>
std::vector<ExactEvent<T>> ExactScene<T>::line(ExactStart<T> const& start, Turns turns) const {
    std::vector<Crossing> const crossings = ahead(start);
    std::vector<ExactEvent<T>> events;
    std::size_t k = 0;
    do {
        events.push_back(next_of(crossings, k, start.direction, turns));
        turns = events.back().turns_after;
    } while (events.back().kind == ExactEvent<T>::Kind::boundary);
    return events;
}

/// Through a hole: a torn body that the line is in and does not leave.
template <class T>
bool ExactScene<T>::never_left(std::vector<Crossing> const& crossings, std::size_t k,
                               Turns const& turns) const {
    for (std::uint32_t p = 0; p < turns.size(); ++p)
        if (scene_.parts[p].torn && turns[p] > 0 &&
            std::none_of(crossings.begin() + static_cast<std::ptrdiff_t>(k), crossings.end(),
                         [&](Crossing const& c) { return c.part == p; }))
            return true;
    return false;
}

template <class T>
ExactEvent<T> ExactScene<T>::next_of(std::vector<Crossing> const& crossings, std::size_t& k,
                                     Wide3<T> const& direction, Turns const& turns) const {
    using Kind = typename ExactEvent<T>::Kind;
    ExactEvent<T> event;
    event.turns_after = turns;
    event.before = medium_of(turns);
    while (k < crossings.size()) {
        Crossing const& first = crossings[k];
        if (never_left(crossings, k, event.turns_after)) {
            event.kind = Kind::unclear;
            return event;
        }
        event.mirror = false;
        event.places.clear();
        event.t = first.t;
        event.slope = first.slope;
        event.turns_before = event.turns_after;
        event.normal = first.normal;
        for (; k < crossings.size(); ++k) {
            Crossing const& c = crossings[k];
            bool const same_part = std::any_of(event.places.begin(), event.places.end(),
                                               [&](auto const& place) { return place.first == c.part; });
            if (same_part || ((c.t - first.t) * c.slope > T(scene_.contact) && c.t != first.t))
                break;
            int const after = event.turns_after[c.part] += c.turn;
            event.places.emplace_back(c.part, c.face);
            event.mirror = event.mirror || scene_.parts[c.part].mirror;
            if (after < 0 || (scene_.parts[c.part].torn && after > 1)) {
                event.kind = Kind::unclear;
                return event;
            }
        }
        event.after = medium_of(event.turns_after);
        if (event.after == event.before && !event.mirror)
            continue; // in silence
        event.kind = Kind::boundary;
        event.total = !event.mirror && is_total(event, direction);
        return event;
    }
    for (int const left : event.turns_after)
        if (left != 0)
            event.kind = Kind::unclear;
    return event;
}

template <class T>
Wide3<T> ExactScene<T>::onto(std::uint32_t part, std::uint32_t face, Wide3<T> const& point) const {
    Part const& on = parts_[part];
    if (on.mesh)
        return on.mesh->onto(face, point);
    if (on.sheet) {
        Wide3<T> local = on.to_world.point_back(point);
        local.z = 0;
        return on.to_world.point(local);
    }
    return on.to_world.point(on.shape->onto(face, on.to_world.point_back(point)));
}

template <class T>
std::uint32_t ExactScene<T>::face_number(std::uint32_t part, std::uint32_t face) const {
    return parts_[part].mesh ? parts_[part].mesh->plane_of(face) : face;
}

} // namespace sahl::bench
