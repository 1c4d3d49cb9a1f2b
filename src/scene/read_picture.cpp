#include "scene/read_picture.h"

#include "math/input_error.h"
#include "scene/read_file.h"
#include "scene/read_transform.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sahl {

namespace {

constexpr double radian = std::numbers::pi / 180.0;
constexpr double most_pixels = 268435456.0; // 2²⁸: their sums fill 16 GiB

Affine const nowhere{}; // cameras and lights belong to no group

std::uint32_t whole(Fields const& fields, std::string_view key) {
    return static_cast<std::uint32_t>(fields.integer(key));
}

void read_resolution(Fields const& fields, Camera& camera) {
    if (!fields.has("resolution"))
        return;
    auto const pixels = fields.numbers("resolution");
    if (pixels[0] != std::floor(pixels[0]) || pixels[1] != std::floor(pixels[1]))
        throw InputError(fields.place("resolution").text(), fields.called("resolution") + " holds a fraction",
                         "give two whole numbers");
    if (pixels[0] * pixels[1] > most_pixels)
        throw InputError(fields.place("resolution").text(),
                         fields.called("resolution") + " makes more than 2^28 pixels", "give fewer");
    camera.columns = static_cast<std::uint32_t>(pixels[0]);
    camera.rows = static_cast<std::uint32_t>(pixels[1]);
}

Camera read_camera(Fields const& fields) {
    Camera camera;
    camera.at = metres(fields.numbers("at_mm"));
    dvec3 const along = metres(fields.numbers("look_at_mm")) - camera.at;
    double const distance = length(along);
    if (!(distance > 0.0) || !std::isfinite(distance))
        throw InputError(fields.place("look_at_mm").text(), "the camera looks at where it stands",
                         "give look_at_mm another place than at_mm");
    camera.forward = along / distance;
    dvec3 const up = fields.has("up") ? vector_of(fields.numbers("up")) : dvec3(0.0, 1.0, 0.0);
    if (fields.has("up") && length(cross(up, camera.forward)) <= 1e-12 * length(up))
        throw InputError(fields.place("up").text(), "the camera's up is along its view, or has no length",
                         "give another direction");
    camera.up = perpendicular_to(camera.forward, up);
    if (fields.has("height_mm")) {
        if (fields.has("fov_deg"))
            fields.only_one_of({"fov_deg", "height_mm"});
        camera.height = metres(fields.number("height_mm"));
    } else {
        camera.fov = fields.number("fov_deg") * radian;
    }
    camera.lens_radius = 0.5 * metres(fields.number("aperture_mm"));
    camera.focus = fields.has("focus_mm") ? metres(fields.number("focus_mm")) : distance;
    read_resolution(fields, camera);
    return camera;
}

SpotLight read_spot(Value const& table) {
    Fields const fields(table, keys::light_spot);
    SpotLight spot{metres(fields.numbers("at_mm")), read_direction(fields, "toward", nowhere),
                   fields.number("inner_deg") * radian, fields.number("half_angle_deg") * radian};
    if (spot.inner > spot.outer)
        throw InputError(fields.place("inner_deg").text(), "the inner cone is wider than the whole",
                         "make inner_deg at most half_angle_deg");
    return spot;
}

Light read_light(Value const& table) {
    Fields const fields(table, keys::light);
    Light light;
    light.intensity = vector_of(fields.numbers("intensity"));
    std::string const kind = fields.only_one_of({"point", "spot", "directional"});
    if (kind == "point")
        light.kind = PointLight{metres(Fields(fields.at("point"), keys::light_point).numbers("at_mm"))};
    else if (kind == "spot")
        light.kind = read_spot(fields.at("spot"));
    else
        light.kind = DirectionalLight{
            read_direction(Fields(fields.at("directional"), keys::light_directional), "toward", nowhere)};
    if (fields.has("falloff_mm")) {
        if (kind == "directional")
            throw InputError(fields.place("falloff_mm").text(), "a directional light has no distance",
                             "leave falloff_mm out");
        light.falloff = metres(fields.number("falloff_mm"));
    }
    char const* const other = kind == "directional" ? "radius_mm" : "angle_deg";
    if (fields.has(other))
        throw InputError(fields.place(other).text(),
                         fields.called(other) + " has no meaning for a " + kind + " light",
                         kind == "directional" ? "give angle_deg" : "give radius_mm");
    light.radius = kind == "directional" ? 0.5 * fields.number("angle_deg") * radian
                                         : metres(fields.number("radius_mm"));
    return light;
}

Background read_background(Fields const& fields, dvec3 const& up, std::filesystem::path const& folder) {
    Background background;
    background.place = fields.place();
    background.up = fields.has("up") ? read_direction(fields, "up", nowhere) : up;
    std::string const kind = fields.only_one_of({"color", "image"});
    if (kind == "image") {
        if (fields.has("zenith"))
            throw InputError(fields.place("zenith").text(), "an image has its own zenith",
                             "leave zenith out, or give color instead of image");
        background.image = existing_file(folder, fields.text("image"), fields.place("image")).string();
        background.place = fields.place("image");
        background.turn = fields.number("turn_deg") * radian;
        return background;
    }
    background.color = vector_of(fields.numbers("color"));
    if (fields.has("zenith"))
        background.zenith = vector_of(fields.numbers("zenith"));
    return background;
}

PictureOptions read_how(Fields const& fields) {
    PictureOptions options;
    options.pattern = fields.choice<SamplePattern>("pattern", {{"regular", SamplePattern::regular},
                                                               {"jittered", SamplePattern::jittered},
                                                               {"sobol", SamplePattern::sobol}});
    options.filter = fields.choice<PixelFilter>("filter", {{"box", PixelFilter::box},
                                                           {"tent", PixelFilter::tent},
                                                           {"gaussian", PixelFilter::gaussian},
                                                           {"mitchell", PixelFilter::mitchell}});
    options.adaptive = fields.number("adaptive");
    options.shadows = fields.choice<Shadows>(
        "shadows", {{"glass", Shadows::glass}, {"hard", Shadows::hard}, {"ambient", Shadows::ambient_only}});
    options.ambient = vector_of(fields.numbers("ambient"));
    options.wavelengths = whole(fields, "wavelengths");
    if (fields.has("caustics")) {
        Fields const caustics(fields.at("caustics"), keys::caustics);
        options.caustics = Caustics{caustics.text("detector"), caustics.number("white_W_per_mm2") * 1e6,
                                    caustics.place("detector")};
    }
    options.half_exr = fields.choice<bool>("exr", {{"float", false}, {"half", true}});
    options.exposure = fields.number("exposure");
    options.filter_textures = fields.truth("filter_textures");
    return options;
}

} // namespace

Picture read_picture(Value const& tree, std::filesystem::path const& folder) {
    static Value const empty = empty_table();
    Picture picture;
    Value const* const how = tree.find("picture");
    picture.options = read_how(Fields(how ? *how : empty, keys::picture));
    dvec3 up(0.0, 1.0, 0.0);
    if (Value const* const table = tree.find("camera")) {
        Fields const fields(*table, keys::camera);
        picture.camera = read_camera(fields);
        picture.options.samples = whole(fields, "samples");
        if (fields.has("up"))
            up = normalize(vector_of(fields.numbers("up")));
    }
    for (Value const& light : tables_in(tree, "light"))
        picture.lights.push_back(read_light(light));
    picture.background.up = up;
    if (Value const* const table = tree.find("background"))
        picture.background = read_background(Fields(*table, keys::background), up, folder);
    return picture;
}

} // namespace sahl
