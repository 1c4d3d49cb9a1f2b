// In: a path. Out: a Model; lines are read in read_obj_parse.cpp, materials in read_obj_materials.cpp,
// meshes made in read_obj_meshes.cpp.
#include "scene/read_obj.h"

#include "scene/read_file.h"
#include "scene/read_obj_parts.h"

namespace sahl {

Model read_obj(std::filesystem::path const& path) {
    Model model;
    model.in_metres = false;
    ObjText const text = parse_obj(file_text(path), path.string(), model.warnings);
    model.materials = obj_materials(path, text, model.warnings);
    add_obj_meshes(model, text, path.string());
    return model;
}

} // namespace sahl
