// Glasses by name in an experiment: the user's catalogues, the built-in one, and what is said where none
// fits.
#include "math/input_error.h"
#include "scene/read_catalogues.h"
#include "scene/read_experiment.h"
#include "support/catch.h"

#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace sahl;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() / ("sahl-test-catalogues-" + std::to_string(::getpid()));
    Folder() {
        fs::create_directories(path / "sub");
        write("my.agf",
              "NM N-BK7 5 0 0 0\nCD 1.7\nLD 0.4 0.8\nNM SPECIAL 5 0 0 0\nCD 1.8 0.01\nLD 0.4 0.8\n");
        write("sub/liquid.yml",
              "DATA:\n  - type: tabulated n\n    data: |\n      0.4 1.41\n      0.8 1.39\n");
    }
    ~Folder() { fs::remove_all(path); }
    void write(std::string const& name, std::string const& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
    }
    Experiment read(std::string const& medium, std::string const& top) const {
        std::string const text =
            top + "\n[[object]]\nname = \"a\"\nshape = {sphere = {radius_mm = 1}}\nmedium = \"" + medium +
            "\"\n[[source]]\nname = \"s\"\nbeam = {from_mm = [0, 0, -9], toward = " +
            "[0, 0, 1], radius_mm = 1, rays = 7}\n";
        return read_experiment(parse_toml(text, "e.toml"), path / "e.toml");
    }
    std::string refusal(std::string const& medium, std::string const& top = "") const {
        try {
            read(medium, top);
        } catch (InputError const& error) {
            return error.what();
        }
        return "accepted";
    }
};

std::string const own = "catalogues = [\"my.agf\", \"sub/liquid.yml\"]";

double index_of_last(Experiment const& experiment) {
    return refractive_index(experiment.media.back().index, 0.6e-6);
}

bool has(std::string const& text, std::string const& part) {
    CAPTURE(text);
    return text.find(part) != text.npos;
}

} // namespace

TEST_CASE("a user's catalogues are read from beside the experiment and go before the built-in one") {
    Folder const folder;
    CHECK(index_of_last(folder.read("SPECIAL", own)) == Approx(1.8 + 0.01 / 0.6));
    CHECK(index_of_last(folder.read("my:special", own)) == Approx(1.8 + 0.01 / 0.6));
    CHECK(index_of_last(folder.read("liquid", own)) == Approx(1.40));
    CHECK(index_of_last(folder.read("N-BK7", own)) == Approx(1.7));
    CHECK(index_of_last(folder.read("SCHOTT:N-BK7", own)) == Approx(1.5163).margin(1e-4));
    CHECK(index_of_last(folder.read("N-BK7", "")) == Approx(1.5163).margin(1e-4));
    CHECK(index_of_last(folder.read("x", own + "\nmedium.x = {glass = \"liquid\"}")) == Approx(1.40));
    CHECK(
        has(folder.read("SPECIAL", own + "\nmedium.x = {glass = \"liquid\"}").media.back().name, "SPECIAL"));
}

TEST_CASE("glasses of one name keep apart in one experiment") {
    Folder const folder;
    auto const e = folder.read("N-BK7", own + "\nsurroundings = \"SCHOTT:N-BK7\"");
    REQUIRE(e.media.size() == 2);
    CHECK(e.media[0].name != e.media[1].name);
    CHECK(index_of_last(e) == Approx(1.7));
}

TEST_CASE("a name that is ambiguous or misspelt is told with its candidates") {
    Folder const folder;
    CHECK(folder.refusal("SCHOTT:F2") == "accepted");
    std::string const two = folder.refusal("F2");
    CHECK(has(two, "e.toml:5:"));
    CHECK(has(two, "more than one glass is called \"F2\"; write SCHOTT:F2, CDGM:F2"));
    CHECK(has(folder.refusal("x", "medium.x = {glass = \"F2\"}"), "more than one glass is called \"F2\""));
    CHECK(has(folder.refusal("N-BK77"), "did you mean 'SCHOTT:N-BK7'"));
    CHECK(has(folder.refusal("SPECAL", own), "did you mean 'my:SPECIAL'"));
    CHECK(has(folder.refusal("x", "medium.x = {glass = \"N-SF1l\"}"), "'SCHOTT:N-SF1'"));
    CHECK(has(folder.refusal("flint1", "medium.flint = {n = 1.6}"), "did you mean 'flint'?"));
}

TEST_CASE("a catalogue that is missing or of another kind is refused with a place") {
    Folder const folder;
    folder.write("my.csv", "1,2");
    CHECK(has(folder.refusal("air", "catalogues = [\"mi.agf\"]"), "did you mean 'my.agf'?"));
    CHECK(has(folder.refusal("air", "catalogues = [\"my.csv\"]"), "a catalogue does not end in \".csv\""));
    CHECK(has(folder.refusal("air", "catalogues = \"my.agf\""), "a list of texts"));
    folder.write("bad.agf", "NM A 2\nCD 1 x\n");
    CHECK(
        has(folder.refusal("air", "catalogues = [\"bad.agf\"]"), "bad.agf:2: \"x\" is not a finite number"));
}

TEST_CASE("a catalogue of more than 64 MiB is refused before it is read") {
    Folder const folder;
    folder.write("huge.agf", "");
    fs::resize_file(folder.path / "huge.agf", (std::uintmax_t(1) << 26) + 1);
    CHECK(has(folder.refusal("air", "catalogues = [\"huge.agf\"]"), "more than 64 MiB"));
}

TEST_CASE("a wavelength outside a glass's range is a warning with the range") {
    Folder const folder;
    auto const e = folder.read("liquid", own + "\n[trace]\nseed = 1");
    CHECK(e.warnings.empty());
    std::string const infrared = own + "\nmedium.x = {glass = \"liquid\"}";
    Value tree = parse_toml(
        infrared + "\n[[object]]\nname = \"a\"\nshape = {sphere = {radius_mm = 1}}\nmedium = \"x\"\n"
                   "[[source]]\nname = \"s\"\nbeam = {from_mm = [0, 0, -9], toward = [0, 0, 1], "
                   "radius_mm = 1, rays = 7}\nwavelengths_nm = [900]\n",
        "e.toml");
    auto const warned = read_experiment(tree, folder.path / "e.toml").warnings;
    REQUIRE(warned.size() == 1);
    CHECK(has(warned.front(), "is used at 900.0 nm, but its index is stated from 400.0 nm to 800.0 nm only"));
    // one warning for a whole spectrum
    set_key_from_text(tree, "source.s.wavelengths_nm=[390, 500, 900, 1000]");
    auto const many = read_experiment(tree, folder.path / "e.toml").warnings;
    REQUIRE(many.size() == 1);
    CHECK(has(many.front(), "is used at 3 wavelengths from 390.0 nm to 1000.0 nm, but"));
}

TEST_CASE("a wavelength outside a metal's table is a warning with the range") {
    Value tree =
        parse_toml("[surface]\nm = {metal = \"gold\"}\nown = {n = 1, k = 5}\n[[source]]\nname = \"s\"\n"
                   "beam = {from_mm = [0, 0, -9], toward = [0, 0, 1]}\nwavelengths_nm = [10600]\n",
                   "e.toml");
    auto const warned = read_experiment(tree, "e.toml").warnings;
    REQUIRE(warned.size() == 1);
    CHECK(
        has(warned.front(), "surface \"m\" is used at 10600.0 nm, but its index is stated from 203.3 nm to"));
    set_key_from_text(tree, "source.s.wavelengths_nm=[1000]");
    CHECK(read_experiment(tree, "e.toml").warnings.empty());
}
