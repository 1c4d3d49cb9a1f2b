// In: the checked tree of a glTF file. Out: its materials, each number in its range.
// From the tree, not from tinygltf: that cuts a whole number in an extension to 32 bits.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <charconv>

namespace sahl {

namespace {

Value const* find(Value const* table, std::string_view key) {
    return table ? table->find(key) : nullptr;
}

double number(Value const& value) {
    auto const* integer = std::get_if<std::int64_t>(&value.data);
    return integer ? static_cast<double>(*integer) : std::get<double>(value.data);
}

std::string text(double number) {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr};
}

double at_least(Value const* value, double low, double otherwise, std::string const& remedy) {
    if (!value)
        return otherwise;
    double const n = number(*value);
    if (n < low)
        throw InputError(value->place.text(), text(n) + " is below " + text(low), remedy);
    return n;
}

double share(Value const* value, double otherwise) {
    double const n = at_least(value, 0.0, otherwise, "give a number from 0 to 1");
    if (n > 1.0)
        throw InputError(value->place.text(), text(n) + " is above 1", "give a number from 0 to 1");
    return n;
}

template <std::size_t size>
void read_shares(Value const* list, std::array<double, size>& shares) {
    for (std::size_t i = 0; list && i < size; ++i)
        shares[i] = share(&std::get<Array>(list->data)[i], 0.0);
}

double read_ior(Value const* value) {
    if (value && number(*value) == 0.0)
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

void warn_of_what_is_left_out(ModelMaterial& material, Value const* pbr, Value const* extensions) {
    auto const warn = [&](std::string const& what) {
        material.warnings.push_back(material.name + ": " + what);
    };
    if (find(pbr, "baseColorTexture"))
        warn("its base colour texture is not read; the factor is taken for all of it");
    if (find(find(extensions, "KHR_materials_transmission"), "transmissionTexture"))
        warn("its transmission texture is not read; the factor is taken for all of it");
    if (material.transmission > 0.0 && material.roughness > 0.0)
        warn("its roughness is left out: surfaces are smooth");
    if (material.alpha_mode == AlphaMode::blend)
        warn("alpha blending is coverage, not glass; for glass export transmission");
}

} // namespace

std::vector<ModelMaterial> gltf_materials(Value const& tree) {
    std::vector<ModelMaterial> materials;
    Value const* const list = tree.find("materials");
    for (Value const& entry : list ? std::get<Array>(list->data) : Array()) {
        Value const* const pbr = entry.find("pbrMetallicRoughness");
        Value const* const extensions = entry.find("extensions");
        Value const* const name = entry.find("name");
        Value const* const sided = entry.find("doubleSided");

        ModelMaterial material;
        material.name = name ? std::get<std::string>(name->data) : "";
        if (material.name.empty())
            material.name = "material_" + std::to_string(materials.size());
        read_shares(find(pbr, "baseColorFactor"), material.base_color);
        material.metallic = share(find(pbr, "metallicFactor"), 1.0);
        material.roughness = share(find(pbr, "roughnessFactor"), 1.0);
        material.transmission =
            share(find(find(extensions, "KHR_materials_transmission"), "transmissionFactor"), 0.0);
        material.ior = read_ior(find(find(extensions, "KHR_materials_ior"), "ior"));
        material.dispersion = at_least(find(find(extensions, "KHR_materials_dispersion"), "dispersion"), 0.0,
                                       0.0, "give 20 / V_d, or 0 for none");
        material.volume = read_volume(find(extensions, "KHR_materials_volume"));
        material.alpha_mode = read_alpha_mode(entry.find("alphaMode"));
        material.double_sided = sided && std::get<bool>(sided->data);
        warn_of_what_is_left_out(material, pbr, extensions);
        materials.push_back(std::move(material));
    }
    return materials;
}

} // namespace sahl
