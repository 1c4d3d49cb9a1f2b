// In: nothing. Out: the keys of pictures: camera, lights, background, and how a picture is made.
#include "scene/keys.h"

namespace sahl {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range above_zero{0.0, infinity, true};
constexpr Range not_negative{0.0};

constexpr Key camera_keys[] = {
    {"at_mm", Kind::three, Required{}, "where it stands"},
    {"look_at_mm", Kind::three, Required{}, "what is in the middle of the picture"},
    {"up", Kind::three, {}, "what is up in the picture; absent: y"},
    {"fov_deg", Kind::number, 35.0, "the angle of view from bottom to top", {0.0, 179.0, true}},
    {"height_mm",
     Kind::number,
     {},
     "instead of `fov_deg`: an orthographic camera, that sees this much from bottom to top",
     above_zero},
    {"resolution", Kind::two, {}, "pixels across and down; absent: 640 × 480", {1.0, 32768.0}},
    {"samples", Kind::integer, 16.0, "rays for each pixel", {1.0, 65536.0}},
    {"aperture_mm", Kind::number, 0.0, "diameter of the lens; 0: everything is sharp", not_negative},
    {"focus_mm", Kind::number, {}, "how far away things are sharp; absent: at `look_at_mm`", above_zero},
};

constexpr Key light_keys[] = {
    {"point", Kind::table, {}, "a lamp at a point"},
    {"spot", Kind::table, {}, "or one that shines into a cone"},
    {"directional", Kind::table, {}, "or one that is far away, such as the sun"},
    {"intensity", Kind::three, Repeated{3, 1.0}, "red, green, blue: what a white surface shows that faces it",
     not_negative},
    {"falloff_mm",
     Kind::number,
     {},
     "the distance at which `intensity` holds, with the inverse square of the distance; absent: it holds at "
     "any distance",
     above_zero},
    {"radius_mm", Kind::number, 0.0,
     "of the lamp as it is seen, in glass and mirrors too; 0: it is not seen itself", not_negative},
    {"angle_deg",
     Kind::number,
     0.0,
     "of a directional light: how wide its disc is in the sky; 0: unseen",
     {0.0, 90.0}},
};

constexpr Key light_point_keys[] = {
    {"at_mm", Kind::three, Required{}, "where it is"},
};

constexpr Key light_spot_keys[] = {
    {"at_mm", Kind::three, Required{}, "where it is"},
    {"toward", Kind::three, Required{}, "the axis of its cone, of any length"},
    {"half_angle_deg", Kind::number, 30.0, "beyond it there is no light", {0.0, 180.0, true}},
    {"inner_deg",
     Kind::number,
     0.0,
     "up to this angle the light is full, then it falls smoothly",
     {0.0, 180.0}},
};

constexpr Key light_directional_keys[] = {
    {"toward", Kind::three, Required{}, "where its light goes, of any length"},
};

constexpr Key background_keys[] = {
    {"color", Kind::three, {}, "red, green, blue, linear", not_negative},
    {"zenith", Kind::three, {}, "with `color`: what that goes over into toward `up`", not_negative},
    {"image",
     Kind::text,
     {},
     "or a picture all around, equirectangular, its top toward `up`, relative to the experiment's file"},
    {"turn_deg", Kind::number, 0.0, "of the image, about `up`"},
    {"up", Kind::three, {}, "absent: that of the camera, or y"},
};

constexpr Key picture_keys[] = {
    {"pattern", Kind::text, "sobol",
     "where in a pixel its samples lie: \"regular\", \"jittered\" or \"sobol\" (of low discrepancy)"},
    {"filter", Kind::text, "gaussian",
     "how they are weighed: \"box\", \"tent\", \"gaussian\" or \"mitchell\" (sharp)"},
    {"adaptive", Kind::number, 0.0,
     "above 0: pixels get a quarter of their samples, and all of them where they differ from a neighbour by "
     "more than this, in sRGB from 0 to 1",
     not_negative},
    {"shadows", Kind::text, "glass",
     "\"glass\": on its straight way from a lamp light is attenuated by glass, by Fresnel and absorption; "
     "\"hard\": anything throws a black shadow; \"ambient\": so too, and what is in shadow of all lamps "
     "shows "
     "its ambient colour alone, reflecting nothing"},
    {"ambient", Kind::three, Repeated{3, 1.0}, "the light that falls from everywhere on `ambient` of paint",
     not_negative},
    {"wavelengths",
     Kind::integer,
     0.0,
     "traced for each sample; 0: one tree of rays for all colours, or 6 where a medium "
     "disperses; 1: one tree even then",
     {0.0, 64.0}},
    {"caustics", Kind::table, {}, "adds light of the sources, traced to a detector, to the paint it lies on"},
    {"exr", Kind::text, "float", "colours of an EXR: \"float\" (32 bits) or \"half\" (16 bits)"},
    {"filter_textures", Kind::truth, true,
     "patterns and pictures on surfaces are averaged over what a sample stands for; false: seen at a point"},
    {"exposure", Kind::number, 0.0, "stops by which the PNG is brighter: 1 doubles", {-32.0, 32.0}},
};

constexpr Key caustics_keys[] = {
    {"detector", Kind::text, Required{},
     "a rectangular detector of this experiment, which lies on paint and faces what is to light it"},
    {"white_W_per_mm2", Kind::number, Required{},
     "the irradiance, by light of the sources' own colour, at which white paint shows 1", above_zero},
};

} // namespace

KeyTable const keys::camera{"[camera]", "For pictures; it has no part in tracing.", camera_keys};
KeyTable const keys::light{
    "[[light]]", "For pictures; it has no part in tracing. Exactly one of point, spot and directional.",
    light_keys};
KeyTable const keys::light_point{"light point", "A lamp of a picture that shines everywhere.",
                                 light_point_keys};
KeyTable const keys::light_spot{"light spot", "A lamp of a picture that shines into a cone.",
                                light_spot_keys};
KeyTable const keys::light_directional{"light directional", "A lamp of a picture that is far away.",
                                       light_directional_keys};
KeyTable const keys::background{"[background]", "For pictures: what is seen where nothing is.",
                                background_keys};
KeyTable const keys::picture{
    "[picture]", "How `sahl render` makes a picture; how rays are followed is in [trace].", picture_keys};
KeyTable const keys::caustics{"caustics", "What no ray tree shows: light that comes by way of glass.",
                              caustics_keys};

} // namespace sahl
