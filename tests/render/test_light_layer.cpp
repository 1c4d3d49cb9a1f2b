// Light that is traced from the sources, on the paint that it lies on.
#include "math/input_error.h"
#include "run/light_layer.h"
#include "scene/read_text.h"
#include "support/catch.h"

using namespace sahl;

namespace {

/// A screen that is turned, with a detector where numbers of five digits put it, and a beam that fills it.
std::string screen(std::string const& at, std::string const& more = "") {
    return "[surface.p]\npaint = {diffuse = [1, 1, 1]}\n[[object]]\nname = \"screen\"\n"
           "shape = {rectangle = {size_mm = [40, 40]}}\nsurface = \"p\"\nturn_deg = [0, 236.69, 0]\n"
           "move_mm = [175.5, 30, 115.33]\n"
           "[[source]]\nname = \"s\"\nwavelengths_nm = [550]\npower_W = 1\n"
           "beam = {from_mm = [91.93, 30, 60.41], toward = [0.83571, 0, 0.54917], up = [0, 1, 0], size_mm = "
           "[60, 60], pattern = \"sobol\", rays = 65536}\n"
           "[[detector]]\nname = \"d\"\nat_mm = " +
           at + "\nfacing = [-0.83571, 0, -0.54917]\nup = [0, 1, 0]\nsize_mm = [40, 40]\npixels = [4, 4]\n" +
           more +
           "[camera]\nat_mm = [0, 0, 0]\nlook_at_mm = [175.5, 30, 115.33]\n"
           "[picture]\ncaustics = {detector = \"d\", white_W_per_mm2 = 2.7777777777777778e-4}\n";
}

std::atomic<bool> const never{false};

double brightness(LightMap const& map, dvec3 const& millimetres) {
    return dot(map.at(1e-3 * millimetres), dvec3(0.2126, 0.7152, 0.0722));
}

} // namespace

TEST_CASE("a layer of light lies on its paint, though their numbers agree to five digits alone", "[render]") {
    auto const map = light_layer(read_text(screen("[175.5, 30, 115.33]")), nullptr, 2, {}, never);
    REQUIRE(map);
    // a watt over 60 × 60 mm² is what shows 1; 1800 rays of a low-discrepancy pattern fall on a pixel
    for (dvec2 const& at : {dvec2(0.0), dvec2(12, 9), dvec2(-14, 3), dvec2(5, -13)}) {
        dvec3 const place =
            dvec3(175.5, 30, 115.33) + at.x * dvec3(-0.54917, 0, 0.83571) + at.y * dvec3(0, 1, 0);
        CHECK(brightness(*map, place) == Approx(1.0).epsilon(0.01));
    }
}

TEST_CASE("a layer of light keeps its detector's filter, and is refused where there is no paint",
          "[render]") {
    auto const none = light_layer(read_text(screen("[175.5, 30, 115.33]", "where = \"refracted >= 1\"\n")),
                                  nullptr, 2, {}, never);
    REQUIRE(none);
    CHECK(brightness(*none, {175.5, 30, 115.33}) == 0.0);
    CHECK_THROWS_AS(light_layer(read_text(screen("[175.4, 30, 115.33]")), nullptr, 2, {}, never), InputError);
}
