// In: nothing. Out: what a picture of a scene needs beside the scene: camera, lights, background, and how it
// is made; plain data in SI units, in the world. Colours are linear red, green and blue.
#pragma once

#include "math/vec.h"
#include "scene/value.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sahl {

/// Looks along `forward`; columns run to the right, rows down.
struct Camera {
    dvec3 at{0.0};
    dvec3 forward{0.0, 0.0, -1.0}, up{0.0, 1.0, 0.0}; // unit, orthogonal
    double fov = 0.0;                                 // rad, from bottom to top; 0: orthographic
    double height = 0.0;                              // m, from bottom to top, of an orthographic one
    double lens_radius = 0.0;                         // m; 0: everything is sharp
    double focus = 1.0;                               // m along `forward`: what is sharp
    std::uint32_t columns = 640, rows = 480;

    dvec3 right() const { return cross(forward, up); }
};

struct PointLight {
    dvec3 at{0.0};
};
/// Full within the inner cone, falling smoothly to nothing at the outer one.
struct SpotLight {
    dvec3 at{0.0}, toward{0.0};      // toward: unit
    double inner = 0.0, outer = 0.0; // rad, half angles, 0 ≤ inner ≤ outer ≤ π
};
struct DirectionalLight {
    dvec3 toward{0.0}; // unit, along travel
};

struct Light {
    std::variant<PointLight, SpotLight, DirectionalLight> kind;
    dvec3 intensity{1.0}; // what a white surface shows that faces it
    double falloff =
        0.0; // m: where the intensity is as given, with the inverse square; 0: the same everywhere
    double radius = 0.0; // m, of the lamp as it is seen; of a directional one rad, half its angle; 0: unseen
};

struct Background {
    dvec3 color{0.0};            // all around, or at and below the horizon
    std::optional<dvec3> zenith; // straight up; in between they are blended
    dvec3 up{0.0, 1.0, 0.0};     // unit: where the zenith, and the top of the image, is
    std::string image;           // a picture all around (equirectangular), or empty
    double turn = 0.0;           // rad, of the image about `up`
    Place place;
};

enum class SamplePattern { regular, jittered, sobol };
enum class PixelFilter { box, tent, gaussian, mitchell };
/// What stands between a surface and a lamp: glass attenuates; anything blocks; or, in shadow of all lamps, a
/// surface shows its ambient colour alone and no rays go on from it.
enum class Shadows { glass, hard, ambient_only };

/// Light of the experiment's sources, traced to a detector and added to the paint that it lies on.
struct Caustics {
    std::string detector;
    double white = 1.0; // W/m²: where white paint shows 1
    Place place;
};

struct PictureOptions {
    std::uint32_t samples = 16; // rays for each pixel
    SamplePattern pattern = SamplePattern::sobol;
    PixelFilter filter = PixelFilter::gaussian;
    double adaptive = 0.0; // > 0: only pixels that differ from a neighbour by more than this get all samples
    Shadows shadows = Shadows::glass;
    dvec3 ambient{1.0};            // light from everywhere, on `ambient` of paint
    std::uint32_t wavelengths = 0; // traced for each sample; 0: as many as the scene needs
    std::optional<Caustics> caustics{};
    bool half_exr = false; // colours of an EXR in 16 bits
    double exposure = 0.0; // stops, applied to the PNG
    bool filter_textures =
        true; // patterns and pictures on surfaces are averaged over what a sample stands for
};

struct Picture {
    std::optional<Camera> camera;
    std::vector<Light> lights;
    Background background;
    PictureOptions options;
};

} // namespace sahl
