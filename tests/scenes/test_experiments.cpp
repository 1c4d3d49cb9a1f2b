// In: the experiments that stand in experiments/. Out: that each passes, that its log tells the same ledger
// as its summary, and that it measures what its README.md says to expect.
#include "support/catch.h"
#include "support/experiments.h"
#include "support/ledger.h"
#include "support/textbook.h"

#include <algorithm>
#include <fstream>
#include <map>

using namespace sahl;
using namespace sahl::bench;
namespace fs = std::filesystem;

namespace {

/// So that logs of all rays stay small: the whole water drop would make one of 400 MB.
std::vector<std::string> fewer_rays(std::string const& name) {
    if (name == "water-drop")
        return {"source.sun.beam.rays=20000"};
    if (name == "bent-guide")
        return {"source.beam.beam.rays=500"};
    if (name == "glass-bunny")
        return {"source.beam.beam.rays=500", "log.every=1"};
    if (name == "concentrator")
        return {"source.sunlight.beam.rays=200", "source.sky.lambertian.rays=200"};
    if (name == "brilliant")
        return {"source.light.beam.rays=100"};
    if (name == "prism-spectrum")
        return {"source.light.beam.rays=10"};
    if (name == "fibre")
        return {"source.beam.beam.rays=100"};
    std::vector<std::string> set;
    if (name == "bunny-in-a-bright-room")
        for (char const* wall : {"left", "right", "bottom", "top", "back", "front"})
            set.push_back("source." + std::string(wall) + ".lambertian.rays=500");
    return set;
}

/// A folder's summary against its log.
void check_ledger(fs::path const& folder) {
    INFO(folder.string());
    RayLogReader const log(folder);
    std::vector<Segment> const rows = log.read(0, log.rows());
    std::ifstream file(folder / "summary.json");
    Value const summary = parse_json(std::string(std::istreambuf_iterator<char>(file), {}), "summary.json");
    Ledger const ledger = ledger_of(rows);
    double const emitted = number_at(summary, {"energy_W", "emitted"});
    double const bound = 1e-12 * emitted;
    auto const close = [&](long double from_log, char const* term) {
        INFO(term);
        CHECK(std::abs(static_cast<double>(from_log) - number_at(summary, {"energy_W", term})) <= bound);
    };
    close(ledger.emitted, "emitted");
    close(ledger.detected, "detected");
    close(ledger.absorbed, "absorbed");
    close(ledger.escaped, "escaped");
    close(ledger.cut, "cut");
    close(ledger.error, "error");
    CHECK(std::abs(number_at(summary, {"energy_W", "remainder"})) <= bound);

    std::map<std::string, double> ends;
    for (Segment const& row : rows)
        ends[std::string(name_of(row.ended))] += 1.0;
    double sum = 0.0;
    for (auto const& [event, count] : std::get<Table>(summary.find("events")->data))
        if (event != "recovered") {
            CAPTURE(event);
            double const count_in_summary = number_at(summary, {"events", event});
            CHECK(ends[event] == count_in_summary);
            sum += ends[event];
        }
    CHECK(sum == number_at(summary, {"segments"}));
    CHECK(static_cast<double>(rows.size()) == sum);
}

} // namespace

TEST_CASE("every experiment passes, and its log tells the ledger of its summary", "[slow]") {
    std::size_t found = 0;
    for (auto const& entry : fs::recursive_directory_iterator(fs::path(SAHL_SOURCE_DIR) / "experiments")) {
        std::string const name = entry.path().stem().string();
        if (entry.path().extension() != ".toml" || (name.find("bunny") != std::string::npos && !has_bunny()))
            continue;
        if (entry.path().parent_path().filename() == "judged")
            continue; // for pictures alone, of models that a script of that folder makes
        CAPTURE(name);
        ExperimentSource const source = load_experiment(entry.path(), {});
        if (read_experiment(source.tree, source.file).sources.empty())
            continue; // for a picture alone
        std::vector<std::string> set{"trace.log=true"};
        for (std::string const& smaller : fewer_rays(name))
            set.push_back(smaller);
        Folder const out;
        RunOptions options;
        options.out = out.path() / "out";
        CHECK(run_experiment(load_experiment(entry.path(), set), options).failures ==
              std::vector<std::string>{});
        CHECK(fs::exists(out.path() / "out" / "report.html"));
        if (fs::exists(out.path() / "out" / "runs"))
            for (auto const& step : fs::directory_iterator(out.path() / "out" / "runs"))
                check_ledger(step.path());
        else
            check_ledger(out.path() / "out");
        ++found;
    }
    CHECK(found >= 27);
}

