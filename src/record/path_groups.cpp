#include "record/path_groups.h"

#include "record/path_counter.h"
#include "record/read_rays.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr double most_room = 1 << 20; // 0.2 GB

PathGroup group_of(PathSums const& sums, SumUnit unit) {
    PathGroup group;
    group.paths = sums.paths;
    group.rays = sums.rays;
    group.power = sums.power.value(unit);
    group.mean_optical_path = group.power > 0.0 ? sums.power_path.value(unit) / group.power : 0.0;
    return group;
}

/// What happened on the way to one end of one ray.
std::vector<PathGroup::Step> steps_to(RayLogReader const& log, std::uint64_t ray, std::uint32_t end) {
    std::vector<Segment> const rows = log.read_ray(ray);
    auto const last =
        std::find_if(rows.begin(), rows.end(), [&](Segment const& s) { return s.index == end; });
    std::vector<PathGroup::Step> steps{{last->ended, last->surface, 1}};
    auto at = static_cast<std::size_t>(last - rows.begin());
    for (std::ptrdiff_t up = parent_position(rows, at); up >= 0; up = parent_position(rows, at)) {
        Event const event = rows[at].born;
        at = static_cast<std::size_t>(up);
        PathGroup::Step const step{event, rows[at].surface, 1};
        if (steps.back().event == step.event && steps.back().surface == step.surface)
            ++steps.back().times;
        else
            steps.push_back(step);
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
}

void read_all(RayLogReader const& log, PathCounter& counter) {
    read_rays(log, nullptr, [&](std::span<Segment const> ray) {
        counter.take(ray);
        return true;
    });
}

} // namespace

std::string filter_of(std::vector<PathGroup::Step> const& steps, std::vector<std::string> const& surfaces) {
    std::string text = "path(";
    for (PathGroup::Step const& step : steps) {
        text +=
            (&step == &steps.front() ? "" : ", ") + (step.times > 1 ? std::to_string(step.times) + " " : "");
        text += name_of(step.event);
        if (step.surface >= 0)
            text += "(" + lone_filter_name(surfaces, static_cast<std::size_t>(step.surface)) + ")";
    }
    return text + ")";
}

PathGroups group_paths(RayLogReader const& log, PathFilter const* where, double least_share,
                       std::size_t room) {
    double const wanted = least_share > 0.0 ? 4.0 / least_share : most_room;
    PathCounter counter(log.header(), where,
                        std::max(room, static_cast<std::size_t>(std::min(wanted, most_room))));
    read_all(log, counter);
    double const overlooked = counter.given_up();
    if (counter.other().paths > 0) { // some were given up, and may have come back
        counter.count_again();
        read_all(log, counter);
    }
    PathGroups found;
    found.rays = counter.rays();
    found.segments = counter.segments();
    found.began = counter.began();
    found.surely_above = overlooked;
    SumUnit const unit = counter.unit();
    PathSums other = counter.other(), all = other;
    std::vector<PathSums> chosen;
    for (auto const& [hash, sums] : counter.table()) {
        all.add(sums);
        if (sums.power.value(unit) >= least_share * found.began)
            chosen.push_back(sums);
        else
            other.add(sums);
    }
    found.paths = all.paths;
    found.power = all.power.value(unit);
    found.other = group_of(other, unit);
    std::sort(chosen.begin(), chosen.end(), [](PathSums const& a, PathSums const& b) {
        if (a.power.units() != b.power.units())
            return a.power.units() > b.power.units();
        return std::pair(a.first_ray, a.first_segment) < std::pair(b.first_ray, b.first_segment);
    });
    for (PathSums const& sums : chosen) {
        PathGroup& group = found.groups.emplace_back(group_of(sums, unit));
        group.steps = steps_to(log, sums.first_ray, sums.first_segment);
        group.filter =
            (where ? "(" + where->text() + ") and " : "") + filter_of(group.steps, log.header().surfaces);
    }
    return found;
}

} // namespace sahl
