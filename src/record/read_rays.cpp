#include "record/read_rays.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr std::uint64_t portion_rows = 65536;

} // namespace

FilterNames filter_names(LogHeader const& header) {
    return {header.surfaces, header.media, header.sources};
}

std::optional<PathFilter> log_filter(LogHeader const& header, std::string const& text,
                                     std::string const& place) {
    PathFilter filter(parse_filter(text, place), filter_names(header));
    return filter.selects_all() ? std::nullopt : std::optional(std::move(filter));
}

std::vector<Segment> selected_rows(std::span<Segment const> ray, PathFilter const& where) {
    SelectedPaths paths(where);
    paths.take(ray);
    auto const& kept = paths.kept();
    std::vector<Segment> selected;
    for (std::size_t i = 0; i < ray.size(); ++i)
        if (kept[i])
            selected.push_back(ray[i]);
    return selected;
}

void read_rays(RayLogReader const& log, PathFilter const* where,
               std::function<bool(std::span<Segment const> ray)> const& take) {
    std::vector<Segment> left_over; // of the last ray of a portion, which the next one may go on with
    auto const pass_on = [&](std::span<Segment const> ray) {
        if (!where)
            return take(ray);
        std::vector<Segment> const selected = selected_rows(ray, *where);
        return selected.empty() || take(selected);
    };
    for (std::uint64_t row = 0; row < log.rows(); row += portion_rows) {
        std::vector<Segment> const read = log.read(row, portion_rows);
        std::span<Segment const> rest(read);
        while (!rest.empty()) {
            auto const next = std::find_if(rest.begin(), rest.end(),
                                           [&](Segment const& s) { return s.ray != rest.front().ray; });
            auto const ray = rest.first(static_cast<std::size_t>(next - rest.begin()));
            rest = rest.subspan(ray.size());
            if (!left_over.empty() && left_over.front().ray != ray.front().ray) {
                if (!pass_on(left_over))
                    return;
                left_over.clear();
            }
            if (left_over.empty() && !rest.empty()) {
                if (!pass_on(ray))
                    return;
            } else {
                left_over.insert(left_over.end(), ray.begin(), ray.end());
            }
        }
    }
    if (!left_over.empty())
        pass_on(left_over);
}

} // namespace sahl
