// The page is well-formed whatever the files say, and says what the summary says.
#include "report/detectors.h"
#include "report/sample_run.h"
#include "report/sweep.h"
#include "report/tags.h"
#include "support/catch.h"

#include <cstdlib>
#include <fstream>

using namespace sahl;

namespace {

std::string page_of(Value const& summary, sample::Run const& run, std::vector<std::string> pictures = {},
                    std::vector<std::string> keys = {}, std::vector<SweepRow> sweep = {}) {
    return report_page(
        {summary, run.scene, run.paths, 36, std::move(pictures), std::move(keys), std::move(sweep)});
}

bool has(std::string const& page, std::string_view part) {
    return page.find(part) != std::string::npos;
}

constexpr char const* hostile = "<script>alert('1')</script>\" onload=\"x & \x01 </style>";

} // namespace

TEST_CASE("a page is well-formed and asks for nothing from elsewhere") {
    std::string const page = page_of(sample::summary(), sample::run(), {"detectors/screen.png"});
    CHECK(sample::fault_of(page) == "");
    CHECK(has(page, "default-src 'none'; img-src 'self' data:; style-src 'unsafe-inline'"));
    CHECK_FALSE(has(page, "<script"));
    CHECK_FALSE(has(page, "http:"));
    CHECK_FALSE(has(page, "https:"));
    CHECK_FALSE(has(page, "url("));
    CHECK_FALSE(has(page, "nan"));
}

TEST_CASE("the checker of tags notices what is wrong") {
    CHECK(sample::fault_of("<p>a<b>c</b></p><br/>") == "");
    CHECK(sample::fault_of("<p>a") != "");
    CHECK(sample::fault_of("<p><b></p></b>") != "");
    CHECK(sample::fault_of("a & b") != "");
    CHECK(sample::fault_of("<p class=x></p>") != "");
    CHECK(sample::fault_of("1 < 2") != "");
}

TEST_CASE("a page says what the summary says") {
    std::string const page = page_of(sample::summary(), sample::run(), {"detectors/screen.png"});
    CHECK(has(page, "A 60° prism at minimum deviation"));
    CHECK(has(page, "36 of 3\u202F000 rays drawn"));
    CHECK(has(page, "0.812346 W"));
    CHECK(has(page, "between 0.8123456 and 0.8123966 W"));
    CHECK(has(page, "<dt>power</dt><dd>0 W</dd>"));
    CHECK(has(page, "<dt>hits</dt><dd>3\u202F100</dd>"));
    CHECK(has(page, "(0.123456, −10.5) mm"));
    CHECK(has(page, "src=\"detectors/screen.png\""));
    CHECK(has(page, "it is traced as clear glass"));
    CHECK(has(page, "not stated"));
    CHECK(has(page, "12 triangles"));
    CHECK(has(page, "3 hits were in doubt"));
    CHECK(has(page, ">x (mm)</text>"));
    CHECK(has(page, "✓ The ledger closes"));
}

TEST_CASE("names from files are shown, not obeyed") {
    sample::Run run = sample::run();
    Value summary = sample::summary();
    for (Body& body : run.scene.bodies)
        body.name = hostile;
    run.scene.sources[0].name = hostile;
    sample::entry(summary, {"title"}).data = hostile;
    sample::entry(summary, {"program"}).data = hostile;
    sample::entry(summary, {"experiment_sha256"}).data = hostile;
    sample::entry(summary, {"options"}).data = Table{{hostile, Value{std::string(hostile), {}}}};
    sample::entry(summary, {"warnings"}).data = Array{Value{std::string(hostile), {}}};
    for (char const* table : {"detectors", "objects", "events", "absorbed_W", "escaped_direction"})
        std::get<Table>(sample::entry(summary, {table}).data).front().first = hostile;
    Value& detector = std::get<Table>(sample::entry(summary, {"detectors"}).data).front().second;
    for (char const* table : {"by_wavelength", "by_source"})
        std::get<Table>(sample::entry(detector, {table}).data).front().first = hostile;
    std::string const picture =
        "detectors/" + std::string("<script>alert('1')<_script>_ onload=_x & _ <_style>") + ".png";

    std::string const page = page_of(summary, run, {picture}, {hostile},
                                     {{{Value{hostile, {}}}, summary}, {{Value{2.0, {}}}, summary}});
    CHECK(sample::fault_of(page) == "");
    CHECK_FALSE(has(page, "<script"));
    CHECK_FALSE(has(page, "onload=\""));
    CHECK(sample::times(page, "</style>") == 2);
    CHECK(has(page, "&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt;"));
}

