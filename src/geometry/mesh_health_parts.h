// In: nothing. Out: the passes that a health report is made of, and what they share.
#pragma once

#include "geometry/mesh_health.h"
#include "geometry/mesh_sides.h"

namespace sahl {

/// A mesh by places, with what its flat triangles closed.
struct HealthView {
    Mesh const& mesh;
    std::vector<dvec3> places;
    std::vector<Corners> corners; // of the mesh's triangles, then of those that were dropped as flat
    Sides sides;
    std::vector<dvec3> normals; // of the mesh's triangles, unit

    std::size_t real() const { return mesh.soup.triangles.size(); }
    dvec3 const& at(std::uint32_t side) const { return places[corners[side / 3][side % 3]]; }
    dvec3 middle(std::uint32_t side) const { return 0.5 * (at(side) + at(next_side(side))); }
    dvec3 centre(std::uint32_t triangle) const {
        Corners const& c = corners[triangle];
        return (places[c[0]] + places[c[1]] + places[c[2]]) / 3.0;
    }
    std::uint32_t shell_of(std::uint32_t triangle) const;
};

HealthView view_of(Mesh const& mesh);

void find_borders(HealthView const& view, MeshHealth& health);
void find_duplicates(HealthView const& view, MeshHealth& health);
void nest_shells(HealthView const& view, MeshHealth& health);
/// `across` with creases as borders.
std::vector<std::uint32_t> find_creases(HealthView const& view, MeshHealth& health);
NormalHealth compare_normals(HealthView const& view, std::vector<std::uint32_t> const& smooth_across);
std::optional<Found> find_self_intersections(HealthView const& view);

} // namespace sahl
