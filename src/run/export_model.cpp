#include "run/export_model.h"

#include "geometry/mesh_decimate.h"
#include "geometry/mesh_subdivide.h"
#include "run/check_words.h"
#include "run/model_of_scene.h"
#include "run/write_glb.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sahl {

namespace {

/// Gives each mesh that is made anew its new triangles: each once, by the largest of its instances.
///   within    m in the world
///   make      of a mesh and a tolerance in its own frame
///   said      of what it is now: behind the counts of triangles
///   refused   of what keeps its triangles
template <class Make>
std::vector<std::string> remake_meshes(Scene& scene, double within, Make&& make, std::string const& said,
                                       std::string const& refused) {
    std::map<std::shared_ptr<Mesh const>, double> stretch;
    for (Body const& body : scene.bodies)
        if (body.mesh)
            stretch[body.mesh] = std::max(stretch[body.mesh], stretch_of(body.to_world));
    std::map<std::shared_ptr<Mesh const>, std::shared_ptr<Mesh const>> anew;
    for (auto const& [mesh, by] : stretch)
        if (std::optional<Mesh> made = make(mesh, within / by))
            anew[mesh] = std::make_shared<Mesh const>(std::move(*made));
    std::vector<std::string> lines;
    for (Body& body : scene.bodies) {
        if (!body.mesh)
            continue;
        auto const made = anew.find(body.mesh);
        if (made == anew.end()) {
            lines.push_back(body.name + refused);
            continue;
        }
        lines.push_back(body.name +
                        words(": %zu triangles in place of %zu; ", made->second->soup.triangles.size(),
                              body.mesh->soup.triangles.size()) +
                        said + words(" %g mm", within * 1e3));
        body.mesh = made->second;
    }
    return lines;
}

} // namespace

std::vector<std::string> export_model(ExperimentSource const& source, unsigned turn,
                                      std::filesystem::path const& to, double decimate, double subdivide) {
    Scene scene = build_scene(read_experiment(source.tree, source.file));
    std::vector<std::string> lines;
    if (decimate > 0.0)
        lines = remake_meshes(
            scene, decimate, [](auto const& mesh, double within) { return decimated(*mesh, within); },
            "no vertex lies farther off them than", ": it is no manifold, and keeps its triangles");
    if (subdivide > 0.0)
        lines = remake_meshes(
            scene, subdivide, [](auto const& mesh, double within) { return subdivided(mesh, within); },
            "their middles and their sides' lie on the curved surface to within",
            ": it has no normals, is no manifold or would take over 20 million triangles, and keeps its own");
    write_glb(model_of(scene, turn, false, source.file.string()), {}, to);
    return lines;
}

} // namespace sahl
