#include "support/bench.h"

#include "support/catch.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <fstream>

namespace sahl::bench {

namespace fs = std::filesystem;

namespace {

ExperimentSource written(Folder const& folder, std::string const& text, std::vector<std::string> const& set) {
    fs::path const file = folder.path() / "experiment.toml";
    std::ofstream(file) << text;
    return load_experiment(file, set);
}

} // namespace

Folder::Folder() {
    static std::atomic<int> count = 0;
    path_ = fs::temp_directory_path() /
            ("sahl-bench-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
    fs::create_directories(path_);
}

Folder::~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

Run run(std::string const& text, std::vector<std::string> const& set) {
    Folder const folder;
    std::vector<std::string> with_log = set;
    with_log.emplace_back("trace.log=true");
    ExperimentSource const source = written(folder, text, with_log);
    RunOptions options;
    options.out = folder.path() / "out";
    RunResult const result = run_experiment(source, options);
    REQUIRE(result.failures == std::vector<std::string>{});
    RayLogReader const log(options.out);
    return {result.summary, log.header(), log.read(0, log.rows())};
}

Value summarise(std::string const& text, std::vector<std::string> const& set) {
    Folder const folder;
    RunResult const result = run_experiment(written(folder, text, set), {});
    REQUIRE(result.failures == std::vector<std::string>{});
    return result.summary;
}

Rows rows_of(Run const& run, std::uint64_t ray) {
    auto const before = [](Segment const& segment, std::uint64_t number) { return segment.ray < number; };
    auto const first = std::lower_bound(run.segments.begin(), run.segments.end(), ray, before);
    auto const end = std::lower_bound(first, run.segments.end(), ray + 1, before);
    return {first, end};
}

Segment branch(Rows const& rows, std::vector<Event> const& births) {
    REQUIRE(!rows.empty());
    Segment const* at = &rows.front();
    for (Event const birth : births) {
        auto const child = std::find_if(rows.begin(), rows.end(), [&](Segment const& row) {
            return row.parent == static_cast<std::int32_t>(at->index) && row.born == birth;
        });
        INFO("no child of segment " << at->index << " is born by " << name_of(birth));
        REQUIRE(child != rows.end());
        at = &*child;
    }
    return *at;
}

Rows direct_path(Rows const& rows) {
    REQUIRE(!rows.empty());
    Rows path{rows.front()};
    for (Segment const& row : rows) // breadth first: a child comes after its parent, the first child first
        if (row.parent == static_cast<std::int32_t>(path.back().index))
            path.push_back(row);
    return path;
}

dvec3 end_of(Segment const& segment) {
    REQUIRE(std::isfinite(segment.length));
    return segment.origin + segment.length * segment.direction;
}

std::string surface_at_end(Run const& run, Segment const& segment) {
    return segment.surface < 0 ? std::string()
                               : run.names.surfaces[static_cast<std::size_t>(segment.surface)];
}

double number_at(Value const& value, std::initializer_list<std::string_view> path) {
    Value const* at = &value;
    for (std::string_view const key : path) {
        Value const* next = at->find(key);
        if (auto const* const array = std::get_if<Array>(&at->data)) {
            std::size_t index = 0;
            std::from_chars(key.data(), key.data() + key.size(), index);
            next = index < array->size() ? &(*array)[index] : nullptr;
        }
        INFO("there is no " << key);
        REQUIRE(next);
        at = next;
    }
    REQUIRE(at->is_number());
    auto const* const whole = std::get_if<std::int64_t>(&at->data);
    return whole ? static_cast<double>(*whole) : std::get<double>(at->data);
}

double index_of(Run const& run, std::string_view medium, double wavelength_nm) {
    auto const& media = run.names.media;
    auto const& wavelengths = run.names.wavelengths_m;
    auto const m = std::find(media.begin(), media.end(), medium);
    REQUIRE(m != media.end());
    auto const w = wavelength_nm == 0.0
                       ? wavelengths.begin()
                       : std::find_if(wavelengths.begin(), wavelengths.end(), [&](double metres) {
                             return std::abs(metres * 1e9 - wavelength_nm) < 1e-6;
                         });
    REQUIRE(w != wavelengths.end());
    return run.names.refractive_index[static_cast<std::size_t>(m - media.begin()) * wavelengths.size() +
                                      static_cast<std::size_t>(w - wavelengths.begin())];
}

} // namespace sahl::bench
