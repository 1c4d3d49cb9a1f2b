#include "run/normal_warnings.h"

#include "geometry/mesh_health.h"
#include "geometry/smooth_fans.h"
#include "geometry/triangle.h"

#include <algorithm>
#include <cstdio>
#include <map>

namespace sahl {

namespace {

/// rad: how far a triangle's normal is from those at its corners, median.
double facets_off(SmoothFans const& fans) {
    std::vector<double> off;
    Mesh const& mesh = *fans.mesh;
    for (std::size_t t = 0; t < fans.triangles.size(); ++t) {
        auto const& corners = mesh.soup.triangles[t];
        dvec3 const normal = normal_of({mesh.soup.positions[corners[0]], mesh.soup.positions[corners[1]],
                                        mesh.soup.positions[corners[2]]});
        for (std::uint32_t const fan : fans.triangles[t].fans)
            off.push_back(length(cross(normal, fans.fans[fan].normal)));
    }
    if (off.empty())
        return 0.0;
    auto const middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
    std::nth_element(off.begin(), middle, off.end());
    return *middle;
}

std::string few_digits(Body const& body, SmoothFans const& fans) {
    char text[300];
    double const facets = facets_off(fans);
    if (body.method != Method::interpolated)
        return body.name +
               ": the file's normals are first order only, or of few digits; the curved surface is "
               "that of its places alone";
    if (fans.normals_off <= facets)
        return {};
    std::snprintf(
        text, sizeof text,
        ": the file's normals are %.2g rad off the surface, its triangles %.2g: interpolated is worse "
        "than facet here; quadratic and fitted take the places alone",
        fans.normals_off, facets);
    return body.name + text;
}

/// A curved method was asked for, and the mesh is met by its triangles.
std::string not_curved(Scene const& scene, Body const& body) {
    Method const asked = scene.mesh_method;
    auto const is_curved = [](Method method) {
        return method == Method::quadratic || method == Method::fitted || method == Method::recognised;
    };
    if (!is_curved(asked) || !body.mesh || is_curved(body.method))
        return {};
    return body.name + (body.open ? ": an open mesh that touches something" : ": a mesh with holes") +
           " is not taken as curved; it is traced as " +
           (body.method == Method::interpolated ? "interpolated" : "facet") +
           ". For a curved mirror use a shape, or a closed body";
}

} // namespace

std::vector<std::string> normal_warnings(Scene const& scene) {
    std::vector<std::string> warnings;
    std::map<std::pair<Mesh const*, Method>, bool> told;
    for (Body const& body : scene.bodies) {
        if (std::string text = not_curved(scene, body); !text.empty())
            warnings.push_back(std::move(text));
        bool const meets_triangles = body.method == Method::facet || body.method == Method::automatic;
        if (!body.mesh || (!body.open && !body.mesh->closed()) || meets_triangles ||
            body.mesh->soup.normals.empty() || !told.try_emplace({body.mesh.get(), body.method}).second)
            continue;
        SmoothFans const fans = smooth_fans(body.mesh);
        if (fans.normals == NormalUse::first_order)
            if (std::string text = few_digits(body, fans); !text.empty())
                warnings.push_back(std::move(text));
        if (body.method != Method::interpolated)
            continue;
        auto const averaged = health_of(*body.mesh).normals.across_creases.count;
        if (averaged > 0)
            warnings.push_back(body.name + ": the file's normals are averaged over creases at " +
                               std::to_string(averaged) +
                               " vertices: near them interpolated is worse than facet");
    }
    return warnings;
}

} // namespace sahl
