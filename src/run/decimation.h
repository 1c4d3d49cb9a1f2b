// In: a scene with meshes finer than they need be. Out: those in fewer triangles, and how far that moves
// light.
#pragma once

#include "run/method_levels.h"

#include <string>
#include <vector>

namespace sahl {

/// A mesh for each of some bodies, and how far what it leaves out lies off it (m, world).
struct FewerTriangles {
    std::vector<std::shared_ptr<Mesh const>> meshes;
    std::vector<double> within;
};

/// Bodies that touch nothing: a mesh in contact keeps its triangles, which its neighbour has too.
std::vector<bool> free_to_decimate(Scene const& scene);

/// What the experiment asks for by decimate_mm, of those of the bodies that are free; nothing where it asks
/// none.
std::optional<FewerTriangles> asked_for(Scene const& scene, std::vector<std::size_t> const& bodies,
                                        std::vector<bool> const& free);

/// The fewest triangles, and the fastest method, by which a group that `found` tells of still meets its share
/// of a tolerance (rad); nothing where its own triangles do as well.
///   whole   the level chosen of its own triangles
struct Decimated {
    FewerTriangles to;
    MethodLevel level;
};
std::optional<Decimated> fewest(MethodPilots& judge, Scene const& scene,
                                std::vector<std::size_t> const& bodies, std::vector<bool> const& free,
                                MethodLevels const& found, MethodLevel const& whole, double tolerance);

/// Gives the bodies those meshes. The scene's geometry is to be built anew then.
///   turn, changed   what the pilots tell of it
void put(Scene& scene, std::vector<std::size_t> const& bodies, FewerTriangles const& to, double turn,
         double changed);

/// What the experiment asks for by decimate_mm and no method was chosen for, by the method that it asks for.
/// Returns warnings.
std::vector<std::string> decimate_by_name(Scene& scene, WavelengthTable const& optics,
                                          Emission const& emission, TraceOptions const& options);

} // namespace sahl
