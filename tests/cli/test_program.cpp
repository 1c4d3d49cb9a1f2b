// The program as a user meets it: commands, exit statuses, and what is left behind.
#include "support/catch.h"

#include "scene/value.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

using namespace sahl;
namespace fs = std::filesystem;

namespace {

struct Shell {
    fs::path folder = fs::temp_directory_path() / ("sahl-test-program-" + std::to_string(::getpid()));
    Shell() { fs::create_directories(folder); }
    ~Shell() { fs::remove_all(folder); }

    /// Exit status; what it said is in out and err.
    int run(std::string const& arguments, std::string const& program = SAHL_PROGRAM) {
        std::string const command =
            "cd " + folder.string() + " && '" + program + "' " + arguments + " >out.txt 2>err.txt";
        int const status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string text(char const* name) const {
        std::ifstream in(folder / name);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void write(char const* name, std::string const& content) const {
        std::ofstream(folder / name) << content;
    }
};

std::string const ball = R"(
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 5}}
medium = "N-BK7"
[[source]]
name = "beam"
beam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 4, rays = 50}
[[detector]]
name = "screen"
at_mm = [0, 0, 8]
facing = [0, 0, -1]
size_mm = [4, 4]
pixels = [16, 16]
)";

} // namespace

TEST_CASE("trace writes a run, explain and export read its log") {
    Shell shell;
    shell.write("ball.toml", ball);
    CHECK(shell.run("trace ball.toml --set trace.log=true") == 0);
    for (char const* file : {"summary.json", "rays.h5", "report.html", "detectors/screen.exr",
                             "detectors/screen.csv", "detectors/screen.png"})
        CHECK(fs::file_size(shell.folder / "out/ball" / file) > 0);
    CHECK(shell.run("explain out/ball --ray 3") == 0);
    CHECK(shell.text("out.txt").find("detected by screen") != std::string::npos);
    CHECK(shell.run("explain out/ball/rays.h5 --ray 100000") == 3);
    CHECK(shell.text("err.txt").find("its last is ray") != std::string::npos);
    CHECK(shell.run("export out/ball --to paths.csv") == 0);
    CHECK(shell.text("paths.csv").rfind("ray,segment,parent,depth,born,ended,surface", 0) == 0);
    CHECK(shell.run("export out/ball --to paths.xyz") == 3);
    CHECK(shell.run("export ball.toml --to ball.glb --fineness 60") == 0);
    CHECK(shell.text("ball.glb").rfind("glTF", 0) == 0);
    CHECK(shell.run("export ball.toml --to ball.csv") == 3);
    CHECK(shell.run("export ball.toml --to ball.glb --fineness 5") == 2);
    CHECK(shell.run("export out/ball --to paths.csv --set trace.seed=2") == 3);
    for (char const* more : {"rays.vtp", "rays.jsonl", "rays.glb --bodies ball.toml --colour power",
                             "rays.tm25ray --detector screen", "rays.csv --layout soltrace"})
        CHECK(shell.run(std::string("export out/ball --to ") + more) == 0);
    CHECK(shell.run("export out/ball --to rays.glb --colour blue") == 2);
}

TEST_CASE("the summary goes to standard output as JSON, and nothing else does") {
    Shell shell;
    shell.write("ball.toml", ball);
    CHECK(shell.run("trace ball.toml --json --quiet --threads 2 --seed 7") == 0);
    Value const summary = parse_json(shell.text("out.txt"), "out.txt");
    CHECK(std::get<std::int64_t>(summary.find("seed")->data) == 7);
    CHECK(std::get<std::int64_t>(summary.find("threads")->data) == 2);
    CHECK(shell.text("err.txt").empty());
}

TEST_CASE(
    "wrong usage is status 2, bad input 3 with place, problem and remedy, and then nothing is written") {
    Shell shell;
    shell.write("ball.toml", ball);
    CHECK(shell.run("trace") == 2);
    CHECK(shell.run("fly ball.toml") == 2);
    CHECK(shell.run("trace ball.toml --fast") == 2);
    CHECK(shell.run("trace balls.toml") == 3);
    shell.write("wrong.toml", ball + "[trace]\nmin_powr = 1\n");
    CHECK(shell.run("trace wrong.toml") == 3);
    CHECK(shell.text("err.txt").find("wrong.toml:16:1: unknown key 'min_powr'") != std::string::npos);
    CHECK(shell.text("err.txt").find("did you mean 'min_power'?") != std::string::npos);
    CHECK(!fs::exists(shell.folder / "out"));
}

