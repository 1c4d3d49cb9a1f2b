// In: what the lines of an OBJ file say. Out: its meshes, polygons cut into triangles, and an instance of
// each.
#include "scene/read_obj_parts.h"

#include "geometry/mesh_weld.h"
#include "geometry/polygon.h"
#include "math/joined_sets.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>

namespace sahl {

namespace {

/// The mesh that each run belongs to: its object's (its group's in a file without objects), or the first of
/// those that share vertices. Numbers are of runs.
std::vector<std::uint32_t> meshes_of_runs(ObjText const& text) {
    std::size_t const runs = text.runs.size();
    JoinedSets parts(runs);
    std::map<std::uint32_t, std::uint32_t> first_run;
    for (std::uint32_t r = 0; r < runs; ++r) {
        std::uint32_t const key = text.objects.empty() ? text.runs[r].group : text.runs[r].object;
        parts.join(first_run.try_emplace(key, r).first->second, r);
    }
    if (first_run.size() > 1) {
        std::vector<std::uint32_t> owner(text.positions.size(), obj_none);
        for (std::uint32_t r = 0; r < runs; ++r) {
            std::uint32_t const last = r + 1 < runs ? text.runs[r + 1].first_polygon
                                                    : static_cast<std::uint32_t>(text.polygons.size() - 1);
            for (std::uint32_t c = text.polygons[text.runs[r].first_polygon]; c < text.polygons[last]; ++c)
                if (std::uint32_t& first = owner[text.corners[c]]; first == obj_none)
                    first = r;
                else
                    parts.join(first, r);
        }
    }
    std::vector<std::uint32_t> mesh(runs);
    for (std::uint32_t r = 0; r < runs; ++r)
        mesh[r] = parts.find(r);
    return mesh;
}

/// A mesh on its way: its triangles' corners are places in ObjText::corners until they get vertices.
struct MeshMaker {
    ObjText const& text;
    std::vector<ModelMaterial> const& materials;
    std::uint64_t& patience;
    ModelMesh mesh;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> faces;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> face_numbers{}; // by group, material
    std::uint64_t tangled = 0;
    std::uint64_t without_length = 0; // vertices whose normal the file gives so

