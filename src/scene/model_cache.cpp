#include "scene/model_cache.h"

#include "geometry/smooth_normals.h"
#include "scene/read_model.h"

#include <algorithm>
#include <system_error>

namespace sahl {

namespace {

std::string stamp_of(std::filesystem::path const& path) {
    std::error_code error;
    auto const size = std::filesystem::file_size(path, error);
    auto const time = std::filesystem::last_write_time(path, error);
    return std::to_string(size) + " " + std::to_string(time.time_since_epoch().count());
}

std::uint64_t triangles_of(Model const& model) {
    std::uint64_t sum = 0;
    for (ModelMesh const& mesh : model.meshes)
        sum += mesh.soup.triangles.size();
    return sum;
}

} // namespace

std::shared_ptr<Model const> ModelCache::model(std::filesystem::path const& path) {
    std::scoped_lock const lock(mutex_);
    Entry& entry = entries_[path.string()];
    std::string const stamp = stamp_of(path);
    entry.asked = ++asked_;
    if (!entry.model || entry.stamp != stamp) {
        forget_meshes(entry);
        entry = Entry{stamp, asked_, 0, std::make_shared<Model const>(read_model(path))};
        entry.triangles = triangles_of(*entry.model);
    }
    std::shared_ptr<Model const> const found = entry.model;
    make_room();
    return found;
}

std::shared_ptr<Mesh const> ModelCache::mesh(std::shared_ptr<Model const> const& model, std::size_t number,
                                             bool smooth) {
    std::scoped_lock const lock(mutex_);
    auto const make = [&] {
        auto mesh = std::make_shared<Mesh const>(make_mesh(model->meshes[number].soup));
        return smooth ? with_smooth_normals(std::move(mesh)) : mesh;
    };
    for (auto& [path, entry] : entries_)
        if (entry.model == model) {
            auto& mesh = entry.meshes[{number, smooth}];
            if (!mesh)
                mesh = make();
            return mesh;
        }
    return make(); // given up meanwhile
}

std::shared_ptr<Mesh const> ModelCache::part(std::shared_ptr<Mesh const> const& mesh,
                                             std::vector<std::uint32_t> const& shells) {
    std::scoped_lock const lock(mutex_);
    auto const make = [&] { return std::make_shared<Mesh const>(part_of(*mesh, shells)); };
    for (auto& [path, entry] : entries_) {
        bool const has = std::any_of(entry.meshes.begin(), entry.meshes.end(),
                                     [&](auto const& known) { return known.second == mesh; });
        if (!has)
            continue;
        auto& part = entry.parts[{mesh.get(), shells}];
        if (!part)
            part = make();
        return part;
    }
    return make();
}

void ModelCache::forget_meshes(Entry const& entry) {
    for (auto const& [number, mesh] : entry.meshes)
        store_->forget(mesh.get());
    for (auto const& [key, part] : entry.parts)
        store_->forget(part.get());
}

void ModelCache::make_room() {
    auto const held = [&] {
        std::uint64_t sum = 0;
        for (auto const& [path, entry] : entries_)
            sum += entry.triangles;
        return sum;
    };
    while (entries_.size() > 1 && held() > kept_) {
        auto const oldest =
            std::min_element(entries_.begin(), entries_.end(),
                             [](auto const& a, auto const& b) { return a.second.asked < b.second.asked; });
        forget_meshes(oldest->second);
        entries_.erase(oldest);
    }
}

} // namespace sahl
