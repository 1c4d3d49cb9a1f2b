// In: nothing. Out: a small run to make pages of: a prism, a lens, a ball, a mirror, a mesh and a detector,
// with a summary and paths made by hand.
#pragma once

#include "report/page.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace sahl::sample {

inline Body body(std::string name, Shape shape, Affine const& to_world) {
    Body made;
    made.name = std::move(name);
    made.open = is_open(shape);
    made.shape = shape;
    made.to_world = to_world;
    return made;
}

inline Affine moved(dvec3 const& by) {
    return {dmat3(1.0), by};
}

/// Turns about the y axis.
inline Affine turned(double angle, dvec3 const& by) {
    double const c = std::cos(angle), s = std::sin(angle);
    return {dmat3(dvec3(c, 0, -s), dvec3(0, 1, 0), dvec3(s, 0, c)), by};
}

/// A cube from −half to +half with its twelve triangles, normals outwards.
inline Mesh cube(double half) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.soup.positions.push_back(half * dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    mesh.soup.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                           {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    mesh.low = dvec3(-half);
    mesh.high = dvec3(half);
    return mesh;
}

inline Segment segment(std::uint64_t ray, double nm, dvec3 const& origin, dvec3 const& towards, double power,
                       bool escapes = false) {
    Segment s;
    s.ray = ray;
    s.parent = 0;
    s.wavelength = nm * 1e-9;
    s.origin = origin;
    s.direction = normalize(towards - origin);
    s.length = escapes ? std::numeric_limits<double>::infinity() : length(towards - origin);
    s.power_start = s.power_end = power;
    return s;
}

struct Run {
    Scene scene;
    std::vector<Segment> paths;
};

inline Run run() {
    using std::numbers::pi;
    Run made;
    Scene& scene = made.scene;
    scene.bodies.push_back(body("prism", Prism{pi / 3, 0.025, 0.025}, moved({0, 0, 0})));
    scene.bodies.push_back(body("lens", Lens{0.05, -0.05, 0.006, 0.02}, turned(pi / 2, {-0.03, 0, 0})));
    scene.bodies.push_back(body("ball", Sphere{0.006}, moved({0.02, 0.018, 0})));
    scene.bodies.push_back(body("rod", Cylinder{0.002, 0.02}, turned(pi / 3, {-0.01, -0.02, 0.004})));
    scene.bodies.push_back(body("mirror", Disk{0.008, 0.002}, turned(-pi / 2, {0.058, -0.02, 0})));
    Body block;
    block.name = "block";
    block.mesh = std::make_shared<Mesh const>(cube(0.005));
    block.to_world = turned(0.4, {-0.03, 0.022, 0});
    scene.bodies.push_back(block);
    scene.detectors.push_back(
        {"screen", turned(-pi / 2, {0.05, -0.01, 0}), {0.03, 0.03}, 64, 64, true, false, {}});
    scene.bodies.push_back(body("screen", Rectangle{{0.03, 0.03}}, scene.detectors[0].to_world));
    scene.bodies.back().detector = DetectorId{0};
    SourceSpec source;
    source.name = "laser";
    source.emitter = Beam{{-0.06, 0, 0}, {1, 0, 0}, {0, 0, 1}, 0.002, {}, {}, Pattern::grid, 1};
    scene.sources.push_back(source);
    std::uint64_t ray = 0;
    for (double const nm : {486.1327, 587.5618, 656.2725, 1064.0})
        for (int i = -4; i <= 4; ++i, ++ray) {
            double const y = 0.0008 * i, bend = -0.02 + (nm - 600) * 1.5e-5;
            made.paths.push_back(segment(ray, nm, {-0.06, y, 0.3 * y}, {-0.006, y, 0.3 * y}, 1e-3));
            made.paths.back().parent = -1;
            made.paths.push_back(
                segment(ray, nm, {-0.006, y, 0.3 * y}, {0.006, y - 0.001, 0.3 * y}, 0.95e-3));
            made.paths.push_back(segment(ray, nm, {-0.006, y, 0.3 * y}, {-0.03, 0.05 + y, 0}, 0.5e-4, true));
            made.paths.push_back(segment(ray, nm, {0.006, y - 0.001, 0.3 * y}, {0.05, y + bend, 0}, 0.9e-3));
            made.paths.push_back(segment(ray, nm, {0.006, y - 0.001, 0.3 * y}, {0.006, -0.0108, 0}, 1e-6));
        }
    return made;
}

inline Value summary() {
    return parse_json(R"json({
      "title": "A 60° prism at minimum deviation", "program": "sahl 0.1.0",
      "experiment_sha256": "4f2b6c…", "seed": 1, "options": {"min_power": 1e-06, "limit_leak": 1e-06, "limit_ledger": 1e-12},
      "rays": 3000, "segments": 18734, "seconds": 0.0123, "segments_per_second": 1523089.4, "threads": 2,
      "energy_W": {"emitted": 1.0, "detected": 0.8123456, "absorbed": 0.0523, "escaped": 0.1353034, "cut": 0.000051,
                   "error": 0.0, "remainder": -2.2e-17},
      "events": {"refracted": 9000, "total_internal": 120, "absorbed": 14, "detected": 3100, "escaped": 6400,
                 "cut_power": 100, "leak": 0, "recovered": 3},
      "absorbed_W": {"prism": {"bulk": 0.05, "surface": {"prism.base": 0.0023}}},
      "escaped_direction": {"486.1327": [0.1, 0.9, 0.0], "587.5618": null},
      "detectors": {"screen": {"power_W": 0.8123456, "power_bound_W": [0.8123456, 0.8123966], "sigma_W": 0.0,
          "hits": 3100, "centroid_mm": [0.123456, -10.5], "rms_radius_mm": 2.3456, "peak_W_per_mm2": 0.0123,
          "mean_direction": [0.9, -0.43589, 0.0], "mean_optical_path_mm": 123.4567,
          "by_wavelength": {"486.1327": {"power_W": 0.27, "hits": 1000, "centroid_mm": [0.1, -11.2],
              "rms_radius_mm": 1.1, "mean_direction": [0.89, -0.45596, 0.0]},
            "656.2725": {"power_W": 0.28, "hits": 1000, "centroid_mm": null, "rms_radius_mm": null}},
          "by_source": {"laser": {"power_W": 0.8123456, "hits": 3100}}},
        "dark": {"power_W": 0.0, "power_bound_W": [0.0, null], "hits": 0, "centroid_mm": null}},
      "objects": {"prism": {"method": "exact", "error_bound_rad": 0.0, "medium": "N-SF11"},
                  "block": {"method": "facet", "error_bound_rad": null, "medium": "N-BK7"}},
      "models": {"block": {"triangles": 12, "closed": true}},
      "warnings": ["block: its base colour would absorb 20 % at each surface; it is traced as clear glass"]
    })json",
                      "summary.json");
}

/// The entry under a path of keys, which must be there.
inline Value& entry(Value& value, std::initializer_list<std::string_view> path) {
    Value* here = &value;
    for (std::string_view const key : path)
        here = here->find(key);
    return *here;
}

inline std::vector<SweepRow> sweep() {
    std::vector<SweepRow> rows;
    for (int i = 0; i <= 12; ++i) {
        SweepRow row{{Value{-45.0 + 2.0 * i, {}}}, summary()};
        double const x = (i - 6) / 6.0;
        entry(row.summary, {"detectors", "screen", "power_W"}).data = 0.85 - 0.3 * x * x + 0.02 * x;
        rows.push_back(std::move(row));
    }
    return rows;
}

} // namespace sahl::sample
