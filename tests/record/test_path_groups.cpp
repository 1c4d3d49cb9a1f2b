// Groups of paths against a slow count of paths written out, and bounded memory against plenty.
#include "record/explain.h"
#include "record/path_groups.h"
#include "record/read_rays.h"
#include "run/paths_report.h"
#include "support/catch.h"
#include "support/path_scene.h"

#include <fstream>
#include <set>

using namespace sahl;

namespace {

/// A run's log that stays on disk as long as this.
struct Logged {
    bench::Folder folder;
    explicit Logged(std::string const& text, std::vector<std::string> const& set = {}) {
        std::ofstream(folder.path() / "x.toml") << text;
        RunOptions options;
        options.out = folder.path() / "out";
        run_experiment(load_experiment(folder.path() / "x.toml", set), options);
    }
    RayLogReader log() const { return RayLogReader(folder.path() / "out"); }
};

Logged const& logged() {
    static Logged const log(bench::path_scene);
    return log;
}

struct Sum {
    std::size_t paths = 0;
    std::set<std::uint64_t> rays{};
    double power = 0.0, power_path = 0.0;
};

std::map<std::string, Sum> slow_groups(RayLogReader const& log) {
    std::map<std::string, Sum> groups;
    for (auto const& path : bench::paths_of(log.header(), log.read(0, UINT64_MAX))) {
        std::string key;
        for (auto const& step : path.steps)
            key += step.event + "@" + step.surface + " ";
        Sum& sum = groups[key];
        ++sum.paths;
        sum.rays.insert(path.ray);
        sum.power += path.power_W;
        sum.power_path += path.power_W * path.optical_path_mm;
    }
    return groups;
}

std::string key_of(PathGroup const& group, LogHeader const& header) {
    std::string key;
    for (auto const& step : group.steps)
        for (std::uint32_t i = 0; i < step.times; ++i)
            key += std::string(name_of(step.event)) + "@" +
                   (step.surface < 0 ? "" : header.surfaces[static_cast<std::size_t>(step.surface)]) + " ";
    return key;
}

} // namespace

TEST_CASE("every group of paths has what a slow count gives it", "[record][paths]") {
    RayLogReader const log = logged().log();
    auto const slow = slow_groups(log);
    PathGroups const found = group_paths(log, nullptr, 0.0);
    REQUIRE(found.groups.size() == slow.size());
    CHECK(slow.size() > 200);
    CHECK(found.other.paths == 0);
    double before = found.began;
    for (PathGroup const& group : found.groups) {
        CAPTURE(group.filter);
        Sum const& sum = slow.at(key_of(group, log.header()));
        CHECK(group.paths == sum.paths);
        CHECK(group.rays == sum.rays.size());
        CHECK(group.power == Approx(sum.power).epsilon(1e-12));
        if (sum.power > 0.0)
            CHECK(group.mean_optical_path * 1e3 ==
                  Approx(sum.power_path / sum.power).epsilon(1e-9).margin(1e-9));
        CHECK(group.power <= before);
        before = group.power;
    }
}

TEST_CASE("the filter of a group selects its paths and no others", "[record][paths]") {
    RayLogReader const log = logged().log();
    PathGroups const found = group_paths(log, nullptr, 1e-3);
    REQUIRE(found.groups.size() > 20);
    for (PathGroup const& group : found.groups) {
        CAPTURE(group.filter);
        auto const filter = log_filter(log.header(), group.filter, "test");
        PathGroups const alone = group_paths(log, &*filter, 0.0);
        REQUIRE(alone.groups.size() == 1);
        CHECK(alone.groups.front().paths == group.paths);
        CHECK(alone.groups.front().power == group.power);
    }
}

