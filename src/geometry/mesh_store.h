// In: meshes that several scenes share. Out: what is made of each to trace it and to report on it, made once.
#pragma once

#include "geometry/curved_tree.h"
#include "geometry/mesh_health.h"
#include "geometry/mesh_sheet.h"
#include "geometry/mesh_tree.h"

#include <map>
#include <memory>
#include <mutex>

namespace sahl {

/// May be asked by several threads at once; while something is made, those that ask wait for it.
class MeshStore {
  public:
    std::shared_ptr<MeshTree const> tree(std::shared_ptr<Mesh const> const& mesh) {
        std::scoped_lock const lock(mutex_);
        Entry& entry = entry_of(mesh);
        if (!entry.tree)
            entry.tree = std::make_shared<MeshTree const>(mesh);
        return entry.tree;
    }
    std::shared_ptr<MeshSheet const> sheet(std::shared_ptr<Mesh const> const& mesh) {
        std::scoped_lock const lock(mutex_);
        Entry& entry = entry_of(mesh);
        if (!entry.sheet)
            entry.sheet = std::make_shared<MeshSheet const>(mesh);
        return entry.sheet;
    }
    std::shared_ptr<CurvedTree const> curved(std::shared_ptr<Mesh const> const& mesh, PatchKind kind) {
        std::scoped_lock const lock(mutex_);
        auto& curved = entry_of(mesh).curved[kind];
        if (!curved)
            curved = std::make_shared<CurvedTree const>(mesh, kind);
        return curved;
    }
    /// As health_of(), without a search for intersections.
    std::shared_ptr<MeshHealth const> health(std::shared_ptr<Mesh const> const& mesh) {
        std::scoped_lock const lock(mutex_);
        Entry& entry = entry_of(mesh);
        if (!entry.health)
            entry.health = std::make_shared<MeshHealth const>(health_of(*mesh));
        return entry.health;
    }
    /// Scenes that have it keep it.
    void forget(Mesh const* mesh) {
        std::scoped_lock const lock(mutex_);
        entries_.erase(mesh);
    }

  private:
    struct Entry {
        std::shared_ptr<Mesh const> mesh; // so that no other mesh has its address
        std::shared_ptr<MeshTree const> tree{};
        std::shared_ptr<MeshSheet const> sheet{};
        std::map<PatchKind, std::shared_ptr<CurvedTree const>> curved{};
        std::shared_ptr<MeshHealth const> health{};
    };
    Entry& entry_of(std::shared_ptr<Mesh const> const& mesh) {
        return entries_.try_emplace(mesh.get(), Entry{mesh}).first->second;
    }

    std::mutex mutex_;
    std::map<Mesh const*, Entry> entries_;
};

} // namespace sahl
