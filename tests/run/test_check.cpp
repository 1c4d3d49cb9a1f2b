// What a check tells of experiments and models in which something is not as meant.
#include "run/check.h"
#include "run/health_report.h"
#include "support/bench.h"
#include "support/catch.h"

#include <fstream>

using namespace sahl;
using namespace sahl::bench;

namespace {

Value check(std::string const& text, std::filesystem::path const& folder = {}) {
    auto const file = folder / "check.toml";
    return check_experiment({file, text, parse_toml(text, file.string()), {}});
}

std::string verdict(Value const& report) {
    return std::get<std::string>(report.find("verdict")->data);
}

/// Does a remark of that kind contain all these words?
bool says(Value const& report, char const* kind, std::vector<std::string> const& words) {
    for (Value const& remark : std::get<Array>(report.find(kind)->data)) {
        auto const& line = std::get<std::string>(remark.data);
        if (std::all_of(words.begin(), words.end(), [&](auto const& w) { return line.find(w) != line.npos; }))
            return true;
    }
    return false;
}

Value const& first_start(Value const& report, char const* source) {
    return std::get<Array>(report.find("sources")->find(source)->find("starts")->data).front();
}

std::string const ball = R"(
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 5}}
medium = "N-BK7"
)";

std::string beam(std::string const& from, std::string const& toward = "[0, 0, 1]") {
    return "[[source]]\nname = \"beam\"\nbeam = {from_mm = " + from + ", toward = " + toward +
           ", radius_mm = 1, rays = 20}\n";
}

/// A tetrahedron's corners and, from 1, its triangles, facing outwards.
std::string const tetrahedron = "v 0 0 0\nv 30 0 0\nv 0 30 0\nv 0 0 30\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";

void write(std::filesystem::path const& file, std::string const& text) {
    std::ofstream(file) << text;
}

void collect_keys(Value const& value, std::vector<std::string>& keys) {
    if (auto const* const table = std::get_if<Table>(&value.data))
        for (auto const& [key, entry] : *table) {
            keys.push_back(key);
            collect_keys(entry, keys);
        }
    if (auto const* const array = std::get_if<Array>(&value.data))
        for (Value const& entry : *array)
            collect_keys(entry, keys);
}

} // namespace

TEST_CASE("an experiment in which light goes where it should is fit", "[check]") {
    Value const report = check(ball + beam("[0, 0, -20]"));
    CHECK(verdict(report) == "fit");
    CHECK(check_text(report).find("fit to trace\n") != std::string::npos);
    Value const& object = *report.find("objects")->find("ball");
    CHECK(std::get<bool>(object.find("entered")->data));
    CHECK_FALSE(std::get<bool>(object.find("opaque")->data));
}

TEST_CASE("sources that all point at nothing are a problem, one of them a warning", "[check]") {
    Value const none = check(ball + beam("[0, 0, -20]", "[0, 0, -1]"));
    CHECK(verdict(none) == "unfit");
    CHECK(says(none, "problems", {"no source points at anything"}));
    std::string other = beam("[0, 0, -20]");
    other.replace(other.find("beam"), 4, "lamp");
    Value const one = check(ball + beam("[0, 0, -20]", "[0, 0, -1]") + other);
    CHECK(verdict(one) == "traced_but");
    CHECK(says(one, "warnings", {"source beam", "none of its", "pilot rays"}));
}

TEST_CASE("a source starts in the body that it stands in, and on the surface that it stands on", "[check]") {
    Value const outside = check(ball + beam("[0, 0, -20]"));
    CHECK(std::get<std::string>(first_start(outside, "beam").find("in")->data) == "surroundings");
    Value const inside = check(ball + beam("[0, 0, 0]"));
    CHECK(std::get<std::string>(first_start(inside, "beam").find("in")->data) == "ball");
    CHECK(std::get<std::string>(first_start(inside, "beam").find("medium")->data) == "N-BK7");
    std::string const rays = "[[source]]\nname = \"spot\"\nrays = [[0, 0, 5, 0, 0, 1]]\n";
    Value const on = check(ball + rays + beam("[0, 0, -20]"));
    CHECK(std::get<std::string>(first_start(on, "spot").find("in")->data) ==
          "surroundings"); // it goes outwards
    auto const& surface = std::get<Array>(first_start(on, "spot").find("on_the_surface_of")->data);
    REQUIRE(surface.size() == 1);
    CHECK(std::get<std::string>(surface[0].data) == "ball");
}

TEST_CASE("a body within an opaque one, and one that is opaque all round, let no light in", "[check]") {
    std::string const box = "[surface]\nwall = {absorb = true}\n[[object]]\nname = \"box\"\nshape = {box = "
                            "{size_mm = [20, 20, 20]}}\nsurface = \"wall\"\nmedium = \"N-SF11\"\n";
    Value const report = check(ball + box + beam("[0, 0, -50]"));
    CHECK(says(report, "warnings", {"object ball", "inside box"}));
    CHECK(says(report, "warnings", {"object box", "opaque", "N-SF11"}));
    CHECK(std::get<std::string>(report.find("objects")->find("ball")->find("inside_opaque")->data) == "box");
    Value const clear = check(ball + beam("[0, 0, -50]"));
    CHECK_FALSE(says(clear, "warnings", {"no light can enter"}));
}

