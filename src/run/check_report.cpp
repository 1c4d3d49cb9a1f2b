#include "run/check_report.h"

#include "run/check_words.h"
#include "run/values.h"
#include "scene/closeness.h"

namespace sahl {

namespace {

std::string name_of(Scene const& scene, std::optional<ObjectId> body) {
    return body ? scene.bodies[body->value].name : "surroundings";
}

/// The box of a mesh's corners in the world, m.
std::pair<dvec3, dvec3> box_of(Mesh const& mesh, Affine const& to_world) {
    dvec3 const centre = to_world.point(0.5 * (mesh.low + mesh.high));
    dvec3 size(0.0);
    for (int axis = 0; axis < 3; ++axis)
        size += (mesh.high - mesh.low)[axis] * glm::abs(to_world.linear[axis]);
    return {centre, size};
}

Value object_value(Checked const& checked, std::uint32_t number) {
    Scene const& scene = checked.scene;
    Body const& body = scene.bodies[number];
    PilotOfBody const& pilot = checked.census.bodies[number];
    bool const inside = !body.open && !pilot.opaque;
    Table faces;
    for (Face const& face : faces_of(scene, {number}))
        faces.emplace_back(face.name, of(face.surface ? surface_words(scene.surfaces[face.surface->value])
                                                      : std::string("clear")));
    Table entry{{"what", of(body_words(scene, {number}, pilot.opaque))},
                {"open", of(body.open)},
                {"opaque", of(pilot.opaque)},
                {"medium", inside ? of(scene.media[body.medium.value].name) : nothing()},
                {"shape", of(body.shape ? shape_words(*body.shape) : std::string("mesh"))},
                {"origin_mm", of(body.to_world.offset, 1e3)},
                {"mirrored", of(glm::determinant(body.to_world.linear) < 0.0)},
                {"priority", Value{std::int64_t{body.priority}, {}}}};
    if (body.mesh) {
        auto const [centre, size] = box_of(*body.mesh, body.to_world);
        Mesh const& whole = body.decimated ? *body.decimated->whole : *body.mesh;
        entry.emplace_back("triangles", of(std::uint64_t{whole.soup.triangles.size()}));
        if (body.decimated)
            entry.emplace_back("decimated", decimation_value(body));
        entry.emplace_back("centre_mm", of(centre, 1e3));
        entry.emplace_back("size_mm", of(size, 1e3));
    }
    entry.emplace_back("faces", of(std::move(faces)));
    if (!scene.sources.empty()) {
        entry.emplace_back("reached", of(pilot.reached));
        entry.emplace_back("entered", of(pilot.entered));
        entry.emplace_back("inside_opaque",
                           pilot.walled_in ? of(name_of(scene, pilot.walled_in)) : nothing());
    }
    return of(std::move(entry));
}

} // namespace

Value objects_value(Checked const& checked) {
    Table objects;
    for (std::uint32_t i = 0; i < checked.scene.bodies.size(); ++i)
        if (!checked.scene.bodies[i].detector)
            objects.emplace_back(checked.scene.bodies[i].name, object_value(checked, i));
    return of(std::move(objects));
}

Value media_value(Checked const& checked) {
    Table media;
    for (std::uint32_t m = 0; m < checked.scene.media.size(); ++m) {
        Table indices;
        for (std::uint32_t w = 0; w < checked.optics.wavelengths().size(); ++w)
            indices.emplace_back(words("%.10g nm", checked.optics.wavelengths()[w] * 1e9),
                                 of(checked.optics.index({m}, {w})));
        media.emplace_back(checked.scene.media[m].name, of(std::move(indices)));
    }
    return of(std::move(media));
}

Value sources_value(Checked const& checked) {
    Scene const& scene = checked.scene;
    Table sources;
    for (std::size_t s = 0; s < scene.sources.size(); ++s) {
        PilotOfSource const& pilot = checked.census.sources[s];
        Array starts, wavelengths;
        for (StartingPlace const& start : pilot.starts) {
            Array on;
            for (ObjectId const body : start.on)
                on.push_back(of(name_of(scene, body)));
            starts.push_back(of(Table{{"in", of(name_of(scene, start.body))},
                                      {"medium", of(scene.media[medium_of(scene, start.body).value].name)},
                                      {"on_the_surface_of", of(std::move(on))},
                                      {"pilot_rays", of(start.rays)}}));
        }
        for (auto const& [wavelength, weight] : scene.sources[s].wavelengths)
            wavelengths.push_back(of(wavelength * 1e9));
        sources.emplace_back(
            scene.sources[s].name,
            of(Table{{"rays", of(checked.emission.first_rays()[s + 1] - checked.emission.first_rays()[s])},
                     {"wavelengths_nm", of(std::move(wavelengths))},
                     {"power_W", of(scene.sources[s].power)},
                     {"starts", of(std::move(starts))},
                     {"pilot_rays", of(pilot.rays)},
                     {"pilot_rays_that_meet_something", of(pilot.meet_something)}}));
    }
    return of(std::move(sources));
}

Value detectors_value(Checked const& checked) {
    Table detectors;
    for (std::size_t d = 0; d < checked.scene.detectors.size(); ++d) {
        DetectorSpec const& spec = checked.scene.detectors[d];
        PilotOfDetector const& pilot = checked.census.detectors[d];
        Table table;
        if (spec.kind == DetectorKind::rectangle) {
            table.emplace_back("size_mm", of(spec.size, 1e3));
            table.emplace_back("pixels",
                               of(Array{of(std::uint64_t{spec.columns}), of(std::uint64_t{spec.rows})}));
            table.emplace_back("absorbs", of(spec.absorbs));
        } else if (spec.kind == DetectorKind::sphere) {
            table.emplace_back("sphere", of(true));
        } else {
            table.emplace_back("surface", of(spec.surface));
        }
        table.emplace_back("pilot_hits", of(pilot.hits));
        table.emplace_back("pilot_hits_from_behind", of(pilot.hits_from_behind));
        detectors.emplace_back(spec.name, of(std::move(table)));
    }
    return of(std::move(detectors));
}

Value contacts_value(Scene const& scene) {
    return of(contact_lines(scene));
}

} // namespace sahl