TEST_CASE("a broken law is status 4, with the results written and marked") {
    Shell shell;
    shell.write("ball.toml", ball);
    CHECK(shell.run("trace ball.toml", SAHL_TAMPERED) == 4); // built with 0.999 of every transmittance
    CHECK(shell.text("err.txt").find("the ledger does not close") != std::string::npos);
    Value const summary = parse_json(shell.text("out/ball/summary.json"), "summary.json");
    CHECK(!std::get<bool>(summary.find("passed")->data));
    CHECK(std::get<Array>(summary.find("failures")->data).size() == 1);
    CHECK(std::get<double>(summary.find("energy_W")->find("remainder")->data) > 1e-4);
}

TEST_CASE("leaks above the limit are status 4, and the lost rays are named") {
    Shell shell;
    // a mesh with a hole: a tetrahedron without its base
    shell.write(
        "open.gltf",
        R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
"materials": [{"name": "glass", "pbrMetallicRoughness": {"metallicFactor": 0}, "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": {"thicknessFactor": 1}}}],
"extensionsUsed": ["KHR_materials_transmission", "KHR_materials_volume"],
"buffers": [{"byteLength": 66, "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAABAAMAAQACAAMAAgAAAAMA"}],
"bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 18}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 1]},
{"bufferView": 1, "componentType": 5123, "count": 9, "type": "SCALAR"}]})");
    shell.write("leak.toml", R"(
[[object]]
name = "tent"
model = "open.gltf"
[[source]]
name = "beam"
beam = {from_mm = [0, 0, 3000], toward = [0, 0, -1], radius_mm = 100, rays = 50}
)");
    CHECK(shell.run("trace leak.toml") == 4);
    Value const summary = parse_json(shell.text("out/leak/summary.json"), "summary.json");
    CHECK(!std::get<bool>(summary.find("passed")->data));
    CHECK(!std::get<Array>(summary.find("lost_rays")->data).empty());
    CHECK(shell.run("trace leak.toml --set limits.leak=1") == 0);
}

TEST_CASE("a torn mesh is traced, its leaks are counted hole by hole, and the status is 4") {
    Shell shell;
    // a cube of 20 mm without half of its back and half of its top
    shell.write("torn.obj", R"(
v -10 -10 -10
v 10 -10 -10
v -10 10 -10
v 10 10 -10
v -10 -10 10
v 10 -10 10
v -10 10 10
v 10 10 10
f 1 3 4
f 5 6 8
f 5 8 7
f 1 2 6
f 1 6 5
f 3 8 4
f 1 5 7
f 1 7 3
f 2 4 8
f 2 8 6
)");
    shell.write("torn.toml", R"(
[[object]]
name = "cube"
model = "torn.obj"
length_unit = "mm"
medium = "N-BK7"
[[source]]
name = "beam"
beam = {from_mm = [0, 0, 50], toward = [0, 0, -1], radius_mm = 8, pattern = "hexagonal", rays = 400}
)");
    CHECK(shell.run("trace torn.toml --set trace.max_depth=1") == 4);
    Value const summary = parse_json(shell.text("out/torn/summary.json"), "summary.json");
    CHECK(!std::get<bool>(summary.find("passed")->data));
    auto const leaks = std::get<std::int64_t>(summary.find("events")->find("leak")->data);
    CHECK(leaks > 150); // half of the back is there
    CHECK(leaks < 250);
    CHECK(std::get<double>(summary.find("energy_W")->find("error")->data) > 0.3);
    std::string warnings = to_json(*summary.find("warnings"));
    CHECK(warnings.find("cube: " + std::to_string(leaks) + " rays leaked at the hole of 3 edges") !=
          std::string::npos);
    CHECK(warnings.find("-10) mm; close it there") != std::string::npos); // the back's, not the side's
    Value const& first = std::get<Array>(summary.find("lost_rays")->data).front();
    CHECK(std::get<std::string>(first.find("event")->data) == "leak");
    CHECK(std::get<Array>(first.find("at_mm")->data).size() == 3);
}

