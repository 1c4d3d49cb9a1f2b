// In: names of model files, asked for again and again by the steps of a sweep. Out: each file as read, and
// its meshes as prepared, once.
#pragma once

#include "geometry/mesh_store.h"
#include "scene/model.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace sahl {

/// May be asked by several threads at once; while a file is read, those that ask wait for it. A file that has
/// another size or time of writing is read again. Of more triangles than are kept, those that were asked for
/// longest ago are given up; scenes that have them keep them.
class ModelCache {
  public:
    /// kept   triangles; four million are about 2 GB with what is made of them
    explicit ModelCache(std::uint64_t kept = 4'000'000) : kept_(kept) {}

    /// Throws InputError, as read_model does.
    std::shared_ptr<Model const> model(std::filesystem::path const& path);
    /// make_mesh() of the model's mesh of this number.
    ///   smooth   with normals where it has none
    std::shared_ptr<Mesh const> mesh(std::shared_ptr<Model const> const& model, std::size_t number,
                                     bool smooth = false);
    /// part_of() a mesh that came from here.
    std::shared_ptr<Mesh const> part(std::shared_ptr<Mesh const> const& mesh,
                                     std::vector<std::uint32_t> const& shells);
    std::shared_ptr<MeshStore> const& store() const { return store_; }

  private:
    struct Entry {
        std::string stamp; // size and time of writing
        std::uint64_t asked = 0, triangles = 0;
        std::shared_ptr<Model const> model{};
        std::map<std::pair<std::size_t, bool>, std::shared_ptr<Mesh const>> meshes{}; // by number, and smooth
        std::map<std::pair<Mesh const*, std::vector<std::uint32_t>>, std::shared_ptr<Mesh const>> parts{};
    };
    void make_room();
    void forget_meshes(Entry const& entry);

    std::mutex mutex_;
    std::uint64_t kept_, asked_ = 0;
    std::map<std::string, Entry> entries_; // by path
    std::shared_ptr<MeshStore> store_ = std::make_shared<MeshStore>();
};

} // namespace sahl
