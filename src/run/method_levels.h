// In: a scene with meshes. Out: for each method that a mesh can be met by, a bound on the error of
// directions, by pilot rays.
#pragma once

#include "geometry/mesh_store.h"
#include "run/path_errors.h"
#include "scene/scene_methods.h"

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace sahl {

struct MethodLevel {
    Method method = Method::facet;
    double bound = 0.0;   // rad
    double rms = 0.0;     // rad, of the pilots against the finest method; of that, what it cannot tell of
                          // itself
    double changed = 0.0; // share of the pilots that meet other events
};

/// Bounds of every method that some bodies can be met by, recognised first, then from coarse to fine.
struct MethodLevels {
    std::vector<MethodLevel> levels;
    bool loses_light = false; // the curved surface through the mesh's data does, as through a scan's noise:
                              // then there are no bounds
    Trees reference{};        // the pilots by the finest method,
    double reference_bound = INFINITY; // rad, and what that errs by itself
};

/// Pilots of a scene whose curved meshes are fitted, but for those that are asked about.
class MethodPilots {
  public:
    /// curved   by body: met as a curved surface where nothing else is said
    MethodPilots(Scene& scene, WavelengthTable const& optics, Emission const& emission,
                 TraceOptions const& options, std::vector<bool> curved);

    bool curved(std::size_t body) const { return curved_[body]; }
    MethodLevels levels(std::vector<std::size_t> const& bodies);
    /// The same of other meshes for these bodies, each method held against the finest that levels() found.
    std::vector<MethodLevel> levels_with(std::vector<std::size_t> const& bodies,
                                         std::vector<std::shared_ptr<Mesh const>> const& meshes,
                                         MethodLevels const& found);
    /// How far other meshes for these bodies move the pilots, all met as the scene has it.
    PathErrors moved_by(std::vector<std::size_t> const& bodies,
                        std::vector<std::shared_ptr<Mesh const>> const& meshes);
    /// What rounding to the digits that the files of these meshes have makes of directions (rad, RMS): how
    /// far they move when places and normals are moved by such steps.
    double floor_of(std::vector<std::size_t> const& bodies);
    /// By body; to be changed when a choice is made.
    std::vector<BodyMethod>& methods() { return base_; }
    /// The scene's geometry, met so.
    std::unique_ptr<Bvh const> met() { return bvh_with(scene_, base_, &store_); }

  private:
    std::optional<Trees> trees(std::vector<std::size_t> const& bodies, BodyMethod method);
    void swap_meshes(std::vector<std::size_t> const& bodies,
                     std::vector<std::shared_ptr<Mesh const>>& meshes);

    Scene& scene_;
    WavelengthTable const& optics_;
    Emission const& emission_;
    TraceOptions const& options_;
    std::vector<std::uint64_t> rays_;
    std::vector<BodyMethod> base_;
    std::vector<bool> curved_;
    MeshStore store_; // what is made of meshes: most methods need the same of them
};

/// Bodies that are closed meshes, or open ones without an inside that touch nothing.
std::vector<bool> curvable_meshes(Scene const& scene);

/// The curved bodies, in groups that take one method: those that touch, since their boundary is in common;
/// where that makes more than six, all of them.
std::vector<std::vector<std::size_t>> judged_together(Scene const& scene, std::vector<bool> const& curved);

/// The fastest of the levels whose bound is within the tolerance (rad); where none is, that of the least
/// bound. By a fixed order, so that a choice never depends on a clock.
struct ChosenLevel {
    MethodLevel level;
    bool within = true;
};
ChosenLevel chosen_level(std::vector<MethodLevel> const& levels, double tolerance);

} // namespace sahl
