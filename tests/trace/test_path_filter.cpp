// A hundred filters and more, each beside a plain sentence of C++ that says the same of a path written out.
#include "math/input_error.h"
#include "record/read_rays.h"
#include "run/check.h"
#include "support/catch.h"
#include "support/path_scene.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <set>

using namespace sahl;
using bench::PathStep;
using bench::WrittenPath;

namespace {

using P = WrittenPath const&;
using Words = std::vector<std::pair<std::string, std::string>>; // event, surface; empty: any

bool fits(PathStep const& step, std::pair<std::string, std::string> const& word) {
    bool const whole_object = step.surface.substr(0, step.surface.find('.')) == word.second;
    return (word.first.empty() || word.first == step.event) &&
           (word.second.empty() || word.second == step.surface || whole_object);
}

long count(P p, std::string const& event, std::string const& surface = "") {
    return std::count_if(p.steps.begin(), p.steps.end(), [&](PathStep const& s) {
        return fits(s, {event, surface});
    });
}

long hits(P p, std::string const& surface) {
    return count(p, "", surface);
}

bool ends(P p, std::string const& event, std::string const& surface = "") {
    return fits(p.steps.back(), {event, surface});
}

long through(P p, std::string const& medium) {
    return std::count(p.media.begin(), p.media.end(), medium);
}

/// Every way of choosing places for the words, one after another: the slow way.
bool in_order(P p, Words const& words, std::size_t from = 0, std::size_t word = 0) {
    if (word == words.size())
        return true;
    for (std::size_t i = from; i < p.steps.size(); ++i)
        if (fits(p.steps[i], words[word]) && in_order(p, words, i + 1, word + 1))
            return true;
    return false;
}

bool from_here(P p, Words const& words, std::size_t start) {
    if (start + words.size() > p.steps.size())
        return false;
    for (std::size_t i = 0; i < words.size(); ++i)
        if (!fits(p.steps[start + i], words[i]))
            return false;
    return true;
}

bool in_a_run(P p, Words const& words) {
    for (std::size_t start = 0; start < p.steps.size(); ++start)
        if (from_here(p, words, start))
            return true;
    return false;
}

bool is_path(P p, Words const& words) {
    return p.steps.size() == words.size() && from_here(p, words, 0);
}

struct Pair {
    char const* filter;
    std::function<bool(P)> obvious;
};

std::string const refracted = "refracted", reflected = "reflected", total = "total_internal";

std::vector<Pair> const events{
    {"refracted", [](P p) { return count(p, refracted) >= 1; }},
    {"reflected", [](P p) { return count(p, reflected) >= 1; }},
    {"total_internal", [](P p) { return count(p, total) >= 1; }},
    {"scattered", [](P p) { return count(p, "scattered") >= 1; }},
    {"passed", [](P p) { return count(p, "passed") >= 1; }},
    {"absorbed", [](P p) { return count(p, "absorbed") >= 1; }},
    {"detected", [](P p) { return count(p, "detected") >= 1; }},
    {"escaped", [](P p) { return count(p, "escaped") >= 1; }},
    {"cut_power", [](P p) { return count(p, "cut_power") >= 1; }},
    {"cut_depth", [](P p) { return count(p, "cut_depth") >= 1; }},
    {"reflected = 0", [](P p) { return count(p, reflected) == 0; }},
    {"reflected == 2", [](P p) { return count(p, reflected) == 2; }},
    {"reflected != 1", [](P p) { return count(p, reflected) != 1; }},
    {"reflected < 2", [](P p) { return count(p, reflected) < 2; }},
    {"reflected <= 2", [](P p) { return count(p, reflected) <= 2; }},
    {"reflected > 2", [](P p) { return count(p, reflected) > 2; }},
    {"reflected >= 2", [](P p) { return count(p, reflected) >= 2; }},
    {"reflected in [1, 2]", [](P p) { return count(p, reflected) >= 1 && count(p, reflected) <= 2; }},
    {"refracted in [2, 2]", [](P p) { return count(p, refracted) == 2; }},
    {"total_internal >= 2", [](P p) { return count(p, total) >= 2; }},
    {"total_internal(block)", [](P p) { return count(p, total, "block") >= 1; }},
    {"total_internal(block.right)", [](P p) { return count(p, total, "block.right") >= 1; }},
    {"reflected(lens.front)", [](P p) { return count(p, reflected, "lens.front") >= 1; }},
    {"reflected(lens)", [](P p) { return count(p, reflected, "lens") >= 1; }},
    {"reflected(splitter) = 1", [](P p) { return count(p, reflected, "splitter") == 1; }},
    {"refracted(lens.back) = 1", [](P p) { return count(p, refracted, "lens.back") == 1; }},
    {"passed(window) >= 2", [](P p) { return count(p, "passed", "window") >= 2; }},
    {"passed(window) = 1", [](P p) { return count(p, "passed", "window") == 1; }},
    {"scattered(paper) = 1", [](P p) { return count(p, "scattered", "paper") == 1; }},
    {"reflected(block.left)", [](P p) { return count(p, reflected, "block.left") >= 1; }},
};

std::vector<Pair> const places{
    {"hits(lens.front)", [](P p) { return hits(p, "lens.front") >= 1; }},
    {"hits(lens)", [](P p) { return hits(p, "lens") >= 1; }},
    {"hits(lens.*)", [](P p) { return hits(p, "lens") >= 1; }},
    {"hits('lens.front')", [](P p) { return hits(p, "lens.front") >= 1; }},
    {"hits(\"ball\") >= 3", [](P p) { return hits(p, "ball") >= 3; }},
    {"hits(*.front)", [](P p) { return hits(p, "lens.front") + hits(p, "block.front") >= 1; }},
    {"hits(b?ock.*)", [](P p) { return hits(p, "block") >= 1; }},
    {"hits(b*) > 3", [](P p) { return hits(p, "block") + hits(p, "ball") + hits(p, "black") > 3; }},
    {"hits(ball) = 2", [](P p) { return hits(p, "ball") == 2; }},
    {"hits(ball) != 0", [](P p) { return hits(p, "ball") != 0; }},
    {"hits(ball) < 2", [](P p) { return hits(p, "ball") < 2; }},
    {"hits(window) in [2, 5]", [](P p) { return hits(p, "window") >= 2 && hits(p, "window") <= 5; }},
    {"hits(screen)", [](P p) { return hits(p, "screen") >= 1; }},
    {"hits(black)", [](P p) { return hits(p, "black") >= 1; }},
    {"hits(splitter)", [](P p) { return hits(p, "splitter") >= 1; }},
    {"ends(screen)", [](P p) { return ends(p, "", "screen"); }},
    {"ends(black)", [](P p) { return ends(p, "", "black"); }},
    {"ends(detected)", [](P p) { return ends(p, "detected"); }},
    {"ends(absorbed)", [](P p) { return ends(p, "absorbed"); }},
    {"ends(absorbed(screen))", [](P p) { return ends(p, "absorbed", "screen"); }},
    {"ends(detected(screen))", [](P p) { return ends(p, "detected", "screen"); }},
    {"ends(escaped)", [](P p) { return ends(p, "escaped"); }},
    {"ends(cut_power)", [](P p) { return ends(p, "cut_power"); }},
    {"ends(cut_depth)", [](P p) { return ends(p, "cut_depth"); }},
    {"ends('screen')", [](P p) { return ends(p, "", "screen"); }},
    {"ends(s*)", [](P p) { return ends(p, "", "screen"); }},
    {"through(N-BK7)", [](P p) { return through(p, "N-BK7") >= 1; }},
    {"through(tinted) >= 2", [](P p) { return through(p, "tinted") >= 2; }},
    {"through(tinted) = 0", [](P p) { return through(p, "tinted") == 0; }},
    {"through(N-*) > 1", [](P p) { return through(p, "N-BK7") + through(p, "N-SF11") > 1; }},
    {"through('air') <= 3", [](P p) { return through(p, "air") <= 3; }},
    {"source(lamp)", [](P p) { return p.source == "lamp"; }},
    {"source(be*)", [](P p) { return p.source == "beam"; }},
    {"source('beam')", [](P p) { return p.source == "beam"; }},
};

std::vector<Pair> const orders{
    {"order(refracted(lens.front), refracted(lens.back))",
     [](P p) {
         return in_order(p, {{refracted, "lens.front"}, {refracted, "lens.back"}});
     }},
    {"order(refracted(lens.back), refracted(lens.front))",
     [](P p) {
         return in_order(p, {{refracted, "lens.back"}, {refracted, "lens.front"}});
     }},
    {"order(hits(lens), hits(ball), hits(splitter))",
     [](P p) {
         return in_order(p, {{"", "lens"}, {"", "ball"}, {"", "splitter"}});
     }},
    {"order(hits(splitter), hits(lens))",
     [](P p) {
         return in_order(p, {{"", "splitter"}, {"", "lens"}});
     }},
    {"order(reflected, refracted, reflected)",
     [](P p) {
         return in_order(p, {{reflected, ""}, {refracted, ""}, {reflected, ""}});
     }},
    {"order(2 reflected(ball), detected)",
     [](P p) {
         return in_order(p, {{reflected, "ball"}, {reflected, "ball"}, {"detected", ""}});
     }},
    {"order(scattered, hits(screen))",
     [](P p) {
         return in_order(p, {{"scattered", ""}, {"", "screen"}});
     }},
    {"order(any, any, any, any, any, any)", [](P p) { return p.steps.size() >= 6; }},
    {"order(6 any)", [](P p) { return p.steps.size() >= 6; }},
    {"order(passed, total_internal)",
     [](P p) {
         return in_order(p, {{"passed", ""}, {total, ""}});
     }},
    {"order(total_internal, passed)",
     [](P p) {
         return in_order(p, {{total, ""}, {"passed", ""}});
     }},
    {"run(refracted(lens.front), refracted(lens.back))",
     [](P p) {
         return in_a_run(p, {{refracted, "lens.front"}, {refracted, "lens.back"}});
     }},
    {"run(reflected(lens.back), reflected(lens.front))",
     [](P p) {
         return in_a_run(p, {{reflected, "lens.back"}, {reflected, "lens.front"}});
     }},
    {"run(reflected, refracted, passed)",
     [](P p) {
         return in_a_run(p, {{reflected, ""}, {refracted, ""}, {"passed", ""}});
     }},
    {"run(refracted, 2 reflected, refracted)",
     [](P p) {
         return in_a_run(p, {{refracted, ""}, {reflected, ""}, {reflected, ""}, {refracted, ""}});
     }},
    {"run(reflected, reflected, refracted)",
     [](P p) {
         return in_a_run(p, {{reflected, ""}, {reflected, ""}, {refracted, ""}});
     }},
    {"run(2 total_internal)",
     [](P p) {
         return in_a_run(p, {{total, ""}, {total, ""}});
     }},
    {"run(hits(ball), any, hits(splitter))",
     [](P p) {
         return in_a_run(p, {{"", "ball"}, {"", ""}, {"", "splitter"}});
     }},
    {"run(reflected(splitter), reflected(ball))",
     [](P p) {
         return in_a_run(p, {{reflected, "splitter"}, {reflected, "ball"}});
     }},
    {"path(escaped)",
     [](P p) {
         return is_path(p, {{"escaped", ""}});
     }},
    {"path(any, any)", [](P p) { return p.steps.size() == 2; }},
    {"path(5 any)", [](P p) { return p.steps.size() == 5; }},
    {"path(reflected(lens.front), escaped)",
     [](P p) {
         return is_path(p, {{reflected, "lens.front"}, {"escaped", ""}});
     }},
    {"path(2 refracted(lens), passed(window), 2 refracted(ball), refracted(splitter), detected(screen))",
     [](P p) {
         return is_path(p, {{refracted, "lens"},
                            {refracted, "lens"},
                            {"passed", "window"},
                            {refracted, "ball"},
                            {refracted, "ball"},
                            {refracted, "splitter"},
                            {"detected", "screen"}});
     }},
    {"path(hits(block), 2 any, escaped)",
     [](P p) {
         return is_path(p, {{"", "block"}, {"", ""}, {"", ""}, {"escaped", ""}});
     }},
};

std::vector<Pair> const quantities{
    {"wavelength_nm = 587.5618", [](P p) { return p.wavelength_nm == 587.5618; }},
    {"wavelength_nm != 587.5618", [](P p) { return p.wavelength_nm != 587.5618; }},
    {"wavelength_nm < 587.5618", [](P p) { return p.wavelength_nm < 587.5618; }},
    {"wavelength_nm in [480, 600]", [](P p) { return p.wavelength_nm >= 480 && p.wavelength_nm <= 600; }},
    {"power_W > 1e-4", [](P p) { return p.power_W > 1e-4; }},
    {"power_W <= 1e-4", [](P p) { return p.power_W <= 1e-4; }},
    {"power_W in [1e-5, 1e-3]", [](P p) { return p.power_W >= 1e-5 && p.power_W <= 1e-3; }},
    {"share >= 0.5", [](P p) { return p.share >= 0.5; }},
    {"share < 0.01", [](P p) { return p.share < 0.01; }},
    {"depth = 3", [](P p) { return p.depth == 3; }},
    {"depth > 5", [](P p) { return p.depth > 5; }},
    {"depth in [2, 4]", [](P p) { return p.depth >= 2 && p.depth <= 4; }},
    {"optical_path_mm > 50", [](P p) { return p.optical_path_mm > 50; }},
    {"optical_path_mm <= 30", [](P p) { return p.optical_path_mm <= 30; }},
    {"optical_path_mm = 0", [](P p) { return p.optical_path_mm == 0; }},
    {"ray = 17", [](P p) { return p.ray == 17; }},
    {"ray in [10, 99]", [](P p) { return p.ray >= 10 && p.ray <= 99; }},
    {"ray >= 100", [](P p) { return p.ray >= 100; }},
};

std::vector<Pair> const joined{
    {"hits(lens.front) and total_internal >= 1",
     [](P p) { return hits(p, "lens.front") >= 1 && count(p, total) >= 1; }},
    {"hits(lens.front) and total_internal >= 1 and ends(escaped)",
     [](P p) { return hits(p, "lens.front") >= 1 && count(p, total) >= 1 && ends(p, "escaped"); }},
    {"ends(screen) or ends(black)", [](P p) { return ends(p, "", "screen") || ends(p, "", "black"); }},
    {"not hits(lens)", [](P p) { return hits(p, "lens") == 0; }},
    {"not not hits(lens)", [](P p) { return hits(p, "lens") != 0; }},
    {"not hits(lens) and hits(ball)", [](P p) { return hits(p, "lens") == 0 && hits(p, "ball") != 0; }},
    {"not (hits(lens) and hits(ball))", [](P p) { return hits(p, "lens") == 0 || hits(p, "ball") == 0; }},
    {"hits(block) or hits(lens) and hits(ball)",
     [](P p) { return hits(p, "block") != 0 || (hits(p, "lens") != 0 && hits(p, "ball") != 0); }},
    {"(hits(block) or hits(lens)) and hits(ball)",
     [](P p) { return (hits(p, "block") != 0 || hits(p, "lens") != 0) && hits(p, "ball") != 0; }},
    {"source(beam) and wavelength_nm < 500 and detected",
     [](P p) { return p.source == "beam" and p.wavelength_nm < 500 and ends(p, "detected"); }},
    {"share > 0.001 and not (ends(escaped) or ends(detected))",
     [](P p) { return p.share > 0.001 && !ends(p, "escaped") && !ends(p, "detected"); }},
};

std::vector<Pair> all_pairs() {
    std::vector<Pair> all;
    for (auto const* part : {&events, &places, &orders, &quantities, &joined})
        for (Pair const& pair : *part)
            all.push_back(pair);
    return all;
}

bench::Run const& traced() {
    static bench::Run const run = bench::run(bench::path_scene);
    return run;
}

/// Ray and number of the segments that the obvious way keeps.
std::set<std::pair<std::uint64_t, std::uint32_t>> kept_by(std::vector<WrittenPath> const& paths,
                                                          std::function<bool(P)> const& obvious) {
    std::set<std::pair<std::uint64_t, std::uint32_t>> kept;
    for (P path : paths)
        if (obvious(path))
            for (std::uint32_t const segment : path.segments)
                kept.emplace(path.ray, segment);
    return kept;
}

std::set<std::pair<std::uint64_t, std::uint32_t>> numbers_of(std::vector<Segment> const& rows) {
    std::set<std::pair<std::uint64_t, std::uint32_t>> numbers;
    for (Segment const& s : rows)
        numbers.emplace(s.ray, s.index);
    return numbers;
}

/// Of each path in order: the rows' own test of its end.
std::vector<bool> selected(bench::Run const& run, PathFilter const& filter) {
    std::vector<bool> selected;
    for (std::uint64_t ray = 0; ray <= run.segments.back().ray; ++ray) {
        auto const rows = bench::rows_of(run, ray);
        SelectedPaths paths(filter);
        paths.take(rows);
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (std::none_of(rows.begin(), rows.end(), [&](Segment const& s) {
                    return s.parent == static_cast<std::int32_t>(rows[i].index);
                }))
                selected.push_back(paths.path_to(i));
    }
    return selected;
}

std::string complaint(std::function<void()> const& action) {
    try {
        action();
    } catch (InputError const& error) {
        return error.what();
    }
    return "";
}

std::string refusal(std::string const& text) {
    return complaint([&] { log_filter(traced().names, text, "--where"); });
}

} // namespace

