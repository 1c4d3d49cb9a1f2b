#include "run/check.h"

#include "run/summary.h"
#include "scene/read_model.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace sahl {

namespace {

constexpr std::uint64_t pilot_rays = 256; // per source

Value text(std::string s) {
    return {std::move(s), {}};
}
Value whole(std::uint64_t n) {
    return {static_cast<std::int64_t>(n), {}};
}

/// What pilot rays of one source meet.
struct Pilot {
    std::uint64_t rays = 0, met_something = 0;
    std::string starts_in;
};

struct Census {
    std::vector<Pilot> sources;
    std::vector<bool> body_met;
    std::vector<std::uint64_t> detector_hits, detector_backs;
};

Census pilot(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
             TraceOptions const& options) {
    Census census;
    census.body_met.resize(scene.bodies.size());
    census.detector_hits.resize(scene.detectors.size());
    census.detector_backs.resize(scene.detectors.size());
    TraceContext const context{scene, optics, emission, options, power_unit(emission), 1};
    for (std::size_t s = 0; s < scene.sources.size(); ++s) {
        Pilot& result = census.sources.emplace_back();
        std::uint64_t const first = emission.first_rays()[s], count = emission.first_rays()[s + 1] - first;
        result.rays = std::min(pilot_rays, count);
        for (std::uint64_t i = 0; i < result.rays; ++i) {
            BatchResult const batch = trace_batch(context, first + count * i / result.rays, 1);
            Segment const& root = batch.log.segments.front();
            result.met_something += root.surface >= 0;
            if (i == 0)
                result.starts_in = scene.media[root.medium].name;
            for (Segment const& segment : batch.log.segments) {
                if (segment.surface < 0)
                    continue;
                Body const& body =
                    scene.bodies[scene.faces[static_cast<std::size_t>(segment.surface)].body.value];
                census.body_met[scene.faces[static_cast<std::size_t>(segment.surface)].body.value] = true;
                if (body.detector) {
                    DetectorSpec const& detector = scene.detectors[body.detector->value];
                    bool const front = dot(segment.direction, detector.to_world.linear[2]) < 0.0;
                    ++(front || detector.back ? census.detector_hits
                                              : census.detector_backs)[body.detector->value];
                }
            }
        }
    }
    return census;
}

Value mesh_health(Mesh const& mesh) {
    Array shells;
    for (MeshShell const& shell : mesh.shells)
        shells.push_back({Table{{"kind", text(shell.sign > 0 ? "body" : "cavity")},
                                {"volume_mm3", {shell.volume * 1e9, {}}}},
                          {}});
    dvec3 const size = (mesh.high - mesh.low) * 1e3;
    return {Table{{"triangles", whole(mesh.soup.triangles.size())},
                  {"closed", {mesh.closed(), {}}},
                  {"boundary_edges", whole(mesh.boundary_edges)},
                  {"non_manifold_edges", whole(mesh.non_manifold_edges)},
                  {"degenerate_triangles", whole(mesh.degenerate_triangles)},
                  {"flipped_triangles", whole(mesh.flipped_triangles)},
                  {"normals", {!mesh.soup.normals.empty(), {}}},
                  {"size_mm", {Array{{size.x, {}}, {size.y, {}}, {size.z, {}}}, {}}},
                  {"shells", {std::move(shells), {}}}},
            {}};
}

void add_warnings(std::vector<std::string>& warnings, Scene const& scene, Census const& census) {
    for (std::size_t s = 0; s < census.sources.size(); ++s)
        if (census.sources[s].met_something == 0)
            warnings.push_back("source " + scene.sources[s].name + ": none of its " +
                               std::to_string(census.sources[s].rays) +
                               " pilot rays meets anything: see from_mm and toward");
    for (std::size_t d = 0; d < scene.detectors.size(); ++d)
        if (census.detector_hits[d] == 0)
            warnings.push_back(
                "detector " + scene.detectors[d].name +
                (census.detector_backs[d]
                     ? ": pilot rays meet it only from behind: turn `facing` round, or set back = true"
                     : ": no pilot ray reaches it"));
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        if (!scene.bodies[b].detector && !census.body_met[b])
            warnings.push_back("object " + scene.bodies[b].name + ": no pilot ray reaches it");
}

void write(std::ostringstream& out, Value const& value, int indent) {
    std::string const margin(static_cast<std::size_t>(indent), ' ');
    auto const scalar = [](Value const& v) { return to_json(v); };
    auto const flat = [](Value const& v) {
        auto const* const array = std::get_if<Array>(&v.data);
        return array &&
               std::all_of(array->begin(), array->end(), [](Value const& e) { return e.is_number(); });
    };
    auto const inline_text = [&](Value const& v) -> std::string {
        if (auto const* const s = std::get_if<std::string>(&v.data))
            return *s;
        if (!flat(v))
            return scalar(v);
        std::string list;
        for (Value const& entry : std::get<Array>(v.data))
            list += (list.empty() ? "" : ", ") + scalar(entry);
        return list;
    };
    if (auto const* const table = std::get_if<Table>(&value.data)) {
        for (auto const& [key, entry] : *table) {
            bool const nested = std::holds_alternative<Table>(entry.data) ||
                                (std::holds_alternative<Array>(entry.data) && !flat(entry));
            out << margin << key << ":" << (nested ? "" : " " + inline_text(entry)) << "\n";
            if (nested)
                write(out, entry, indent + 2);
        }
    } else if (auto const* const array = std::get_if<Array>(&value.data)) {
        for (Value const& entry : *array) {
            if (std::holds_alternative<Table>(entry.data)) {
                std::ostringstream inner;
                write(inner, entry, indent + 2);
                std::string lines = inner.str();
                lines.replace(static_cast<std::size_t>(indent), 2, "- ");
                out << lines;
            } else {
                out << margin << "- " << inline_text(entry) << "\n";
            }
        }
    }
}

Value list_of(std::vector<std::string> const& strings) {
    Array array;
    for (std::string const& s : strings)
        array.push_back(text(s));
    return {std::move(array), {}};
}

} // namespace

