// Mistakes that people make in an experiment file: each is refused with its line, what is wrong, and what to
// do.
#include "scene/read_text.h"
#include "support/catch.h"

#include <vector>

using namespace sahl;

namespace {

struct Mistake {
    char const* what;
    int line;
    std::string text;
    std::vector<std::string> words; // of problem and remedy
};

std::string const ball = "[[object]]\nname = \"ball\"\n";
std::string const glass = "medium = \"N-BK7\"\n";
std::string const ray = "[[source]]\nname = \"s\"\n";
std::string const beam = "beam = {from_mm = [0, 0, 0], toward = [0, 0, 1]}\n";
std::string const screen = "[[detector]]\nname = \"d\"\nat_mm = [0, 0, 0]\nfacing = [0, 0, 1]\n";

std::vector<Mistake> mistakes() {
    return {
        {"a misspelt key",
         4,
         ball + glass + "shape = {sphere = {raddius_mm = 3}}\n",
         {"unknown key 'raddius_mm' in shape sphere", "did you mean 'radius_mm'?"}},
        {"a key without its unit",
         4,
         ball + glass + "shape = {sphere = {radius = 3}}\n",
         {"unknown key 'radius'", "did you mean 'radius_mm'?"}},
        {"a detector's place without its unit",
         3,
         "[[detector]]\nname = \"d\"\nat = [0, 0, 0]\n",
         {"did you mean 'at_mm'?"}},
        {"a misspelt table", 1, "[tarce]\nseed = 1\n", {"unknown key 'tarce'", "did you mean 'trace'?"}},
        {"a number in quotes",
         4,
         ball + glass + "shape = {sphere = {radius_mm = \"3\"}}\n",
         {"'radius_mm' in shape sphere is \"3\"", "give a number above 0"}},
        {"a size that is missing",
         4,
         ball + glass + "shape = {cylinder = {radius_mm = 3}}\n",
         {"'length_mm' is missing in shape cylinder"}},
        {"a negative radius",
         4,
         ball + glass + "shape = {sphere = {radius_mm = -3}}\n",
         {"is -3", "above 0"}},
        {"an infinite radius",
         4,
         ball + glass + "shape = {sphere = {radius_mm = inf}}\n",
         {"is infinite", "above 0"}},
        {"an apex of 190°",
         4,
         ball + glass + "shape = {prism = {apex_deg = 190, side_mm = 1, length_mm = 1}}\n",
         {"apex_deg", "0 and 180"}},
        {"a lens whose surfaces cross",
         4,
         ball + glass + "shape = {lens = {r1_mm = 20, r2_mm = -20, thickness_mm = 1, diameter_mm = 20}}\n",
         {"surfaces cross", "thickness_mm"}},
        {"a conic that ends before the rim",
         4,
         ball + glass + "shape = {lens = {r1_mm = 20, thickness_mm = 50, diameter_mm = 30, conic1 = 3}}\n",
         {"does not reach a rim of diameter 30 mm", "at most 20 mm"}},
        {"a cone without its length", 4, ball + glass + "shape = {cone = {radius_mm = 1}}\n", {"length_mm"}},
        {"a quadric of nine coefficients",
         4,
         ball + glass +
             "shape = {quadric = {coefficients = [1, 1, 1, 0, 0, 0, 0, 0, 0], clip_mm = [1, 1, 1]}}\n",
         {"9 coefficients instead of 10", "xx, yy, zz"}},
        {"an unknown shape",
         4,
         ball + glass + "shape = {sphear = {radius_mm = 1}}\n",
         {"did you mean 'sphere'?"}},
        {"an unknown glass",
         3,
         ball + "medium = \"N-BK77\"\nshape = {sphere = {radius_mm = 1}}\n",
         {"there is no medium \"N-BK77\"", "did you mean '", "SCHOTT:N-BK7'"}},
        {"an unknown glass in a medium",
         1,
         "medium.m = {glass = \"SF11x\"}\n",
         {"there is no glass \"SF11x\"", "did you mean"}},
        {"a medium with two formulas",
         1,
         "medium.m = {n = 1.5, glass = \"N-BK7\"}\n",
         {"glass, n at once", "exactly one"}},
        {"nd without vd", 1, "medium.m = {nd = 1.5}\n", {"without vd", "give both"}},
        {"an index of 0", 1, "medium.m = {n = 0}\n", {"is 0", "above 0"}},
        {"a medium's table that goes back",
         1,
         "medium.m = {table = [[500, 1.5], [400, 1.6]]}\n",
         {"do not ascend", "sort"}},
        {"an unknown surface",
         3,
         ball + "surface = \"wal\"\nshape = {sphere = {radius_mm = 1}}\n[surface]\nwall = {absorb = true}\n",
         {"there is no surface \"wal\"", "did you mean 'wall'?"}},
        {"a metal in place of a surface",
         3,
         ball + "surface = \"silver\"\nshape = {sphere = {radius_mm = 1}}\n",
         {"there is no surface \"silver\"", "surface.silver = {metal = \"silver\"}"}},
        {"an unknown metal",
         1,
         "surface.m = {metal = \"silber\"}\n",
         {"there is no metal", "did you mean 'silver'?"}},
        {"shares above 1", 1, "surface.m = {reflect = 0.6, transmit = 0.6}\n", {"more than 1", "at most 1"}},
        {"an unknown face",
         5,
         ball + glass +
             "shape = {prism = {apex_deg = 60, side_mm = 1, length_mm = 1}}\nfaces = {bass = \"w\"}\n",
         {"no face 'bass'", "did you mean 'base'?"}},
        {"a body without a medium",
         1,
         ball + "shape = {sphere = {radius_mm = 1}}\n",
         {"\"ball\" has no medium", "give medium"}},
        {"an open shape without a surface",
         1,
         ball + "shape = {disk = {radius_mm = 1}}\n",
         {"open shape without a surface", "give surface"}},
        {"an open shape with a medium",
         3,
         ball + glass + "shape = {disk = {radius_mm = 1}}\n",
         {"open shape", "no inside"}},
        {"shape and model at once",
         5,
         ball + glass + "shape = {sphere = {radius_mm = 1}}\nmodel = \"a.obj\"\n",
         {"shape, model at once"}},
        {"a model that is not there",
         3,
         ball + "model = \"nowhere/bunny.obj\"\nlength_unit = \"mm\"\n",
         {"there is no file", "bunny.obj"}},
        {"a scale of 0",
         4,
         ball + glass + "scale = 0\nshape = {sphere = {radius_mm = 1}}\n",
         {"'scale'", "other than 0"}},
        {"a matrix beside a move",
         5,
         ball + glass +
             "matrix = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]\nmove_mm = [0, 0, 1]\n"
             "shape = {sphere = {radius_mm = 1}}\n",
         {"beside a matrix"}},
        {"a flat matrix",
         4,
         ball + glass + "matrix = [1,0,0,0, 1,0,0,0, 0,0,1,0, 0,0,0,1]\nshape = {sphere = {radius_mm = 1}}\n",
         {"flattens space"}},
        {"an unknown group",
         3,
         ball + "group = \"hed\"\nshape = {sphere = {radius_mm = 1}}\n[[group]]\nname = \"head\"\n",
         {"no group \"hed\"", "did you mean 'head'?"}},
        {"groups in a circle",
         3,
         "[[group]]\nname = \"a\"\ngroup = \"b\"\n[[group]]\nname = \"b\"\ngroup = \"a\"\n",
         {"\"a\" belongs to itself", "\"b\""}},
        {"two sources of one name",
         4,
         ray + beam + ray + beam,
         {"source \"s\" has the name of another source", "rename"}},
        {"a name with a dot",
         2,
         "[[source]]\nname = \"a.b\"\n" + beam,
         {"\"a.b\" cannot be a name", "without dots"}},
        {"no source", 0, "title = \"dark\"\n", {"no source of light", "[[source]]"}},
        {"a source that is nothing", 1, ray, {"exactly one of beam, point, lambertian, rays, file"}},
        {"a direction of length 0",
         3,
         ray + "beam = {from_mm = [0, 0, 0], toward = [0, 0, 0]}\n",
         {"length 0", "[0, 0, 1]"}},
        {"up along the direction",
         3,
         ray + "beam = {from_mm = [0, 0, 0], toward = [0, 0, 1], up = [0, 0, -2]}\n",
         {"parallel"}},
        {"a wide beam without a width",
         3,
         ray + "beam = {from_mm = [0, 0, 0], toward = [0, 0, 1], rays = 9}\n",
         {"how wide", "radius_mm or size_mm"}},
        {"an unknown pattern",
         3,
         ray + "beam = {from_mm = [0, 0, 0], toward = [0, 0, 1], pattern = \"hexagon\"}\n",
         {"did you mean 'hexagonal'?"}},
        {"wavelengths in µm",
         4,
         ray + beam + "wavelengths_nm = [0.587]\n",
         {"0.587 nm", "wavelengths are in nm", "µm", "1000"}},
        {"an unknown line", 4, ray + beam + "lines = [\"Q\"]\n", {"no spectral line \"Q\"", "F', F, e"}},
        {"too few weights",
         5,
         ray + beam + "wavelengths_nm = [400, 500]\nweights = [1]\n",
         {"1 weights for 2", "one for each"}},
        {"a spectrum", 4, ray + beam + "spectrum = \"D50\"\n", {"no illuminant \"D50\"", "black_body_K"}},
        {"a spectrum beside weights",
         6,
         ray + beam + "spectrum = \"D65\"\nwavelengths_nm = [500]\nweights = [1]\n",
         {"weights and spectrum", "keep one"}},
        {"a spectrum that ends before it begins",
         4,
         ray + beam + "spectrum = {black_body_K = 3000, from_nm = 700, to_nm = 500}\n",
         {"ends before it begins", "to_nm"}},
        {"a spectrum that is dark",
         4,
         ray + beam + "spectrum = {illuminant = \"D65\", from_nm = 900, to_nm = 1000}\n",
         {"dark", "range in which it has power"}},
        {"more polarised than light can be",
         4,
         ray + beam + "polarisation = {stokes = [1, 1, 1, 0], axis = [0, 1, 0]}\n",
         {"Stokes", "at most S0"}},
        {"a ray of five numbers",
         3,
         ray + "rays = [[0, 0, 0, 0, 1]]\n",
         {"5 numbers", "x, y, z, dx, dy, dz"}},
        {"a file of rays that is not there",
         3,
         ray + "file = \"nowhere/rays.csv\"\n",
         {"there is no file", "correct the path"}},
        {"a source in a group that scales",
         4,
         ray + beam + "group = \"g\"\n[[group]]\nname = \"g\"\nscale = 2\n",
         {"\"g\" scales", "only turns and moves"}},
        {"no pixels",
         6,
         screen + "size_mm = [1, 1]\npixels = [0, 1]\n",
         {"'pixels'", "holds 0", "from 1 to 65536"}},
        {"half a pixel", 6, screen + "size_mm = [1, 1]\npixels = [1.5, 1]\n", {"fraction", "whole"}},
        {"a detector of 4 · 10⁹ pixels",
         6,
         screen + "size_mm = [1, 1]\npixels = [65536, 65536]\n",
         {"8192 × 8192"}},
        {"scales beyond all numbers",
         1,
         ball + glass +
             "group = \"g\"\nscale = 1e200\nshape = {sphere = {radius_mm = 1}}\n"
             "[[group]]\nname = \"g\"\nscale = 1e200\n",
         {"\"ball\"", "beyond all numbers"}},
        {"three sizes of a detector",
         5,
         screen + "size_mm = [1, 1, 1]\n",
         {"a list of 3", "a list of 2 numbers"}},
        {"a negative depth",
         2,
         "[trace]\nmax_depth = -1\n",
         {"'max_depth' in [trace] is -1", "from 0 to 65534"}},
        {"half a depth", 2, "[trace]\nmax_depth = 1.5\n", {"whole number"}},
        {"a tolerance of 0",
         2,
         "[trace]\ntolerance_rad = 0\n",
         {"'tolerance_rad' in [trace] is 0", "above 0"}},
        {"an unknown branch", 2, "[trace]\nbranch = \"splitt\"\n", {"did you mean 'split'?", "roulette"}},
        {"an unknown method", 2, "[trace]\nmethod = \"fited\"\n", {"did you mean 'fitted'?"}},
        {"polarised tracing",
         2,
         "[trace]\npolarised = true\n",
         {"polarised tracing does not exist yet", "auto"}},
        {"a floor above all power", 2, "[log]\nmin_power = 1.5\n", {"min_power"}},
        {"a log of no ray", 2, "[log]\nevery = 0\n", {"'every' in [log] is 0"}},
        {"a sweep over a key that does not exist",
         5,
         ray + beam + "[sweep]\n\"source.s.beam.radius_m\" = [1, 2]\n",
         {"unknown key 'radius_m' in beam", "did you mean 'radius_mm'?"}},
        {"a sweep over an object that does not exist",
         5,
         ray + beam + "[sweep]\n\"source.t.power_W\" = [1, 2]\n",
         {"there is no source \"t\"", "did you mean 's'?"}},
        {"a sweep that ends outside the range",
         5,
         ray + beam + "[sweep]\n\"source.s.power_W\" = {from = 1, to = 0, steps = 3}\n",
         {"'power_W' in [[source]] is 0.0"}},
        {"a zip of unequal lists",
         7,
         ray + beam + "[sweep]\nmode = \"zip\"\n\"trace.seed\" = [1, 2]\n\"trace.max_depth\" = [1]\n",
         {"trace.max_depth has 1 values, trace.seed has 2", "grid"}},
        {"a camera's angle in quotes",
         4,
         "[camera]\nat_mm = [0, 0, 0]\nlook_at_mm = [0, 0, 1]\nfov_deg = \"35\"\n",
         {"'fov_deg' in [camera]"}},
        {"a key twice", 2, "title = \"a\"\ntitle = \"b\"\n", {"title"}},
        {"a quote that is not closed",
         1,
         "title = \"a\nsurroundings = \"air\"\n",
         {"quote that closes this text missing"}},
    };
}

} // namespace

