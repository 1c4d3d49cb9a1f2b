#include "run/paths_report.h"

#include "run/values.h"

#include <cstdio>

namespace sahl {

namespace {

double share_of(double power, PathGroups const& found) {
    return found.began > 0.0 ? power / found.began : 0.0;
}

/// 1 234 567
std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t at = digits.size(); at > 3;)
        digits.insert(at -= 3, " ");
    return digits;
}

std::string line(PathGroup const& group, PathGroups const& found, std::string const& rays,
                 std::string const& what) {
    char text[120];
    std::snprintf(text, sizeof text, "%9.4f %%  %14s  %12s  %14.6g mm  ",
                  100.0 * share_of(group.power, found), grouped(group.paths).c_str(), rays.c_str(),
                  group.mean_optical_path * 1e3);
    return text + what + "\n";
}

} // namespace

Value paths_value(PathGroups const& found, LogHeader const& header) {
    Array groups;
    for (PathGroup const& group : found.groups) {
        Array steps;
        for (PathGroup::Step const& step : group.steps) {
            Table entry{{"event", of(std::string(name_of(step.event)))}};
            if (step.surface >= 0)
                entry.emplace_back("surface", of(header.surfaces[static_cast<std::size_t>(step.surface)]));
            if (step.times > 1)
                entry.emplace_back("times", of(std::uint64_t{step.times}));
            steps.push_back(of(std::move(entry)));
        }
        groups.push_back(of(Table{{"share", of(share_of(group.power, found))},
                                  {"power_W", of(group.power)},
                                  {"paths", of(group.paths)},
                                  {"rays", of(group.rays)},
                                  {"mean_optical_path_mm", of(group.mean_optical_path * 1e3)},
                                  {"filter", of(group.filter)},
                                  {"steps", of(std::move(steps))}}));
    }
    return of(Table{{"rays", of(found.rays)},
                    {"segments", of(found.segments)},
                    {"paths", of(found.paths)},
                    {"began_W", of(found.began)},
                    {"power_W", of(found.power)},
                    {"groups", of(std::move(groups))},
                    {"other", of(Table{{"share", of(share_of(found.other.power, found))},
                                       {"power_W", of(found.other.power)},
                                       {"paths", of(found.other.paths)},
                                       {"mean_optical_path_mm", of(found.other.mean_optical_path * 1e3)}})},
                    {"complete_above_W", of(found.surely_above)}});
}

std::string paths_text(PathGroups const& found) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "%s rays in the log, %s segments, %s paths; %.9g W began, %.9g W at the ends of these paths\n",
        grouped(found.rays).c_str(), grouped(found.segments).c_str(), grouped(found.paths).c_str(),
        found.began, found.power);
    std::string all = text;
    all += "      power           paths          rays     optical path  where\n";
    for (PathGroup const& group : found.groups)
        all += line(group, found, grouped(group.rays), group.filter);
    if (found.other.paths > 0)
        all += line(found.other, found, "", "other");
    if (found.surely_above > 0.0) {
        std::snprintf(text, sizeof text,
                      "so many different paths that the weakest were not followed: each with more than %.3g "
                      "W was found\n",
                      found.surely_above);
        all += text;
    }
    return all;
}

} // namespace sahl