TEST_CASE("paths below a share are summed up as other", "[record][paths]") {
    RayLogReader const log = logged().log();
    PathGroups const all = group_paths(log, nullptr, 0.0), some = group_paths(log, nullptr, 0.01);
    CHECK(some.groups.size() > 3);
    CHECK(some.groups.size() < all.groups.size());
    std::uint64_t paths = some.other.paths;
    double power = some.other.power;
    for (PathGroup const& group : some.groups) {
        CHECK(group.power >= 0.01 * some.began);
        paths += group.paths;
        power += group.power;
    }
    CHECK(some.other.power > 0.0);
    CHECK(paths == all.paths);
    CHECK(power == Approx(all.power).epsilon(1e-12));
}

TEST_CASE("groups of a selection are counted within it, and their filters keep to it", "[record][paths]") {
    RayLogReader const log = logged().log();
    auto const blue = log_filter(log.header(), "wavelength_nm < 500 or source(lamp)", "test");
    PathGroups const found = group_paths(log, &*blue, 0.01), all = group_paths(log, nullptr, 0.01);
    CHECK(found.began == all.began);
    CHECK(found.paths < all.paths);
    PathGroup const& first = found.groups.front();
    CHECK(first.filter.find("(wavelength_nm < 500 or source(lamp)) and path(") == 0);
    auto const again = log_filter(log.header(), first.filter, "test");
    CHECK(group_paths(log, &*again, 0.0).paths == first.paths);
}

TEST_CASE("with room for a few different paths only, the figures of the strong ones are exact",
          "[record][paths]") {
    RayLogReader const log = logged().log();
    PathGroups const plenty = group_paths(log, nullptr, 0.05), tight = group_paths(log, nullptr, 0.05, 80);
    CHECK(plenty.surely_above == 0.0);
    CHECK(tight.surely_above > 0.0);
    CHECK(tight.surely_above < 0.05 * tight.began);
    REQUIRE(plenty.groups.size() > 2);
    REQUIRE(tight.groups.size() == plenty.groups.size());
    for (std::size_t i = 0; i < plenty.groups.size(); ++i) {
        CHECK(tight.groups[i].filter == plenty.groups[i].filter);
        CHECK(tight.groups[i].paths == plenty.groups[i].paths);
        CHECK(tight.groups[i].rays == plenty.groups[i].rays);
        CHECK(tight.groups[i].power == plenty.groups[i].power);
    }
    CHECK(tight.paths == plenty.paths);
    CHECK(tight.power == plenty.power);
    CHECK(tight.other.paths == plenty.other.paths);
}

TEST_CASE("groups as text and as JSON say the same", "[run][paths]") {
    RayLogReader const log = logged().log();
    PathGroups const found = group_paths(log, nullptr, 0.02);
    std::string const text = paths_text(found);
    Value const value = paths_value(found, log.header());
    auto const& groups = std::get<Array>(value.find("groups")->data);
    REQUIRE(groups.size() == found.groups.size());
    for (Value const& group : groups)
        CHECK(text.find("  " + std::get<std::string>(group.find("filter")->data) + "\n") !=
              std::string::npos);
    CHECK(text.find("  other\n") != std::string::npos);
}

TEST_CASE("a ray drawn along its selected paths keeps what its other branches tell", "[record][filter]") {
    RayLogReader const log = logged().log();
    auto const filter =
        log_filter(log.header(), "path(2 refracted(lens), passed(window), any, any, any, any)", "test");
    std::vector<Segment> rows;
    read_rays(log, &*filter, [&](std::span<Segment const> found) {
        rows = log.read_ray(found.front().ray);
        return false;
    });
    REQUIRE(!rows.empty());
    SelectedPaths paths(*filter);
    paths.take(rows);
    auto const kept = paths.kept();
    std::string const whole = explain_ray(log.header(), rows), some = explain_ray(log.header(), rows, &kept);
    auto const drawn = [](std::string const& text, Segment const& s) {
        return text.find("#" + std::to_string(s.index) + " ") != std::string::npos;
    };
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        CHECK(drawn(whole, rows[i]));
        CHECK(drawn(some, rows[i]) == (kept[i] != 0));
        left_out += !kept[i];
    }
    CHECK(left_out > 0);
    CHECK(some.find("T ") <
          some.find(", R ")); // the reflected branch of the first face is not drawn, and told of
}