TEST_CASE("every mistake is refused with its line, what is wrong and what to do") {
    for (Mistake const& mistake : mistakes()) {
        // What a mistake does not need to be alone in its file goes after it, so that lines stay as they are.
        bool const needs_source = mistake.text.find("[[source]]") == std::string::npos && mistake.line > 0;
        std::string const what =
            error_of([&] { read_text(mistake.text + (needs_source ? one_source : "")); });
        INFO(mistake.what << "\n" << mistake.text);
        CAPTURE(what);
        std::string const place =
            mistake.line > 0 ? "test.toml:" + std::to_string(mistake.line) + ":" : "test.toml:";
        CHECK(what.rfind(place, 0) == 0);
        for (std::string const& word : mistake.words) {
            CAPTURE(word);
            CHECK(what.find(word) != std::string::npos);
        }
    }
}

TEST_CASE("a bad line of a ray file is named with the file") {
    TemporaryFolder const folder;
    auto const error = [&](std::string const& csv) {
        folder.write("rays.csv", csv);
        return error_of(
            [&] { read_text("[[source]]\nname = \"s\"\nfile = \"rays.csv\"\n", folder.path / "test.toml"); });
    };
    CHECK(error("x,y,z,dx,dy,dz\n0,0,0,0,0,1\n0,0,zero,0,0,1\n").find("rays.csv:3: \"zero\" is no number") !=
          std::string::npos);
    CHECK(error("0,0,0,0,0,1\n0,0,0,0,0\n").find("rays.csv:2: this ray has 5 numbers") != std::string::npos);
    CHECK(error("0,0,0,0,0,0\n").find("rays.csv:1: this ray has a direction of length 0") !=
          std::string::npos);
    CHECK(error("0,0,nan,0,0,1\n").find("not finite") != std::string::npos);
    CHECK(error("0,0,0,0,0,1,-1\n").find("power") != std::string::npos);
    CHECK(error("0,0,0,0,0,1,1\n0,0,0,0,0,1\n").find("to all of them or to none") != std::string::npos);
    CHECK(error("y,x,z,dx,dy,dz\n").find("rays.csv:1") != std::string::npos);
    CHECK(error("").find("no rays in this file") != std::string::npos);
}

