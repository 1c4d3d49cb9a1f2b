// The page holds what the run says as data that nothing in it can leave, whatever the files say.
#include "report/page.h"
#include "report/sample_run.h"
#include "report/web_page.h"
#include "support/catch.h"

#include <set>

using namespace sahl;

namespace {

LogHeader names_of(sample::Run const& run) {
    LogHeader names;
    names.sources = {"laser"};
    for (Body const& body : run.scene.bodies)
        names.surfaces.push_back(body.name);
    names.media = {"air"};
    names.wavelengths_m = {486.1327e-9, 587.5618e-9, 656.2725e-9, 1064e-9};
    names.refractive_index = {1.0, 1.0, 1.0, 1.0};
    return names;
}

std::string page_of(Value const& summary, sample::Run const& run, std::vector<std::string> keys = {},
                    std::vector<SweepRow> sweep = {}) {
    PageDetector screen;
    screen.name = "screen";
    screen.columns = screen.rows = 2;
    screen.irradiance = {0.0F, 1.0F, 2.0F, 0.5F};
    LogHeader const names = names_of(run);
    PageInput input{summary, run.scene, names, {}, {}, {}, {}, {}};
    input.paths = {run.paths, 36};
    input.detectors.push_back(std::move(screen));
    input.sweep_keys = std::move(keys);
    input.sweep = std::move(sweep);
    return report_page(input);
}

std::size_t times(std::string const& text, std::string_view part) {
    std::size_t count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}

/// What the page's script reads.
Value data_of(std::string const& page) {
    std::string const begins = "id=\"sahl-data\">";
    std::size_t const begin = page.find(begins) + begins.size();
    return parse_json(page.substr(begin, page.find("</script>", begin) - begin), "page");
}

std::string text_at(Value const& value, std::string_view key) {
    return std::get<std::string>(value.find(key)->data);
}

constexpr char const* hostile =
    "</script><script>alert('1')</script>\" onload=\"x & \x01 <!-- @DATA@ @TITLE@";

} // namespace

TEST_CASE("the page is one file that may ask for nothing") {
    std::string const page = report::web_page();
    CHECK(times(page, "@TITLE@") == 1);
    CHECK(times(page, "@DATA@") == 1);
    CHECK(page.find("default-src 'none'; script-src 'sha256-") != std::string::npos);
    CHECK(page.find("connect-src") == std::string::npos);
    CHECK(times(page, "<script") == 2);
    CHECK(times(page, " src=") == 0);
    CHECK(times(page, "<link") == 0);
    CHECK(page.find("@import") == std::string::npos);
}

TEST_CASE("a page has the summary, the scene and the paths") {
    sample::Run const run = sample::run();
    Value const data = data_of(page_of(sample::summary(), run));
    CHECK(text_at(data, "title") == "A 60° prism at minimum deviation");
    CHECK(to_json(*data.find("summary")) == to_json(sample::summary()));
    CHECK(std::get<Array>(data.find("bodies")->data).size() == run.scene.bodies.size());
    CHECK(text_at(std::get<Array>(data.find("bodies")->data)[0], "name") == "prism");
    // three numbers of eight bytes a segment, in base64
    CHECK(text_at(*data.find("rays")->find("at"), "f64").size() == (24 * run.paths.size() + 2) / 3 * 4);
    CHECK(text_at(*std::get<Array>(data.find("detectors")->data)[0].find("irradiance"), "f32") ==
          "AAAAAAAAgD8AAABAAAAAPw==");
    CHECK(std::get<Array>(data.find("names")->find("colours")->data).size() == 4);
}

