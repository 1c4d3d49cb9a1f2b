#include "run/write_glb.h"

#include "record/pending_file.h"
#include "run/run.h"
#include "run/values.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace sahl {

namespace {

enum Component { unsigned_byte = 5121, unsigned_int = 5125, floating = 5126 };
enum Target { vertices = 34962, indices = 34963 };
constexpr std::uint64_t lines_mode = 1;

Value number(std::uint64_t n) {
    return of(n);
}

Value colour(std::array<double, 3> const& c) {
    return of(Array{of(c[0]), of(c[1]), of(c[2])});
}

class GlbWriter {
  public:
    Value json(Model const& model, std::span<ModelLines const> lines) {
        Array materials, meshes, nodes;
        for (ModelMaterial const& material : model.materials)
            materials.push_back(of(material_json(material)));
        for (ModelMesh const& mesh : model.meshes)
            meshes.push_back(mesh_json(mesh));
        for (ModelInstance const& instance : model.instances)
            nodes.push_back(node_json(instance));
        for (ModelLines const& of_kind : lines) {
            if (of_kind.places.empty())
                continue;
            nodes.push_back(of(Table{{"name", of(of_kind.name)}, {"mesh", number(meshes.size())}}));
            meshes.push_back(lines_json(of_kind, lines_material(materials)));
        }
        Array roots;
        for (std::uint64_t i = 0; i < nodes.size(); ++i)
            roots.push_back(number(i));
        Table table{
            {"asset", of(Table{{"version", of(std::string("2.0"))}, {"generator", of(program_name())}})},
            {"scene", number(0)},
            {"scenes", of(Array{of(Table{{"nodes", of(std::move(roots))}})})}};
        auto const add = [&](char const* key, Array array) {
            if (!array.empty())
                table.emplace_back(key, of(std::move(array)));
        };
        add("nodes", std::move(nodes));
        add("meshes", std::move(meshes));
        add("materials", std::move(materials));
        add("accessors", std::move(accessors_));
        add("bufferViews", std::move(views_));
        if (!bytes_.empty())
            add("buffers", {of(Table{{"byteLength", number(bytes_.size())}})});
        Array used;
        for (std::string const& name : extensions_)
            used.push_back(of(name));
        add("extensionsUsed", std::move(used));
        if (!model.extras.empty())
            table.emplace_back("extras", parse_json(model.extras, "extras"));
        return of(std::move(table));
    }

    std::string const& bytes() const { return bytes_; }

  private:
    template <class T>
    void put(T const& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        bytes_.append(reinterpret_cast<char const*>(&value), sizeof value);
    }

    /// What was put since `begin` becomes an accessor of its own.
    std::uint64_t accessor(std::size_t begin, Target target, Component component, char const* type,
                           std::uint64_t count, Table more = {}) {
        views_.push_back(of(Table{{"buffer", number(0)},
                                  {"byteOffset", number(begin)},
                                  {"byteLength", number(bytes_.size() - begin)},
                                  {"target", number(target)}}));
        Table table{{"bufferView", number(views_.size() - 1)},
                    {"componentType", number(component)},
                    {"count", number(count)},
                    {"type", of(std::string(type))}};
        for (auto& entry : more)
            table.push_back(std::move(entry));
        accessors_.push_back(of(std::move(table)));
        return accessors_.size() - 1;
    }

    std::uint64_t places(std::vector<dvec3> const& list) {
        std::size_t const begin = bytes_.size();
        glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
        for (dvec3 const& place : list) {
            glm::vec3 const p(place);
            low = glm::min(low, p);
            high = glm::max(high, p);
            put(p);
        }
        return accessor(begin, vertices, floating, "VEC3", list.size(),
                        {{"min", of(dvec3(low))}, {"max", of(dvec3(high))}});
    }
    std::uint64_t normals(std::vector<dvec3> const& list) {
        std::size_t const begin = bytes_.size();
        for (dvec3 const& normal : list)
            put(glm::vec3(normal));
        return accessor(begin, vertices, floating, "VEC3", list.size());
    }

    Value mesh_json(ModelMesh const& mesh) {
        TriangleSoup const& soup = mesh.soup;
        Array primitives;
        for (std::uint32_t face = 0; face < soup.face_names.size(); ++face) {
            std::vector<std::uint32_t> corners; // in the order of first use
            std::vector<dvec3> at, normal;
            std::map<std::uint32_t, std::uint32_t> known;
            for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
                if (soup.triangle_face[t] != face)
                    continue;
                for (std::uint32_t const corner : soup.triangles[t]) {
                    auto const [found, is_new] =
                        known.try_emplace(corner, static_cast<std::uint32_t>(at.size()));
                    if (is_new) {
                        at.push_back(soup.positions[corner]);
                        if (!soup.normals.empty())
                            normal.push_back(soup.normals[corner]);
                    }
                    corners.push_back(found->second);
                }
            }
            if (corners.empty())
                continue;
            Table attributes{{"POSITION", number(places(at))}};
            if (!normal.empty())
                attributes.emplace_back("NORMAL", number(normals(normal)));
            std::size_t const begin = bytes_.size();
            for (std::uint32_t const corner : corners)
                put(corner);
            Table primitive{
                {"attributes", of(std::move(attributes))},
                {"indices", number(accessor(begin, indices, unsigned_int, "SCALAR", corners.size()))}};
            if (mesh.face_material[face])
                primitive.emplace_back("material", number(*mesh.face_material[face]));
            primitive.emplace_back("extras", of(Table{{"face", of(soup.face_names[face])}}));
            primitives.push_back(of(std::move(primitive)));
        }
        return of(Table{{"name", of(mesh.name)}, {"primitives", of(std::move(primitives))}});
    }

