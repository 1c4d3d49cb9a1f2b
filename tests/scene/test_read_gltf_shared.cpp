// Malformed files and models made elsewhere: each is read or refused, none crashes, and what is valid is
// read.
#include "geometry/mesh.h"
#include "math/input_error.h"
#include "scene/read_gltf.h"
#include "scene/value.h"
#include "support/catch.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace sahl;

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> gltf_files(fs::path const& folder) {
    std::vector<fs::path> files;
    for (fs::directory_entry const& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb")
            files.push_back(entry.path());
    return files;
}

fs::path const shared = SAHL_SHARED_DATA;

struct Outcome {
    bool refused = false, warned = false; // of something that is wrong with the file
    std::string said;
};

/// Reads the file, and makes its meshes, which must not fail either.
Outcome read(fs::path const& path) {
    Outcome outcome;
    try {
        Model const model = read_gltf(path);
        for (ModelMesh const& mesh : model.meshes)
            make_mesh(mesh.soup);
        for (std::string const& warning : model.warnings)
            if (warning.find("no node of its scene") == std::string::npos) {
                outcome.warned = true;
                outcome.said += warning + "; ";
            }
        for (ModelMaterial const& material : model.materials)
            outcome.warned = outcome.warned || !material.warnings.empty();
    } catch (InputError const& error) {
        outcome.refused = true;
        outcome.said = error.what();
        CHECK(outcome.said.rfind(path.string(), 0) == 0);
    }
    return outcome;
}

} // namespace

TEST_CASE("every malformed glTF file is read or refused, and every valid one is read") {
    if (!fs::exists(shared / "badinput")) {
        WARN("skipped: no shared data");
        return;
    }
    std::size_t refused = 0, handmade_read = 0;
    for (fs::path const& path : gltf_files(shared / "badinput")) {
        INFO(path.string());
        Outcome const outcome = read(path);
        refused += outcome.refused;
        handmade_read += !outcome.refused && path.parent_path().filename() == "handmade";
        std::string const name = path.filename().string();
        if (name.find("VALID") != std::string::npos || name == "valid.gltf" || name == "00-valid-glass.gltf")
            CHECK_FALSE(outcome.refused);
    }
    CHECK(refused >= 40);
    CHECK(handmade_read == 4); // the three that are valid, and a huge image that is never decoded
}

TEST_CASE("where the glTF validator finds an error the file is refused or warned of, else it is read") {
    fs::path const folder = shared / "badinput" / "gltf-validator-tests";
    if (!fs::exists(folder)) {
        WARN("skipped: no shared data");
        return;
    }
    std::size_t with_errors = 0, without = 0;
    for (fs::path const& path : gltf_files(folder)) {
        std::ifstream stream(path.string() + ".report.json");
        if (!stream)
            continue;
        std::string const text{std::istreambuf_iterator<char>(stream), {}};
        Value const report = parse_json(text, path.string());
        std::int64_t const errors = std::get<std::int64_t>(report.find("issues")->find("numErrors")->data);
        Outcome const outcome = read(path);
        INFO(path.string() << ": " << errors << " errors; " << outcome.said);
        if (errors > 0)
            CHECK((outcome.refused || outcome.warned));
        else
            CHECK_FALSE(outcome.refused);
        ++(errors > 0 ? with_errors : without);
    }
    CHECK(with_errors > 80);
    CHECK(without > 40);
}

TEST_CASE("models made elsewhere are read, or refused for their compression") {
    if (!fs::exists(shared / "models")) {
        WARN("skipped: no shared data");
        return;
    }
    for (fs::path const& path : gltf_files(shared / "models")) {
        INFO(path.string());
        std::string problem;
        try {
            read_gltf(path);
        } catch (InputError const& error) {
            problem = error.what();
        }
        bool const compressed = path.parent_path().filename() == "compressed";
        CHECK((problem.find("export without compression") != std::string::npos) == compressed);
        CHECK(problem.empty() == !compressed);
    }
}

TEST_CASE("instances of EXT_mesh_gpu_instancing are placed one by one") {
    fs::path const path = shared / "models" / "24_gpu_instancing" / "24_gpu_instancing.gltf";
    if (!fs::exists(path)) {
        WARN("skipped: no shared data");
        return;
    }
    Model const model = read_gltf(path);
    CHECK(model.meshes.size() == 2);
    CHECK(model.instances.size() > 1000);
}

TEST_CASE("a sparse accessor replaces what it names") {
    fs::path const path = shared / "badinput" / "handmade" / "sparse-VALID.gltf";
    if (!fs::exists(path)) {
        WARN("skipped: no shared data");
        return;
    }
    Model const model = read_gltf(path);
    REQUIRE(model.meshes.size() == 1);
    CHECK(model.meshes[0].soup.positions[0] == dvec3(0.0)); // element 0 becomes the first of the values
    CHECK(model.materials[0].dispersion == 0.31);
}
