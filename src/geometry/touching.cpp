#include "geometry/touching.h"

#include "geometry/box_pairs.h"
#include "geometry/mesh_contact.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sahl {

namespace {

/// Far above rounding, of floats too, and far below anything else.
double margin_of(Placed const& object) {
    return 1e-6 * (length(object.box.high - object.box.low) +
                   length(glm::max(glm::abs(object.box.low), glm::abs(object.box.high))));
}

Bounds box_through(Bounds const& box, Affine const& map) {
    Bounds seen{dvec3(INFINITY), dvec3(-INFINITY)};
    for (int corner = 0; corner < 8; ++corner) {
        dvec3 const p = map.point({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                                   corner & 4 ? box.high.z : box.low.z});
        seen = joined(seen, {p, p});
    }
    return seen;
}

} // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> neighbours(std::span<Placed const> objects,
                                                                double grown_by) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    std::vector<std::uint32_t> bounded, unbounded;
    std::vector<Bounds> boxes;
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        if (!objects[i].bounded) {
            unbounded.push_back(i);
            continue;
        }
        bounded.push_back(i);
        double const margin = grown_by + margin_of(objects[i]);
        boxes.push_back({objects[i].box.low - margin, objects[i].box.high + margin});
    }
    for (std::uint32_t const plane : unbounded) {
        for (std::uint32_t const i : bounded)
            pairs.push_back(std::minmax(plane, i));
        for (std::uint32_t const other : unbounded)
            if (plane < other)
                pairs.emplace_back(plane, other);
    }
    BoxHalves const halves(boxes);
    for (std::uint32_t k = 0; k < bounded.size(); ++k)
        halves.visit(boxes[k], [&](std::uint32_t l) {
            if (k < l)
                pairs.emplace_back(bounded[k], bounded[l]);
        });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

/// What is found, pair by pair, before it is put in order.
struct Touching::Search {
    std::span<Placed const> objects;
    std::vector<Part> parts;
    std::vector<std::pair<FaceId, FaceId>> faces;
    std::vector<Bvh::Tangency> tangencies;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> tangent_objects;
    std::vector<PlacedFit> fits; // of meshes
    bool some_rounded = false;
    std::map<Mesh const*, bool> is_float;

    bool has_floats(Placed const& object) {
        auto const [known, is_new] = is_float.try_emplace(object.mesh(), false);
        if (is_new)
            known->second = has_float_positions(*object.mesh());
        return known->second;
    }
    FaceId face_id(std::uint32_t object, std::uint32_t face) const {
        return {objects[object].geometry.first_face.value + objects[object].local_face(face)};
    }
    void add(std::uint32_t i, std::uint32_t part, std::uint32_t j, std::uint32_t other_part) {
        parts.push_back({i, part, j});
        parts.push_back({j, other_part, i});
    }
    void take(PlacedFit const& fit, FaceId one, FaceId other, double placing) {
        fits.push_back(fit);
        if (fit.fit.apart > placing) {
            some_rounded = true;
            return;
        }
        add(fit.one, fit.fit.one, fit.other, fit.fit.other);
        faces.emplace_back(one, other);
    }
    void shapes(std::uint32_t i, std::uint32_t j);
    void faces_of_shapes(std::uint32_t i, std::uint32_t f, Carrier const& one, std::uint32_t j,
                         std::uint32_t g, Carrier const& other, double reach);
    void mesh_and_shape(std::uint32_t mesh, std::uint32_t shape);
    void meshes(std::uint32_t i, std::uint32_t j);
    void shells_of(std::uint32_t i);
};

void Touching::Search::shapes(std::uint32_t i, std::uint32_t j) {
    if (!objects[i].bounded)
        std::swap(i, j); // the reach is that of a bounded one
    Placed const &a = objects[i], &b = objects[j];
    double const reach = a.bounded ? a.extent : 1.0; // of two planes none
    std::vector<Carriers> others;
    for (std::uint32_t g = 0; g < b.face_count(); ++g)
        others.push_back(b.carriers(g));
    for (std::uint32_t f = 0; f < a.face_count(); ++f)
        for (Carrier const& one : a.carriers(f))
            for (std::uint32_t g = 0; g < others.size(); ++g)
                for (Carrier const& other : others[g])
                    faces_of_shapes(i, f, one, j, g, other, reach);
}

void Touching::Search::faces_of_shapes(std::uint32_t i, std::uint32_t f, Carrier const& one, std::uint32_t j,
                                       std::uint32_t g, Carrier const& other, double reach) {
    Placed const &a = objects[i], &b = objects[j];
    Affine const &one_place = a.geometry.to_world, &other_place = b.geometry.to_world;
    if (coincide(one, one_place, other, other_place, reach)) {
        add(i, f, j, g);
        faces.emplace_back(face_id(i, f), face_id(j, g));
    } else if (auto const at = tangent_point(one, one_place, other, other_place, reach)) {
        auto const near = [&](Placed const& object) {
            double const margin = margin_of(object);
            return !object.bounded ||
                   overlap({object.box.low - margin, object.box.high + margin}, {*at, *at});
        };
        if (!near(a) || !near(b))
            return;
        // beside the point there is a gap: no crossings are merged
        tangencies.push_back({face_id(i, f), face_id(j, g), *at});
        tangent_objects.emplace_back(std::minmax(i, j));
    }
}