    Value lines_json(ModelLines const& lines, std::uint64_t material) {
        Table attributes{{"POSITION", number(places(lines.places))}};
        std::size_t const begin = bytes_.size();
        for (auto const& c : lines.colours)
            put(c);
        attributes.emplace_back("COLOR_0",
                                number(accessor(begin, vertices, unsigned_byte, "VEC4", lines.colours.size(),
                                                {{"normalized", of(true)}})));
        Table primitive{{"attributes", of(std::move(attributes))},
                        {"mode", number(lines_mode)},
                        {"material", number(material)}};
        if (!lines.extras.empty())
            primitive.emplace_back("extras", parse_json(lines.extras, "extras"));
        return of(Table{{"name", of(lines.name)}, {"primitives", of(Array{of(std::move(primitive))})}});
    }

    /// What shows the colours of places as they are.
    std::uint64_t lines_material(Array& materials) {
        if (!lines_material_) {
            lines_material_ = materials.size();
            materials.push_back(of(Table{{"name", of(std::string("rays"))},
                                         {"extensions", of(Table{extension("KHR_materials_unlit", {})})}}));
        }
        return *lines_material_;
    }

    std::pair<std::string, Value> extension(std::string const& name, Table content) {
        if (std::find(extensions_.begin(), extensions_.end(), name) == extensions_.end())
            extensions_.push_back(name);
        return {name, of(std::move(content))};
    }

    Table material_json(ModelMaterial const& m) {
        Table table{{"name", of(m.name)},
                    {"pbrMetallicRoughness",
                     of(Table{{"baseColorFactor", of(Array{of(m.base_color[0]), of(m.base_color[1]),
                                                           of(m.base_color[2]), of(m.base_color[3])})},
                              {"metallicFactor", of(m.metallic)},
                              {"roughnessFactor", of(m.roughness)}})}};
        if (m.alpha_mode == AlphaMode::blend)
            table.emplace_back("alphaMode", of(std::string("BLEND")));
        if (m.double_sided)
            table.emplace_back("doubleSided", of(true));
        Table extensions;
        if (m.transmission > 0.0) {
            extensions.push_back(
                extension("KHR_materials_transmission", {{"transmissionFactor", of(m.transmission)}}));
            extensions.push_back(extension("KHR_materials_ior", {{"ior", of(m.ior)}}));
        }
        if (m.dispersion > 0.0)
            extensions.push_back(extension("KHR_materials_dispersion", {{"dispersion", of(m.dispersion)}}));
        if (m.volume) {
            Table volume{{"thicknessFactor", of(m.volume->thickness_factor)}};
            if (std::isfinite(m.volume->attenuation_distance)) {
                volume.emplace_back("attenuationDistance", of(m.volume->attenuation_distance));
                volume.emplace_back("attenuationColor", colour(m.volume->attenuation_color));
            }
            extensions.push_back(extension("KHR_materials_volume", std::move(volume)));
        }
        if (!extensions.empty())
            table.emplace_back("extensions", of(std::move(extensions)));
        if (!m.extras.empty())
            table.emplace_back("extras", parse_json(m.extras, "extras"));
        return table;
    }

    static Value node_json(ModelInstance const& instance) {
        Table table{{"name", of(instance.name)}, {"mesh", number(instance.mesh)}};
        Affine const& map = instance.to_world;
        if (!(map == Affine{})) {
            Array matrix;
            for (int column = 0; column < 4; ++column) {
                for (int row = 0; row < 3; ++row)
                    matrix.push_back(of(column < 3 ? map.linear[column][row] : map.offset[row]));
                matrix.push_back(of(column < 3 ? 0.0 : 1.0));
            }
            table.emplace_back("matrix", of(std::move(matrix)));
        }
        return of(std::move(table));
    }

    std::string bytes_;
    Array views_, accessors_;
    std::vector<std::string> extensions_;
    std::optional<std::uint64_t> lines_material_;
};

std::string word(std::uint64_t n) { // little-endian, as every machine that this runs on
    auto const narrow = static_cast<std::uint32_t>(n);
    return {reinterpret_cast<char const*>(&narrow), sizeof narrow};
}

} // namespace

bool is_made_of_scale_and_turn(dmat3 const& linear) {
    for (auto const& [a, b] : {std::pair(0, 1), {0, 2}, {1, 2}})
        if (std::abs(dot(linear[a], linear[b])) > 1e-12 * length(linear[a]) * length(linear[b]))
            return false;
    return true;
}

void write_glb(Model const& model, std::span<ModelLines const> lines, std::filesystem::path const& out) {
    GlbWriter writer;
    std::string json = to_json(writer.json(model, lines));
    json.append((4 - json.size() % 4) % 4, ' ');
    std::string const& bytes = writer.bytes(); // all of it in fours
    std::uint64_t const size = 12 + 8 + json.size() + (bytes.empty() ? 0 : 8 + bytes.size());
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw InputError(out.string(), "it would be larger than the 4 GiB that a .glb can have",
                         "choose a smaller fineness, or fewer rays");
    PendingFile file(out);
    file.write("glTF" + word(2) + word(size) + word(json.size()) + "JSON");
    file.write(json);
    if (!bytes.empty()) {
        file.write(word(bytes.size()) + std::string("BIN\0", 4));
        file.write(bytes);
    }
    file.finish();
}

} // namespace sahl
