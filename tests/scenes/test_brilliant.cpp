// In: the experiment brilliant, and the OBJ files of its stone. Out: that the stone returns what a tracer of
// convex stones returns that is written here, apart from Sahl; and rays by its table under a closed form.
#include "support/catch.h"
#include "support/experiments.h"
#include "support/textbook.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace sahl;
using namespace sahl::bench;

namespace {

double const n = 2.417;

struct Facet {
    dvec3 normal; // outward
    double offset;
};

/// The facets of an OBJ file of polygons, stretched along z; those in the plane z = 0 are inside the stone.
void add_facets(std::vector<Facet>& stone, std::string const& model, double stretch) {
    std::ifstream in(std::string(SAHL_SOURCE_DIR) + "/models/" + model);
    REQUIRE(in.good());
    std::vector<dvec3> corners;
    std::string line, key;
    while (std::getline(in, line)) {
        std::istringstream words(line);
        words >> key;
        if (key == "v") {
            dvec3 p(0.0);
            words >> p.x >> p.y >> p.z;
            corners.emplace_back(p.x, p.y, stretch * p.z);
        } else if (key == "f") {
            std::vector<dvec3> face;
            for (std::size_t i = 0; words >> i;)
                face.push_back(corners.at(i - 1));
            dvec3 across(0.0);
            for (std::size_t i = 1; i + 1 < face.size(); ++i)
                across += cross(face[i] - face[0], face[i + 1] - face[0]);
            dvec3 const normal = normalize(across);
            if (std::abs(dot(normal, face[0])) > 1e-6)
                stone.push_back({normal, dot(normal, face[0])});
        }
    }
}

struct Meeting {
    double t = INFINITY;
    Facet const* facet = nullptr;
};

Meeting leaving(std::vector<Facet> const& stone, dvec3 const& p, dvec3 const& d) {
    Meeting first;
    for (Facet const& facet : stone)
        if (double const along = dot(facet.normal, d); along > 0.0)
            if (double const t = (facet.offset - dot(facet.normal, p)) / along; t < first.t)
                first = {t, &facet};
    return first;
}

Meeting entering(std::vector<Facet> const& stone, dvec3 const& p, dvec3 const& d) {
    Meeting last{-INFINITY, nullptr};
    for (Facet const& facet : stone)
        if (double const along = dot(facet.normal, d); along < 0.0)
            if (double const t = (facet.offset - dot(facet.normal, p)) / along; t > last.t)
                last = {t, &facet};
    return last.t < leaving(stone, p, d).t ? last : Meeting();
}

dvec3 mirrored(dvec3 const& d, dvec3 const& normal) {
    return d - 2.0 * dot(d, normal) * normal;
}

/// Snell's law in Heckbert's form; the normal faces the ray.
dvec3 refracted(dvec3 const& d, dvec3 const& normal, double ratio) {
    double const c1 = -dot(d, normal), c2 = std::sqrt(1.0 - ratio * ratio * (1.0 - c1 * c1));
    return ratio * d + (ratio * c1 - c2) * normal;
}

bool arrives_above(dvec3 const& p, dvec3 const& d) {
    dvec3 const at = p + (6.0 - p.z) / d.z * d;
    return d.z > 0.0 && std::max(std::abs(at.x), std::abs(at.y)) < 500.0;
}

/// The share of a ray from above that comes back up. What leaves a convex stone does not come to it again.
double returned(std::vector<Facet> const& stone, dvec3 p, dvec3 d) {
    Meeting const in = entering(stone, p, d);
    if (!in.facet)
        return 0.0;
    p += in.t * d;
    dvec3 const normal = in.facet->normal;
    double const reflected = mean_reflectance(1.0, n, std::acos(std::min(1.0, -dot(d, normal))));
    double sum = arrives_above(p, mirrored(d, normal)) ? reflected : 0.0;
    double inside = 1.0 - reflected;
    for (d = refracted(d, normal, 1.0 / n); inside > 1e-16;) {
        Meeting const out = leaving(stone, p, d);
        p += out.t * d;
        double const cosine = dot(d, out.facet->normal);
        if (n * n * (1.0 - cosine * cosine) < 1.0) {
            double const back = mean_reflectance(n, 1.0, std::acos(std::min(1.0, cosine)));
            if (arrives_above(p, refracted(d, -out.facet->normal, n)))
                sum += (1.0 - back) * inside;
            inside *= back;
        }
        d = mirrored(d, out.facet->normal);
    }
    return sum;
}

} // namespace

