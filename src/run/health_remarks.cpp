// In: the health of a mesh. Out: what a person should know of it, in sentences.
#include "run/health_report.h"

#include "run/check_words.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sahl {

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;
constexpr double noticeable = 0.1; // rad: normals this far from the geometry are told of, whatever made them
constexpr double first_order_matters = 1e-3; // rad, RMS: the direction error of a lens that focuses at all

using Count = unsigned long long;

struct Speaker {
    std::string const& name;
    Mesh const& mesh;
    MeshHealth const& health;
    Affine const& to_world;
    Remarks remarks;

    double mm(double length) const {
        return length * std::cbrt(std::abs(glm::determinant(to_world.linear))) * 1e3;
    }
    std::string at(dvec3 const& place) const {
        dvec3 const p = to_world.point(place) * 1e3;
        return words("(%.4g, %.4g, %.4g) mm", p.x, p.y, p.z);
    }
    void problem(std::string const& what) { remarks.problems.push_back(name + ": " + what); }
    void warn(std::string const& what) { remarks.warnings.push_back(name + ": " + what); }
    void note(std::string const& what) { remarks.notes.push_back(name + ": " + what); }

    void closing(bool body);
    void triangles();
    void shells();
    void normals();
};

void Speaker::closing(bool body) {
    if (health.borders > 0) {
        Border const& longest = health.longest_borders.front();
        std::string const where =
            words("the longest %.4g mm round, at ", mm(longest.length)) + at(longest.centre);
        if (health.torn())
            (body ? problem(
                        plural(health.borders, "hole", "holes") + " (" + where +
                        "): rays that find one are lost; fill it, in Blender by Mesh > Clean Up > Fill Holes")
                  : warn("it looks torn: " + plural(health.borders, "hole", "holes") + " (" + where +
                         "); fill them if it is to be a body"));
        else if (body)
            problem("not closed: " + plural(health.borders, "border", "borders") + " (" + where +
                    "), so it has no inside; close it, or give it a surface as a mirror or a wall");
    }
    if (health.crowded_edges.count > 0)
        warn(plural(health.crowded_edges.count, "edge", "edges") +
             " of more than two triangles, or whose two sides cannot agree, the first at " +
             at(health.crowded_edges.places.front()) + ": rays that pass there may be lost");
    if (health.pinched_places.count > 0)
        note("parts touch at a single point in " + plural(health.pinched_places.count, "place", "places") +
             ", the first at " + at(health.pinched_places.places.front()));
}

void Speaker::triangles() {
    if (mesh.flipped_triangles > 0)
        note(words("%llu of %llu triangles lay the wrong way round, and were turned",
                   static_cast<Count>(mesh.flipped_triangles), static_cast<Count>(health.triangles)));
    if (mesh.degenerate_triangles > 0)
        note(plural(mesh.degenerate_triangles, "triangle", "triangles") + " without area left out");
    if (health.duplicates.count > 0)
        warn(plural(health.duplicates.count, "triangle is", "triangles are") + " there twice, the first at " +
             at(health.duplicates.places.front()) +
             "; merge what is double, in Blender by Mesh > Merge > By Distance");
    if (health.slivers.count > 0)
        note(plural(health.slivers.count, "sliver", "slivers") +
             words(" (height below %.2g of the longest side), the thinnest %.3g mm high",
                   MeshHealth::sliver_ratio, mm(health.thinnest)));
    if (health.self_intersections && health.self_intersections->count > 0)
        warn("it goes through itself: " + plural(health.self_intersections->count, "pair", "pairs") +
             " of triangles, the first at " + at(health.self_intersections->places.front()));
}

void Speaker::shells() {
    auto const unseen = std::count_if(health.shells.begin(), health.shells.end(),
                                      [](ShellHealth const& shell) { return shell.unseen(); });
    if (unseen == 0)
        return;
    ShellHealth const& first = *std::find_if(health.shells.begin(), health.shells.end(),
                                             [](ShellHealth const& shell) { return shell.unseen(); });
    warn(plural(static_cast<Count>(unseen), "shell lies", "shells lie") +
         " within another and face the same way, so light does not see it; if it is a bubble, flip its "
         "normals (the first, at " +
         at(0.5 * (first.low + first.high)) + ")");
}

void Speaker::normals() {
    NormalHealth const& n = health.normals;
    if (n.across_creases.count > 0)
        warn("normals of " + plural(n.across_creases.count, "vertex", "vertices") +
             words(" are averaged over creases, up to %.3g° off, the first at ",
                   n.worst_across_crease * degrees) +
             at(n.across_creases.places.front()) +
             ": flat faces there bend light as if they were curved; export with sharp edges split, or set "
             "method = \"facet\"");
    if (n.kind == NormalKind::area_weighted || n.kind == NormalKind::angle_weighted ||
        n.kind == NormalKind::plain_mean) {
        std::string const line = words(
            "its normals are means of the triangles' normals weighted by %s: right to first order only, "
            "%.3g mrad RMS and %.3g mrad at worst from second-order ones",
            n.kind == NormalKind::area_weighted    ? "area"
            : n.kind == NormalKind::angle_weighted ? "angle"
                                                   : "nothing",
            n.rms * 1e3, n.worst * 1e3);
        n.rms >= first_order_matters ? warn(line) : note(line);
    } else if (n.kind == NormalKind::flat)
        note("its normals are those of the flat triangles: curved surfaces act as facets");
    else if (n.worst > noticeable)
        warn(words("its normals disagree with the triangles by up to %.3g° (RMS %.3g°), at worst at ",
                   n.worst * degrees, n.rms * degrees) +
             at(n.worst_at));
    if (n.against.count > 0)
        note("normals of " + plural(n.against.count, "vertex", "vertices") +
             " point to the other side of the surface than its triangles do; they are taken the right way "
             "round");
}

} // namespace

void Remarks::add(Remarks const& other) {
    auto const append = [](auto& to, auto const& from) {
        for (std::string const& line : from)
            if (std::find(to.begin(), to.end(), line) == to.end())
                to.push_back(line);
    };
    append(problems, other.problems);
    append(warnings, other.warnings);
    append(notes, other.notes);
}

Remarks health_remarks(std::string const& name, Mesh const& mesh, MeshHealth const& health,
                       Affine const& to_world, bool body) {
    Speaker speaker{name, mesh, health, to_world, {}};
    speaker.closing(body);
    speaker.shells();
    speaker.triangles();
    speaker.normals();
    return std::move(speaker.remarks);
}

std::string unit_doubt(double size, double metres_per_unit) {
    constexpr double least = 1e-4, most = 5.0; // m
    if (!(size > 0.0) || (size >= least && size <= most))
        return "";
    struct Unit {
        char const* name;
        double metres;
    };
    std::string list;
    for (Unit const& unit : {Unit{"mm", 1e-3}, Unit{"cm", 1e-2}, Unit{"inch", 0.0254}, Unit{"m", 1.0}}) {
        double const other = size / metres_per_unit * unit.metres;
        if (std::abs(unit.metres / metres_per_unit - 1.0) > 1e-9 && other >= least && other <= most)
            list += (list.empty() ? "" : ", ") + words("%.4g mm if in %s", other * 1e3, unit.name);
    }
    return words("it is %.4g mm across: are the units right?", size * 1e3) +
           (list.empty() ? "" : " The same file would be " + list);
}

} // namespace sahl
