// In: tinygltf's meshes. Out: triangles in double, each index in range, each number finite, normals of unit
// length.
#include "scene/read_gltf_parts.h"

#include "math/input_error.h"

#include <tiny_gltf.h>

#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace sahl {

namespace {

constexpr char const* again = "export the file again";

std::vector<dvec3> as_vectors(std::vector<double> const& numbers, std::string const& place) {
    std::vector<dvec3> vectors(numbers.size() / 3);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        vectors[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
        if (!std::isfinite(vectors[i].x + vectors[i].y + vectors[i].z))
            throw InputError(place, "element " + std::to_string(i) + " is not finite", again);
    }
    return vectors;
}

/// Twice the triangle's area times its normal.
dvec3 area_vector(TriangleSoup const& soup, std::array<std::uint32_t, 3> const& t) {
    return cross(soup.positions[t[1]] - soup.positions[t[0]], soup.positions[t[2]] - soup.positions[t[0]]);
}

dvec3 unit_or(dvec3 const& v, dvec3 const& otherwise) {
    double const size = length(v);
    return size > 0.0 && std::isfinite(size) ? v / size : otherwise;
}

/// One of tinygltf's meshes on its way into a ModelMesh.
struct MeshReader {
    tinygltf::Model const& model;
    AccessorBudget& budget;
    std::vector<std::string>& warnings;
    ModelMesh& mesh;
    TriangleSoup& soup;
    bool any_normals;
    AccessorBudget texture_budget{std::uint64_t{1} << 26};
    std::map<std::pair<int, int>, std::uint32_t>
        first_vertex{}; // of the vertices with these positions and normals

