// The rooms of src/ include one way and every library has one door; and the rules that say so can fail.
#include "architecture/rules.h"
#include "support/catch.h"

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace sahl;

namespace {

std::string read(std::filesystem::path const& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

bool allowed(std::string const& file, std::string const& line) {
    auto const includes = includes_of(file, line);
    REQUIRE(includes.size() == 1);
    return problem_with(includes[0]).empty();
}

} // namespace

TEST_CASE("rooms include one way and every library has one door") {
    std::filesystem::path const src = std::filesystem::path(SAHL_SOURCE_DIR) / "src";
    int files = 0;
    for (auto const& entry : std::filesystem::recursive_directory_iterator(src)) {
        auto const ending = entry.path().extension();
        if (ending != ".h" && ending != ".cpp")
            continue;
        ++files;
        for (Include const& include :
             includes_of(entry.path().lexically_relative(src).generic_string(), read(entry)))
            CHECK(problem_with(include) == "");
    }
    CHECK(files > 0);
}

TEST_CASE("an include of a room above is a fault") {
    CHECK(allowed("trace/tracer.cpp", "#include \"math/vec.h\""));
    CHECK(allowed("materials/medium.h", "#include \"optics/snell.h\""));
    CHECK(allowed("run/run.cpp", "#include \"report/page.h\""));
    CHECK(allowed("cli/main.cpp", "#include \"trace/event.h\""));
    CHECK(allowed("math/ids.h", "#include \"math/vec.h\""));

    CHECK_FALSE(allowed("math/vec.h", "#include \"trace/event.h\""));
    CHECK_FALSE(allowed("scene/scene.h", "#include \"trace/event.h\""));
    CHECK_FALSE(allowed("report/page.cpp", "#include \"run/run.h\""));
    CHECK_FALSE(allowed("run/run.cpp", "#include \"cli/options.h\""));
    CHECK_FALSE(allowed("run/run.cpp", "#include <cli/options.h>"));
}

TEST_CASE("neighbouring rooms are strangers") {
    CHECK_FALSE(allowed("optics/fresnel.cpp", "#include \"geometry/mesh.h\""));
    CHECK_FALSE(allowed("geometry/embree/bvh.cpp", "#include \"optics/snell.h\""));
    CHECK_FALSE(allowed("geometry/mesh.cpp", "#include \"materials/medium.h\""));
    CHECK_FALSE(allowed("image/image.cpp", "#include \"optics/snell.h\""));
    CHECK_FALSE(allowed("record/ray_log.cpp", "#include \"render/film.h\""));
    CHECK_FALSE(allowed("python/module.cpp", "#include \"cli/options.h\""));
}

TEST_CASE("an include outside the rooms is a fault") {
    CHECK_FALSE(allowed("optics/snell.cpp", "#include \"snell.h\""));
    CHECK_FALSE(allowed("optics/snell.cpp", "#include \"../math/vec.h\""));
    CHECK_FALSE(allowed("optics/snell.cpp", "#include \"attic/old.h\""));
    CHECK_FALSE(allowed("attic/old.cpp", "#include <vector>"));
    CHECK_FALSE(allowed("old.cpp", "#include <vector>"));
}

TEST_CASE("a second door to a library is a fault, and so is a library without one") {
    CHECK(allowed("geometry/embree/bvh.cpp", "#include <embree3/rtcore.h>"));
    CHECK(allowed("geometry/mesh_health.cpp", "#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>"));
    CHECK(allowed("math/vec.h", "#include <glm/vec3.hpp>"));
    CHECK(allowed("record/ray_log.cpp", "#include <unistd.h>"));
    CHECK(allowed("trace/tracer.cpp", "#include <vector>"));

    CHECK_FALSE(allowed("trace/tracer.cpp", "#include <embree4/rtcore.h>"));
    CHECK_FALSE(allowed("geometry/shape.h", "#include <glm/vec3.hpp>"));
    CHECK_FALSE(allowed("scene/read_obj.cpp", "#include <tiny_gltf.h>"));
    CHECK_FALSE(allowed("report/page.cpp", "#include <nlohmann/json.hpp>"));
    CHECK_FALSE(allowed("trace/tracer.cpp", "#include <tbb/parallel_for.h>"));
    CHECK_FALSE(allowed("math/matrix.h", "#include <Eigen/Dense>"));
}

TEST_CASE("includes are found however they are spaced, and comments and conditions are not includes") {
    auto const found =
        includes_of("math/a.h", "#pragma once\r\n  #  include <vector>\n#include\t\"math/vec.h\" // why\n"
                                "// #include \"trace/event.h\"\n#if __has_include(<zlib.h>)\n#include <a>");
    REQUIRE(found.size() == 3);
    CHECK(found[0].path == "vector");
    CHECK(found[0].line == 2);
    CHECK_FALSE(found[0].quoted);
    CHECK(found[1].path == "math/vec.h");
    CHECK(found[1].quoted);
    CHECK(found[2].line == 6);
}
