#include "run/model_substance.h"

#include "math/overloaded.h"
#include "run/values.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

// m: the lines that V_d = (n_d − 1)/(n_F − n_C) is made of (helium; hydrogen), as glass makers print them
constexpr double d_line = 587.5618e-9, f_line = 486.1327e-9, c_line = 656.2725e-9;

struct Band { // where a colour's number holds (see materials/colour.h), as far as it is seen
    double from, to;
};
constexpr std::array<Band, 3> bands{
    {{580e-9, 700e-9}, {490e-9, 580e-9}, {400e-9, 490e-9}}}; // red, green, blue

Colour over_bands(double (*at)(void const*, double), void const* what) {
    Colour mean{};
    constexpr int samples = 16;
    for (std::size_t i = 0; i < 3; ++i)
        for (int k = 0; k < samples; ++k)
            mean[i] +=
                at(what, bands[i].from + (bands[i].to - bands[i].from) * (k + 0.5) / samples) / samples;
    return mean;
}

Colour absorption(Medium const& medium) {
    if (medium.absorption.size() == 1)
        return {medium.absorption[0].second, medium.absorption[0].second, medium.absorption[0].second};
    return over_bands(
        [](void const* of_medium, double wavelength) {
            return absorption_coefficient(*static_cast<Medium const*>(of_medium), wavelength);
        },
        &medium);
}

/// R = |(n − 1)/(n + 1)|² of n + ik, from air.
Colour reflectance(Metal const& metal) {
    return over_bands(
        [](void const* of_metal, double wavelength) {
            auto const n = complex_index(*static_cast<Metal const*>(of_metal), wavelength);
            return std::norm((n - 1.0) / (n + 1.0));
        },
        &metal);
}

void paint(ModelMaterial& material, Colour const& colour) {
    material.base_color = {colour[0], colour[1], colour[2], 1.0};
}

/// mirrored = metallic · base, clear = 1 − metallic, transmitted = transmission · base.
void tint(ModelMaterial& material, double clear, Colour const& transmitted, Colour const& mirrored) {
    double const most = *std::max_element(transmitted.begin(), transmitted.end());
    material.metallic = 1.0 - clear;
    if (clear == 0.0) {
        paint(material, mirrored);
        material.volume.reset();
        material.transmission = 0.0;
    } else if (most > 0.0) {
        material.transmission = most;
        paint(material, {transmitted[0] / most, transmitted[1] / most, transmitted[2] / most});
    } else {
        material.transmission = 0.0;
        material.volume.reset();
    }
}

void make_opaque(ModelMaterial& material) {
    material.transmission = 0.0;
    material.volume.reset();
    material.dispersion = 0.0;
    material.ior = 1.5;
}

} // namespace

ModelMaterial glass_material(Medium const& medium, double thickness) {
    ModelMaterial material;
    material.name = medium.name;
    material.metallic = material.roughness = 0.0;
    material.transmission = 1.0;
    double const nd = refractive_index(medium.index, d_line);
    material.ior = std::max(1.0, nd);
    if (auto const* const abbe = std::get_if<AbbeIndex>(&medium.index)) {
        material.ior = abbe->nd;
        material.dispersion = 20.0 / abbe->vd;
    } else if (disperses(medium.index) && nd > 1.0) {
        double const spread = refractive_index(medium.index, f_line) - refractive_index(medium.index, c_line);
        material.dispersion = std::isfinite(spread) ? std::max(0.0, 20.0 * spread / (nd - 1.0)) : 0.0;
    }
    material.volume.emplace();
    material.volume->thickness_factor = thickness;
    Colour const alpha = absorption(medium);
    double const most = *std::max_element(alpha.begin(), alpha.end());
    if (most > 0.0) {
        material.volume->attenuation_distance = 1.0 / most;
        for (std::size_t i = 0; i < 3; ++i)
            material.volume->attenuation_color[i] = std::exp(-alpha[i] / most);
    }
    material.extras = to_json(of(Table{{"sahl_medium", of(medium.name)}}));
    return material;
}

ModelMaterial surface_material(Surface const& surface, Scene const& scene, MediumId medium,
                               double thickness) {
    ModelMaterial material = glass_material(scene.media[medium.value], thickness);
    material.extras =
        to_json(of(Table{{"sahl_medium", of(material.name)}, {"sahl_surface", of(surface.name)}}));
    material.name = surface.name;
    std::visit(Overloaded{
                   [&](Metal const& metal) {
                       make_opaque(material);
                       material.metallic = 1.0;
                       paint(material, reflectance(metal));
                   },
                   [&](Shares const& s) { // no word for it: a mirror that covers a part
                       double const rest = 1.0 - s.reflect;
                       double const through = rest > 0.0 ? std::min(1.0, s.transmit / rest) : 0.0;
                       tint(material, rest, {through, through, through}, {1.0, 1.0, 1.0});
                   },
                   [&](Absorber const&) {
                       make_opaque(material);
                       paint(material, {0.0, 0.0, 0.0});
                       material.roughness = 1.0;
                   },
                   [&](Diffuse const& d) {
                       make_opaque(material);
                       paint(material, {d.reflectance, d.reflectance, d.reflectance});
                       material.roughness = 1.0;
                   },
                   [&](Paint const& p) {
                       make_opaque(material);
                       paint(material, p.diffuse);
                       material.roughness = 1.0;
                       if (p.covers < 1.0) {
                           material.alpha_mode = AlphaMode::blend;
                           material.base_color[3] = p.covers;
                       }
                   },
                   [&](Tinted const& t) { tint(material, t.clear, t.transmitted, t.mirrored); },
                   [&](ThinWall const& t) {
                       material = glass_material(scene.media[t.wall.value], thickness);
                       material.name = surface.name;
                       tint(material, t.clear, t.transmitted, t.mirrored);
                       material.volume.reset();
                   },
               },
               surface.kind);
    return material;
}

} // namespace sahl