TEST_CASE("each of a hundred path filters selects what a slow and obvious evaluation selects",
          "[trace][filter]") {
    bench::Run const& run = traced();
    auto const paths = bench::paths_of(run.names, run.segments);
    REQUIRE(paths.size() > 1000);
    auto const pairs = all_pairs();
    CHECK(pairs.size() >= 100);
    for (Pair const& pair : pairs) {
        CAPTURE(pair.filter);
        auto const filter = log_filter(run.names, pair.filter, "--where");
        REQUIRE(filter);
        auto const found = selected(run, *filter);
        REQUIRE(found.size() == paths.size());
        std::size_t wrong = 0, some = 0;
        for (std::size_t i = 0; i < paths.size(); ++i) {
            wrong += found[i] != pair.obvious(paths[i]);
            some += found[i];
        }
        CHECK(wrong == 0);
        CHECK(some > 0);
        CHECK(some < paths.size());
    }
}

TEST_CASE("a log that is filtered while it is written has the rows of the selected paths", "[run][filter]") {
    auto const paths = bench::paths_of(traced().names, traced().segments);
    auto const pairs = all_pairs();
    for (std::size_t i = 0; i < pairs.size(); i += 7) {
        CAPTURE(pairs[i].filter);
        std::string text = pairs[i].filter;
        std::replace(text.begin(), text.end(), '"', '\'');
        auto const log = bench::run(bench::path_scene, {"log.where=\"" + text + "\""});
        CHECK((numbers_of(log.segments) == kept_by(paths, pairs[i].obvious)));
        CHECK(log.names.where == text);
    }
}

