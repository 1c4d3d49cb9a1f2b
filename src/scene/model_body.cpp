#include "scene/model_body.h"

#include "math/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace sahl {

namespace {

// Where the sRGB primaries' bands meet: a colour of three numbers is taken to hold over red, green and blue
// light.
constexpr double blue_to_green = 490e-9; // m
constexpr double green_to_red = 580e-9;  // m

MediumId add_medium(Scene& scene, Medium medium) {
    scene.media.push_back(std::move(medium));
    return {static_cast<std::uint32_t>(scene.media.size() - 1)};
}

SurfaceId add_surface(Scene& scene, Surface surface) {
    scene.surfaces.push_back(std::move(surface));
    return {static_cast<std::uint32_t>(scene.surfaces.size() - 1)};
}

std::vector<std::pair<double, double>> absorption_of(ModelVolume const& volume) {
    if (!std::isfinite(volume.attenuation_distance))
        return {};
    std::array<double, 3> alpha{};
    bool any = false;
    for (std::size_t i = 0; i < 3; ++i) {
        // a colour of 0 would absorb without end: what a double's smallest normal number leaves is black
        // enough
        double const colour = std::max(volume.attenuation_color[i], std::numeric_limits<double>::min());
        alpha[i] = -std::log(colour) / volume.attenuation_distance;
        any = any || alpha[i] > 0.0;
    }
    if (!any)
        return {};
    double const step = 1e-12; // m: bands end as sharply as a table can say
    return {{blue_to_green - step, alpha[2]},
            {blue_to_green, alpha[1]},
            {green_to_red - step, alpha[1]},
            {green_to_red, alpha[0]}};
}

MediumId medium_of(ModelMaterial const& material, Scene& scene, std::string const& name) {
    for (std::uint32_t i = 0; i < scene.media.size(); ++i) // shared by the faces and bodies that have it
        if (scene.media[i].name == name)
            return {i};
    Medium medium;
    medium.name = name;
    medium.index = ConstantIndex{material.ior == 0.0 ? 1.0 : material.ior};
    if (material.dispersion > 0.0 && material.ior > 1.0)
        medium.index = AbbeIndex{material.ior, 20.0 / material.dispersion};
    if (material.volume)
        medium.absorption = absorption_of(*material.volume);
    return add_medium(scene, std::move(medium));
}

/// Luminance of a linear colour (ITU-R BT.709 weights): the one reflectance that a colour can stand for.
double grey(std::array<double, 4> const& colour) {
    return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2];
}

std::optional<SurfaceId> surface_of(ModelMaterial const& material, Scene& scene, std::string const& name) {
    bool const mirror = material.metallic >= 0.5 || material.ior == 0.0;
    bool const glass = material.transmission > 0.0 && !mirror;
    double const tint = grey(material.base_color);
    if (glass && tint >= 1.0 && material.transmission >= 1.0)
        return std::nullopt;
    for (std::uint32_t i = 0; i < scene.surfaces.size(); ++i)
        if (scene.surfaces[i].name == name)
            return SurfaceId{i};
    if (mirror)
        return add_surface(scene, {name, Shares{tint, 0.0}});
    if (!glass)
        return add_surface(scene, {name, Absorber{}});
    char text[200];
    std::snprintf(text, sizeof text,
                  "%s: its base colour or transmission below 1 would absorb %.0f %% at each surface; it is "
                  "traced as clear glass",
                  name.c_str(), 100.0 * (1.0 - tint * material.transmission));
    if (std::find(scene.warnings.begin(), scene.warnings.end(), text) == scene.warnings.end())
        scene.warnings.push_back(text);
    return std::nullopt;
}

} // namespace

ModelBody body_of(ObjectSpec const& object, ModelReference const& reference, Model const& model,
                  ModelMesh const& mesh, Scene& scene) {
    ModelBody body{object.medium.value_or(scene.surroundings), {}};
    bool has_medium = object.medium.has_value();
    for (auto const& material : mesh.face_material) {
        std::optional<SurfaceId> surface = object.surface;
        if (material) {
            ModelMaterial const& from_file = model.materials[*material];
            auto const mapping =
                std::find_if(reference.materials.begin(), reference.materials.end(),
                             [&](MaterialMapping const& m) { return m.material == from_file.name; });
            std::string const name = object.name + ":" + from_file.name;
            bool const mapped = mapping != reference.materials.end();
            if (mapped) {
                surface = mapping->surface;
                if (mapping->medium)
                    body.medium = *mapping->medium;
                has_medium = has_medium || mapping->medium;
            } else if (!object.medium && !object.surface) {
                surface = surface_of(from_file, scene, name);
                if (!has_medium && from_file.transmission > 0.0) {
                    body.medium = medium_of(from_file, scene, name);
                    has_medium = true;
                }
            }
        }
        body.surfaces.push_back(surface);
    }
    for (std::size_t face = 0; face < body.surfaces.size(); ++face)
        for (auto const& [name, surface] : object.faces)
            if (name == mesh.soup.face_names[face])
                body.surfaces[face] = surface;
    bool const clear =
        std::any_of(body.surfaces.begin(), body.surfaces.end(), [](auto const& s) { return !s; });
    if (clear && !has_medium)
        throw InputError(reference.place.text(),
                         "nothing says what the model of '" + object.name + "' is made of",
                         "give the object a medium, or map the file's materials with materials = {…}");
    return body;
}

bool wants_part(ModelReference const& reference, std::string const& instance) {
    return reference.parts.empty() ||
           std::any_of(reference.parts.begin(), reference.parts.end(),
                       [&](auto const& part) { return part == "*" || part == instance; });
}

InputError no_such_part(ModelReference const& reference, Model const& model) {
    std::vector<std::string> known;
    std::string list;
    for (ModelInstance const& instance : model.instances) {
        known.push_back(instance.name);
        if (known.size() <= 20)
            list += (list.empty() ? "" : ", ") + instance.name;
    }
    if (known.empty())
        return InputError(reference.place.text(), reference.path.string() + " has no mesh in its scene",
                          "export the objects themselves, not only cameras and lights");
    return InputError(reference.place.text(), "none of the parts is in " + reference.path.string(),
                      "it has: " + list + "; nearest to '" + reference.parts.front() + "' is '" +
                          nearest_name(reference.parts.front(), known) + "'");
}

void check_mapping(ModelReference const& reference, Model const& model) {
    std::vector<std::string> known;
    for (ModelMaterial const& material : model.materials)
        known.push_back(material.name);
    for (MaterialMapping const& mapping : reference.materials)
        if (std::find(known.begin(), known.end(), mapping.material) == known.end())
            throw InputError(mapping.place.text(),
                             reference.path.string() + " has no material '" + mapping.material + "'",
                             known.empty() ? "it has no materials: give the object a medium"
                                           : "did you mean '" + nearest_name(mapping.material, known) + "'?");
}

std::string unique_name(Scene const& scene, std::string const& object, std::string node) {
    std::replace(node.begin(), node.end(), '.', '_');
    auto const taken = [&](std::string const& name) {
        return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                           [&](Body const& b) { return b.name == name; });
    };
    std::string const name = object + "." + (node.empty() ? "part" : node);
    if (!taken(name))
        return name;
    for (int number = 2;; ++number)
        if (std::string const numbered = name + "_" + std::to_string(number); !taken(numbered))
            return numbered;
}

Method object_method(Mesh const& mesh, Method asked) {
    if (asked == Method::automatic)
        return mesh.soup.normals.empty() ? Method::facet : Method::interpolated;
    return asked == Method::interpolated && mesh.soup.normals.empty() ? Method::facet : asked;
}

} // namespace sahl
