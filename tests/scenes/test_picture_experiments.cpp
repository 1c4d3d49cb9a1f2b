// The experiments of which pictures are made: each is made small, and loses no ray.
#include "run/render.h"
#include "support/catch.h"
#include "support/experiments.h"

using namespace sahl;
using namespace sahl::bench;
namespace fs = std::filesystem;

TEST_CASE("every picture experiment makes its picture and loses no ray") {
    std::size_t found = 0;
    for (char const* const name : {"whitted-1980", "bunny-over-text", "wine-glass", "fire", "magnifier",
                                   "prism-spectrum", "kaleidoscope", "nested-bubbles"}) {
        if (std::string(name).find("bunny") != std::string::npos && !has_bunny())
            continue;
        CAPTURE(name);
        std::vector<std::string> set{"camera.resolution=[32, 24]", "camera.samples=1",
                                     "picture.wavelengths=1"};
        if (std::string(name) == "prism-spectrum")
            set.push_back("source.light.beam.rays=4");
        fs::path const folder = fs::path(SAHL_SOURCE_DIR) / "experiments" / name;
        Folder const out;
        RenderOptions options;
        options.files = {out.path() / "small.png"};
        RenderResult const result =
            render_experiment(load_experiment(folder / (std::string(name) + ".toml"), set), options);
        CHECK(result.whole);
        CHECK(number_at(result.summary, {"leaks"}) == 0.0);
        CHECK(number_at(result.summary, {"segments"}) > 32 * 24);
        CHECK(fs::exists(folder / (std::string(name) + ".jpg")));
        ++found;
    }
    CHECK(found >= 7);
}