TEST_CASE("a filter of the log, each third ray and a floor thin the log together", "[run][filter]") {
    auto const paths = bench::paths_of(traced().names, traced().segments);
    auto expected = kept_by(paths, [](P p) { return ends(p, "escaped") && p.ray % 3 == 0; });
    std::map<std::uint64_t, double> power;
    for (Segment const& s : traced().segments) {
        if (s.parent < 0)
            power[s.ray] = s.power_start;
        if (s.power_start < 0.01 * power[s.ray])
            expected.erase({s.ray, s.index});
    }
    auto const log =
        bench::run(bench::path_scene, {"log.where=ends(escaped)", "log.every=3", "log.min_power=0.01"});
    CHECK((numbers_of(log.segments) == expected));
}

TEST_CASE("a detector with a filter counts the light that came by the selected paths", "[run][filter]") {
    auto const& run = traced();
    auto const all = bench::summarise(bench::path_scene);
    for (auto const& [detector, text, came_so] :
         std::vector<std::tuple<std::string, std::string, std::function<bool(P)>>>{
             {"screen", "reflected = 2", [](P p) { return count(p, reflected) == 2; }},
             {"screen", "hits(ball) and source(beam)",
              [](P p) { return hits(p, "ball") > 0 && p.source == "beam"; }},
             {"screen", "ends(detected) and reflected(ball) = 0",
              [](P p) { return count(p, reflected, "ball") == 0; }}}) {
        CAPTURE(text);
        double power = 0.0;
        std::size_t hits = 0;
        for (P path : bench::paths_of(run.names, run.segments))
            if (ends(path, "detected", detector) && came_so(path)) {
                power += path.power_W;
                ++hits;
            }
        std::string const with = std::string(bench::path_scene) + "where = \"" + text + "\"\n";
        auto const summary = bench::summarise(with); // the screen is the last table
        CHECK(hits > 0);
        CHECK(bench::number_at(summary, {"detectors", detector, "hits"}) == static_cast<double>(hits));
        CHECK(bench::number_at(summary, {"detectors", detector, "power_W"}) == Approx(power).epsilon(1e-12));
        CHECK(bench::number_at(summary, {"detectors", detector, "hits"}) <
              bench::number_at(all, {"detectors", detector, "hits"}));
        CHECK(bench::number_at(summary, {"energy_W", "detected"}) ==
              bench::number_at(all, {"energy_W", "detected"}));
    }
}

