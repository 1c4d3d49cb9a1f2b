#include "geometry/mesh_health.h"

#include "geometry/mesh_health_parts.h"
#include "geometry/mesh_weld.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace sahl {

namespace {

/// Numbers of places: the vertices' own where no two of them share a position.
void number_places(HealthView& view) {
    TriangleSoup const& soup = view.mesh.soup;
    std::size_t const vertices = soup.positions.size();
    auto const position = [&](std::size_t i) {
        return i < vertices ? soup.positions[i]
                            : view.mesh.flat[(i - vertices) / 3].corners[(i - vertices) % 3];
    };
    std::vector<std::uint32_t> place, first;
    if (soup.normals.empty() && view.mesh.flat.empty()) {
        view.places = soup.positions;
        view.corners = soup.triangles;
        return;
    }
    place = number_kinds(
        vertices + 3 * view.mesh.flat.size(),
        [&](std::size_t i) {
            dvec3 const p = position(i);
            return std::array<std::uint64_t, 3>{std::bit_cast<std::uint64_t>(p.x),
                                                std::bit_cast<std::uint64_t>(p.y),
                                                std::bit_cast<std::uint64_t>(p.z)};
        },
        first);
    view.places.reserve(first.size());
    for (std::uint32_t const i : first)
        view.places.push_back(position(i));
    view.corners.reserve(soup.triangles.size() + view.mesh.flat.size());
    for (auto const& t : soup.triangles)
        view.corners.push_back({place[t[0]], place[t[1]], place[t[2]]});
    for (std::size_t i = vertices; i < place.size(); i += 3)
        view.corners.push_back({place[i], place[i + 1], place[i + 2]});
}

/// Areas, normals, slivers, and what each shell amounts to.
void measure_triangles(HealthView& view, MeshHealth& health) {
    for (MeshShell const& shell : view.mesh.shells) {
        ShellHealth& made = health.shells.emplace_back();
        made.sign = shell.sign;
        made.volume = shell.volume;
        made.low = dvec3(std::numeric_limits<double>::infinity());
        made.high = -made.low;
    }
    view.normals.reserve(view.real());
    health.thinnest = std::numeric_limits<double>::infinity();
    for (std::uint32_t t = 0; t < view.real(); ++t) {
        Corners const& c = view.corners[t];
        dvec3 const &p = view.places[c[0]], &q = view.places[c[1]], &r = view.places[c[2]];
        dvec3 const sides[3] = {q - p, r - q, p - r};
        dvec3 const twice = cross(sides[0], -sides[2]);
        double const size = length(twice);
        view.normals.push_back(size > 0.0 ? twice / size : dvec3(0.0));
        double const longest =
            std::max({dot(sides[0], sides[0]), dot(sides[1], sides[1]), dot(sides[2], sides[2])});
        if (size < MeshHealth::sliver_ratio * longest) {
            health.slivers.add(view.centre(t));
            health.thinnest = std::min(health.thinnest, size / std::sqrt(longest));
        }
        ShellHealth& shell = health.shells[view.mesh.triangle_shell[t]];
        ++shell.triangles;
        shell.area += 0.5 * size;
        for (dvec3 const* const corner : {&p, &q, &r}) {
            shell.low = glm::min(shell.low, *corner);
            shell.high = glm::max(shell.high, *corner);
        }
    }
    if (health.slivers.count == 0)
        health.thinnest = 0.0;
    for (ShellHealth const& shell : health.shells)
        health.area += shell.area;
}

/// Places where more than one fan meets and every side there is joined or a border: a crowded edge is told as
/// such.
void find_pinches(HealthView const& view, MeshHealth& health) {
    enum : std::uint8_t { seen = 1, crowded = 2, pinched = 4 };
    std::vector<std::uint8_t> state(view.places.size(), 0);
    auto const place_of = [&](std::uint32_t side) { return view.corners[side / 3][side % 3]; };
    for (std::uint32_t const side : view.sides.crowded_edges)
        for (std::uint32_t const end : {side, next_side(side)})
            state[place_of(end)] |= crowded;
    for_each_fan(view.sides.across, [&](std::span<std::uint32_t const> fan) {
        std::uint32_t const place = place_of(fan.front());
        if (state[place] == seen)
            health.pinched_places.add(view.places[place]);
        state[place] |= state[place] & seen ? pinched : seen;
    });
}

} // namespace

std::uint32_t HealthView::shell_of(std::uint32_t triangle) const {
    return triangle < real() ? mesh.triangle_shell[triangle] : mesh.flat[triangle - real()].shell;
}

HealthView view_of(Mesh const& mesh) {
    HealthView view{mesh, {}, {}, {}, {}};
    number_places(view);
    view.sides = pair_sides(view.corners, view.places.size());
    return view;
}

bool MeshHealth::torn() const {
    return std::any_of(shells.begin(), shells.end(), [](ShellHealth const& shell) { return shell.torn(); });
}

MeshHealth health_of(Mesh const& mesh, bool look_for_intersections) {
    MeshHealth health;
    HealthView view = view_of(mesh);
    health.triangles = view.real();
    health.places = view.places.size();
    measure_triangles(view, health);
    find_borders(view, health);
    for (std::uint32_t const side : view.sides.crowded_edges)
        health.crowded_edges.add(view.middle(side));
    find_duplicates(view, health);
    find_pinches(view, health);
    nest_shells(view, health);
    auto const smooth = find_creases(view, health);
    if (!mesh.soup.normals.empty())
        health.normals = compare_normals(view, smooth);
    if (look_for_intersections)
        health.self_intersections = find_self_intersections(view);
    return health;
}

} // namespace sahl
