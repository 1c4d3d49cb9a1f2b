// In: a scene. Out: what stands in it, as meshes, places and kinds of faces. See page_data.h.
#include "geometry/tessellate.h"
#include "math/overloaded.h"
#include "report/drawn_mesh.h"
#include "report/page_data.h"

#include <algorithm>
#include <map>

namespace sahl::report {

namespace {

constexpr std::size_t most_bodies = 1500, most_triangles = 150'000; // of all meshes together
constexpr unsigned pieces_of_a_turn = 96;

char const* kind_of(Surface const& surface) {
    return std::visit(Overloaded{[](Metal const&) { return "mirror"; }, [](Shares const&) { return "half"; },
                                 [](Absorber const&) { return "absorber"; },
                                 [](Diffuse const&) { return "diffuse"; },
                                 [](Paint const&) { return "paint"; },
                                 [](Tinted const& t) { return t.clear > 0.0 ? "glass" : "mirror"; },
                                 [](ThinWall const&) { return "glass"; }},
                      surface.kind);
}

class BodyWriter {
  public:
    BodyWriter(JsonText& json, Scene const& scene) : json_(json), scene_(scene) {}

    void write() {
        std::size_t const shown = std::min(scene_.bodies.size(), most_bodies);
        std::vector<std::optional<std::uint32_t>> meshes;
        for (std::size_t i = 0; i < shown; ++i)
            meshes.push_back(mesh_of(scene_.bodies[i]));
        json_.key("bodies").open('[');
        for (std::size_t i = 0; i < shown; ++i)
            body(static_cast<std::uint32_t>(i), meshes[i]);
        json_.close(']').entry("bodies_in_all", std::uint64_t{scene_.bodies.size()});
        json_.key("meshes").open('[');
        for (DrawnMesh const& mesh : meshes_) {
            json_.open('{').array("places", mesh.places);
            if (!mesh.normals.empty())
                json_.array("normals", mesh.normals);
            json_.array("triangles", mesh.triangles).array("face_begins", mesh.face_begins);
            json_.array("creases", mesh.creases).array("borders", mesh.borders);
            json_.entry("triangles_of_model", mesh.triangles_of_model).close('}');
        }
        json_.close(']');
    }

  private:
    std::optional<std::uint32_t> mesh_of(Body const& body) {
        if (body.mesh) {
            auto const [found, is_new] =
                known_.try_emplace(body.mesh.get(), static_cast<std::uint32_t>(meshes_.size()));
            if (is_new)
                add(body.mesh->soup);
            return found->second;
        }
        if (!body.shape || std::holds_alternative<Plane>(*body.shape))
            return std::nullopt;
        Tessellation const made = tessellate(*body.shape, pieces_of_a_turn);
        if (!made.problem.empty())
            return std::nullopt;
        if (!last_.empty() && last_ == made.soup.positions) // the next of a row of equal bodies
            return last_mesh_;
        last_ = made.soup.positions;
        last_mesh_ = static_cast<std::uint32_t>(meshes_.size());
        add(made.soup);
        return last_mesh_;
    }

    void add(TriangleSoup const& soup) {
        std::size_t const room = most_triangles - std::min(most_triangles - 2000, used_);
        meshes_.push_back(drawn_mesh(soup, room));
        used_ += meshes_.back().triangles.size() / 3;
    }

    void body(std::uint32_t number, std::optional<std::uint32_t> mesh) {
        Body const& body = scene_.bodies[number];
        json_.open('{').entry("name", body.name).entry("open", body.open);
        if (!body.open)
            json_.entry("medium", body.medium.value);
        if (body.detector)
            json_.entry("detector", body.detector->value);
        if (mesh)
            json_.entry("mesh", *mesh);
        else
            json_.entry("endless", body.shape && std::holds_alternative<Plane>(*body.shape));
        json_.key("matrix").open('['); // column by column
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                json_.value(body.to_world.linear[column][row]);
        for (int row = 0; row < 3; ++row)
            json_.value(1e3 * body.to_world.offset[row]);
        json_.close(']').key("faces").open('[');
        for (Face const& face : faces_of(scene_, {number}))
            json_.open('[')
                .value(face.name)
                .value(face.surface ? kind_of(scene_.surfaces[face.surface->value])
                       : body.open  ? "absorber"
                                    : "glass")
                .value(face.surface ? scene_.surfaces[face.surface->value].name : std::string())
                .close(']');
        json_.close(']').close('}');
    }

    JsonText& json_;
    Scene const& scene_;
    std::vector<DrawnMesh> meshes_;
    std::map<Mesh const*, std::uint32_t> known_;
    std::vector<dvec3> last_;
    std::uint32_t last_mesh_ = 0;
    std::size_t used_ = 0;
};

/// Where a source stands; of given rays, where the first one starts. And where it shines to.
std::pair<dvec3, dvec3> place_of(SourceSpec const& source) {
    return std::visit(Overloaded{[](Beam const& e) { return std::pair(e.from, e.toward); },
                                 [](PointEmitter const& e) { return std::pair(e.at, e.toward); },
                                 [](LambertianEmitter const& e) { return std::pair(e.at, e.toward); },
                                 [](ExplicitRays const& e) {
                                     return e.rays.empty()
                                                ? std::pair(dvec3(0.0), dvec3(0.0))
                                                : std::pair(e.rays.front().origin, e.rays.front().direction);
                                 }},
                      source.emitter);
}

} // namespace

void write_bodies(JsonText& json, Scene const& scene) {
    BodyWriter(json, scene).write();
    json.entry("surroundings", scene.surroundings.value);
    json.key("sources").open('[');
    for (SourceSpec const& source : scene.sources) {
        auto const [at, toward] = place_of(source);
        json.open('{').entry("name", source.name).entry("power_W", source.power);
        json.key("at_mm").value(at, 1e3).key("toward").value(toward).close('}');
    }
    json.close(']');
}

} // namespace sahl::report