TEST_CASE("light that passes a detector is asked for its path up to there", "[run][filter]") {
    std::string text = bench::path_scene;
    std::string const window = "name = \"window\"\n";
    text.insert(text.find(window) + window.size(), "where = \"ends(window) and passed = 1\"\n");
    std::size_t first_times = 0;
    for (auto const& [ray, passed] : [] {
             std::map<std::pair<std::uint64_t, std::uint32_t>, std::size_t>
                 passages; // by the segment that meets it
             for (P path : bench::paths_of(traced().names, traced().segments)) {
                 std::size_t seen = 0;
                 for (std::size_t i = 0; i < path.steps.size(); ++i)
                     if (path.steps[i].event == "passed")
                         passages[{path.ray, path.segments[path.segments.size() - 1 - i]}] = ++seen;
             }
             return passages;
         }())
        first_times += passed == 1;
    CHECK(bench::number_at(bench::summarise(text), {"detectors", "window", "hits"}) ==
          static_cast<double>(first_times));
    CHECK(first_times <
          bench::number_at(bench::summarise(bench::path_scene), {"detectors", "window", "hits"}));
}

TEST_CASE("what is wrong in a filter is said, with a mark under the word", "[trace][filter]") {
    struct Wrong {
        char const *text, *problem, *mark;
    };
    for (Wrong const& wrong : std::vector<Wrong>{
             {"hits(lens.frnt) and reflected",
              "no surface or detector is called 'lens.frnt'; did you mean 'lens.front'?", "     ^^^^^^^^^"},
             {"reflected or reflcted >= 2", "'reflcted' is no condition; did you mean 'reflected'?",
              "             ^^^^^^^^"},
             {"hits lens", "'(' should stand here, not 'lens'", "     ^^^^"},
             {"hits(lens", "')' is missing at the end", "         ^"},
             {"hits(lens) reflected", "'reflected' has no place here; join conditions with and, or",
              "           ^^^^^^^^^"},
             {"depth", "a comparison of depth is missing at the end", "     ^"},
             {"depth > deep", "a number should stand here, not 'deep'", "        ^^^^"},
             {"depth in [3, 1]", "this range ends before it begins", "             ^"},
             {"through(water)", "no medium is called 'water'", "        ^^^^^"},
             {"source(sun)", "no source is called 'sun'; did you mean 'beam'?", "       ^^^"},
             {"order(reflected, lens)", "an event should stand here, not 'lens'", "                 ^^^^"},
             {"order(0 reflected)", "'0' is no number of times", "      ^"},
             {"run(60 any, 5 reflected)", "these are more than 64 events", "            ^"},
             {"hits('lens)", "these quotes are not closed", "     ^^^^^^"},
             {"", "", ""},
             {"hits(\"linse\") and hits(\"größe\")", "'linse'", "     ^^^^^^^"},
             {"hits(lens) and", "a condition is missing at the end", "              ^"},
             {"hits(lens) or & 2", "'&' is no condition", "              ^"},
             {"ends()", "the name of a surface, a detector or an event should stand here, not ')'",
              "     ^"}}) {
        CAPTURE(wrong.text);
        std::string const said = refusal(wrong.text);
        INFO(said);
        CHECK(said.find(wrong.problem) != std::string::npos);
        if (*wrong.text) {
            CHECK(said.find(std::string("--where: ")) == 0);
            std::string const picture = std::string("\n    ") + wrong.text + "\n    " + wrong.mark;
            CHECK(said.substr(said.size() - picture.size()) == picture);
        }
    }
}

