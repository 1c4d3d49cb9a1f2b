// sahl view writes the page of a run anew, from its own data or from the experiment, and that of a model.
#include "math/input_error.h"
#include "run/model_marks.h"
#include "run/view.h"
#include "scene/read_file.h"
#include "support/bench.h"
#include "support/catch.h"

#include <fstream>

using namespace sahl;

namespace {

constexpr char const* prism = R"(title = "again"
[[object]]
name = "prism"
shape = {prism = {apex_deg = 60, side_mm = 25, length_mm = 25}}
medium = "N-SF11"
[[source]]
name = "laser"
beam = {from_mm = [-50, 0, 0], toward = [1, 0, 0], radius_mm = 2, rays = 7}
[[detector]]
name = "screen"
at_mm = [40, -60, 0]
facing = [-0.4, 0.92, 0]
size_mm = [80, 80]
pixels = [16, 16]
spot = true
)";

struct Made {
    bench::Folder folder;
    std::filesystem::path experiment = folder.path() / "again.toml", out = folder.path() / "out";

    explicit Made(std::string const& text) {
        std::ofstream(experiment) << text;
        RunOptions options;
        options.out = out;
        run_experiment(load_experiment(experiment), options);
    }
};

} // namespace

TEST_CASE("the page of a run is made again from its experiment, byte by byte") {
    for (char const* sweep : {"", "[sweep]\n\"object.prism.turn_deg[2]\" = [0, 5, 10]\n"}) {
        CAPTURE(sweep);
        Made const made(std::string(prism) + sweep);
        std::string const before = file_text(made.out / "report.html");
        CHECK(view_run(made.out, {}) == made.out / "report.html");
        CHECK(file_text(made.out / "report.html") == before);
        std::filesystem::remove(made.out / "report.html");
        CHECK_THROWS_AS(view_run(made.out, {}), InputError);
        view_run(made.out, made.experiment);
        CHECK(file_text(made.out / "report.html") == before);
    }
}

TEST_CASE("a run is not shown with another experiment") {
    Made const made(prism);
    std::ofstream(made.experiment, std::ios::app) << "# changed\n";
    CHECK_THROWS_AS(view_run(made.out, made.experiment), InputError);
    CHECK_THROWS_AS(view_run(made.folder.path(), {}), InputError);
}

TEST_CASE("a model's page has its holes and turned triangles where they are") {
    bench::Folder const folder;
    std::filesystem::path const model = folder.path() / "torn.obj";
    // a pyramid of 10 mm without one of its sides, another one turned
    std::ofstream(model) << "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 5 5 10\n"
                            "f 1 3 2\nf 1 4 3\nf 1 2 5\nf 2 5 3\nf 3 4 5\n";
    std::filesystem::path const page = view_model(model, folder.path() / "out");
    std::string const text = file_text(page);
    CHECK(text.find("<title>torn.obj</title>") != std::string::npos);
    CHECK(text.find(R"("kind":"holes")") != std::string::npos);
    CHECK(text.find(R"("kind":"turned")") != std::string::npos);
    CHECK(text.find(R"("kind":"slivers")") == std::string::npos);
    CHECK_THROWS_AS(view_model(folder.path() / "absent.obj", folder.path() / "out"), InputError);
}