Value check_experiment(ExperimentSource const& source) {
    Experiment const experiment = read_experiment(source.tree, source.file);
    Scene const scene = build_scene(experiment);
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, experiment.trace.seed);
    Census const census = pilot(scene, optics, emission, experiment.trace);

    Table objects, media, sources, detectors, models;
    for (Body const& body : scene.bodies) {
        if (body.detector)
            continue;
        objects.emplace_back(
            body.name, text(body.open ? "open surface" : "body of " + scene.media[body.medium.value].name));
        if (body.mesh)
            models.emplace_back(body.name, mesh_health(*body.mesh));
    }
    for (std::uint32_t m = 0; m < scene.media.size(); ++m) {
        Table indices;
        for (std::uint32_t w = 0; w < optics.wavelengths().size(); ++w) {
            char name[32];
            std::snprintf(name, sizeof name, "%.10g nm", optics.wavelengths()[w] * 1e9);
            indices.emplace_back(name, Value{optics.index({m}, {w}), {}});
        }
        media.emplace_back(scene.media[m].name, Value{std::move(indices), {}});
    }
    for (std::size_t s = 0; s < scene.sources.size(); ++s)
        sources.emplace_back(
            scene.sources[s].name,
            Value{Table{{"rays", whole(emission.first_rays()[s + 1] - emission.first_rays()[s])},
                        {"starts_in", text(census.sources[s].starts_in)},
                        {"pilot_rays", whole(census.sources[s].rays)},
                        {"pilot_rays_that_meet_something", whole(census.sources[s].met_something)}},
                  {}});
    for (std::size_t d = 0; d < scene.detectors.size(); ++d)
        detectors.emplace_back(scene.detectors[d].name,
                               Value{Table{{"pilot_hits", whole(census.detector_hits[d])},
                                           {"pilot_hits_from_behind", whole(census.detector_backs[d])}},
                                     {}});
    std::vector<std::string> contacts;
    for (auto const& [one, other] : scene.bvh->contacts())
        contacts.push_back(scene.faces[one.value].name + " touches " + scene.faces[other.value].name);
    std::vector<std::string> warnings = scene.warnings;
    add_warnings(warnings, scene, census);
    return {Table{{"title", text(experiment.title)},
                  {"objects", {std::move(objects), {}}},
                  {"media", {std::move(media), {}}},
                  {"contacts", list_of(contacts)},
                  {"sources", {std::move(sources), {}}},
                  {"detectors", {std::move(detectors), {}}},
                  {"models", {std::move(models), {}}},
                  {"warnings", list_of(warnings)}},
            {}};
}

Value check_model(std::filesystem::path const& file) {
    Model const model = read_model(file);
    Table materials, models;
    std::vector<std::string> instances, warnings = model.warnings;
    if (!model.in_metres)
        warnings.insert(warnings.begin(), file.string() +
                                              ": does not say what its lengths are in: taken as "
                                              "metres here; an experiment must give a length_unit");
    for (ModelMaterial const& material : model.materials) {
        char line[160];
        std::snprintf(line, sizeof line, "transmission %g, index %g, metallic %g, %s", material.transmission,
                      material.ior, material.metallic, material.volume ? "a body (volume)" : "no volume");
        materials.emplace_back(material.name, text(line));
        for (std::string const& warning : material.warnings)
            warnings.push_back(warning);
    }
    for (ModelInstance const& instance : model.instances)
        instances.push_back(instance.name + " (mesh " + model.meshes[instance.mesh].name + ")");
    for (std::size_t i = 0; i < model.meshes.size(); ++i) {
        Mesh const mesh = make_mesh(model.meshes[i].soup);
        std::string const name =
            model.meshes[i].name.empty() ? "mesh " + std::to_string(i) : model.meshes[i].name;
        models.emplace_back(name, mesh_health(mesh));
        if (!mesh.closed())
            warnings.push_back(
                name + ": not closed: it has no inside, and rays that find a hole will be counted as leaks");
    }
    return {Table{{"file", text(file.string())},
                  {"instances", list_of(instances)},
                  {"materials", {std::move(materials), {}}},
                  {"models", {std::move(models), {}}},
                  {"warnings", list_of(warnings)}},
            {}};
}

std::string check_text(Value const& report) {
    std::ostringstream out;
    write(out, report, 0);
    return out.str();
}

} // namespace sahl
