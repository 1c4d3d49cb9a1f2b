#include "scene/interface.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sahl {

namespace {

dvec3 facing(dvec3 const& normal, dvec3 const& reference, dvec3 const& direction) {
    return dot(reference, direction) > 0.0 ? -normal : normal;
}

/// Fills in where the interface is and how it faces, from the crossing that counts.
void take_place(Interface& found, NextHit const& hit, Crossing const& crossing, dvec3 const& direction) {
    found.t = hit.t;
    found.point = crossing.point;
    found.normal = facing(crossing.normal, crossing.facet_normal, direction);
    found.facet_normal = facing(crossing.facet_normal, crossing.facet_normal, direction);
    found.face = crossing.face;
    found.primitive = crossing.primitive;
    found.against_facing = crossing.enters;
}

/// Sheets at this place, those that are met now last. False where they are too many to remember.
bool remember_sheets(Scene const& scene, NextHit const& hit, LeftSheets const& left, Interface& found) {
    Crossing const& first = hit.at_one_place.front();
    auto const met = [&](Crossing const& c) { return c.open && (!first.detector || &c == &first); };
    auto const is_new = [&](LeftSheet const& sheet) {
        auto const same = [&](auto const& other) { return other.object == sheet.object; };
        return std::any_of(hit.beside.begin(), hit.beside.end(), same) ||
               std::any_of(hit.at_one_place.begin(), hit.at_one_place.end(),
                           [&](Crossing const& c) { return met(c) && same(c); });
    };
    bool fits = true;
    auto const add = [&](LeftSheet const& sheet) {
        fits = fits && !found.left.full();
        if (fits)
            found.left.push_back(sheet);
    };
    found.left.clear();
    found.newly = 0;
    if (left.empty() && hit.beside.empty() && !first.open) // open surfaces come first
        return true;
    if (!left.empty())
        for (LeftSheet const& sheet : scene.bvh->still_there(left, first.point))
            if (!is_new(sheet))
                add(sheet);
    for (LeftSheet const& sheet : hit.beside)
        add(sheet);
    found.newly = found.left.size();
    for (Crossing const& c : hit.at_one_place)
        if (met(c))
            add({c.object, c.enters});
    return fits;
}

/// Faces that detectors watch. One that lies within a body of higher priority is no boundary there.
void note_arrivals(Scene const& scene, NextHit const& hit, bool boundary, Interface& found) {
    for (Crossing const& c : hit.at_one_place)
        if ((c.open || boundary) &&
            std::any_of(scene.surface_detectors.begin(), scene.surface_detectors.end(),
                        [&](auto const& watched) { return watched.first.value == c.face.value; }))
            found.arrivals.push_back({c.face, hit.t, c.point, !c.enters});
}

/// Of the bodies whose surfaces coincide here, the face whose surface counts: that of the body of higher
/// priority, else of the only one that has a surface.
Crossing const& deciding(Scene const& scene, NextHit const& hit) {
    if (hit.at_one_place.size() == 1)
        return hit.at_one_place.front();
    Crossing const* best = nullptr;
    auto const key = [&](Crossing const& c) {
        Face const& face = scene.faces[c.face.value];
        return std::tuple(face.surface.has_value(), scene.bodies[face.body.value].priority, face.body);
    };
    for (Crossing const& c : hit.at_one_place)
        if (!c.open && (!best || key(c) > key(*best)))
            best = &c;
    return best ? *best : hit.at_one_place.front();
}

/// Leaves and enters what is crossed. False where the ray is then in more shells than can be held.
bool cross_faces(NextHit const& hit, ShellSet& inside) {
    for (Crossing const& c : hit.at_one_place)
        if (!c.open && !c.enters)
            inside.erase(c.shell);
    for (Crossing const& c : hit.at_one_place)
        if (!c.open && c.enters && !inside.insert(c.shell))
            return false;
    return true;
}

/// Of a line that runs in a face or along an edge which bodies have in common, each may take it for one that
/// runs beside it, and what they say together may contradict what the ray is in. Then lines are asked that
/// rounding does not tell from it, ever farther off: the first whose answer fits counts. Where none does, it
/// is a leak.
NextHit next_beside(Scene const& scene, dvec3 const& origin, dvec3 const& direction, ShellSet const& inside,
                    LeftSheets const& left, double from) {
    auto const [low, high] = scene.bvh->bounds();
    dvec3 const farthest = glm::max(glm::abs(origin), glm::max(-low, high));
    double const rounding = 0x1p-52 * std::max({farthest.x, farthest.y, farthest.z});
    dvec3 const along = perpendicular_to(direction, dvec3(1.0, 0.0, 0.0));
    dvec3 const across = cross(direction, along);
    for (double const off : {4.0 * rounding, 16.0 * rounding, 64.0 * rounding})
        for (dvec3 const& way : {along, across, -along, -across}) {
            NextHit hit = scene.bvh->next(origin + off * way, direction, inside, left, from);
            if (hit.proof != Proof::leak) {
                hit.proof = Proof::recovered;
                return hit;
            }
        }
    return scene.bvh->next(origin, direction, inside, left, from);
}

} // namespace

