// In: the checked tree of a glTF file. Out: its materials, each number in its range.
// From the tree, not from tinygltf: that cuts a whole number in an extension to 32 bits.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace sahl {

namespace {

using gltf::at_least;
using gltf::find;
using gltf::share;

template <std::size_t size>
void read_shares(Value const* list, std::array<double, size>& shares) {
    for (std::size_t i = 0; list && i < size; ++i)
        shares[i] = share(&std::get<Array>(list->data)[i], 0.0);
}

double read_ior(Value const* value) {
    if (at_least(value, 0.0, 1.5, "give 1 or more, or 0 for an ideal mirror") == 0.0)
        return 0.0;
    return at_least(value, 1.0, 1.5, "give 1 or more, or 0 for an ideal mirror");
}

std::optional<ModelVolume> read_volume(Value const* extension) {
    if (!extension)
        return std::nullopt;
    ModelVolume volume;
    volume.thickness_factor = at_least(find(extension, "thicknessFactor"), 0.0, 0.0, "give 0 or more");
    Value const* const distance = find(extension, "attenuationDistance");
    volume.attenuation_distance =
        at_least(distance, 0.0, volume.attenuation_distance, "give a length above 0");
    if (volume.attenuation_distance == 0.0)
        throw InputError(distance->place.text(), "0 lets no light through", "give a length above 0");
    read_shares(find(extension, "attenuationColor"), volume.attenuation_color);
    return volume;
}

AlphaMode read_alpha_mode(Value const* value) {
    std::string const name = value ? std::get<std::string>(value->data) : "OPAQUE";
    if (name != "OPAQUE" && name != "MASK" && name != "BLEND")
        throw InputError(value->place.text(), "there is no mode " + name.substr(0, 40),
                         "write OPAQUE, MASK or BLEND");
    return name == "OPAQUE" ? AlphaMode::opaque : name == "MASK" ? AlphaMode::mask : AlphaMode::blend;
}

/// Extensions of a material that change what it looks like and are not modelled.
constexpr std::pair<std::string_view, std::string_view> left_out[] = {
    {"KHR_materials_iridescence", "its iridescence is not modelled: reflection follows Fresnel's equations"},
    {"KHR_materials_clearcoat", "its clear coat is not modelled"},
    {"KHR_materials_sheen", "its sheen is not modelled"},
    {"KHR_materials_anisotropy", "its anisotropy is not modelled"},
    {"KHR_materials_diffuse_transmission", "its diffuse transmission is not modelled"},
    {"KHR_materials_subsurface", "its subsurface scattering is not modelled"},
    {"KHR_materials_emissive_strength", "it emits no light: name sources in the experiment"},
    {"KHR_materials_unlit", "unlit has no meaning for tracing: it is read as any other material"},
    {"KHR_materials_pbrSpecularGlossiness",
     "its specular-glossiness values are not read; export metallic-roughness"},
};

std::string rounded(double number) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.3g", number);
    return buffer;
}

/// Beside that of the colour.
bool any_texture(Value const* table) {
    if (auto const* const entries = table ? std::get_if<Table>(&table->data) : nullptr)
        for (auto const& [key, value] : *entries)
            if (key.ends_with("Texture") && key != "baseColorTexture")
                return true;
    return false;
}

bool emits(Value const& entry) {
    Value const* const factor = entry.find("emissiveFactor");
    auto const* const list = factor ? std::get_if<Array>(&factor->data) : nullptr;
    return list && std::any_of(list->begin(), list->end(), [](Value const& value) {
               return value.is_number() && at_least(&value, -INFINITY, 0.0, "") > 0.0;
           });
}

