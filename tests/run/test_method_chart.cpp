// The same rays by every method: a ball as a mesh against the sphere.
#include "run/method_chart.h"

#include "math/input_error.h"
#include "report/method_page.h"
#include "run/values.h"
#include "scene/read_experiment.h"
#include "support/catch.h"
#include "support/gltf.h"

#include <algorithm>

using namespace sahl;
using namespace sahl::bench;

namespace {

std::string experiment(std::string const& ball) {
    return "title = \"a ball & its sphere\"\n[trace]\nmin_power = 0.5\n[medium]\nglass = {n = "
           "1.5168}\n[[object]]\nname = "
           "\"ball\"\nmedium = \"glass\"\n" +
           ball +
           "\n[[source]]\nname = \"beam\"\nbeam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 4, "
           "pattern = \"hexagonal\", rays = 300}\n";
}

MethodFigures const& of_method(MethodChart const& chart, std::string const& name) {
    auto const at = std::find_if(chart.methods.begin(), chart.methods.end(),
                                 [&](auto const& m) { return m.method == name; });
    REQUIRE(at != chart.methods.end());
    return *at;
}

} // namespace

TEST_CASE("a chart holds every method against the exact shape, which has a row of its own", "[curved]") {
    TemporaryFolder const folder("method-chart");
    auto const written = [&](char const* name, std::string const& ball) {
        return load_experiment(folder.write(name, experiment(ball)));
    };
    ExperimentSource const mesh =
        written("mesh.toml", "model = \"" + std::string(SAHL_SOURCE_DIR) + "/models/ball-5120.glb\"");
    ExperimentSource const exact = written("exact.toml", "shape = {sphere = {radius_mm = 5}}");
    MethodChart const chart = method_chart(mesh, exact);
    REQUIRE(chart.methods.size() == 6);
    CHECK(chart.methods.back().method == "exact");
    CHECK(chart.methods.back().reference);
    CHECK(chart.methods.back().rms == 0.0);
    CHECK(of_method(chart, "facet").rms > 10.0 * of_method(chart, "interpolated").rms);
    CHECK(of_method(chart, "interpolated").rms > 100.0 * of_method(chart, "fitted").rms);
    CHECK(of_method(chart, "recognised").rms < 3e-9);
    for (MethodFigures const& m : chart.methods) {
        CHECK(m.segments == chart.methods.back().segments); // in, through, out: nothing else above this power
        CHECK(m.leaving <= m.greatest);
        CHECK((m.leaving > 0.0) == (m.method != "exact"));
        CHECK(m.ns_per_segment > 0.0);
    }
    MethodChart const alone = method_chart(mesh, std::nullopt);
    CHECK(alone.reference == "recognised");
    CHECK(alone.methods.size() == 5);
    CHECK_THROWS_AS(method_chart(exact, std::nullopt), InputError); // nothing to choose between
}

TEST_CASE("the files of a chart say the same, and its page is whole and shows what it was given as text",
          "[curved]") {
    MethodChart chart{"a <b> & c", "the sphere", 100, {}, {}};
    chart.methods.push_back({"facet", 80.0, 500, 1e-3, 5e-3, 2e-3, 0.25, false, true});
    chart.methods.push_back({"exact", 20.0, 500, 0.0, 0.0, 0.0, 0.0, true, true});
    std::string const csv = chart_csv(chart), head = csv.substr(0, csv.find('\n'));
    Value const value = chart_value(chart);
    Table const& first = std::get<Table>(std::get<Array>(value.find("methods")->data).front().data);
    std::string keys;
    for (auto const& [key, ignored] : first)
        keys += (keys.empty() ? "" : ",") + key;
    CHECK(head == keys);
    CHECK(csv.find("facet,80,500,0.001,0.002,0.005,0.25,0,1\n") != std::string::npos);
    std::string const page =
        report::method_page({{"facet", 80.0, 1e-3, 5e-3, true, 2e-3, 0.25}}, chart.title, chart.reference);
    CHECK(page.find("a &lt;b&gt; &amp; c") != std::string::npos);
    CHECK(page.find("a <b>") == std::string::npos);
    CHECK(page.find("<svg") != std::string::npos);
    CHECK(page.find("<td>25</td>") != std::string::npos);
    CHECK(page.find("http:") == page.find("http://www.w3.org/2000/svg")); // a name, not an address
}