TEST_CASE("a sweep writes a row for each value and a folder for each run") {
    Shell shell;
    shell.write("ball.toml",
                ball + "[sweep]\n\"detector.screen.at_mm[2]\" = {from = 6, to = 9, steps = 4}\n");
    CHECK(shell.run("trace ball.toml") == 0);
    std::string const csv = shell.text("out/ball/sweep.csv");
    CHECK(csv.rfind("detector.screen.at_mm[2],", 0) == 0);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 5);
    for (char const* run : {"000", "001", "002", "003"})
        CHECK(fs::exists(shell.folder / "out/ball/runs" / run / "summary.json"));
}

TEST_CASE("check says what is in an experiment and in a model") {
    Shell shell;
    shell.write("ball.toml", ball);
    CHECK(shell.run("check ball.toml") == 0);
    CHECK(shell.text("out.txt").find("ball: body of N-BK7") != std::string::npos);
    CHECK(shell.run("check ball.toml --set detector.screen.facing=[0,0,1] --json") == 0);
    Value const report = parse_json(shell.text("out.txt"), "out.txt");
    std::string const warning = to_json(*report.find("warnings"));
    CHECK(warning.find("only from behind") != std::string::npos);
    CHECK(shell.run("check '" SAHL_SOURCE_DIR "/models/ball-320.glb'") == 0);
    CHECK(shell.text("out.txt").find("closed: true") != std::string::npos);
}

TEST_CASE("check tells a hole in a model by its place, as text and as JSON, and is done all the same") {
    Shell shell;
    std::string cube = "mtllib glass.mtl\nusemtl glass\n";
    for (int i = 0; i < 8; ++i)
        cube += "v " + std::to_string(i & 1 ? 9 : 0) + " " + std::to_string(i & 2 ? 9 : 0) + " " +
                std::to_string(i & 4 ? 9 : 0) + "\n";
    cube += "f 1 5 7 3\nf 2 4 8 6\nf 1 2 6 5\nf 3 7 8 4\nf 1 3 4 2\nf 5 6 8\n"; // f 5 8 7 is not there
    shell.write("glass.mtl", "newmtl glass\nNi 1.5\nd 0\nillum 7\n");
    shell.write("torn.obj", cube);
    CHECK(shell.run("check torn.obj --json") == 0);
    Value const report = parse_json(shell.text("out.txt"), "out.txt");
    Value const& model = std::get<Table>(report.find("models")->data).front().second;
    CHECK_FALSE(std::get<bool>(model.find("closed")->data));
    Value const& hole = std::get<Array>(model.find("borders")->find("longest")->data).front();
    CHECK(std::get<std::int64_t>(hole.find("edges")->data) == 3);
    CHECK(shell.run("check torn.obj") == 0);
    CHECK(shell.text("out.txt").find("border of 30.73 mm (3 edges)") != std::string::npos);
    shell.write("torn.obj", "v 0 0 nan\nf 1 1 1\n");
    CHECK(shell.run("check torn.obj") == 3);
    CHECK(shell.text("out.txt").empty());
}

TEST_CASE("a picture that is told to stop is written as far as it is, with the status of its signal") {
    Shell shell;
    shell.write("slow.toml", ball + "[camera]\nat_mm = [0, 0, 40]\nlook_at_mm = [0, 0, 0]\nfov_deg = 10\n"
                                    "resolution = [1600, 1600]\nsamples = 256\n"
                                    "[background]\ncolor = [1, 1, 1]\n");
    // which signals the program, and then its whole group: that is one wish and not two
    std::string const until = "timeout' --preserve-status 4 '";
    CHECK(shell.run("render slow.toml --out slow.exr", until + SAHL_PROGRAM) == 143);
    CHECK(shell.text("err.txt") == "sahl: stopped; what was done is written\n");
    CHECK(fs::file_size(shell.folder / "slow.exr") > 1600);
}

TEST_CASE("what is wrong with a picture of a model is said of what is wrong") {
    Shell shell;
    std::string const ball_model = "'" SAHL_SOURCE_DIR "/models/ball-320.glb'";
    CHECK(shell.run("render " + ball_model + " --glass N-BK8") == 3);
    CHECK(shell.text("err.txt").rfind("sahl: --glass: there is no medium \"N-BK8\"", 0) == 0);
    shell.write("noise.glb", "noise");
    CHECK(shell.run("render noise.glb") == 3);
    CHECK(shell.text("err.txt").find("this is no glTF") != std::string::npos);
    shell.write("lens.toml",
                "[[object]]\nname = \"ball\"\nlength_unit = \"mm\"\nmodel = " +
                    ("\"" SAHL_SOURCE_DIR "/models/ball-320.glb\"" + std::string("\ndecimate_mm = 0.1\n")) +
                    "medium = \"N-BK7\"\n[camera]\nat_mm = [0, 0, 40]\nlook_at_mm = [0, 0, 0]\n"
                    "resolution = [8, 6]\nsamples = 1\n");
    CHECK(shell.run("render lens.toml --out lens.png") == 0);
    CHECK(shell.text("out.txt").find("decimate_mm are for `sahl trace`") != std::string::npos);
    CHECK(shell.run("render " + ball_model +
                    " --glass N-SF11 --out ball.png --set 'camera.resolution=[8, 6]'") == 0);
    CHECK(shell.text("out.txt").find("decimate") == std::string::npos);
}

