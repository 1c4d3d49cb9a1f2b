// In: a mesh with normals from its file. Out: how far they are from what the triangles say, and by which rule
// they were made.
#include "geometry/mesh_health_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sahl {

namespace {

/// The angle between two directions, well conditioned where it is small.
double angle(dvec3 const& a, dvec3 const& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// Sums over a fan's corners by each rule; lengths do not matter.
using Rules = std::array<dvec3, 4>; // max, area, angle, plain
constexpr std::array<NormalKind, 4> rule_kinds{NormalKind::max_weighted, NormalKind::area_weighted,
                                               NormalKind::angle_weighted, NormalKind::plain_mean};

/// The corner's part in Max's sum: N sin α / (|e₁||e₂|) = (e₁×e₂) / (|e₁|²|e₂|²).
dvec3 max_term(HealthView const& view, std::uint32_t corner) {
    dvec3 const at = view.at(corner);
    dvec3 const e1 = view.at(next_side(corner)) - at, e2 = view.at(previous_side(corner)) - at;
    return cross(e1, e2) / (dot(e1, e1) * dot(e2, e2));
}

void add_terms(HealthView const& view, std::uint32_t corner, Rules& sums) {
    dvec3 const at = view.at(corner);
    dvec3 const e1 = view.at(next_side(corner)) - at, e2 = view.at(previous_side(corner)) - at;
    sums[0] += max_term(view, corner);
    sums[1] += cross(e1, e2);
    sums[2] += angle(e1, e2) * view.normals[corner / 3];
    sums[3] += view.normals[corner / 3];
}

/// Of the corners of a sample of the fans, how many each rule explains.
struct Suspects {
    std::array<std::uint64_t, 4> explained{};
    std::uint64_t flat = 0; // by the triangles' own normals
    std::uint64_t corners = 0;
};

/// rad: float's rounding, or a few digits of text.
constexpr double explains_within = 1e-3;
constexpr std::uint64_t sample = 4096; // fans: enough to tell rules apart

/// Nine in ten: a rim whose normals are averaged over a crease does not hide how the others were made.
NormalKind kind_of(Suspects const& suspects) {
    auto const enough = [&](std::uint64_t count) { return 10 * count >= 9 * suspects.corners; };
    auto const candidates = std::count_if(suspects.explained.begin(), suspects.explained.end(), enough);
    if (candidates > 1)
        return NormalKind::any_mean;
    for (std::size_t i = 0; i < rule_kinds.size(); ++i)
        if (enough(suspects.explained[i]))
            return rule_kinds[i];
    return enough(suspects.flat) ? NormalKind::flat : NormalKind::other;
}

} // namespace

NormalHealth compare_normals(HealthView const& view, std::vector<std::uint32_t> const& smooth_across) {
    NormalHealth found;
    TriangleSoup const& soup = view.mesh.soup;
    constexpr std::uint32_t nobody = 0xFFFFFFFFu;
    std::vector<std::uint32_t> owner(soup.normals.size(), nobody); // the fan that a vertex was met in first
    std::vector<bool> shared(soup.normals.size(), false);
    struct Compared {
        std::uint32_t vertex;
        double angle;
    };
    std::vector<Compared> compared;
    compared.reserve(soup.normals.size());
    Suspects suspects;
    std::uint32_t number = 0;
    std::uint64_t const stride = std::max<std::uint64_t>(1, view.places.size() / sample);
    for_each_fan(smooth_across, [&](std::span<std::uint32_t const> fan) {
        dvec3 sum(0.0);
        for (std::uint32_t const corner : fan)
            if (corner / 3 < view.real())
                sum += max_term(view, corner);
        bool const sampled = number % stride == 0;
        Rules rules{};
        for (std::size_t i = 0; sampled && i < fan.size(); ++i)
            if (fan[i] / 3 < view.real())
                add_terms(view, fan[i], rules);
        for (std::uint32_t const corner : fan) {
            if (corner / 3 >= view.real())
                continue;
            std::uint32_t const vertex = soup.triangles[corner / 3][corner % 3];
            dvec3 const& normal = soup.normals[vertex];
            bool const against = dot(normal, sum) < 0.0;
            if (owner[vertex] != number) {
                if (owner[vertex] == nobody) {
                    if (against)
                        found.against.add(soup.positions[vertex]);
                } else if (!shared[vertex]) {
                    shared[vertex] = true;
                    found.across_creases.add(soup.positions[vertex]);
                }
                owner[vertex] = number;
                compared.push_back({vertex, angle(against ? -normal : normal, sum)});
            }
            if (!sampled || fan.size() < 2)
                continue;
            dvec3 const facing = against ? -normal : normal;
            for (std::size_t i = 0; i < rules.size(); ++i)
                suspects.explained[i] += angle(facing, rules[i]) < explains_within;
            suspects.flat += angle(facing, view.normals[corner / 3]) < explains_within;
            ++suspects.corners;
        }
        ++number;
    });

    double squares = 0.0;
    for (Compared const& c : compared) {
        if (shared[c.vertex]) {
            found.worst_across_crease = std::max(found.worst_across_crease, c.angle);
            continue;
        }
        ++found.vertices;
        squares += c.angle * c.angle;
        if (c.angle > found.worst) {
            found.worst = c.angle;
            found.worst_at = soup.positions[c.vertex];
        }
    }
    found.rms = std::sqrt(squares / static_cast<double>(std::max<std::uint64_t>(1, found.vertices)));
    found.kind = kind_of(suspects);
    return found;
}

} // namespace sahl