void Touching::Search::mesh_and_shape(std::uint32_t mesh, std::uint32_t shape) {
    Placed const &a = objects[mesh], &b = objects[shape];
    Affine const to_mesh = compose(a.to_local, b.geometry.to_world);
    Bounds const region =
        b.bounded ? box_through(b.box, a.to_local) : Bounds{dvec3(-INFINITY), dvec3(INFINITY)};
    FitTolerance const tolerance{placing_tolerance(a.geometry.to_world, b.geometry.to_world, a.extent),
                                 has_floats(a), false};
    for (std::uint32_t face = 0; face < b.face_count(); ++face)
        for (Carrier const& carrier : b.carriers(face)) {
            auto const seen = seen_through(carrier, to_mesh);
            auto const* const plane = seen ? std::get_if<PlaneCarrier>(&*seen) : nullptr;
            if (!plane) // a flat triangle lies on no sphere
                continue;
            for (TriangleFit fit : fits_of(*a.mesh(), *plane, region, tolerance)) {
                fit.other = face;
                take({mesh, shape, fit}, face_id(mesh, a.mesh()->soup.triangle_face[fit.one]),
                     face_id(shape, face), tolerance.placing);
            }
        }
}

void Touching::Search::meshes(std::uint32_t i, std::uint32_t j) {
    Placed const &a = objects[i], &b = objects[j];
    double const reach = a.extent; // they meet within it
    FitTolerance const tolerance{placing_tolerance(a.geometry.to_world, b.geometry.to_world, reach),
                                 has_floats(a), has_floats(b)};
    for (TriangleFit const& fit :
         fits_of(*a.mesh(), *b.mesh(), compose(a.to_local, b.geometry.to_world), tolerance))
        take({i, j, fit}, face_id(i, a.mesh()->soup.triangle_face[fit.one]),
             face_id(j, b.mesh()->soup.triangle_face[fit.other]), tolerance.placing);
}

/// Shells of one mesh that lie on each other.
void Touching::Search::shells_of(std::uint32_t i) {
    Placed const& object = objects[i];
    Mesh const& mesh = *object.mesh();
    FitTolerance const tolerance{
        placing_tolerance(object.geometry.to_world, object.geometry.to_world, object.extent),
        has_floats(object), has_floats(object)};
    for (TriangleFit const& fit : fits_of(mesh, mesh, {}, tolerance)) {
        if (fit.one >= fit.other || mesh.triangle_shell[fit.one] == mesh.triangle_shell[fit.other])
            continue;
        FaceId const one = face_id(i, mesh.soup.triangle_face[fit.one]),
                     other = face_id(i, mesh.soup.triangle_face[fit.other]);
        take({i, i, fit}, std::min(one, other), std::max(one, other), tolerance.placing);
    }
}

Touching::Touching(std::span<Placed const> objects) : set_of_part_(objects.size()) {
    Search search{objects, {}, {}, {}, {}, {}, false, {}};
    for (auto const& [i, j] : neighbours(objects)) {
        bool const i_is_mesh = objects[i].mesh(), j_is_mesh = objects[j].mesh();
        if (i_is_mesh && j_is_mesh)
            search.meshes(i, j);
        else if (i_is_mesh || j_is_mesh)
            search.mesh_and_shape(i_is_mesh ? i : j, i_is_mesh ? j : i);
        else
            search.shapes(i, j);
    }
    for (std::uint32_t i = 0; i < objects.size(); ++i)
        if (Mesh const* const mesh = objects[i].mesh(); mesh && mesh->shells.size() > 1)
            search.shells_of(i);
    auto const put_in_order = [](auto& list) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    };
    put_in_order(search.parts);
    put_in_order(search.faces);
    faces_ = std::move(search.faces);
    for (Part const& part : search.parts)
        if (part.object <= part.touches)
            objects_.emplace_back(part.object, part.touches);
    put_in_order(objects_);
    tangencies_ = std::move(search.tangencies);
    put_in_order(search.tangent_objects);
    tangent_objects_ = std::move(search.tangent_objects);
    if (search.some_rounded)
        to_make_flush_ = std::move(search.fits);

    std::map<std::vector<std::uint32_t>, std::uint32_t> numbers{{{}, 0}};
    sets_.emplace_back(); // of parts that touch nothing
    for (auto first = search.parts.begin(); first != search.parts.end();) {
        auto const last = std::find_if(first, search.parts.end(), [&](Part const& part) {
            return part.object != first->object || part.part != first->part;
        });
        std::vector<std::uint32_t> set;
        for (auto part = first; part != last; ++part)
            set.push_back(part->touches);
        auto const [number, is_new] = numbers.try_emplace(set, static_cast<std::uint32_t>(sets_.size()));
        if (is_new)
            sets_.push_back(std::move(set));
        auto& of_object = set_of_part_[first->object];
        Placed const& object = objects[first->object];
        Mesh const* const mesh = object.mesh();
        of_object.resize(mesh ? mesh->soup.triangles.size() : object.face_count(), 0);
        of_object[first->part] = number->second;
        first = last;
    }
}

} // namespace sahl