TEST_CASE("the mark under a word counts letters, not bytes", "[trace][filter]") {
    std::string const said = refusal("hits('größe') or x");
    CHECK(said.substr(said.rfind('\n')) == "\n    " + std::string(17, ' ') + "^");
}

TEST_CASE("a filter with many brackets is refused, and not followed down the stack", "[trace][filter]") {
    CHECK(refusal(std::string(100000, '(')).find("nested too deeply") != std::string::npos);
    std::string negations;
    for (int i = 0; i < 100000; ++i)
        negations += "not ";
    CHECK(refusal(negations).find("nested too deeply") != std::string::npos);
}

TEST_CASE("a wrong filter in an experiment is bad input with its line, in trace and in check",
          "[run][filter]") {
    std::string const text = std::string(bench::path_scene) + "where = \"ends(scren)\"\n";
    auto const line = std::count(text.begin(), text.end(), '\n');
    std::string const in_trace = complaint([&] { bench::summarise(text); });
    CHECK(in_trace.find(":" + std::to_string(line) + ":") != std::string::npos);
    CHECK(in_trace.find("did you mean 'screen'?") != std::string::npos);
    CHECK(complaint([] {
              bench::run(bench::path_scene, {"log.where=hits(lense)"});
          }).find("did you mean 'lens'?") != std::string::npos);
    bench::Folder const folder;
    std::ofstream(folder.path() / "wrong.toml") << text;
    CHECK(complaint([&] {
              check_experiment(load_experiment(folder.path() / "wrong.toml"));
          }).find("'scren'") != std::string::npos);
}