TEST_CASE("names from files cannot leave the data that they stand in") {
    sample::Run run = sample::run();
    Value summary = sample::summary();
    for (Body& body : run.scene.bodies)
        body.name = hostile;
    run.scene.sources[0].name = run.scene.detectors[0].name = hostile;
    sample::entry(summary, {"title"}).data = hostile;
    sample::entry(summary, {"warnings"}).data = Array{Value{std::string(hostile), {}}};
    for (char const* table : {"detectors", "objects", "events", "absorbed_W", "escaped_direction"})
        std::get<Table>(sample::entry(summary, {table}).data).front().first = hostile;
    std::string const page =
        page_of(summary, run, {hostile}, {{{Value{hostile, {}}}, summary}, {{Value{2.0, {}}}, summary}});
    CHECK(times(page, "<script") == 2);
    CHECK(times(page, "</script") == 2);
    CHECK(times(page, "<!--") == 0);
    Value const data = data_of(page);
    CHECK(text_at(data, "title") == hostile);
    CHECK(text_at(std::get<Array>(data.find("bodies")->data)[0], "name") == hostile);
    CHECK(page.find("<title>&lt;/script&gt;&lt;script&gt;") != std::string::npos);
    auto const renewed = renewed_page(page);
    REQUIRE(renewed);
    CHECK(*renewed == page);
}

TEST_CASE("a page can be made of a summary in which anything is absent") {
    Value const data = data_of(page_of(Value{Table{}, {}}, sample::Run{}));
    CHECK(text_at(data, "title") == "Untitled run");
    CHECK(text_at(*data.find("rays")->find("at"), "f64").empty());
}

TEST_CASE("a sweep's page has each run's values and figures") {
    Value const data =
        data_of(page_of(sample::summary(), sample::run(), {"object.prism.turn_deg[2]"}, sample::sweep()));
    CHECK(text_at(data, "kind") == "sweep");
    Array const& rows = std::get<Array>(data.find("sweep")->find("rows")->data);
    REQUIRE(rows.size() == 13);
    CHECK(std::get<double>(std::get<Array>(rows[3].find("values")->data)[0].data) == -39.0);
    CHECK(rows[3].find("detectors")->find("screen")->find("power_W") != nullptr);
    CHECK(rows[3].find("detectors")->find("screen")->find("by_wavelength") == nullptr);
}

TEST_CASE("a page of another kind is not renewed") {
    CHECK_FALSE(renewed_page(""));
    CHECK_FALSE(renewed_page("<!DOCTYPE html><html><head><title>x</title></head></html>"));
    CHECK_FALSE(renewed_page("<title>x</title><script type=\"application/json\" id=\"sahl-data\">{}"));
}

TEST_CASE("paths are thinned fairly: whole rays, evenly spread, and no more than asked for") {
    PagePaths paths;
    for (std::uint64_t ray = 0; ray < 1000; ++ray)
        for (std::uint32_t i = 0; i < 3 + ray % 5; ++i) {
            Segment s;
            s.ray = ray;
            s.index = i;
            paths.segments.push_back(s);
        }
    paths.rays = 1000;
    CHECK(thinned(paths, 5000).segments.size() == 5000); // all that there are
    for (std::size_t const most : {std::size_t{4000}, std::size_t{1000}, std::size_t{37}}) {
        CAPTURE(most);
        PagePaths const left = thinned(paths, most);
        CHECK(left.segments.size() <= most);
        CHECK(left.segments.size() >= most * 8 / 10);
        std::set<std::uint64_t> rays;
        for (Segment const& s : left.segments)
            rays.insert(s.ray);
        CHECK(rays.size() == left.rays);
        std::uint64_t before = 0;
        std::size_t whole = 0;
        for (std::uint64_t const ray : rays) {
            CHECK(ray - before <= 2 * 5000 / most + 2);
            before = ray;
            whole += 3 + ray % 5;
        }
        CHECK(1000 - before <= 2 * 5000 / most + 2);
        CHECK(whole == left.segments.size());
    }
    PagePaths lone;
    lone.segments.assign(100, Segment{});
    lone.rays = 1;
    CHECK(thinned(lone, 10).segments.size() == 10);
}
