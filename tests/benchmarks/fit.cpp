// Figures, never asserted: how light leaves planoconvex aspheres whose fitted meshes have places and normals
// in float and in double, RMS and greatest error over 80 % of the aperture: what the fit leaves, and what the
// digits do.
#include "support/curved.h"

#include "geometry/curved_tree.h"
#include "geometry/tessellate.h"

#include <cmath>
#include <cstdio>
#include <numbers>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr double index = 1.5168;

/// Lengths in mm, as an experiment has them.
Lens asphere(double radius, double conic, std::vector<double> const& terms) {
    Lens lens{1e-3 * radius, 0.0, 8e-3, 25e-3, conic, 0.0, {}, {}};
    double unit = 1e9;
    for (double const term : terms) {
        lens.aspheric1.push_back(term * unit);
        unit *= 1e6;
    }
    return lens;
}

double slope_of(Lens const& lens, double r) {
    double const c = 1.0 / lens.r1;
    double sum = c * r / std::sqrt(1.0 - (1.0 + lens.conic1) * c * c * r * r), power = r * r * r, k = 4.0;
    for (double const term : lens.aspheric1) {
        sum += k * term * power;
        power *= r * r;
        k += 2.0;
    }
    return sum;
}

/// Behind the flat, of light that comes along z to a place with this normal.
dvec3 leaving(dvec3 const& normal) {
    double const cosine = -normal.z, by = 1.0 / index;
    dvec3 const in = by * dvec3(0.0, 0.0, 1.0) +
                     (by * cosine - std::sqrt(1.0 - by * by * (1.0 - cosine * cosine))) * normal;
    dvec2 const across = index * dvec2(in);
    return {across, std::sqrt(1.0 - dot(across, across))};
}

void measure(char const* name, Lens const& lens, bool floats) {
    TriangleSoup soup = tessellate(lens, 290).soup;
    if (floats) {
        for (dvec3& p : soup.positions)
            p = as_float(p);
        for (dvec3& n : soup.normals)
            n = normalize(as_float(n));
    }
    auto const mesh = std::make_shared<Mesh const>(make_mesh(std::move(soup)));
    CurvedTree const tree(mesh, PatchKind::fitted);
    constexpr int rays = 20000;
    double squares = 0.0, most = 0.0;
    for (int i = 0; i < rays; ++i) {
        double const r = 0.4 * lens.diameter * std::sqrt((i + 0.5) / rays),
                     turn = i * std::numbers::phi * 2.0 * std::numbers::pi;
        dvec3 const from(r * std::cos(turn), r * std::sin(turn), -0.01);
        auto const met = tree.next(from, {0.0, 0.0, 1.0}, {{}, {0}}, {0.0, INFINITY}, 1e-15).crossing;
        double const s = slope_of(lens, r);
        dvec3 const exact = normalize(dvec3(s * std::cos(turn), s * std::sin(turn), -1.0));
        double const error = met ? length(leaving(met->normal) - leaving(exact)) : 1.0;
        squares += error * error / rays;
        most = std::max(most, error);
    }
    std::printf("%-34s %zu triangles in %s: RMS %.2g rad, most %.2g\n", name, mesh->soup.triangles.size(),
                floats ? "float " : "double", std::sqrt(squares), most);
}

} // namespace

int main() {
    for (bool const floats : {true, false}) {
        measure("f/1.6, terms 1e-6, -2e-9", asphere(20, -0.7, {1e-6, -2e-9}), floats);
        measure("f/2, terms 1e-6, -2e-9", asphere(25, -0.7, {1e-6, -2e-9}), floats);
        measure("f/2, conic", asphere(25, -0.7, {}), floats);
        measure("f/2, terms 2e-5, -5e-8", asphere(25, -0.7, {2e-5, -5e-8}), floats);
        measure("f/4, terms 1e-6, -2e-9", asphere(50, -0.7, {1e-6, -2e-9}), floats);
        measure("f/4, terms 2e-5, -5e-8", asphere(50, -0.7, {2e-5, -5e-8}), floats);
    }
    return 0;
}
