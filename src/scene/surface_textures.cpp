#include "scene/surface_textures.h"

#include "geometry/texture_place.h"
#include "math/input_error.h"

#include <map>
#include <tuple>

namespace sahl {

namespace {

Image read(TextureSource const& source) {
    if (!source.problem.empty())
        throw InputError(source.place, source.problem, "export the model again");
    return source.bytes ? read_image(*source.bytes, source.place, most_texture_pixels)
                        : read_image(source.file, most_texture_pixels);
}

/// Where the place lies on the picture of its surface, and in which frame.
std::optional<TexturePlace> place_of(Scene const& scene, Body const& body, Interface const& interface,
                                     Affine const& to_object) {
    dvec3 const point = to_object.point(interface.point);
    if (body.mesh)
        return interface.primitive < 0
                   ? std::nullopt
                   : texture_place(*body.mesh, static_cast<std::uint32_t>(interface.primitive), point);
    if (!body.shape)
        return std::nullopt;
    // a body's own normals point outward, and an open surface's to +z; the interface's faces the light
    bool const turned = body.open
                            ? interface.against_facing
                            : interface.body_before && &scene.bodies[interface.body_before->value] == &body;
    dvec3 const normal = glm::transpose(body.to_world.linear) * interface.facet_normal;
    Face const* const first = faces_of(scene, scene.faces[interface.face.value].body).data();
    auto const face = static_cast<std::size_t>(&scene.faces[interface.face.value] - first);
    return texture_place(*body.shape, face, point, body.open ? dvec3(0, 0, 1) : turned ? -normal : normal);
}

} // namespace

SurfaceTextures::SurfaceTextures(Scene const& scene) {
    std::map<std::tuple<std::string, void const*, Wrap, Wrap>, std::shared_ptr<Texture const>> known;
    for (TextureSource const& source : scene.textures) {
        auto& texture = known[{source.file.string(), source.bytes.get(), source.across, source.up}];
        try {
            if (!texture)
                texture = std::make_shared<Texture const>(read(source), source.across, source.up);
        } catch (InputError const& error) {
            if (!source.of_model)
                throw;
            warnings_.push_back(std::string(error.what()) + " Until then it is white.");
        }
        textures_.push_back(texture);
    }
}

bool SurfaceTextures::has(Scene const& scene, Interface const& interface) const {
    return !textures_.empty() && interface.surface && scene.surfaces[interface.surface->value].texture;
}

dvec3 SurfaceTextures::at(Scene const& scene, Interface const& interface, dvec3 const& dx,
                          dvec3 const& dy) const {
    if (textures_.empty() || !interface.surface)
        return dvec3(1.0);
    auto const id = scene.surfaces[interface.surface->value].texture;
    Texture const* const texture = id ? textures_[id->value].get() : nullptr;
    if (!texture)
        return dvec3(1.0);
    Body const& body = scene.bodies[scene.faces[interface.face.value].body.value];
    Affine const to_object = inverse(body.to_world);
    auto const place = place_of(scene, body, interface, to_object);
    return place ? texture->at(place->uv, place->moved(to_object.vector(dx)),
                               place->moved(to_object.vector(dy)))
                 : dvec3(1.0);
}

} // namespace sahl