TEST_CASE("the brilliant experiment returns the light that a tracer of convex stones returns") {
    for (double const scale : {0.7, 0.84, 0.86165512651493438, 1.0, 1.12}) {
        CAPTURE(scale);
        std::vector<Facet> stone;
        add_facets(stone, "brilliant-crown.obj", 1.0);
        add_facets(stone, "brilliant-pavilion.obj", scale);
        REQUIRE(stone.size() == 49 + 40);
        Run const run = run_of("brilliant", {"sweep={}", text("object.pavilion.scale[2]=", scale),
                                             "source.light.beam.rays=200", "trace.min_power=1e-12",
                                             "trace.max_depth=5000"});
        double expected = 0.0, rays = 0.0;
        for (Segment const& row : run.segments)
            if (row.parent < 0) {
                expected += returned(stone, 1e3 * row.origin, row.direction);
                rays += 1.0;
            }
        double const arrived = number_at(run.summary, {"detectors", "above", "power_W"});
        // What was cut, and roundings: a place is off by 1e-15 mm at each of some hundred facets, and no
        // reflectance changes by more than some hundred times that but near the critical angle
        CHECK(std::abs(arrived - expected / rays) <= number_at(run.summary, {"energy_W", "cut"}) + 1e-11);
    }
}

TEST_CASE("the brilliant experiment turns light by four times its pavilion's angle") {
    for (double const angle_deg : {40.75, 42.0, 45.0, 47.0}) {
        CAPTURE(angle_deg);
        double const angle = radians(angle_deg);
        Run const run = run_of("brilliant", {"sweep={}", text("object.pavilion.scale[2]=", std::tan(angle)),
                                             "source.light.beam.from_mm=[0.3, 0, 5]",
                                             "source.light.beam.radius_mm=0", "source.light.beam.rays=1"});
        Rows const rows = rows_of(run, 0);
        std::vector<Event> const way{Event::refracted, Event::total_internal, Event::total_internal,
                                     Event::refracted};
        Segment const out = branch(rows, way);
        CHECK(surface_at_end(run, rows.front()) == "crown.table");
        CHECK(surface_at_end(run, rows[static_cast<std::size_t>(out.parent)]) == "crown.table");
        // 180° − 4α from the axis inside, refracted at the table. Where facets 2° apart meet, the file has
        // their common corner to 1e-14 mm; over the half millimetre of a facet that turns it by 2e-14, of
        // which a part is seen, twice at each facet and n times at the table.
        CHECK(std::abs(std::abs(out.direction.x) - n * std::abs(std::sin(4.0 * angle))) < 5e-14);
        CHECK(std::abs(out.direction.y) < 5e-14);
        CHECK(out.direction.z > 0.0);
    }
}

TEST_CASE("the brilliant experiment returns most where Tolkowsky cut it, and less than four fifths beyond") {
    Folder const out;
    run_experiment_of("brilliant", out.path() / "out", {"source.light.beam.rays=600"});
    auto columns = read_sweep(out.path() / "out" / "sweep.csv");
    auto const& tangent = columns["object.pavilion.scale[2]"];
    auto const& power = columns["detectors.above.power_W"];
    REQUIRE(power.size() == 24);
    std::size_t const best =
        static_cast<std::size_t>(std::max_element(power.begin(), power.end()) - power.begin());
    CHECK(std::abs(degrees(std::atan(tangent[best])) - 40.75) < 2.0);
    CHECK(power[best] > 0.92);
    for (std::size_t i = 0; i < power.size(); ++i)
        if (tangent[i] > std::tan(radians(47.0)))
            CHECK(power[i] < 0.8);
}