    std::uint32_t face_of(ObjRun const& run);
    void add_run(std::uint32_t run);
    void name_faces();
    void make_vertices();
    void keep_textures();
    void make_normals(std::vector<std::uint32_t> const& corner_of_vertex);
};

std::uint32_t MeshMaker::face_of(ObjRun const& run) {
    auto const [entry, is_new] =
        face_numbers.try_emplace({run.group, run.material}, static_cast<std::uint32_t>(face_numbers.size()));
    if (is_new)
        mesh.face_material.push_back(run.material == obj_none ? std::nullopt
                                                              : std::optional<std::uint32_t>(run.material));
    return entry->second;
}

void MeshMaker::add_run(std::uint32_t r) {
    std::uint32_t const face = face_of(text.runs[r]);
    std::uint32_t const last = r + 1 < text.runs.size()
                                   ? text.runs[r + 1].first_polygon
                                   : static_cast<std::uint32_t>(text.polygons.size() - 1);
    std::vector<dvec3> corners;
    std::vector<std::array<std::uint32_t, 3>> pieces;
    for (std::uint32_t p = text.runs[r].first_polygon; p < last; ++p) {
        std::uint32_t const begin = text.polygons[p], size = text.polygons[p + 1] - begin;
        if (size == 3) {
            triangles.push_back({begin, begin + 1, begin + 2});
            continue;
        }
        corners.clear();
        pieces.clear();
        for (std::uint32_t c = begin; c < begin + size; ++c)
            corners.push_back(text.positions[text.corners[c]]);
        tangled += !cut_polygon(corners, pieces, patience);
        for (auto const& [a, b, c] : pieces)
            triangles.push_back({begin + a, begin + b, begin + c});
    }
    faces.resize(triangles.size(), face);
}

/// After the groups where there are several, and after the materials where a group, or all, has several.
void MeshMaker::name_faces() {
    std::map<std::uint32_t, int> materials_of;
    for (auto const& entry : face_numbers)
        ++materials_of[entry.first.first];
    mesh.soup.face_names.resize(face_numbers.size());
    for (auto const& [key, number] : face_numbers) {
        std::string const group = key.first == obj_none ? "" : text.groups[key.first];
        std::string const material = key.second == obj_none ? "" : text.materials[key.second];
        std::string name = materials_of.size() > 1 ? group : "";
        if (name.empty() || materials_of[key.first] > 1)
            name += (name.empty() || material.empty() ? "" : "_") + material;
        std::replace(name.begin(), name.end(), '.', '_');
        mesh.soup.face_names[number] = name.empty() ? "surface" : name;
    }
}

/// One for each pair of position and normal that a corner has.
void MeshMaker::make_vertices() {
    bool const normals = std::any_of(triangles.begin(), triangles.end(), [&](auto const& t) {
        return !text.corner_normals.empty() && text.corner_normals[t[0]] != obj_none;
    });
    auto const key = [&](std::size_t i) {
        std::uint32_t const corner = triangles[i / 3][i % 3];
        std::uint64_t const normal = normals ? text.corner_normals[corner] : obj_none;
        // corners without a normal take their triangle's, and share no vertex
        return std::array<std::uint64_t, 2>{normal << 32 | text.corners[corner],
                                            normals && normal == obj_none ? i / 3 : 0};
    };
    std::vector<std::uint32_t> first;
    std::vector<std::uint32_t> const vertex = number_kinds(triangles.size() * 3, key, first);
    mesh.soup.positions.reserve(first.size());
    for (std::uint32_t& corner : first) {
        corner = triangles[corner / 3][corner % 3];
        mesh.soup.positions.push_back(text.positions[text.corners[corner]]);
    }
    mesh.soup.triangles.resize(triangles.size());
    for (std::size_t i = 0; i < vertex.size(); ++i)
        mesh.soup.triangles[i / 3][i % 3] = vertex[i];
    mesh.soup.triangle_face = std::move(faces);
    if (normals)
        make_normals(first);
}

/// Texture coordinates stay with the corners: they would part vertices that are one place of one surface.
/// They are kept where a material takes its colour from a picture.
void MeshMaker::keep_textures() {
    auto const texture_of = [&](std::optional<std::uint32_t> material) -> ModelTexture const* {
        return material && materials[*material].color_texture ? &*materials[*material].color_texture
                                                              : nullptr;
    };
    bool const any = std::any_of(mesh.face_material.begin(), mesh.face_material.end(), texture_of);
    if (!any || text.corner_textures.empty() || text.texture_coordinates.empty())
        return;
    mesh.soup.texture_coordinates.resize(triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        ModelTexture const* const texture = texture_of(mesh.face_material[faces[t]]);
        for (std::size_t k = 0; texture && k < 3; ++k) {
            std::uint32_t const corner = triangles[t][k];
            std::uint32_t const number =
                corner < text.corner_textures.size() ? text.corner_textures[corner] : obj_none;
            dvec2 const uv =
                number < text.texture_coordinates.size() ? text.texture_coordinates[number] : dvec2(0.0);
            mesh.soup.texture_coordinates[t][k] =
                uv.x * texture->linear[0] + uv.y * texture->linear[1] + texture->offset;
        }
    }
}

void MeshMaker::make_normals(std::vector<std::uint32_t> const& corner_of_vertex) {
    TriangleSoup& soup = mesh.soup;
    auto const unit_or_zero = [](dvec3 const& v) {
        double const largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
        return largest > 0.0 ? normalize(v / largest) : dvec3(0.0);
    };
    for (std::uint32_t const corner : corner_of_vertex) {
        std::uint32_t const normal = text.corner_normals[corner];
        soup.normals.push_back(normal == obj_none ? dvec3(0.0) : unit_or_zero(text.normals[normal]));
        without_length += normal != obj_none && soup.normals.back() == dvec3(0.0);
    }
    for (auto const& t : soup.triangles)
        for (std::uint32_t const corner : t)
            if (soup.normals[corner] == dvec3(0.0)) {
                dvec3 const own = unit_or_zero(cross(soup.positions[t[1]] - soup.positions[t[0]],
                                                     soup.positions[t[2]] - soup.positions[t[0]]));
                soup.normals[corner] = own == dvec3(0.0) ? dvec3(0.0, 0.0, 1.0) : own;
            }
}

/// Its object's or group's; the file's where a mesh without objects has all of several groups.
std::string name_of(ObjText const& text, ObjRun const& run, bool all_groups, std::string const& file) {
    auto const& names = text.objects.empty() ? text.groups : text.objects;
    std::uint32_t const number = text.objects.empty() ? run.group : run.object;
    std::string const name = number == obj_none || all_groups ? "" : names[number];
    return name.empty() ? std::filesystem::path(file).stem().string() : name;
}

/// All objects and groups that have a share in a mesh.
std::shared_ptr<ModelNode const> node_of(ObjText const& text, std::vector<std::uint32_t> const& runs) {
    std::set<std::uint32_t> objects, groups;
    for (std::uint32_t const r : runs) {
        objects.insert(text.runs[r].object);
        groups.insert(text.runs[r].group);
    }
    auto node = std::make_shared<ModelNode>();
    for (std::uint32_t const number : objects)
        if (number != obj_none)
            node->groups.push_back(text.objects[number]);
    for (std::uint32_t const number : groups)
        if (number != obj_none)
            node->groups.push_back(text.groups[number]);
    return node;
}

} // namespace

void add_obj_meshes(Model& model, ObjText const& text, std::string const& file) {
    std::vector<std::uint32_t> const mesh_of_run = meshes_of_runs(text);
    std::map<std::uint32_t, std::vector<std::uint32_t>> runs_of_mesh;
    for (std::uint32_t r = 0; r < mesh_of_run.size(); ++r)
        runs_of_mesh[mesh_of_run[r]].push_back(r);
    std::uint64_t tangled = 0, without_length = 0;
    std::uint64_t patience = 3000000000; // some seconds for all polygons of a file
    for (auto const& [first, runs] : runs_of_mesh) {
        MeshMaker maker{text, model.materials, patience, {}, {}, {}};
        bool const all_groups = text.objects.empty() && runs_of_mesh.size() == 1 && text.groups.size() > 1;
        maker.mesh.name = name_of(text, text.runs[first], all_groups, file);
        for (std::uint32_t const r : runs)
            maker.add_run(r);
        maker.name_faces();
        maker.keep_textures();
        maker.make_vertices();
        tangled += maker.tangled;
        without_length += maker.without_length;
        model.instances.push_back(
            {maker.mesh.name, {}, static_cast<std::uint32_t>(model.meshes.size()), node_of(text, runs)});
        model.meshes.push_back(std::move(maker.mesh));
    }
    if (without_length > 0)
        model.warnings.push_back(
            file + ": " + std::to_string(without_length) +
            " vertices have a normal (vn) of no length; those of their triangles are taken");
    if (tangled > 0)
        model.warnings.push_back(file + ": the outlines of " + std::to_string(tangled) +
                                 " polygons cross themselves or are too tangled, and their triangles may "
                                 "overlap; triangulate the model when you export it");
}

} // namespace sahl
