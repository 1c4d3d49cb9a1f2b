#include "run/export_model.h"

#include "geometry/mesh_decimate.h"
#include "run/check_words.h"
#include "run/model_of_scene.h"
#include "run/write_glb.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sahl {

namespace {

/// Of each mesh once, by the largest of its instances.
std::vector<std::string> decimate_meshes(Scene& scene, double within) {
    std::map<std::shared_ptr<Mesh const>, double> stretch;
    for (Body const& body : scene.bodies)
        if (body.mesh)
            stretch[body.mesh] = std::max(stretch[body.mesh], stretch_of(body.to_world));
    std::map<std::shared_ptr<Mesh const>, std::shared_ptr<Mesh const>> fewer;
    for (auto const& [mesh, by] : stretch)
        if (auto made = decimated(*mesh, within / by))
            fewer[mesh] = std::make_shared<Mesh const>(std::move(*made));
    std::vector<std::string> lines;
    for (Body& body : scene.bodies) {
        if (!body.mesh)
            continue;
        auto const made = fewer.find(body.mesh);
        if (made == fewer.end()) {
            lines.push_back(body.name + ": it is no manifold, and keeps its triangles");
            continue;
        }
        lines.push_back(body.name +
                        words(": %zu of %zu triangles; no vertex lies farther off them than %g mm",
                              made->second->soup.triangles.size(), body.mesh->soup.triangles.size(),
                              within * 1e3));
        body.mesh = made->second;
    }
    return lines;
}

} // namespace

std::vector<std::string> export_model(ExperimentSource const& source, unsigned turn,
                                      std::filesystem::path const& to, double decimate) {
    Scene scene = build_scene(read_experiment(source.tree, source.file));
    std::vector<std::string> lines;
    if (decimate > 0.0)
        lines = decimate_meshes(scene, decimate);
    write_glb(model_of(scene, turn, false, source.file.string()), {}, to);
    return lines;
}

} // namespace sahl