TEST_CASE("an option that is no number, or no method, is wrong usage that names the option") {
    Shell shell;
    shell.write("ball.toml", ball);
    for (std::string const wrong :
         {"--seed x", "--seed -1", "--tolerance 0", "--tolerance thin", "--method fast"}) {
        CAPTURE(wrong);
        CHECK(shell.run("trace ball.toml " + wrong) == 2);
        CHECK(shell.text("err.txt").rfind(wrong.substr(0, wrong.find(' ')), 0) == 0);
        CHECK(!fs::exists(shell.folder / "out"));
    }
}

TEST_CASE("glass lists the catalogue, searches it and prints a glass, as text and as JSON") {
    Shell shell;
    auto const said = [&](std::string const& part) {
        return shell.text("out.txt").find(part) != std::string::npos;
    };
    CHECK(shell.run("glass") == 0);
    for (char const* part : {"SCHOTT (163)", "OHARA (410)", " N-SF11 ", "metals (4)", "sahl glass NAME"})
        CHECK(said(part));
    CHECK(shell.run("glass n-bk7 --at 1064 --thickness 50") == 0);
    for (char const* part :
         {"SCHOTT:N-BK7", "n at 1064 nm", "1.50663", "64.17", "300 – 2500 nm", "50 mm let through"})
        CHECK(said(part));
    CHECK(shell.run("glass 'N-SF1?'") == 0);
    CHECK((said("SCHOTT:N-SF11") && said("SCHOTT:N-SF19") && !said("SCHOTT:N-SF1 ")));
    CHECK(shell.run("glass F2") == 0); // both, so that one sees what to write
    CHECK((said("SCHOTT:F2") && said("CDGM:F2")));
    CHECK(shell.run("glass silver --at 633 --json") == 0);
    Value const metal = parse_json(shell.text("out.txt"), "out.txt");
    CHECK(std::get<double>(std::get<Array>(metal.find("metals")->data).front().find("reflectance")->data) >
          0.98);
    CHECK(shell.run("glass --nd 1.5168 --vd 64.17 --count 3 --json") == 0);
    Value const nearest = parse_json(shell.text("out.txt"), "out.txt");
    Array const& glasses = std::get<Array>(nearest.find("glasses")->data);
    REQUIRE(glasses.size() == 3);
    CHECK(std::get<double>(glasses[0].find("nd")->data) == Approx(1.5168).margin(1e-4));
    CHECK(std::get<double>(glasses[0].find("vd")->data) == Approx(64.17).margin(0.05));
}

TEST_CASE("glass looks into catalogues of one's own, and refuses what it cannot find") {
    Shell shell;
    shell.write("my.agf", "NM SPECIAL 5 0 0 0\nCD 1.8 0.01\nLD 0.4 0.8\nIT 0.5 0.5 10\n");
    CHECK(shell.run("glass special --catalogue my.agf --at 500 --json") == 0);
    Value const report = parse_json(shell.text("out.txt"), "out.txt");
    Value const& glass = std::get<Array>(report.find("glasses")->data).front();
    CHECK(std::get<double>(glass.find("n")->data) == Approx(1.82));
    CHECK(std::get<double>(glass.find("internal_transmittance")->data) == Approx(0.5));
    CHECK(shell.run("glass special") == 3);
    CHECK(shell.run("glass N-BK77") == 3);
    CHECK(shell.text("err.txt").find("did you mean 'SCHOTT:N-BK7'") != std::string::npos);
    CHECK(shell.run("glass N-BK7 --at nan") == 2);
    CHECK(shell.run("glass N-BK7 --at -5") == 2);
    CHECK(shell.run("glass --catalogue none.agf") == 3);
}
