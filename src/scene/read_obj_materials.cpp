// In: the names of MTL files and of materials. Out: what those materials are, as docs/models.md says.
// A fault that could change the light is an InputError, but only in a material that a face has.
#include "scene/read_obj_parts.h"

#include "math/input_error.h"
#include "math/nearest_name.h"
#include "scene/read_obj_mtl.h"

#include <algorithm>

namespace sahl {

namespace {

using Warnings = std::vector<std::string>;

double grey(std::array<double, 3> const& colour) {
    return 0.2126 * colour[0] + 0.7152 * colour[1] + 0.0722 * colour[2]; // ITU-R BT.709
}

std::string quoted(std::vector<std::string> const& names) {
    std::string list;
    for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 10); ++i)
        list += (i ? ", '" : "'") + names[i] + "'";
    return list + (names.size() > 10 ? ", …" : "");
}

/// Throws where a value of these keys could not be read; warns of those of all others.
void judge(MtlMaterial const& source, std::vector<std::string_view> const& decisive, Warnings& warnings) {
    for (MtlFault const& fault : source.faults) {
        if (std::find(decisive.begin(), decisive.end(), fault.key) != decisive.end())
            throw InputError(fault.place, fault.problem, fault.remedy);
        warnings.push_back(fault.place + ": " + fault.problem + ": it is left out");
    }
}

/// How much of what is behind it the material shows: 0 opaque, by d or Tr.
double transparency(MtlMaterial const& source, Warnings& warnings) {
    if (source.d && source.tr && std::abs(1.0 - *source.d - *source.tr) > 1e-3)
        warnings.push_back(source.place + ": material '" + source.name +
                           "': d and Tr contradict each other (Tr should be 1 - d); d is taken");
    return source.d ? 1.0 - *source.d : source.tr.value_or(0.0);
}

bool has_illum(MtlMaterial const& source, std::initializer_list<int> models) {
    return source.illum && std::find(models.begin(), models.end(), *source.illum) != models.end();
}

void make_glass(ModelMaterial& material, MtlMaterial const& source, double seen_through, Warnings& warnings) {
    auto const warn = [&](std::string const& what) {
        warnings.push_back(source.place + ": material '" + source.name + "': " + what);
    };
    material.transmission = 1.0;
    material.may_be_body = true;
    material.ior = source.ni.value_or(1.5);
    for (std::size_t i = 0; source.tf && i < 3; ++i)
        material.base_color[i] = std::min((*source.tf)[i], 1.0);
    if (!source.ni)
        warn("it is glass without an index: 1.5 is assumed; add Ni to the MTL file, or map the material");
    else if (material.ior == 1.0)
        warn("Ni 1 bends no light, so that this glass cannot be seen; some programs write it for want of an "
             "index: correct it, or map the material");
    if (seen_through > 0.0 && seen_through < 0.5)
        warn("by d it is more opaque than not, yet it is traced as clear glass; map the material if it is "
             "paint");
}

void make_mirror(ModelMaterial& material, std::array<double, 3> const& colour, MtlMaterial const& source,
                 Warnings& warnings) {
    material.metallic = 1.0;
    for (std::size_t i = 0; i < 3; ++i)
        material.base_color[i] = std::min(colour[i], 1.0);
    if (double const share = grey(colour); share < 0.8)
        warnings.push_back(source.place + ": material '" + source.name + "': this mirror reflects " +
                           std::to_string(static_cast<int>(std::lround(100.0 * share))) +
                           " % of the light by its colour; map the material to a metal if that is not meant");
}

