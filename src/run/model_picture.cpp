#include "run/model_picture.h"

#include "math/input_error.h"
#include "render/lamps.h"
#include "scene/model_cache.h"
#include "scene/model_picture.h"
#include "scene/read_media.h"
#include "scene/read_transform.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace sahl {

namespace {

namespace fs = std::filesystem;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double fov_deg = 28.0, round_deg = 24.0;
constexpr double least_above_deg = 11.0, more_above_deg = 22.0; // the latter is added over what is flat
constexpr double share_filled = 0.86; // of the picture's height or width, by the box's corners
constexpr double bright = 0.85; // what white shows that faces the lamps: with the ambient light, nearly all

std::string quoted(std::string const& text) {
    return to_json({text, {}}); // a JSON string is a TOML basic string too
}

struct ModelBox {
    dvec3 low{INFINITY}, high{-INFINITY};
};

/// Of all that is in the file, in its unit.
ModelBox bounds_of(Model const& model, fs::path const& file) {
    ModelBox box;
    for (ModelInstance const& instance : model.instances)
        for (dvec3 const& position : model.meshes[instance.mesh].soup.positions) {
            dvec3 const at = instance.to_world.point(position);
            box.low = glm::min(box.low, at);
            box.high = glm::max(box.high, at);
        }
    if (!(length(box.high - box.low) > 0.0))
        throw InputError(file.string(), "there is nothing in it to be seen",
                         "export it again with its meshes");
    return box;
}

std::string list(dvec3 const& v) {
    std::ostringstream text;
    text.precision(12);
    text << "[" << v.x << ", " << v.y << ", " << v.z << "]";
    return text.str();
}

/// How far from the box's middle the camera stands so that all corners are in the picture. The picture is 4
/// : 3.
double distance_to_see(ModelBox const& box, dvec3 const& from) {
    dvec3 const right = normalize(cross(dvec3(0.0, 1.0, 0.0), from)), up = cross(from, right);
    double const slope = share_filled * sin_of_deg(0.5 * fov_deg) / cos_of_deg(0.5 * fov_deg);
    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        dvec3 const half = 0.5 * (box.high - box.low);
        dvec3 const at(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y,
                       corner & 4 ? half.z : -half.z);
        double const wide = std::max(std::abs(dot(at, up)), 0.75 * std::abs(dot(at, right)));
        distance = std::max(distance, dot(at, from) + wide / slope);
    }
    return distance;
}

/// From the middle of the box toward the camera. What is flat is seen more from above.
dvec3 view_of(ModelBox const& box) {
    dvec3 const size = box.high - box.low;
    double const tall = std::min(1.0, 2.0 * size.y / std::max(size.x, size.z));
    double const above = least_above_deg + more_above_deg * (1.0 - tall);
    return {sin_of_deg(round_deg) * cos_of_deg(above), sin_of_deg(above),
            cos_of_deg(round_deg) * cos_of_deg(above)};
}

std::string camera_text(Camera const& camera) {
    std::ostringstream text;
    text.precision(12);
    text << "[camera]\nat_mm = " << list(1e3 * camera.at)
         << "\nlook_at_mm = " << list(1e3 * (camera.at + camera.focus * camera.forward))
         << "\nup = " << list(camera.up);
    if (camera.height > 0.0)
        text << "\nheight_mm = " << 1e3 * camera.height;
    else
        text << "\nfov_deg = " << camera.fov / degree;
    text << "\nresolution = [" << camera.columns << ", " << camera.rows << "]\nsamples = 16\n\n";
    return text.str();
}

/// The file's first camera, or one that sees all of it. Lengths of the box in mm.
Camera camera_for(Model const& model, ModelBox const& box) {
    if (!model.cameras.empty())
        return camera_of(model.cameras.front(), {});
    dvec3 const from = view_of(box), centre = 0.5 * (box.low + box.high);
    Camera camera;
    camera.focus = 1e-3 * distance_to_see(box, from);
    camera.at = 1e-3 * centre + camera.focus * from;
    camera.forward = -from;
    camera.up = perpendicular_to(from, dvec3(0.0, 1.0, 0.0));
    camera.fov = fov_deg * degree;
    return camera;
}