void warn_of_what_is_left_out(ModelMaterial& material, Value const& entry) {
    Value const* const pbr = entry.find("pbrMetallicRoughness");
    Value const* const extensions = entry.find("extensions");
    auto const warn = [&](std::string const& what) {
        material.warnings.push_back("material " + material.name + ": " + what);
    };
    bool textures = any_texture(&entry) || any_texture(pbr);
    if (auto const* const all = extensions ? std::get_if<Table>(&extensions->data) : nullptr)
        for (auto const& [name, extension] : *all)
            textures = textures || any_texture(&extension);
    if (textures)
        warn("its textures are not used, but for that of the base colour; the factors are taken for all of "
             "it");
    if (material.color_texture)
        warn(
            "the texture of its base colour shows in pictures alone: tracing takes the factor for all of it");
    bool const shiny = material.transmission > 0.0 || material.metallic > 0.0;
    if (shiny && material.roughness > 0.0)
        warn("its roughness of " + rounded(material.roughness) + " is not modelled: surfaces are smooth");
    if (material.transmission > 0.0 && material.metallic >= 1.0)
        warn("its metallic factor of 1, which is glTF's default, hides its transmission: it is a mirror; for "
             "glass "
             "make it 0");
    if (!pbr || std::get<Table>(pbr->data).empty())
        if (material.transmission == 0.0)
            warn("it says nothing of its substance, which in glTF means a white metal: it reflects all. "
                 "Blender's "
                 "Glass BSDF is exported so; use the Principled BSDF with transmission, or map it with "
                 "materials");
    if (material.alpha_mode == AlphaMode::blend)
        warn(material.transmission > 0.0 ? "its alpha, which is coverage and not glass, is not modelled"
                                         : "alpha blending is coverage, not glass: the share of light that "
                                           "it does not cover goes straight "
                                           "on; for glass export transmission");
    if (material.alpha_mode != AlphaMode::opaque && material.color_texture)
        warn("the alpha of its base colour's texture is not used: the factor's holds for all of it");
    if (emits(entry))
        warn("it emits no light: name sources in the experiment");
    if (find(extensions, "KHR_materials_specular") && material.ior != 0.0)
        warn("its specular factors are not modelled: reflection follows Fresnel's equations");
    for (auto const& [name, text] : left_out)
        if (find(extensions, name))
            warn(std::string(text));
}

void read_specular(ModelMaterial& material, Value const* extension) {
    material.specular = share(find(extension, "specularFactor"), 1.0);
    Value const* const color = find(extension, "specularColorFactor");
    for (std::size_t i = 0; color && i < 3; ++i)
        material.specular_color[i] = at_least(&std::get<Array>(color->data)[i], 0.0, 1.0, "give 0 or more");
}

} // namespace

std::vector<ModelMaterial> gltf_materials(GltfFile const& file, Value const& tree,
                                          tinygltf::Model const& model) {
    GltfTextures textures(file, tree, model);
    std::vector<ModelMaterial> materials;
    Value const* const list = tree.find("materials");
    for (Value const& entry : list ? std::get<Array>(list->data) : Array()) {
        Value const* const pbr = entry.find("pbrMetallicRoughness");
        Value const* const extensions = entry.find("extensions");
        Value const* const sided = entry.find("doubleSided");

        ModelMaterial material;
        material.name = gltf::name_or(entry, "material_" + std::to_string(materials.size()));
        read_shares(find(pbr, "baseColorFactor"), material.base_color);
        material.metallic = share(find(pbr, "metallicFactor"), 1.0);
        material.roughness = share(find(pbr, "roughnessFactor"), 1.0);
        material.transmission =
            share(find(find(extensions, "KHR_materials_transmission"), "transmissionFactor"), 0.0);
        material.ior = read_ior(find(find(extensions, "KHR_materials_ior"), "ior"));
        material.dispersion = at_least(find(find(extensions, "KHR_materials_dispersion"), "dispersion"), 0.0,
                                       0.0, "give 20 / V_d, or 0 for none");
        material.color_texture = textures.of(find(pbr, "baseColorTexture"));
        read_specular(material, find(extensions, "KHR_materials_specular"));
        material.volume = read_volume(find(extensions, "KHR_materials_volume"));
        material.alpha_mode = read_alpha_mode(entry.find("alphaMode"));
        material.alpha_cutoff = at_least(entry.find("alphaCutoff"), 0.0, 0.5, "give 0 or more");
        material.double_sided = sided && std::get<bool>(sided->data);
        material.extras = gltf::extras_of(entry);
        warn_of_what_is_left_out(material, entry);
        materials.push_back(std::move(material));
    }
    return materials;
}

} // namespace sahl
