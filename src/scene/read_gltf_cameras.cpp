// In: the tree of a glTF file, and where its nodes stand. Out: cameras and lights, kept for pictures.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <cmath>
#include <numbers>

namespace sahl {

namespace {

double above_zero(Value const& table, std::string_view key, double otherwise) {
    Value const* const value = table.find(key);
    double const n = gltf::at_least(value, 0.0, otherwise, "give a number above 0");
    if (n == 0.0)
        throw InputError((value ? *value : table).place.text(),
                         value ? "0 is not above 0" : "it has no " + std::string(key),
                         "give a number above 0");
    return n;
}

std::string type_of(Value const& entry) {
    Value const* const type = entry.find("type");
    auto const* const name = type ? std::get_if<std::string>(&type->data) : nullptr;
    if (!name)
        throw InputError(entry.place.text(), "it has no type", "export the file again");
    return *name;
}

Value const& part(Value const& entry, std::string const& key) {
    Value const* const table = entry.find(key);
    if (!table || !std::holds_alternative<Table>(table->data))
        throw InputError(entry.place.text(), "it has no " + key, "export the file again");
    return *table;
}

ModelCamera camera_of(Value const& entry) {
    ModelCamera camera;
    camera.name = gltf::name_or(entry, "");
    std::string const type = type_of(entry);
    camera.perspective = type == "perspective";
    if (!camera.perspective && type != "orthographic")
        throw InputError(entry.place.text() + "/type", "there is no camera " + type.substr(0, 40),
                         "write perspective or orthographic");
    Value const& numbers = part(entry, type);
    if (camera.perspective) {
        camera.yfov = above_zero(numbers, "yfov", 0.0);
        if (camera.yfov >= std::numbers::pi)
            throw InputError(numbers.place.text() + "/yfov", "it is not below pi", "give radians");
        camera.aspect = numbers.find("aspectRatio") ? above_zero(numbers, "aspectRatio", 0.0) : 0.0;
        camera.znear = above_zero(numbers, "znear", 0.0);
        camera.zfar = numbers.find("zfar") ? above_zero(numbers, "zfar", 0.0) : INFINITY;
    } else {
        camera.xmag = above_zero(numbers, "xmag", 0.0);
        camera.ymag = above_zero(numbers, "ymag", 0.0);
        if (!numbers.find("znear"))
            throw InputError(numbers.place.text(), "it has no znear", "give 0 or more");
        camera.znear = gltf::at_least(numbers.find("znear"), 0.0, 0.0, "give 0 or more");
        camera.zfar = above_zero(numbers, "zfar", 0.0);
    }
    if (camera.zfar <= camera.znear)
        throw InputError(numbers.place.text(), "zfar is not beyond znear", "make zfar larger");
    return camera;
}

ModelLight light_of(Value const& entry) {
    ModelLight light;
    light.name = gltf::name_or(entry, "");
    std::string const type = type_of(entry);
    if (type != "directional" && type != "point" && type != "spot")
        throw InputError(entry.place.text() + "/type", "there is no light " + type.substr(0, 40),
                         "write directional, point or spot");
    light.kind = type == "directional" ? ModelLight::Kind::directional
                 : type == "point"     ? ModelLight::Kind::point
                                       : ModelLight::Kind::spot;
    if (Value const* const color = entry.find("color")) {
        auto const* const list = std::get_if<Array>(&color->data);
        if (!list || list->size() != 3)
            throw InputError(color->place.text(), "this must have 3 numbers", "correct it");
        for (std::size_t i = 0; i < 3; ++i)
            light.color[i] = gltf::share(&(*list)[i], 1.0);
    }
    light.intensity = gltf::at_least(entry.find("intensity"), 0.0, 1.0, "give 0 or more");
    light.range = entry.find("range") ? above_zero(entry, "range", 0.0) : INFINITY;
    if (light.kind == ModelLight::Kind::spot) {
        Value const& spot = part(entry, "spot");
        light.inner_cone = gltf::at_least(spot.find("innerConeAngle"), 0.0, 0.0, "give radians");
        light.outer_cone =
            gltf::at_least(spot.find("outerConeAngle"), 0.0, 0.25 * std::numbers::pi, "give radians");
        if (light.outer_cone > 0.5 * std::numbers::pi || light.inner_cone >= light.outer_cone)
            throw InputError(spot.place.text(), "its cone angles are not 0 ≤ inner < outer ≤ pi/2",
                             "give radians");
    }
    return light;
}

} // namespace

void add_cameras_and_lights(Value const& tree, std::vector<PlacedNode> const& nodes, Model& model) {
    auto const checked = [&](auto const& read) {
        try {
            read();
        } catch (InputError const& fault) {
            model.warnings.push_back(std::string(fault.what()) + "; it is left out");
        }
    };
    std::vector<std::optional<ModelCamera>> all_cameras;
    for_each_match(tree, "/cameras/*", [&](Value const& entry) {
        all_cameras.emplace_back();
        checked([&] { all_cameras.back() = camera_of(entry); });
    });
    std::vector<std::optional<ModelLight>> all_lights;
    for_each_match(tree, "/extensions/KHR_lights_punctual/lights/*", [&](Value const& entry) {
        all_lights.emplace_back();
        checked([&] { all_lights.back() = light_of(entry); });
    });
    auto const place = [&](auto const& all, auto& placed, Value const& index, PlacedNode const& node,
                           std::string const& what) {
        auto const* const number = std::get_if<std::int64_t>(&index.data);
        if (!number || *number < 0 || static_cast<std::size_t>(*number) >= all.size())
            throw InputError(index.place.text(), "there is no such " + what, "export the file again");
        auto const& entry = all[static_cast<std::size_t>(*number)];
        if (!entry)
            return;
        placed.push_back(*entry);
        placed.back().to_world = node.to_world;
        if (placed.back().name.empty())
            placed.back().name = gltf::name_or(std::get<Array>(tree.find("nodes")->data)[node.number], what);
    };
    for (PlacedNode const& placed : nodes) {
        Value const& node = std::get<Array>(tree.find("nodes")->data)[placed.number];
        if (Value const* const index = node.find("camera"))
            checked([&] { place(all_cameras, model.cameras, *index, placed, "camera"); });
        if (Value const* const index =
                gltf::find(gltf::find(node.find("extensions"), "KHR_lights_punctual"), "light"))
            checked([&] { place(all_lights, model.lights, *index, placed, "light"); });
    }
    auto const counted = [](std::size_t count, std::string const& what) {
        return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
    };
    if (!model.cameras.empty() || !model.lights.empty())
        model.warnings.push_back(tree.place.file + ": " + counted(model.cameras.size(), "camera") + " and " +
                                 counted(model.lights.size(), "light") +
                                 " are kept for pictures; tracing takes its light from [[source]]");
}

} // namespace sahl
