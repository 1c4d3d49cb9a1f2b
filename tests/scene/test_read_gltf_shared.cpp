// Malformed files and models made elsewhere: each is read or refused, none crashes, and what is valid is
// read.
#include "geometry/mesh.h"
#include "math/input_error.h"
#include "scene/read_gltf.h"
#include "support/catch.h"

#include <cmath>
#include <filesystem>
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

} // namespace

TEST_CASE("every malformed glTF file is read or refused, and every valid one is read") {
    if (!fs::exists(shared / "badinput")) {
        WARN("skipped: no shared data");
        return;
    }
    std::size_t refused = 0, handmade_read = 0;
    for (fs::path const& path : gltf_files(shared / "badinput")) {
        INFO(path.string());
        std::string problem;
        try {
            Model const model = read_gltf(path);
            for (ModelMesh const& mesh : model.meshes)
                make_mesh(mesh.soup);
            handmade_read += path.parent_path().filename() == "handmade";
        } catch (InputError const& error) {
            problem = error.what();
            ++refused;
            CHECK(problem.rfind(path.string(), 0) == 0);
        }
        std::string const name = path.filename().string();
        if (name.find("VALID") != std::string::npos || name == "valid.gltf" || name == "00-valid-glass.gltf")
            CHECK(problem.empty());
    }
    CHECK(refused >= 40);
    CHECK(handmade_read == 4); // the three that are valid, and a huge image that is never decoded
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