TEST_CASE("every experiment is on the list and has a page with its theory, expected values and a plot") {
    auto const text_of = [](fs::path const& page) {
        std::ifstream in(page);
        REQUIRE(in.good());
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    fs::path const folder = fs::path(SAHL_SOURCE_DIR) / "experiments";
    std::string const list = text_of(folder / "README.md");
    for (auto const& entry : fs::directory_iterator(folder)) {
        if (!entry.is_directory())
            continue;
        std::string const name = entry.path().filename().string();
        CAPTURE(name);
        CHECK(list.find("(" + name + "/README.md)") != list.npos);
        std::string const page = text_of(entry.path() / "README.md");
        if (name != "stability") // six experiments, whose page is a report
            for (char const* heading : {"\n## Theory\n", "\n## What to "})
                CHECK(page.find(heading) != page.npos);
        std::size_t plots = 0;
        for (std::size_t at = page.find("!["); at != page.npos; at = page.find("![", at + 1), ++plots) {
            std::size_t const open = page.find("](", at) + 2;
            CHECK(fs::exists(entry.path() / page.substr(open, page.find(')', open) - open)));
        }
        CHECK(plots >= 1);
    }
}

TEST_CASE("the prism experiment finds the least deviation", "[slow]") {
    Folder const out;
    run_experiment_of("prism-minimum-deviation", out.path() / "out", {"trace.log=false"});
    auto columns = read_sweep(out.path() / "out" / "sweep.csv");
    auto const deviation_deg = [&](std::string const& line_nm, std::size_t row) {
        std::string const direction = "detectors.screen.by_wavelength." + line_nm + ".mean_direction";
        REQUIRE(columns[direction + "[0]"].size() == 21);
        return degrees(std::atan2(-columns[direction + "[1]"][row], columns[direction + "[0]"][row]));
    };
    std::size_t const middle = 10;
    CHECK(std::abs(columns["object.prism.turn_deg[2]"][middle] - -29.782955281437395) < 1e-14);
    // 1e-12°: a direction is stored to 1.1e-16 in each coordinate, 6e-15°, and some twenty roundings come
    // before
    CHECK(std::abs(deviation_deg("486.1327", middle) - 61.706967085592080) < 1e-12);
    CHECK(std::abs(deviation_deg("587.5618", middle) - 59.565910562874791) < 1e-12);
    CHECK(std::abs(deviation_deg("656.2725", middle) - 58.732905572980189) < 1e-12);
    for (std::size_t row = 0; row < 21; ++row)
        if (row != middle)
            CHECK(deviation_deg("587.5618", row) > 59.565910562874791 + 1e-3);
}

TEST_CASE("the ball lens experiment finds the spherical aberration") {
    struct Height {
        double mm, crossing_mm;
    };
    for (Height const& height : {Height{1.0, 7.2572758012627711}, Height{4.0, 5.9098639994315969}}) {
        Run const run =
            run_of("ball-lens", {"source.beam.beam.rays=1", "source.beam.beam.radius_mm=0",
                                 "source.beam.beam.from_mm=" + text(dvec3(height.mm, 0.0, -10.0))});
        Rows const path = direct_path(rows_of(run, 0));
        REQUIRE(path.size() == 3);
        Segment const& out = path[2];
        double const crossing = 1e3 * (out.origin.z - out.origin.x * out.direction.z / out.direction.x);
        CHECK(std::abs(crossing - height.crossing_mm) < 1e-12); // y / sin δ magnifies 1e-16 some 60 times
    }
}

TEST_CASE("the doublet experiment sends its two single rays where an exact trace does") {
    Run const run = run_of("cemented-doublet", {});
    struct Expected {
        double x_mm, y_mm, direction_z, optical_path_mm;
    };
    Expected const expected[] = {
        {0.0, -0.062208717104795488, 0.99498493235677649, 119.78580829638772},
        {1.7298541095568703, 0.91581198518088537, 0.99738242722701064, 119.78750571839521}};
    for (std::size_t i = 0; i < 2; ++i) {
        Rows const path = direct_path(rows_of(run, run.names.source_first_ray[1] + i));
        REQUIRE(path.size() == 4);
        Segment const& last = path.back();
        REQUIRE(last.ended == Event::detected);
        // 1e-11 mm: places of 100 mm are stored to 1.4e-14, and roundings of three directions reach over as
        // much
        CHECK(std::abs(1e3 * end_of(last).x - expected[i].x_mm) < 1e-11);
        CHECK(std::abs(1e3 * end_of(last).y - expected[i].y_mm) < 1e-11);
        CHECK(std::abs(last.direction.z - expected[i].direction_z) < 1e-11);
        CHECK(std::abs(1e3 * last.optical_path - expected[i].optical_path_mm) < 1e-11);
    }
}

TEST_CASE("the mesh lens experiment sees the same spot twice") {
    Run const run = run_of("mesh-lens", {"trace.method=interpolated"});
    auto const figure = [&](char const* detector, std::initializer_list<std::string_view> key) {
        Value const* const of = run.summary.find("detectors")->find(detector);
        REQUIRE(of);
        return number_at(*of, key);
    };
    char const *const exact = "focus of the exact lens", *const mesh = "focus of the mesh lens";
    // directions on 4104 triangles err by some 1e-5 rad, over 47 mm, and at the rim a few times that
    CHECK(std::abs(figure(exact, {"rms_radius_mm"}) - figure(mesh, {"rms_radius_mm"})) < 2e-3);
    for (std::string_view const axis : {"0", "1"})
        CHECK(std::abs(figure(exact, {"centroid_mm", axis}) - figure(mesh, {"centroid_mm", axis})) < 2e-3);
}

namespace {

/// RMS angle between what leaves the exact lens and what leaves the mesh, ray by ray.
double error_of_mesh_lens(std::string const& model, std::string const& method) {
    Run const run = run_of("mesh-lens", {"object.mesh lens.model=" SAHL_SOURCE_DIR "/models/" + model,
                                         "trace.min_power=0.5", "trace.method=" + method});
    std::uint64_t const half = run.names.source_first_ray[1];
    double sum = 0.0;
    for (std::uint64_t i = 0; i < half; ++i) {
        dvec3 const off = direct_path(rows_of(run, i)).back().direction -
                          direct_path(rows_of(run, i + half)).back().direction;
        sum += dot(off, off);
    }
    return std::sqrt(sum / static_cast<double>(half));
}

} // namespace

TEST_CASE("the mesh lens experiment errs as its page says, with facets by h and with normals by h²") {
    double const R = 50.0, n = 1.5168, half_diameter = 15.0; // mm
    struct Mesh {
        char const* model;
        int rings;
    };
    double coarser = 0.0, coarser_edge = 0.0;
    for (Mesh const& mesh : {Mesh{"singlet-504.glb", 6}, Mesh{"singlet-1872.glb", 12},
                             Mesh{"singlet-4104.glb", 18}, Mesh{"singlet-15984.glb", 36}}) {
        CAPTURE(mesh.model);
        double const h = half_diameter / mesh.rings;
        // The estimate is for equilateral triangles, many to the beam. These are not quite, and the beam's
        // edge cuts some: with 6 rings over the lens there are 4 across the beam's radius, and it errs by 40
        // %.
        double const facet = error_of_mesh_lens(mesh.model, "facet") / ((n - 1.0) * h / (std::sqrt(6.0) * R));
        CHECK((facet > 0.9 && facet < (mesh.rings < 18 ? 1.5 : 1.1)));
        double const error = error_of_mesh_lens(mesh.model, "interpolated");
        if (coarser > 0.0) {
            double const order = std::log(coarser / error) / std::log(coarser_edge / h);
            CHECK((order > 1.9 && order < 2.1));
        }
        coarser = error;
        coarser_edge = h;
    }
}

TEST_CASE("the water drop experiment shows its bows where Descartes put them", "[slow]") {
    struct Bow {
        int reflections;
        double impact_parameter, angle_deg;
    };
    Bow const bows[] = {{1, 0.86083505969494528, 42.078107380243553},
                        {2, 0.95020464900988566, 50.890757769900665}};
    auto const from_antisolar = [](Segment const& segment) {
        return angle_deg(segment.direction, dvec3(0, 0, -1));
    };
    for (Bow const& bow : bows) {
        Run const run =
            run_of("water-drop", {"source.sun.beam.rays=1", "source.sun.beam.radius_mm=0",
                                  "source.sun.beam.from_mm=" + text(dvec3(bow.impact_parameter, 0.0, -5.0))});
        std::vector<Event> births(static_cast<std::size_t>(bow.reflections) + 2, Event::reflected);
        births.front() = births.back() = Event::refracted;
        CHECK(std::abs(from_antisolar(branch(rows_of(run, 0), births)) - bow.angle_deg) < 1e-11);
    }
    // and the whole beam: light inside the primary bow, none between, light outside the secondary
    Run const run = run_of("water-drop", {"source.sun.beam.rays=20000"});
    double widest = 0.0, narrowest = 180.0;
    for (Segment const& segment : run.segments)
        if (segment.born == Event::refracted && segment.medium != run.segments[1].medium) {
            if (segment.depth == 3)
                widest = std::max(widest, from_antisolar(segment));
            if (segment.depth == 4)
                narrowest = std::min(narrowest, from_antisolar(segment));
        }
    CHECK(widest < bows[0].angle_deg + 1e-11);
    CHECK(narrowest > bows[1].angle_deg - 1e-11);
    // 20 000 points of the disc lie so close to the stationary ring, where the angle changes with the square
    // of the distance, that the edges are reached to well below 1e-3°
    CHECK(widest > bows[0].angle_deg - 1e-3);
    CHECK(narrowest < bows[1].angle_deg + 1e-3);
}
