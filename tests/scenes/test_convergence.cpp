// In: the same ball and the same lens as exact shapes and as ever finer meshes. Out: the order in which the
// error of what leaves them falls with the size of the triangles: first with the triangles' own normals,
// second with those of their vertices. With h the edge of a triangle on a sphere of radius R: its normal is
// off by up to h/2R, first order. The vertices' normals, weighted, are right to second order, and the place
// of refraction lies off the sphere by the sag h²/8R.
#include "support/bench.h"
#include "support/catch.h"
#include "support/textbook.h"

using namespace sahl;
using namespace sahl::bench;

namespace {

std::string beam_through(std::string const& object, double radius_mm) {
    return text("[medium]\nglass = {n = 1.5168}\n[[object]]\nname = 'body'\nmedium = 'glass'\n", object,
                "\n[[source]]\nname = 'beam'\nbeam = {from_mm = [0.013, 0.029, -20], toward = [0, 0, 1], "
                "radius_mm = ",
                radius_mm, ", pattern = 'hexagonal', rays = 2000}\n");
}

/// Of each ray, where what goes straight through leaves to.
std::vector<dvec3> exits(std::string const& experiment, std::string const& method) {
    Run const run = bench::run(experiment, {"trace.min_power=0.5", "trace.method=" + method});
    std::vector<dvec3> directions;
    for (std::uint64_t ray = 0; ray <= run.segments.back().ray; ++ray) {
        Rows const path = direct_path(rows_of(run, ray));
        REQUIRE(path.size() == 3);
        directions.push_back(path[2].direction);
    }
    return directions;
}

double rms_angle(std::vector<dvec3> const& one, std::vector<dvec3> const& other) {
    REQUIRE(one.size() == other.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i)
        sum += dot(one[i] - other[i], one[i] - other[i]); // squares of small angles
    return std::sqrt(sum / static_cast<double>(one.size()));
}

struct Fineness {
    char const* model;
    double edge; // of a typical triangle, in any unit
};

/// The order between neighbours in fineness, coarse to fine; prints the table.
std::vector<double> orders(std::string const& exact, double radius_mm, std::vector<Fineness> const& meshes,
                           std::string const& method) {
    std::vector<dvec3> const truth = exits(beam_through(exact, radius_mm), "auto");
    std::ostringstream table;
    table << method << ": RMS error of the exit direction\n";
    std::vector<double> errors, found;
    for (Fineness const& mesh : meshes) {
        std::string const path = SAHL_SOURCE_DIR "/models/" + std::string(mesh.model);
        errors.push_back(rms_angle(truth, exits(beam_through("model = '" + path + "'", radius_mm), method)));
        table << "  " << mesh.model << "  " << errors.back() << " rad";
        if (errors.size() > 1) {
            Fineness const& coarser = meshes[errors.size() - 2];
            found.push_back(std::log(errors[errors.size() - 2] / errors.back()) /
                            std::log(coarser.edge / mesh.edge));
            table << "  order " << found.back();
        }
        table << "\n";
    }
    WARN(table.str());
    return found;
}

// Beams of 80 % of the aperture, so that no ray meets another face on a mesh than on the shape.
std::vector<Fineness> const balls{
    {"ball-320.glb", 8.0}, {"ball-1280.glb", 4.0}, {"ball-5120.glb", 2.0}, {"ball-20480.glb", 1.0}};
std::vector<Fineness> const singlets{{"singlet-504.glb", std::sqrt(15984.0 / 504.0)},
                                     {"singlet-4104.glb", std::sqrt(15984.0 / 4104.0)},
                                     {"singlet-15984.glb", 1.0}};
char const* const ball = "shape = {sphere = {radius_mm = 5}}";
char const* const singlet = "shape = {lens = {r1_mm = 50, r2_mm = -50, thickness_mm = 10, diameter_mm = 30}}";

} // namespace

TEST_CASE("facets converge with the first order", "[slow]") {
    for (double const order : orders(ball, 4.0, balls, "facet"))
        CHECK((order > 0.8 && order < 1.3));
    for (double const order : orders(singlet, 12.0, singlets, "facet"))
        CHECK((order > 0.8 && order < 1.3));
}

TEST_CASE("interpolated normals converge with the second order", "[slow]") {
    for (double const order : orders(ball, 4.0, balls, "interpolated"))
        CHECK((order > 1.7 && order < 2.4));
    for (double const order : orders(singlet, 12.0, singlets, "interpolated"))
        CHECK((order > 1.7 && order < 2.4));
}