TEST_CASE("a page can be made of a summary in which anything is absent or null") {
    sample::Run const empty;
    Value const nothing{Table{}, {}};
    std::string const page = page_of(nothing, empty);
    CHECK(sample::fault_of(page) == "");
    CHECK(has(page, "Untitled run"));
    CHECK(has(page, "No paths were kept"));
    CHECK_FALSE(has(page, "nan"));

    Value const whole = sample::summary();
    for (auto const& [key, value] : std::get<Table>(whole.data)) {
        CAPTURE(key);
        for (Value const& instead : {Value{}, Value{std::string("text"), {}}, Value{Array{}, {}},
                                     Value{Table{}, {}}, Value{-1.0, {}}}) {
            Value summary = whole;
            *summary.find(key) = instead;
            CHECK(sample::fault_of(page_of(summary, empty, {"detectors/screen.png"})) == "");
            CHECK(sample::fault_of(page_of(summary, empty, {}, {"source.laser.power_W"},
                                           {{{Value{1.0, {}}}, summary}, {{Value{2.0, {}}}, summary}})) ==
                  "");
        }
    }
}

TEST_CASE("failed checks of the physics are flagged") {
    Value summary = sample::summary();
    sample::entry(summary, {"energy_W", "remainder"}).data = 1e-9;
    std::get<Table>(summary.data)
        .emplace_back("failures", Value{Array{Value{std::string("it is dark"), {}}}, {}});
    sample::entry(summary, {"events", "leak"}).data = std::int64_t{7};
    std::string const page = page_of(summary, sample::run());
    CHECK(has(page, "⚑ The ledger does not close"));
    CHECK(has(page, "A check of the physics failed"));
    CHECK(has(page, "it is dark"));
    CHECK(has(page, "leaked or were invalid: 7"));
}

TEST_CASE("a sweep has a chart and a table for each detector") {
    Value summary = sample::summary();
    std::get<Table>(summary.data)
        .emplace_back("sweep", parse_json(R"({"key": "k", "runs": [{"value": -45.0, "folder": "runs/000"}]})",
                                          "sweep"));
    std::string const page =
        page_of(summary, sample::run(), {}, {"object.prism.turn_deg[2]"}, sample::sweep());
    CHECK(sample::fault_of(page) == "");
    CHECK(has(page, "object.prism.turn_deg[2] (°)"));
    CHECK(has(page, "<a href=\"runs/000/report.html\">−45</a>"));
    CHECK(has(page, "closes in all 13 runs"));
    CHECK(sample::times(page, "class=\"dot\"") == 26); // two detectors
    CHECK(report::unit_of_key("object.lens.shape.lens.r1_mm") == "mm");
    CHECK(report::unit_of_key("medium.syrup.absorption_per_mm") == "1/mm");
    CHECK(report::unit_of_key("object.a_mm.priority") == "");
}

TEST_CASE("a picture belongs to the detector that it is called after") {
    std::vector<std::string> const pictures{"detectors/a_b.png", "detectors/screen.left.png",
                                            "detectors/screen.png"};
    CHECK(report::picture_of("screen", pictures) == "detectors/screen.png");
    CHECK(report::picture_of("screen.left", pictures) == "detectors/screen.left.png");
    CHECK(report::picture_of("a/b", pictures) == "detectors/a_b.png");
    CHECK_FALSE(report::picture_of("axb", pictures));
    CHECK_FALSE(report::picture_of("scree", pictures));
    CHECK_FALSE(report::picture_of("", pictures));
}
