#include "run/model_of_scene.h"

#include "geometry/tessellate.h"
#include "math/input_error.h"
#include "run/model_substance.h"
#include "run/write_glb.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace sahl {

namespace {

struct Exporter {
    Scene const& scene;
    unsigned turn;
    std::string const& place;
    Model model{};
    std::map<std::tuple<std::uint32_t, std::uint32_t, bool>, std::uint32_t> known_materials{};

    static constexpr std::uint32_t none = ~0U, veil = ~0U - 1U;

    TriangleSoup soup_of(Body const& body) const {
        if (body.mesh)
            return body.mesh->soup;
        Tessellation made = tessellate(*body.shape, turn);
        if (!made.problem.empty())
            throw InputError(place + ": object " + body.name, made.problem,
                             "or leave the object out of the experiment that is exported");
        return std::move(made.soup);
    }

    std::uint32_t material(Body const& body, std::optional<SurfaceId> surface, double thickness) {
        std::uint32_t const face = body.detector ? veil : surface ? surface->value : none;
        auto const [found, is_new] =
            known_materials.try_emplace({body.open ? none : body.medium.value, face, body.open},
                                        static_cast<std::uint32_t>(model.materials.size()));
        if (is_new)
            model.materials.push_back(made_of(body, surface, thickness));
        return found->second;
    }

    ModelMaterial made_of(Body const& body, std::optional<SurfaceId> surface, double thickness) const {
        ModelMaterial made;
        if (body.detector) {
            made.name = "detector";
            made.metallic = 0.0;
            made.base_color = {0.5, 0.5, 0.5, 0.25};
            made.alpha_mode = AlphaMode::blend;
        } else if (surface) {
            made = surface_material(scene.surfaces[surface->value], scene, body.medium, thickness);
            if (!body.open && made.transmission > 0.0)
                made.name += " on " + scene.media[body.medium.value].name;
        } else {
            made = glass_material(scene.media[body.medium.value], thickness);
        }
        if (body.open)
            made.volume.reset();
        made.double_sided = body.open;
        return made;
    }

    void add(std::uint32_t number) {
        Body const& body = scene.bodies[number];
        ModelMesh mesh{body.name, soup_of(body), {}};
        TriangleSoup& soup = mesh.soup;
        dvec3 low(INFINITY), high(-INFINITY);
        for (dvec3 const& p : soup.positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        dvec3 const size = high - low;
        double const thickness = std::min({size.x, size.y, size.z});
        for (Face const& face : scene.faces)
            if (face.body.value == number)
                mesh.face_material.push_back(material(body, face.surface, thickness));
        Affine to_world = body.to_world;
        if (!is_made_of_scale_and_turn(to_world.linear)) {
            apply(to_world, soup);
            to_world = {};
        }
        model.instances.push_back({body.name, to_world, mesh_number(std::move(mesh))});
    }

    static void apply(Affine const& map, TriangleSoup& soup) {
        dmat3 const of_normals = glm::transpose(inverse(map).linear);
        for (dvec3& p : soup.positions)
            p = map.point(p);
        for (dvec3& n : soup.normals)
            n = normalize(of_normals * n);
        if (glm::determinant(map.linear) < 0.0)
            for (auto& triangle : soup.triangles)
                std::swap(triangle[1], triangle[2]);
    }

    /// That of a mesh which is the same, or a new one.
    std::uint32_t mesh_number(ModelMesh mesh) {
        auto const same = std::find_if(model.meshes.begin(), model.meshes.end(), [&](ModelMesh const& m) {
            return m.face_material == mesh.face_material && m.soup.positions == mesh.soup.positions &&
                   m.soup.triangles == mesh.soup.triangles && m.soup.normals == mesh.soup.normals &&
                   m.soup.triangle_face == mesh.soup.triangle_face;
        });
        auto const found = static_cast<std::uint32_t>(same - model.meshes.begin());
        if (same == model.meshes.end())
            model.meshes.push_back(std::move(mesh));
        return found;
    }
};

} // namespace

Model model_of(Scene const& scene, unsigned turn, bool with_detectors, std::string const& place) {
    Exporter exporter{scene, turn, place};
    for (std::uint32_t number = 0; number < scene.bodies.size(); ++number)
        if (with_detectors || !scene.bodies[number].detector)
            exporter.add(number);
    return std::move(exporter.model);
}

} // namespace sahl
