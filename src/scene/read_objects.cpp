// In: the tables [[object]]. Out: shapes and models with their media, surfaces and places.
#include "scene/read_objects.h"

#include "math/input_error.h"
#include "scene/read_file.h"
#include "scene/read_shape.h"
#include "scene/read_surfaces.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace sahl {

namespace {

struct Names { // what names of the file can mean
    MediaBook& media;
    std::vector<Surface> const& surfaces;
    std::filesystem::path const& folder;
};

std::optional<MediumId> read_medium(Fields const& fields, Names const& names) {
    if (!fields.has("medium"))
        return {};
    return names.media.refer(fields.text("medium"), fields.place("medium"));
}

std::optional<SurfaceId> read_surface(Fields const& fields, Names const& names) {
    if (!fields.has("surface"))
        return {};
    return find_surface(names.surfaces, fields.text("surface"), fields.place("surface"));
}

std::string lower_extension(std::filesystem::path const& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

double read_length_unit(Fields const& fields, std::string const& extension) {
    if (fields.has("length_unit"))
        return fields.choice<double>(
            "length_unit",
            {{"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.0}, {"in", 0.0254}, {"ft", 0.3048}});
    if (extension == ".obj")
        throw InputError(fields.place("model").text(), "an OBJ file does not say what its lengths are in",
                         "give length_unit = \"mm\", or whatever it is");
    return 1.0;
}

std::vector<MaterialMapping> read_materials(Fields const& fields, Names const& names) {
    std::vector<MaterialMapping> mappings;
    if (!fields.has("materials"))
        return mappings;
    for (auto const& [material, table] : std::get<Table>(fields.at("materials").data)) {
        Fields const mapping(table, keys::material);
        if (!mapping.has("medium") && !mapping.has("surface"))
            throw InputError(table.place.text(), "material \"" + material + "\" is mapped to nothing",
                             "give it a medium, a surface or both");
        mappings.push_back(
            {material, read_medium(mapping, names), read_surface(mapping, names), table.place});
    }
    return mappings;
}

ModelReference read_model(Fields const& fields, Names const& names) {
    ModelReference model;
    model.place = fields.place("model");
    std::string const extension = lower_extension(fields.text("model"));
    if (extension != ".obj" && extension != ".gltf" && extension != ".glb")
        throw InputError(model.place.text(), "\"" + fields.text("model") + "\" is no model that can be read",
                         "give a .gltf, .glb or .obj file");
    if (fields.has("faces"))
        throw InputError(fields.place("faces").text(), "a model has no named faces",
                         "use materials or surface");
    model.path = existing_file(names.folder, fields.text("model"), model.place);
    model.metres_per_unit = read_length_unit(fields, extension);
    if (fields.has("parts"))
        for (Value const& part : std::get<Array>(fields.at("parts").data))
            model.parts.push_back(std::get<std::string>(part.data));
    model.materials = read_materials(fields, names);
    if (fields.has("decimate_mm"))
        model.decimate = 1e-3 * fields.number("decimate_mm");
    model.smooth = fields.truth("smooth");
    model.open_walls = fields.truth("open_walls");
    return model;
}

std::vector<std::pair<std::string, SurfaceId>> read_faces(Fields const& fields, Shape const& shape,
                                                          Names const& names) {
    std::vector<std::pair<std::string, SurfaceId>> faces;
    if (!fields.has("faces"))
        return faces;
    auto const known = face_names(shape);
    for (auto const& [face, surface] : std::get<Table>(fields.at("faces").data)) {
        if (std::find(known.begin(), known.end(), face) == known.end())
            throw InputError(surface.place.text(), "this shape has no face '" + face + "'",
                             did_you_mean(face, {known.begin(), known.end()}) + " It has " +
                                 listed({known.begin(), known.end()}));
        if (!has_kind(surface, Kind::text))
            throw InputError(surface.place.text(),
                             "the surface of face '" + face + "' is " + quoted_value(surface),
                             "give the name of a surface");
        faces.emplace_back(face,
                           find_surface(names.surfaces, std::get<std::string>(surface.data), surface.place));
    }
    return faces;
}

/// A closed shape needs a medium unless it is opaque all over; an open one needs a surface and takes no
/// medium.
void check_substance(ObjectSpec const& object, Shape const& shape, Fields const& fields) {
    bool const covered = object.surface || object.faces.size() == face_names(shape).size();
    std::string const who = "object \"" + object.name + "\"";
    if (is_open(shape) && object.medium)
        throw InputError(fields.place("medium").text(),
                         who + " is an open shape, which has no inside for a medium",
                         "leave the medium out and give a surface");
    if (is_open(shape) && !covered)
        throw InputError(object.place.text(), who + " is an open shape without a surface",
                         "give surface = \"…\", the name of one defined under surface");
    if (!is_open(shape) && !object.medium && !covered)
        throw InputError(object.place.text(), who + " has no medium",
                         "give medium = \"N-BK7\" or another, or a surface for all of its faces");
}

/// Motions that are each finite may not be so together.
void check_finite(ObjectSpec const& object) {
    Affine const& map = object.to_world;
    for (dvec3 const& v : {map.linear[0], map.linear[1], map.linear[2], map.offset})
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
            throw InputError(object.place.text(),
                             "object \"" + object.name +
                                 "\" and its groups scale or move it beyond all numbers",
                             "give smaller scales and moves");
}

ObjectSpec read_object(Value const& table, Names const& names, Groups const& groups) {
    Fields const fields(table, keys::object);
    ObjectSpec object;
    object.name = fields.text("name");
    object.place = table.place;
    check_name(object.name, fields.place("name"));
    object.to_world = compose(group_of(fields, groups), read_transform(fields));
    check_finite(object);
    object.medium = read_medium(fields, names);
    object.surface = read_surface(fields, names);
    object.priority = static_cast<int>(fields.integer("priority"));
    if (fields.only_one_of({"shape", "model"}) == "model") {
        object.what = read_model(fields, names);
        return object;
    }
    for (auto const key : {"length_unit", "parts", "materials", "decimate_mm", "smooth", "open_walls"})
        if (fields.has(key))
            throw InputError(fields.place(key).text(),
                             fields.called(key) + " is for models, and this is a shape", "leave it out");
    Shape const shape = read_shape(fields.at("shape"));
    object.what = shape;
    object.faces = read_faces(fields, shape, names);
    check_substance(object, shape, fields);
    return object;
}

} // namespace

std::vector<ObjectSpec> read_objects(Array const& tables, MediaBook& media,
                                     std::vector<Surface> const& surfaces, Groups const& groups,
                                     std::filesystem::path const& folder) {
    std::vector<ObjectSpec> objects;
    for (Value const& table : tables)
        objects.push_back(read_object(table, {media, surfaces, folder}, groups));
    return objects;
}

} // namespace sahl