TEST_CASE("an OBJ model needs its unit, and the nearest file is offered for one that is not there") {
    TemporaryFolder const folder;
    folder.write("bunny.obj", "v 0 0 0\n");
    auto const error = [&](std::string const& keys) {
        return error_of([&] {
            read_text("[[object]]\nname = \"o\"\n" + keys + "\n" + one_source, folder.path / "test.toml");
        });
    };
    CHECK(error("model = \"bunny.obj\"").find("give length_unit") != std::string::npos);
    CHECK(error("model = \"bunny.obj\"\nlength_unit = \"mm\"").empty());
    CHECK(error("model = \"bunni.obj\"\nlength_unit = \"mm\"").find("did you mean 'bunny.obj'?") !=
          std::string::npos);
    CHECK(error("model = \"bunny.stl\"").find("give a .gltf, .glb or .obj file") != std::string::npos);
    CHECK(error("model = \"bunny.obj\"\nlength_unit = \"mm\"\nfaces = {a = \"b\"}").find("no named faces") !=
          std::string::npos);
}

TEST_CASE("a mistake in JSON is named by its pointer") {
    std::string const json = R"({"source": [{"name": "s", "rays": [[0, 0, 0, 0, 0, 1]], "power_w": 1}]})";
    std::string const what = error_of([&] { read_experiment(parse_json(json, "a.json"), "a.json"); });
    CHECK(what == "a.json: /source/0/power_w: unknown key 'power_w' in [[source]]; did you mean 'power_W'?");
}

TEST_CASE("an experiment that is not there is an error that names it") {
    std::string text;
    CHECK(error_of([&] { read_experiment_file("nowhere/a.toml", text); }).rfind("nowhere/a.toml: ", 0) == 0);
    CHECK(error_of([&] { read_experiment_file(".", text); }).find("not a file") != std::string::npos);
}