std::optional<ObjectId> body_at(Scene const& scene, ShellSet const& inside) {
    if (inside.empty())
        return std::nullopt;
    std::optional<ObjectId> best;
    for (ShellId const id : inside) {
        Shell const& shell = scene.shells[id.value];
        if (!shell.only) {
            int winding = 0;
            for (ShellId const other : inside)
                if (scene.shells[other.value].body == shell.body)
                    winding += scene.shells[other.value].sign;
            if (winding < 1)
                continue;
        }
        auto const rank = [&](ObjectId body) { return std::pair(scene.bodies[body.value].priority, body); };
        if (!best || rank(shell.body) > rank(*best))
            best = shell.body;
    }
    return best;
}

Meeting next_interface(Scene const& scene, dvec3 const& origin, dvec3 const& direction,
                       ShellSet const& inside, std::optional<ObjectId> body, LeftSheets const& left,
                       Interface& found, SeenAhead const* ahead) {
    found.inside_after = inside;
    found.on_the_way.clear();
    found.arrivals.clear();
    found.recovered = false;
    double from = 0.0;
    for (;;) {
        NextHit hit = scene.bvh->next(origin, direction, found.inside_after, left, from, ahead);
        if (hit.proof == Proof::leak)
            hit = next_beside(scene, origin, direction, found.inside_after, left, from);
        found.t = hit.t;
        if (hit.proof == Proof::leak)
            return Meeting::leak;
        found.recovered = found.recovered || hit.proof == Proof::recovered;
        if (hit.at_one_place.empty())
            return Meeting::nothing;
        Crossing const& first = hit.at_one_place.front();
        bool const alone = hit.at_one_place.size() == 1;
        if (alone && hit.fits && left.empty() && hit.beside.empty()) { // as nearly always
            found.left.clear();
            found.newly = 0;
            if (first.open)
                found.left.push_back({first.object, first.enters});
        } else if (!hit.fits || !remember_sheets(scene, hit, left, found)) {
            return Meeting::too_deep;
        }
        found.inside_before = found.inside_after;
        found.body_before = body;
        if (first.detector) { // nothing is crossed yet: bodies and mirrors at the same place are met next
            take_place(found, hit, first, direction);
            found.detector = scene.bodies[first.object].detector;
            found.surface.reset();
            found.body_after = body;
            found.medium_after = medium_of(scene, body);
            return Meeting::interface;
        }
        bool const crossed = !(alone && first.open); // some body's face
        if (crossed && !cross_faces(hit, found.inside_after))
            return Meeting::too_deep;
        found.body_after = crossed ? body_at(scene, found.inside_after) : body;
        found.medium_after = medium_of(scene, found.body_after);
        found.detector.reset();
        bool const same_body = body == found.body_after; // it happens under a body of higher priority
        if (!scene.surface_detectors.empty())
            note_arrivals(scene, hit, !same_body, found);
        if (first.open) { // it acts in place of the boundary that it lies on
            take_place(found, hit, first, direction);
            found.surface = scene.faces[first.face.value].surface;
            return Meeting::interface;
        }
        Crossing const& crossing = deciding(scene, hit);
        found.surface = scene.faces[crossing.face.value].surface;
        if (!same_body && (found.surface || found.medium_after != medium_of(scene, body))) {
            take_place(found, hit, crossing, direction);
            return Meeting::interface;
        }
        if (!same_body && !found.on_the_way.full())
            found.on_the_way.push_back({hit.t, body});
        body = found.body_after;
        from = hit.t;
        ahead = nullptr; // it was seen of the first place alone
    }
}

} // namespace sahl
