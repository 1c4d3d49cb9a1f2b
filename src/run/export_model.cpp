#include "run/export_model.h"

#include "run/model_of_scene.h"
#include "run/write_glb.h"

namespace sahl {

void export_model(ExperimentSource const& source, unsigned turn, std::filesystem::path const& to) {
    Scene const scene = build_scene(read_experiment(source.tree, source.file));
    write_glb(model_of(scene, turn, false, source.file.string()), {}, to);
}

} // namespace sahl
