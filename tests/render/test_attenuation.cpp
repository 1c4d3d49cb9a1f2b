// Khronos' AttenuationTest of the shared data: blocks of glass as thick as it says, beside their colours by
// Beer and Lambert.
#include "run/render_scene.h"
#include "scene/read_text.h"
#include "scene/scene.h"
#include "support/catch.h"

#include <cmath>
#include <filesystem>

using namespace sahl;

namespace {

std::filesystem::path const model =
    std::filesystem::path(SAHL_SHARED_DATA) / "models/16_volume/16_volume.gltf";

/// What a camera sees that looks straight through the part at (x, y), in metres of the file, at a white wall.
dvec3 seen(std::string const& part, double x, double y) {
    auto const at = [&](double z) {
        return "[" + std::to_string(1000.0 * x + 30.0) + ", " + std::to_string(1000.0 * y + 40.0) + ", " +
               std::to_string(1000.0 * z) + "]";
    };
    Experiment experiment =
        read_text("[surface.white]\npaint = {ambient = [1, 1, 1]}\n[[object]]\nname = \"wall\"\n"
                  "shape = {rectangle = {size_mm = [400, 400]}}\nsurface = \"white\"\nmove_mm = " +
                  at(-2.0) + "\n[[object]]\nname = \"m\"\nmodel = \"" + model.string() + "\"\nparts = [\"" +
                  part + "\"]\n[trace]\nmin_power = 1e-6\n[camera]\nat_mm = " + at(3.0) +
                  "\nlook_at_mm = " + at(0.0) + "\nheight_mm = 1\nresolution = [1, 1]\nsamples = 1\n");
    Scene scene = build_scene(experiment);
    PictureMaker const maker(scene, *experiment.picture, experiment.trace);
    std::atomic<bool> const never{false};
    Film const film = render_scene(maker, experiment.picture->options, 1, {}, never).film;
    return film.mean(film.at(0, 0));
}

} // namespace

TEST_CASE("the rows of AttenuationTest have the colours that its sample row is painted in", "[render]") {
    if (!std::filesystem::exists(model)) {
        WARN("skipped: the shared data are not here");
        return;
    }
    // at right angles to glass of 1.5; light that was reflected twice within a block adds 0.16 % at most
    double const once = 0.96, plate = (1.0 - 0.04) / (1.0 + 0.04);
    struct Column {
        char const* name;
        double thickness, x;
    };
    for (Column const& column : {Column{"0.25", 0.25, -3.5}, Column{"0.50", 0.5, -2.0},
                                 Column{"1.0", 1.0, 0.0}, Column{"1.5", 1.5, 2.5}, Column{"2.0", 2.0, 6.0}}) {
        INFO(column.name);
        dvec3 const sample = seen("R1_Sample_" + std::string(column.name), column.x, 6.0) / plate;
        dvec3 baked;
        for (int c = 0; c < 3; ++c) {
            baked[c] = std::pow(dvec3(0.1, 0.5, 0.9)[c], column.thickness); // as its baseColorFactor is
            CHECK(sample[c] == Approx(baked[c]).margin(1e-6));
        }
        for (auto const& [row, y] : {std::pair{"R2_Block_", 3.0}, {"R4_Block_", -3.0}, {"R5_Block_", -6.0}}) {
            INFO(row);
            dvec3 const block = seen(row + std::string(column.name), column.x, y) / (once * once);
            for (int c = 0; c < 3; ++c)
                CHECK(block[c] == Approx(baked[c]).margin(1.0 / 255.0));
        }
    }
}