ModelMaterial understood(MtlMaterial const& source, Warnings& warnings, Warnings& like_blender_glass) {
    ModelMaterial material;
    material.name = source.name;
    material.metallic = material.roughness = 0.0;
    material.color_texture = source.map_kd;
    std::vector<std::string_view> decisive{"illum", "d", "Tr", "Pm"};
    double const seen_through = transparency(source, warnings);
    bool const metal = source.pm.value_or(0.0) >= 0.5;
    bool const mirror = metal || has_illum(source, {3, 5, 8});
    bool const glass = !mirror && (has_illum(source, {4, 6, 7, 9}) || seen_through > 0.0 ||
                                   (!source.illum && source.tf && grey(*source.tf) > 0.0));
    if (glass)
        decisive.insert(decisive.end(), {"Ni", "Tf"});
    if (mirror)
        decisive.push_back(metal ? "Kd" : "Ks");
    judge(source, decisive, warnings);
    if (glass && source.ni && (*source.ni < 1.0 || *source.ni > 10.0))
        throw InputError(source.ni_place,
                         "Ni " + source.ni_text + (*source.ni < 1.0 ? " is below 1" : " is above 10"),
                         "give the index of refraction, 1.5 for plain glass");
    std::array<double, 3> const white{1.0, 1.0, 1.0};
    if (glass) {
        make_glass(material, source, seen_through, warnings);
    } else if (mirror) {
        make_mirror(material, (metal ? source.kd : source.ks).value_or(white), source, warnings);
    } else {
        for (std::size_t i = 0; source.kd && i < 3; ++i)
            material.base_color[i] = std::min((*source.kd)[i], 1.0);
        if (source.ni.value_or(1.0) > 1.0)
            like_blender_glass.push_back(source.name);
    }
    return material;
}

/// What is left out, each with the materials that it is left out of: often it is the same for many.
struct LeftOut {
    std::string what, first_place;
    std::vector<std::string> materials;
};

void collect(std::vector<LeftOut>& all, MtlMaterial const& source) {
    for (std::string const& what : source.left_out) {
        auto entry = std::find_if(all.begin(), all.end(), [&](LeftOut const& e) { return e.what == what; });
        if (entry == all.end())
            entry = all.insert(all.end(), {what, source.place, {}});
        entry->materials.push_back(source.name);
    }
}

/// What is taken where no MTL file has the material: paint, which absorbs.
ModelMaterial opaque(std::string const& name) {
    ModelMaterial material;
    material.name = name;
    material.metallic = material.roughness = 0.0;
    return material;
}

} // namespace

std::vector<ModelMaterial> obj_materials(std::filesystem::path const& path, ObjText const& text,
                                         Warnings& warnings) {
    MtlLibrary library;
    for (ObjText::Library const& entry : text.libraries)
        add_mtl_files(path.parent_path() / ".", entry.names, entry.place, library, warnings);

    std::vector<ModelMaterial> materials;
    std::vector<std::string> missing, like_blender_glass;
    std::vector<LeftOut> left_out;
    std::string first_place;
    for (std::size_t i = 0; i < text.materials.size(); ++i) {
        auto const found = library.numbers.find(text.materials[i]);
        if (found != library.numbers.end()) {
            MtlMaterial const& source = library.materials[found->second];
            materials.push_back(understood(source, warnings, like_blender_glass));
            collect(left_out, source);
            continue;
        }
        materials.push_back(opaque(text.materials[i]));
        if (text.materials[i].empty() || text.materials[i] == "(null)")
            continue;
        if (missing.empty())
            first_place = text.material_places[i];
        missing.push_back(text.materials[i]);
    }
    for (LeftOut const& entry : left_out)
        warnings.push_back(entry.first_place + ": " + quoted(entry.materials) + ": " + entry.what);
    if (!missing.empty()) {
        std::vector<std::string> known;
        for (MtlMaterial const& material : library.materials)
            if (known.size() < 1000)
                known.push_back(material.name);
        std::string const nearest = nearest_name(missing.front(), known);
        warnings.push_back(first_place + ": no MTL file has " + quoted(missing) +
                           (nearest.empty() ? "" : " (the nearest is '" + nearest + "')") +
                           ": taken as opaque, which absorbs all light; map them with materials = {…}, or "
                           "put the MTL file beside the model");
    }
    if (!like_blender_glass.empty())
        warnings.push_back(path.string() + ": " + quoted(like_blender_glass) +
                           ": opaque by illum and d, and absorbs all light, though Ni gives an index "
                           "(Blender writes its glass so); if it is glass, write illum 7, or map it with "
                           "materials = {…}");
    return materials;
}

} // namespace sahl
