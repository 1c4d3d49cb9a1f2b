#include "support/catch.h"

#include "math/input_error.h"
#include "run/run_folder.h"

#include <fstream>
#include <unistd.h>

using namespace sahl;
namespace fs = std::filesystem;

namespace {

struct Scratch {
    fs::path path = fs::temp_directory_path() / ("sahl-test-folder-" + std::to_string(::getpid()));
    Scratch() { fs::remove_all(path); }
    ~Scratch() { fs::remove_all(path); }
};

void write(fs::path const& file, char const* text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

std::string read(fs::path const& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

TEST_CASE("a run that is not finished leaves the earlier one as it was") {
    Scratch const scratch;
    write(scratch.path / "out" / "summary.json", "old");
    {
        RunFolder const folder(scratch.path / "out");
        write(folder.path() / "summary.json", "half of the new");
    }
    CHECK(read(scratch.path / "out" / "summary.json") == "old");
    CHECK(std::distance(fs::directory_iterator(scratch.path), {}) == 1);
}

TEST_CASE("a finished run replaces the earlier one and keeps the user's own files") {
    Scratch const scratch;
    write(scratch.path / "out" / "summary.json", "old");
    write(scratch.path / "out" / "rays.h5", "old log");
    write(scratch.path / "out" / "notes.txt", "mine");
    RunFolder folder(scratch.path / "out/");
    write(folder.path() / "summary.json", "new");
    folder.publish();
    CHECK(read(scratch.path / "out" / "summary.json") == "new");
    CHECK(!fs::exists(scratch.path / "out" / "rays.h5"));
    CHECK(read(scratch.path / "out" / "notes.txt") == "mine");
    CHECK(std::distance(fs::directory_iterator(scratch.path), {}) == 1);
}

TEST_CASE("a folder that holds files but no run is not touched") {
    Scratch const scratch;
    write(scratch.path / "out" / "thesis.tex", "mine");
    try {
        RunFolder const folder(scratch.path / "out");
        FAIL("it was taken");
    } catch (InputError const& error) {
        CHECK(std::string(error.what()).find("holds files, but no earlier run") != std::string::npos);
    }
    CHECK(read(scratch.path / "out" / "thesis.tex") == "mine");
}
