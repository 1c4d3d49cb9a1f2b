#include "scene/model_material.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace sahl {

namespace {

Colour times(double factor, Colour const& colour) {
    return {factor * colour[0], factor * colour[1], factor * colour[2]};
}

Colour base(ModelMaterial const& material) {
    return {material.base_color[0], material.base_color[1], material.base_color[2]};
}

bool is_grey(Colour const& colour) {
    return colour[0] == colour[1] && colour[1] == colour[2];
}

/// T = colour^(x / distance) is Beer–Lambert's law with α = −ln(colour) / distance, in each band of its own.
std::vector<std::pair<double, double>> absorption_of(ModelVolume const& volume, double metres_per_unit) {
    if (!std::isfinite(volume.attenuation_distance))
        return {};
    Colour alpha{};
    for (std::size_t i = 0; i < 3; ++i) {
        // a colour of 0 would absorb without end: what a double's smallest normal number leaves is black
        // enough
        double const colour = std::max(volume.attenuation_color[i], std::numeric_limits<double>::min());
        alpha[i] = std::max(0.0, -std::log(colour)) / (volume.attenuation_distance * metres_per_unit);
    }
    if (alpha == Colour{})
        return {};
    double const step = 1e-12; // m: bands end as sharply as a table can say
    return {{blue_to_green - step, alpha[2]},
            {blue_to_green, alpha[1]},
            {green_to_red - step, alpha[1]},
            {green_to_red, alpha[0]}};
}

/// Of the light from everywhere, as a corner of a room has it: files speak of lamps alone, and what no lamp
/// reaches is not black.
constexpr double ambient_share = 0.35;

/// The share of the surface that is there at all (alphaMode: coverage).
double coverage(ModelMaterial const& material) {
    double const alpha = material.base_color[3];
    return material.alpha_mode == AlphaMode::opaque  ? 1.0
           : material.alpha_mode == AlphaMode::blend ? alpha
           : alpha >= material.alpha_cutoff          ? 1.0
                                                     : 0.0;
}

/// What is reflected as by a mirror: the metal's share, and at ior 0 the share of the specular reflection.
Colour mirrored(ModelMaterial const& material) {
    Colour colour = times(material.metallic, base(material));
    for (std::size_t i = 0; i < 3 && material.ior == 0.0; ++i)
        colour[i] +=
            (1.0 - material.metallic) * material.specular * std::min(1.0, material.specular_color[i]);
    return colour;
}

/// A material through which no light goes: metal, mirror or paint; where it covers less than all, the rest
/// goes straight on.
decltype(Surface::kind) opaque_kind(ModelMaterial const& material) {
    double const covers = coverage(material);
    Colour const mirror = times(covers, mirrored(material));
    if (mirror == Colour{} && covers > 0.0)
        return Paint{times(ambient_share, base(material)), base(material), {}, 1.0, 0.0, {}, {}, covers};
    if (covers < 1.0)
        return Tinted{1.0 - covers, {1.0, 1.0, 1.0}, mirror};
    return Tinted{0.0, {1.0, 1.0, 1.0}, mirror};
}

constexpr char const* bands = "colours of three numbers hold over bands of wavelength: blue below 490 nm, "
                              "green below 580 nm, red above";

std::string percent(double share) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.3g %%", 100.0 * share);
    return buffer;
}

} // namespace

bool is_glass(ModelMaterial const& material) {
    return material.transmission > 0.0 && material.metallic < 1.0 && material.ior != 0.0;
}

void MaterialBook::warn(std::string const& text) {
    std::string line = object_ + ": " + text;
    if (std::find(scene_.warnings.begin(), scene_.warnings.end(), line) == scene_.warnings.end())
        scene_.warnings.push_back(std::move(line));
}

SurfaceId MaterialBook::add(ModelMaterial const& material, std::string const& name, Surface surface) {
    for (std::uint32_t i = 0; i < scene_.surfaces.size(); ++i)
        if (scene_.surfaces[i].name == name)
            return {i};
    surface.name = name;
    if (auto const& texture = material.color_texture) {
        surface.texture = TextureId{static_cast<std::uint32_t>(scene_.textures.size())};
        scene_.textures.push_back({texture->file, texture->bytes, texture->place, texture->problem,
                                   texture->across, texture->up, true});
    }
    scene_.surfaces.push_back(std::move(surface));
    return {static_cast<std::uint32_t>(scene_.surfaces.size() - 1)};
}

MediumId MaterialBook::medium(ModelMaterial const& material) {
    std::string const name = object_ + ":" + material.name;
    for (std::uint32_t i = 0; i < scene_.media.size(); ++i) // shared by the bodies that have it
        if (scene_.media[i].name == name)
            return {i};
    Medium medium;
    medium.name = name;
    medium.index = ConstantIndex{material.ior == 0.0 ? 1.0 : material.ior};
    if (material.dispersion > 0.0 && material.ior > 1.0)
        medium.index = AbbeIndex{material.ior, 20.0 / material.dispersion};
    if (material.volume) {
        medium.absorption = absorption_of(*material.volume, metres_per_unit_);
        if (!is_grey(material.volume->attenuation_color))
            warn(bands);
    }
    scene_.media.push_back(std::move(medium));
    return {static_cast<std::uint32_t>(scene_.media.size() - 1)};
}

void MaterialBook::warn_of_tint(ModelMaterial const& material, bool thin) {
    Colour const colour = base(material);
    bool const grey = is_grey(colour);
    if (!grey)
        warn(bands);
    if (!is_glass(material) || (colour == Colour{1.0, 1.0, 1.0} && material.transmission == 1.0))
        return;
    Colour const lost = {1.0 - material.transmission * colour[0], 1.0 - material.transmission * colour[1],
                         1.0 - material.transmission * colour[2]};
    warn("material " + material.name + ": its base colour" +
         (material.transmission < 1.0 ? " and a transmission below 1 take " : " takes ") +
         (grey ? percent(lost[0])
               : percent(lost[0]) + " of the red, " + percent(lost[1]) + " of the green, " +
                     percent(lost[2]) + " of the blue") +
         " of the light that goes through " +
         (thin ? "the thin wall" : "each surface, once going in and once coming out") +
         "; for clear glass make the base colour white and the transmission 1");
}

std::optional<SurfaceId> MaterialBook::boundary(ModelMaterial const& material) {
    warn_of_tint(material, false);
    std::string const name = object_ + ":" + material.name;
    if (!is_glass(material))
        return add(material, name, {{}, opaque_kind(material)});
    Tinted const tinted{1.0 - material.metallic, times(material.transmission, base(material)),
                        mirrored(material)};
    if (tinted.clear == 1.0 && tinted.transmitted == Colour{1.0, 1.0, 1.0} && !material.color_texture)
        return std::nullopt;
    return add(material, name, {{}, tinted});
}

SurfaceId MaterialBook::sheet(ModelMaterial const& material) {
    std::string const name = object_ + ":" + material.name;
    warn_of_tint(material, true);
    if (!is_glass(material))
        return add(material, name, {{}, opaque_kind(material)});
    return add(material, name + " (thin wall)",
               {{},
                ThinWall{medium(material), 1.0 - material.metallic,
                         times(material.transmission, base(material)), mirrored(material)}});
}

SurfaceId MaterialBook::wall(MediumId medium) {
    std::string const name = object_ + ":" + scene_.media[medium.value].name + " (thin wall)";
    return add({}, name, {{}, ThinWall{medium}});
}

} // namespace sahl
