// In: the summary of a run and some of its paths. Out: report.html, the page a person looks at.
// The page itself is made of the sources in report/web/; here its data are put into it.
#pragma once

#include "record/ray_log.h"
#include "scene/scene.h"
#include "scene/value.h"
#include "trace/segment.h"

#include <optional>
#include <string>
#include <vector>

namespace sahl {

/// One row of a sweep: the value of each of its keys, and the summary of its run.
struct SweepRow {
    std::vector<Value> values;
    Value summary;
};

/// What a detector recorded, as the page shows it. What was not recorded is empty.
struct PageDetector {
    std::string name;
    std::uint32_t columns = 0, rows = 0; // of the picture
    std::uint32_t pixels_in_one = 1;     // along each axis: how many were taken together
    std::vector<float> irradiance;       // W/mm², row-major, the first row at the top
    std::vector<double> encircled_mm;    // radii that hold 1 %, 2 %, … 100 %
    struct {
        std::uint32_t rings = 0, sectors = 0;
        double largest_deg = 0.0;
        std::vector<double> intensities; // W/sr, by ring from the axis on, and in it by sector
    } far_field;
    struct {
        double from_mm = 0.0, to_mm = 0.0;
        std::vector<double> powers; // W, in equal bins
    } optical_path;
};

/// A set of lines or triangles that a check of a model points at.
struct PageMark {
    std::string kind;             // "holes", "slivers", "turned", "crowded"
    std::string text;             // what it means
    std::vector<float> lines;     // mm, world: two places each
    std::vector<float> triangles; // mm, world: three places each
};

/// Some of a run's rays, whole trees of them, in the order of the log.
struct PagePaths {
    std::vector<Segment> segments;
    std::uint64_t rays = 0; // how many they belong to
};

struct PageInput {
    Value const& summary; // summary.json as written; of a model the report of its check
    Scene const& scene;   // of the run, or of the first run of a sweep
    LogHeader names;      // what the numbers in the paths stand for
    PagePaths paths;
    std::vector<PageDetector> detectors;
    std::vector<std::string> sweep_keys; // none: no sweep
    std::vector<SweepRow> sweep;
    std::vector<PageMark> marks; // of a model
    bool is_model = false;       // and no run
};

/// The most segments that a page can turn smoothly.
inline constexpr std::size_t most_page_segments = 100'000;

/// The whole page as one HTML text: it makes no request at all. All text that comes from files is data in it.
std::string report_page(PageInput const& input);

/// The same data in the page of this program, or nothing where `page` is no such page.
///   methods   what each method costs and how far it errs (run/method_chart.h), to be shown too; or null
std::optional<std::string> renewed_page(std::string const& page, Value const* methods = nullptr);

/// Of some rays an even share, whole, so that their segments are at most `most`; of a lone ray with more than
/// that the first ones.
PagePaths thinned(PagePaths const& paths, std::size_t most);

} // namespace sahl