TEST_CASE("a body beside the light is told to be out of it, before a sweep as a note", "[check]") {
    std::string const aside = beam("[20, 0, -20]") +
                              "[[detector]]\nname = \"screen\"\nat_mm = [20, 0, 9]\nfacing = [0, 0, -1]\n"
                              "size_mm = [9, 9]\npixels = [4, 4]\n";
    CHECK(says(check(ball + aside), "warnings", {"object ball", "no pilot ray reaches it"}));
    std::string const sweep = "[sweep]\n\"object.ball.move_mm[0]\" = {from = 0, to = 20, steps = 3}\n";
    std::string moved = ball;
    moved += "move_mm = [0, 0, 0]\n";
    CHECK(verdict(check(moved + aside + sweep)) == "fit");
    CHECK(says(check(moved + aside + sweep), "notes", {"object ball", "no pilot ray reaches it"}));
}

TEST_CASE("a detector that is met from behind alone is told to be turned", "[check]") {
    std::string const detector = "[[detector]]\nname = \"screen\"\nat_mm = [0, 0, 9]\nsize_mm = [9, 9]\n"
                                 "pixels = [4, 4]\nfacing = [0, 0, ";
    CHECK(says(check(ball + beam("[0, 0, -20]") + detector + "1]\n"), "warnings", {"screen", "from behind"}));
    CHECK(verdict(check(ball + beam("[0, 0, -20]") + detector + "-1]\n")) == "fit");
}

TEST_CASE("a body whose mesh goes round nothing is not fit, and the border is told in millimetres",
          "[check]") {
    Folder const folder;
    write(folder.path() / "closed.obj", tetrahedron + "f 2 3 4\n");
    write(folder.path() / "open.obj", tetrahedron);
    auto const object = [](std::string const& file) {
        return "[[object]]\nname = \"tent\"\nmodel = \"" + file +
               "\"\nlength_unit = \"mm\"\nmedium = \"N-BK7\"\n";
    };
    std::string const light = beam("[4, 4, -20]");
    CHECK(verdict(check(object("closed.obj") + light, folder.path())) == "fit");
    Value const report = check(object("open.obj") + light, folder.path());
    double const side = 30.0 * std::sqrt(2.0);
    Value const& borders = *report.find("models")->find("tent")->find("borders");
    CHECK(number_at(borders, {"count"}) == 1);
    CHECK(number_at(borders, {"length_mm"}) == Approx(3.0 * side));
    CHECK(number_at(borders, {"longest", "0", "centre_mm", "0"}) == Approx(10.0));
    CHECK_FALSE(std::get<bool>(report.find("models")->find("tent")->find("closed")->data));
}

TEST_CASE("a model of an unlikely size is asked about, with what it would be in other units", "[check]") {
    CHECK(unit_doubt(40.0, 1.0).find("40 mm if in mm") != std::string::npos);
    CHECK(unit_doubt(0.04, 1.0).empty());
    CHECK(unit_doubt(5.0, 1.0).empty());
    CHECK_FALSE(unit_doubt(5.1, 1.0).empty());
    CHECK(unit_doubt(1e-4, 1e-3).empty());
    CHECK(unit_doubt(0.9e-4, 1e-3).find("90 mm if in m") != std::string::npos);
    CHECK(unit_doubt(0.0, 1.0).empty());
    Folder const folder;
    std::string tiny = "v 0 0 0\nv 0.04 0 0\nv 0 0.04 0\nv 0 0 0.04\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    write(folder.path() / "tiny.obj", tiny);
    CHECK(says(check_model(folder.path() / "tiny.obj"), "warnings",
               {"tiny", "0.04 mm across", "40 mm if in m"}));
}

TEST_CASE("a model without materials is checked, with a note that it needs a medium", "[check]") {
    Folder const folder;
    write(folder.path() / "plain.obj", tetrahedron + "f 2 3 4\n");
    Value const report = check_model(folder.path() / "plain.obj");
    CHECK(says(report, "notes", {"give the object a medium"}));
    CHECK(number_at(report, {"models", "plain", "volume_mm3"}) == Approx(4500.0));
    CHECK(number_at(report, {"models", "plain", "triangles"}) == 4);
}

TEST_CASE("every key of a report is in its page", "[check]") {
    Folder const folder;
    write(folder.path() / "plain.obj", "v 9 9 9\nvn 0 0 1\n" + tetrahedron + "f 2 3 4\n");
    Value report = check("[[object]]\nname = \"NAME\"\nmodel = \"plain.obj\"\nlength_unit = \"mm\"\nmedium = "
                         "\"N-BK7\"\n" +
                             beam("[4, 4, -20]"),
                         folder.path());
    std::ifstream in(std::filesystem::path(SAHL_SOURCE_DIR) / "docs/check.md");
    std::string const page{std::istreambuf_iterator<char>(in), {}};
    std::vector<std::string> keys;
    for (auto& [key, entry] : std::get<Table>(report.data)) {
        keys.push_back(key);
        if (key != "media")
            collect_keys(entry, keys);
    }
    for (std::string const& key : keys)
        if (key != "NAME" && key.rfind("NAME.", 0) != 0 && key != "beam") {
            INFO(key);
            CHECK(page.find(key) != std::string::npos);
        }
}
