#include "run/health_report.h"

#include "geometry/mesh_store.h"
#include "run/values.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>

namespace sahl {

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

char const* name_of(NormalKind kind) {
    switch (kind) {
    case NormalKind::none:
        return "none";
    case NormalKind::flat:
        return "flat";
    case NormalKind::max_weighted:
        return "max_weighted";
    case NormalKind::area_weighted:
        return "area_weighted";
    case NormalKind::angle_weighted:
        return "angle_weighted";
    case NormalKind::plain_mean:
        return "plain_mean";
    case NormalKind::any_mean:
        return "any_mean";
    case NormalKind::other:
        break;
    }
    return "other";
}

struct InWorld {
    Affine to_world;
    double scale = std::cbrt(std::abs(glm::determinant(to_world.linear)));

    Value place(dvec3 const& p) const { return of(to_world.point(p), 1e3); }
    Value length_mm(double x) const { return of(x * scale * 1e3); }
    Value found(Found const& what) const {
        Array places;
        for (dvec3 const& p : what.places)
            places.push_back(place(p));
        return of(Table{{"count", of(what.count)}, {"first_at_mm", of(std::move(places))}});
    }
};

/// Of the box round the box's corners in the world.
dvec3 size_in_world(dvec3 const& low, dvec3 const& high, Affine const& to_world) {
    dvec3 const half = 0.5 * (high - low);
    dvec3 size(0.0);
    for (int axis = 0; axis < 3; ++axis)
        size += 2.0 * half[axis] * glm::abs(to_world.linear[axis]);
    return size;
}

Value shells_value(MeshHealth const& health, InWorld const& world) {
    double const s = world.scale;
    Array shells;
    for (ShellHealth const& shell : health.shells) {
        if (shells.size() == 100) // a model of ten thousand pieces is not listed piece by piece
            break;
        std::string const kind = !shell.closed ? "open" : shell.sign > 0 ? "body" : "cavity";
        shells.push_back(of(Table{
            {"kind", of(kind)},
            {"triangles", of(shell.triangles)},
            {"volume_mm3", shell.closed ? of(shell.volume * s * s * s * 1e9) : nothing()},
            {"area_mm2", of(shell.area * s * s * 1e6)},
            {"centre_mm", world.place(0.5 * (shell.low + shell.high))},
            {"size_mm", of(size_in_world(shell.low, shell.high, world.to_world), 1e3)},
            {"border_mm", world.length_mm(shell.border_length)},
            {"torn", of(shell.torn())},
            {"winding_outside",
             health.nesting_known ? Value{std::int64_t{shell.winding_outside}, {}} : nothing()},
        }));
    }
    return of(std::move(shells));
}

Value normals_value(NormalHealth const& normals, InWorld const& world) {
    if (normals.kind == NormalKind::none)
        return of(Table{{"kind", of(std::string("none"))}});
    return of(Table{{"kind", of(std::string(name_of(normals.kind)))},
                    {"compared", of(normals.vertices)},
                    {"worst_deg", of(normals.worst * degrees)},
                    {"worst_at_mm", world.place(normals.worst_at)},
                    {"rms_deg", of(normals.rms * degrees)},
                    {"across_creases", world.found(normals.across_creases)},
                    {"worst_across_crease_deg", of(normals.worst_across_crease * degrees)},
                    {"against_the_surface", world.found(normals.against)}});
}

} // namespace

Value health_value(Mesh const& mesh, MeshHealth const& health, Affine const& to_world) {
    InWorld const world{to_world};
    double volume = 0.0;
    for (ShellHealth const& shell : health.shells)
        volume += shell.unseen() ? 0.0 : shell.sign * shell.volume;
    bool const closed = health.borders == 0 && health.crowded_edges.count == 0;
    Array borders;
    for (Border const& border : health.longest_borders)
        borders.push_back(of(Table{{"length_mm", world.length_mm(border.length)},
                                   {"centre_mm", world.place(border.centre)},
                                   {"edges", of(border.edges)}}));
    return of(Table{
        {"triangles", of(health.triangles)},
        {"vertices", of(health.places)},
        {"size_mm", of(size_in_world(mesh.low, mesh.high, to_world), 1e3)},
        {"closed", of(closed)},
        {"torn", of(health.torn())},
        {"volume_mm3", of(volume * world.scale * world.scale * world.scale * 1e9)},
        {"area_mm2", of(health.area * world.scale * world.scale * 1e6)},
        {"shell_count", of(std::uint64_t{health.shells.size()})},
        {"shells", shells_value(health, world)},
        {"borders", of(Table{{"count", of(health.borders)},
                             {"length_mm", world.length_mm(health.border_length)},
                             {"longest", of(std::move(borders))}})},
        {"non_manifold_edges", world.found(health.crowded_edges)},
        {"non_manifold_vertices", world.found(health.pinched_places)},
        {"turned_triangles", of(mesh.flipped_triangles)},
        {"degenerate_triangles", of(mesh.degenerate_triangles)},
        {"duplicate_triangles", world.found(health.duplicates)},
        {"slivers", world.found(health.slivers)},
        {"thinnest_sliver_mm", health.slivers.count ? world.length_mm(health.thinnest) : nothing()},
        {"creases",
         of(Table{{"count", of(health.creases)}, {"length_mm", world.length_mm(health.crease_length)}})},
        {"normals", normals_value(health.normals, world)},
        {"self_intersections",
         health.self_intersections ? world.found(*health.self_intersections) : nothing()},
    });
}

Value decimation_value(Body const& body) {
    Decimation const& by = *body.decimated;
    return of(Table{{"triangles", of(std::uint64_t{body.mesh->soup.triangles.size()})},
                    {"of", of(std::uint64_t{by.whole->soup.triangles.size()})},
                    {"within_mm", of(by.within * 1e3)},
                    {"turn_rad", of(by.turn)},
                    {"sequence_changed", of(by.sequence_changed)}});
}

Value models_value(Scene const& scene, bool look_for_intersections, Remarks* remarks) {
    Table models;
    std::map<std::pair<Mesh const*, bool>, std::size_t> first; // of the same mesh, open or not: its entry
    for (Body const& body : scene.bodies) {
        if (!body.mesh)
            continue;
        auto const& mesh = body.decimated ? body.decimated->whole : body.mesh;
        auto const [entry, is_new] = first.try_emplace({mesh.get(), body.open}, models.size());
        if (!is_new) {
            auto const& [name, like] = models[entry->second];
            models.emplace_back(body.name, of(Table{{"same_mesh_as", of(name)},
                                                    {"triangles", *like.find("triangles")},
                                                    {"closed", *like.find("closed")}}));
            continue;
        }
        bool const known = scene.meshes && !look_for_intersections;
        MeshHealth const health =
            known ? *scene.meshes->health(mesh) : health_of(*mesh, look_for_intersections);
        models.emplace_back(body.name, health_value(*mesh, health, body.to_world));
        if (remarks)
            remarks->add(health_remarks(body.name, *mesh, health, body.to_world, !body.open));
    }
    return of(std::move(models));
}

} // namespace sahl