    std::uint32_t vertices_of(tinygltf::Primitive const& primitive, std::string const& place,
                              std::size_t& count);
    std::vector<std::uint32_t> corners_of(tinygltf::Primitive const& primitive, std::string const& place,
                                          std::size_t vertices);
    void add_triangles(tinygltf::Primitive const& primitive, std::uint32_t face, std::string const& place,
                       std::optional<ModelTexture> const& texture);
    void keep_textures(tinygltf::Primitive const& primitive, ModelTexture const& texture, std::uint32_t first,
                       std::size_t first_triangle);
    void make_flat_normals(std::size_t first_triangle);
    void mend_zero_normals(std::size_t first_triangle, std::string const& place);
};

int attribute(tinygltf::Primitive const& primitive, char const* name) {
    auto const found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

/// Reads positions and normals, once for all primitives that share them; returns the first one's number.
std::uint32_t MeshReader::vertices_of(tinygltf::Primitive const& primitive, std::string const& place,
                                      std::size_t& count) {
    int const position = attribute(primitive, "POSITION"), normal = attribute(primitive, "NORMAL");
    std::string const position_place = place + "/attributes/POSITION",
                      normal_place = place + "/attributes/NORMAL";
    if (auto const known = first_vertex.find({position, normal});
        known != first_vertex.end() && normal >= 0) {
        count = model.accessors[static_cast<std::size_t>(position)].count;
        return known->second;
    }
    auto const positions =
        as_vectors(accessor_numbers(model, position, 3, position_place, budget), position_place);
    count = positions.size();
    std::uint32_t const first = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.insert(soup.positions.end(), positions.begin(), positions.end());
    first_vertex[{position, normal}] = first;
    if (any_normals)
        soup.normals.resize(soup.positions.size(), dvec3(0.0));
    if (normal < 0)
        return first;
    auto const normals = as_vectors(accessor_numbers(model, normal, 3, normal_place, budget), normal_place);
    if (normals.size() != count)
        throw InputError(
            normal_place,
            std::to_string(normals.size()) + " normals for " + std::to_string(count) + " positions", again);
    for (std::size_t i = 0; i < count; ++i)
        soup.normals[first + i] = unit_or(normals[i], dvec3(0.0));
    return first;
}

std::vector<std::uint32_t> MeshReader::corners_of(tinygltf::Primitive const& primitive,
                                                  std::string const& place, std::size_t vertices) {
    int const indices_accessor = attribute(primitive, gltf_indices_attribute);
    std::vector<std::uint32_t> corners;
    if (indices_accessor < 0) {
        for (std::size_t i = 0; i < vertices; ++i)
            corners.push_back(static_cast<std::uint32_t>(i));
        return corners;
    }
    std::string const from = place + "/indices";
    auto const indices = accessor_numbers(model, indices_accessor, 1, from, budget);
    int const type = model.accessors[static_cast<std::size_t>(indices_accessor)].componentType;
    if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
        type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        throw InputError(from, "component type " + std::to_string(type) + " is not one of indices", again);
    corners.reserve(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (!(indices[i] >= 0.0 && indices[i] < static_cast<double>(vertices) &&
              indices[i] == std::floor(indices[i])))
            throw InputError(from,
                             "element " + std::to_string(i) +
                                 " names a vertex that is not there: there are " + std::to_string(vertices),
                             again);
        corners.push_back(static_cast<std::uint32_t>(indices[i]));
    }
    return corners;
}

/// Lists, strips and fans (glTF 2.0, section 3.7.2.1); others have no area.
void MeshReader::add_triangles(tinygltf::Primitive const& primitive, std::uint32_t face,
                               std::string const& place, std::optional<ModelTexture> const& texture) {
    std::size_t vertices = 0;
    std::uint32_t const first = vertices_of(primitive, place, vertices);
    std::vector<std::uint32_t> const corners = corners_of(primitive, place, vertices);
    std::size_t const first_triangle = soup.triangles.size();
    auto const add = [&](std::size_t a, std::size_t b, std::size_t c) {
        soup.triangles.push_back({first + corners[a], first + corners[b], first + corners[c]});
    };
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
        if (corners.size() % 3 != 0)
            warnings.push_back(place + ": the last " + std::to_string(corners.size() % 3) +
                               " corners make no triangle, and are left out");
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
            add(i, i + 1, i + 2);
    }
    for (std::size_t i = 0; i + 2 < corners.size() && primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP; ++i)
        add(i, i + 1 + i % 2, i + 2 - i % 2);
    for (std::size_t i = 0; i + 2 < corners.size() && primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN; ++i)
        add(i + 1, i + 2, 0);
    soup.triangle_face.resize(soup.triangles.size(), face);
    if (texture)
        keep_textures(primitive, *texture, first, first_triangle);
    if (any_normals && attribute(primitive, "NORMAL") < 0)
        make_flat_normals(first_triangle);
    else if (any_normals)
        mend_zero_normals(first_triangle, place);
}

/// Coordinates that cannot be read change no light: warn_of_accessors tells of them, and none are kept.
void MeshReader::keep_textures(tinygltf::Primitive const& primitive, ModelTexture const& texture,
                               std::uint32_t first, std::size_t first_triangle) {
    std::string const name = "TEXCOORD_" + std::to_string(texture.coordinates);
    std::vector<double> numbers;
    try {
        if (int const accessor = attribute(primitive, name.c_str()); accessor >= 0)
            numbers = accessor_numbers(model, accessor, 2, name, texture_budget);
    } catch (InputError const&) {
        return;
    }
    if (numbers.empty())
        return;
    soup.texture_coordinates.resize(soup.triangles.size());
    for (std::size_t t = first_triangle; t < soup.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            if (std::size_t const i = 2 * (soup.triangles[t][k] - first); i + 1 < numbers.size()) {
                dvec2 const uv =
                    numbers[i] * texture.linear[0] + numbers[i + 1] * texture.linear[1] + texture.offset;
                soup.texture_coordinates[t][k] = {uv.x, 1.0 - uv.y}; // v runs downwards
            }
}

/// Without normals a primitive is flat (glTF 2.0, section 3.7.2.1): each corner gets a vertex of its own.
void MeshReader::make_flat_normals(std::size_t first_triangle) {
    for (std::size_t t = first_triangle; t < soup.triangles.size(); ++t) {
        dvec3 const normal = unit_or(area_vector(soup, soup.triangles[t]), dvec3(0.0, 0.0, 1.0));
        for (std::uint32_t& corner : soup.triangles[t]) {
            soup.positions.push_back(dvec3(soup.positions[corner]));
            soup.normals.push_back(normal);
            corner = static_cast<std::uint32_t>(soup.positions.size() - 1);
        }
    }
}

void MeshReader::mend_zero_normals(std::size_t first_triangle, std::string const& place) {
    std::size_t mended = 0;
    for (std::size_t t = first_triangle; t < soup.triangles.size(); ++t)
        for (std::uint32_t const corner : soup.triangles[t])
            if (soup.normals[corner] == dvec3(0.0)) {
                soup.normals[corner] = unit_or(area_vector(soup, soup.triangles[t]), dvec3(0.0, 0.0, 1.0));
                ++mended;
            }
    if (mended > 0)
        warnings.push_back(place + "/attributes/NORMAL: " + std::to_string(mended) +
                           " normals have no length; the triangle's own are taken");
}

bool has_area(tinygltf::Primitive const& primitive) {
    return primitive.mode >= TINYGLTF_MODE_TRIANGLES && primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN;
}

/// A buffer may have no bytes of its own, for an extension to bring them (glTF 2.0, section 3.6.1.1).
bool lacks_bytes(tinygltf::Model const& model, tinygltf::Primitive const& primitive) {
    for (char const* const name : {"POSITION", "NORMAL", gltf_indices_attribute}) {
        auto const accessor = static_cast<std::size_t>(attribute(primitive, name));
        if (accessor >= model.accessors.size())
            continue;
        auto const view = static_cast<std::size_t>(model.accessors[accessor].bufferView);
        if (view >= model.bufferViews.size())
            continue;
        auto const buffer = static_cast<std::size_t>(model.bufferViews[view].buffer);
        if (buffer < model.buffers.size() && model.buffers[buffer].data.empty())
            return true;
    }
    return false;
}

} // namespace

std::vector<ModelMesh> gltf_meshes(tinygltf::Model const& model, std::vector<ModelMaterial> const& materials,
                                   std::string const& file, std::vector<std::string>& warnings) {
    std::vector<ModelMesh> meshes;
    AccessorBudget budget;
    for (tinygltf::Mesh const& source : model.meshes) {
        std::string const place = file + ": /meshes/" + std::to_string(meshes.size());
        ModelMesh mesh;
        mesh.name =
            source.name.empty() ? "mesh_" + std::to_string(meshes.size()) : gltf::short_name(source.name);
        bool any_normals = false;
        for (tinygltf::Primitive const& primitive : source.primitives)
            any_normals = any_normals || (has_area(primitive) && attribute(primitive, "NORMAL") >= 0);
        MeshReader reader{model, budget, warnings, mesh, mesh.soup, any_normals};
        for (std::size_t i = 0; i < source.primitives.size(); ++i) {
            tinygltf::Primitive const& primitive = source.primitives[i];
            std::string const here = place + "/primitives/" + std::to_string(i);
            if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
                throw InputError(here + "/mode", "there is no mode " + std::to_string(primitive.mode),
                                 "give 0 to 6");
            std::string_view const fault = attribute(primitive, "POSITION") < 0 ? "it has no POSITION"
                                           : !has_area(primitive) ? "points and lines have no area"
                                           : lacks_bytes(model, primitive)
                                               ? "its buffer names no file and has no data"
                                               : "";
            if (!fault.empty()) {
                warnings.push_back(here + ": " + std::string(fault) + ": it is left out");
                continue;
            }
            std::optional<std::uint32_t> material;
            if (primitive.material >= 0)
                material = static_cast<std::uint32_t>(primitive.material);
            if (material && *material >= materials.size())
                throw InputError(here + "/material", "there is no material " + std::to_string(*material),
                                 again);
            std::uint32_t const face = static_cast<std::uint32_t>(mesh.face_material.size());
            mesh.face_material.push_back(material);
            mesh.soup.face_names.push_back(material ? materials[*material].name : "surface");
            reader.add_triangles(primitive, face, here,
                                 material ? materials[*material].color_texture : std::nullopt);
            if (!primitive.targets.empty())
                warnings.push_back(here +
                                   "/targets: morph targets are left out: the mesh has its rest shape");
        }
        if (!mesh.soup.texture_coordinates.empty())
            mesh.soup.texture_coordinates.resize(mesh.soup.triangles.size());
        if (mesh.soup.face_names.empty()) {
            mesh.soup.face_names.push_back("surface");
            mesh.face_material.push_back(std::nullopt);
        }
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

} // namespace sahl
