// Keys as written in --set and sweeps reach their value, and the reference page is what the tables of keys
// say.
#include "scene/keys.h"

#include "scene/read_table.h"

#include "scene/read_text.h"
#include "support/catch.h"

#include <cstdlib>
#include <iterator>

using namespace sahl;

namespace {

Value tree() {
    return parse_toml("[[object]]\nname = \"ball\"\nmedium = \"N-BK7\"\nshape = {sphere = {radius_mm = 1}}\n"
                      "[[object]]\nname = \"rod\"\nmedium = \"N-BK7\"\nturn_deg = [1, 2, 3]\n"
                      "shape = {cylinder = {radius_mm = 1, length_mm = 9}}\n" +
                          std::string(one_source),
                      "test.toml");
}

Experiment with(std::string const& assignment) {
    Value changed = tree();
    set_key_from_text(changed, assignment);
    return read_experiment(changed, "test.toml");
}

std::string error_with(std::string const& assignment) {
    return error_of([&] { with(assignment); });
}

bool has(std::string const& text, std::string const& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("a key sets a value that is there, one that is not, and an element of a list") {
    CHECK(with("trace.seed=7").trace.seed == 7);
    CHECK(std::get<Cylinder>(std::get<Shape>(with("object.rod.shape.cylinder.length_mm = 4").objects[1].what))
              .length == 0.004);
    CHECK(std::get<Beam>(with("source.s.beam.from_mm[2]=-20").sources[0].emitter).from == dvec3(0, 0, -0.02));
}

TEST_CASE("a table that is missing on the way to a key is made") {
    CHECK(with("source.s.beam.profile.gaussian_radius_mm=2").sources.size() == 1);
    CHECK(with("medium.oil.n=1.5").media.size() == with("trace.seed=1").media.size());
    CHECK(with("limits.leak=0.5").limits.leak == 0.5);
}

TEST_CASE("an element of turn_deg or move_mm can be set where the file leaves them at their default") {
    CHECK(with("object.ball.move_mm[1]=5").objects[0].to_world.offset == dvec3(0.0, 0.005, 0.0));
    CHECK(with("object.ball.turn_deg[2]=90").objects[0].to_world.vector(dvec3(1, 0, 0)) == dvec3(0, 1, 0));
}

TEST_CASE("the text of a setting is a TOML value, and a word without quotes where it is none") {
    CHECK(with("title=Hello there").title == "Hello there");
    CHECK(with("title=\"quoted\"").title == "quoted");
    Experiment const other = with("object.ball.medium=N-SF11");
    CHECK(has(other.media.at(other.objects[0].medium->value).name, "N-SF11"));
    CHECK(with("source.s.wavelengths_nm=[400, 500]").sources[0].wavelengths.size() == 2);
    CHECK(with("trace.log=true").log.on);
    CHECK(with("title=1\ntrace.seed = 9").trace.seed == 1);
}

TEST_CASE("a setting that is wrong names itself and the nearest name") {
    CHECK(has(error_with("object.bal.move_mm[1]=5"),
              "--set object.bal.move_mm[1]=5: there is no object \"bal\""));
    CHECK(has(error_with("object.bal.move_mm[1]=5"), "did you mean 'ball'?"));
    CHECK(has(error_with("object.rod.turn_deg[3]=5"), "no element 3"));
    CHECK(has(error_with("object.rod.turn_degs[0]=5"), "did you mean 'turn_deg'?"));
    CHECK(has(error_with("trace.sed=5"),
              "--set trace.sed=5: unknown key 'sed' in [trace]; did you mean 'seed'?"));
    CHECK(has(error_with("detector.d.back=true"), "there is no detector in this experiment"));
    CHECK(has(error_with("trace.seed.x=5"), "'seed' in [trace] is a table"));
    CHECK(has(error_with("object.rod.name.x=5"), "'x' cannot be set in something that is no table"));
    CHECK(has(error_with("seed"), "KEY=VALUE"));
    CHECK(has(error_with("object..x=1"), "is no key"));
    CHECK(has(error_with("object.rod.turn_deg[x]=1"), "is no key"));
    CHECK(has(error_with("object.rod.turn_deg[0=1"), "is no key"));
    CHECK(has(error_with("trace.seed=\"many\""), "give a whole number"));
}

TEST_CASE("a sweep takes a range, values or a plain list, and whole numbers where a key wants them") {
    auto const sweep = [](std::string const& what) {
        Experiment const e =
            read_text("sweep.\"source.s.beam.rays\" = " + what + "\n[[source]]\nname = \"s\"\n" +
                      "beam = {from_mm = [0, 0, 0], toward = [0, 0, 1], radius_mm = 1}\n");
        return numbers_in(e.sweep.axes.at(0).values);
    };
    CHECK(sweep("{from = 1, to = 9, steps = 3}") == std::vector<double>{1, 5, 9});
    CHECK(sweep("{from = 4, to = 9, steps = 1}") == std::vector<double>{4});
    CHECK(sweep("{values = [3, 1]}") == std::vector<double>{3, 1});
    CHECK(sweep("[2, 4]") == std::vector<double>{2, 4});
}

namespace {

std::string const page_path = std::string(SAHL_SOURCE_DIR) + "/docs/experiment.md";

std::string reference_page() {
    std::ifstream in(page_path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

TEST_CASE("the reference of keys is the page that the tables of keys make") {
    std::string const page = reference_page();
    auto const start = page.find("\n## the experiment\n");
    REQUIRE(start != std::string::npos);
    if (std::getenv("SAHL_WRITE_REFERENCE"))
        std::ofstream(page_path, std::ios::binary) << page.substr(0, start) << keys_reference();
    INFO("to write the page anew, run this test with SAHL_WRITE_REFERENCE=1");
    CHECK(reference_page().substr(start) == keys_reference());
}

TEST_CASE("the example of the reference page is an experiment without warnings") {
    std::string const page = reference_page(), fence = "```toml\n";
    auto const start = page.find(fence) + fence.size();
    Experiment const e = read_text(page.substr(start, page.find("```", start) - start));
    CHECK(e.objects.size() == 1);
    CHECK(e.detectors.size() == 1);
    CHECK(e.warnings.empty());
}