/// Stops by which the picture is brighter so that white in the middle of the box that faces the file's lamps
/// shows what it should: lamps have any number of candelas.
double exposure_for(Model const& model, ModelBox const& box) {
    double light = 0.0;
    for (ModelLight const& of_file : model.lights) {
        LampView const view = view_of(light_of(of_file, {}), 5e-4 * (box.low + box.high));
        light += std::max({view.light.x, view.light.y, view.light.z});
    }
    return light > 0.0 ? std::log2(bright / light) : 0.0;
}

/// Camera, floor, sky and light about a box. Lengths in mm. The floor's squares, the dark of the horizon and
/// the bright of the sky are what glass bends.
std::string stage(Model const& model, ModelBox const& box) {
    dvec3 const centre = 0.5 * (box.low + box.high);
    double const radius = 0.5 * length(box.high - box.low);
    // a floor in contact would be optically glued to the glass
    double const floor = box.low.y - 1e-3 * radius;
    Camera const camera = camera_for(model, box);
    double const exposure = exposure_for(model, box), dim = std::exp2(-exposure);
    std::ostringstream text;
    text.precision(9);
    if (1e3 * camera.at.y > floor)
        text << "[surface.floor]\npaint = {ambient = [0.3, 0.3, 0.3], diffuse = [0.5, 0.5, 0.5], checker = "
                "{size_mm = "
             << 0.4 * radius << ", other = [0.3, 0.36, 0.46]}}\n\n"
             << "[[object]]\nname = \"the floor\"\nshape = {disk = {radius_mm = "
             << std::max(14.0 * radius, 1e3 * length(camera.at - 1e-3 * centre) + 4.0 * radius)
             << "}}\nsurface = \"floor\"\nturn_deg = [-90, 0, 0]\nmove_mm = "
             << list({centre.x, floor, centre.z}) << "\n\n";
    text << camera_text(camera);
    if (model.lights.empty())
        text << "[[light]] # the sun, from the left and from behind the camera\n"
                "directional = {toward = [0.62, -1, -0.48]}\nintensity = "
             << list(bright * dvec3(1.0, 0.96, 0.89)) << "\nangle_deg = 14\n\n";
    text << "[picture] # lamps of the file are as bright as it says, and the picture exposed for "
            "them\nexposure = "
         << exposure << "\nambient = " << list(dim * dvec3(1.0))
         << "\nadaptive = 0.02\n\n[background]\ncolor = " << list(dim * dvec3(0.42, 0.47, 0.54))
         << "\nzenith = " << list(dim * dvec3(0.9, 0.95, 1.02)) << "\n";
    return text.str();
}

ExperimentSource experiment_of(fs::path const& file, std::string const& text) {
    ExperimentSource source;
    source.file = file;
    source.text = text;
    source.tree = parse_toml(text, file.string());
    return source;
}

} // namespace

ExperimentSource model_picture(fs::path const& file, std::string const& glass, ModelCache& models) {
    std::shared_ptr<Model const> const model = models.model(file);
    double const mm = model->in_metres ? 1000.0 : 1.0; // an OBJ's unit is its maker's: its size is only seen
    ModelBox box = bounds_of(*model, file);
    box.low *= mm;
    box.high *= mm;
    auto const with = [&](std::string const& medium) {
        std::string text =
            "title = " + quoted(file.filename().string()) +
            "\n\n[trace]\nmax_depth = 24\nmin_power = 1e-3\n\n[[object]]\nname = \"model\"\nmodel = " +
            quoted(file.filename().string()) + "\n";
        text += "smooth = true\nopen_walls = true\n";
        if (!model->in_metres)
            text += "length_unit = \"mm\"\n";
        if (!medium.empty())
            text += "medium = " + quoted(medium) + "\n";
        return experiment_of(file, text + "\n" + stage(*model, box));
    };
    if (!glass.empty())
        MediaBook(nullptr).refer(glass,
                                 {"--glass", 0, 0, ""}); // what is wrong with it is not the model's fault
    ExperimentSource source = with(glass);
    if (!glass.empty())
        return source;
    try {
        Experiment const experiment = read_experiment(source.tree, source.file);
        build_scene(experiment, &models);
    } catch (InputError const&) {
        return with("N-BK7"); // nothing says what it is made of; whatever else is wrong will be said again
    }
    return source;
}

} // namespace sahl
