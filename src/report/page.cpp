#include "report/page.h"

#include "report/html.h"
#include "report/page_data.h"
#include "report/web_page.h"

#include <cmath>

namespace sahl {

namespace {

using namespace report;

constexpr std::string_view data_begins = "<script type=\"application/json\" id=\"sahl-data\">",
                           data_ends = "</script>";

/// The page with its title and its data, where the bundle keeps room for them.
std::string filled(std::string const& title, std::string_view data) {
    std::string const page = web_page();
    std::string_view const rest(page);
    constexpr std::string_view title_room = "@TITLE@", data_room = "@DATA@";
    std::size_t const at_title = rest.find(title_room), at_data = rest.find(data_room);
    std::string out;
    out.reserve(page.size() + title.size() + data.size());
    out += rest.substr(0, at_title);
    out += title;
    out += rest.substr(at_title + title_room.size(), at_data - at_title - title_room.size());
    out += data;
    out += rest.substr(at_data + data_room.size());
    return out;
}

std::string title_of(Value const& summary) {
    Value const* const title = summary.find("title");
    auto const* text = title ? std::get_if<std::string>(&title->data) : nullptr;
    if (text && !text->empty())
        return *text;
    Value const* const file = summary.find("file"); // of a model
    auto const* name = file ? std::get_if<std::string>(&file->data) : nullptr;
    return name ? name->substr(name->find_last_of('/') + 1) : "Untitled run";
}

} // namespace

std::string report_page(PageInput const& input) {
    JsonText json;
    json.open('{').entry("format", std::uint64_t{1});
    json.entry("kind", input.is_model ? "model" : input.sweep_keys.empty() ? "run" : "sweep");
    json.entry("title", title_of(input.summary)).entry("summary", input.summary);
    write_names(json, input.names);
    write_rays(json, input.paths, input.names);
    write_bodies(json, input.scene);
    write_detectors(json, input.scene, input.detectors);
    write_sweep(json, input.sweep_keys, input.sweep);
    json.key("marks").open('[');
    for (PageMark const& mark : input.marks)
        json.open('{')
            .entry("kind", mark.kind)
            .entry("text", mark.text)
            .array("lines", mark.lines)
            .array("triangles", mark.triangles)
            .close('}');
    json.close(']');
    json.entry("methods", Value{}).close('}'); // last, where renewed_page looks for them
    return filled(escaped(title_of(input.summary)), json.take());
}

std::optional<std::string> renewed_page(std::string const& page, Value const* methods) {
    auto const between = [&](std::string_view from, std::string_view to) -> std::optional<std::string_view> {
        std::size_t const begin = page.find(from);
        std::size_t const end = begin == std::string::npos ? begin : page.find(to, begin);
        if (end == std::string::npos)
            return std::nullopt;
        return std::string_view(page).substr(begin + from.size(), end - begin - from.size());
    };
    auto const title = between("<title>", "</title>"), data = between(data_begins, data_ends);
    if (!title || !data)
        return std::nullopt;
    constexpr std::string_view last = ",\"methods\":"; // in a text its quotes would be escaped
    std::size_t const at_methods = data->rfind(last);
    if (!methods || at_methods == std::string_view::npos)
        return filled(std::string(*title), *data);
    JsonText json;
    json.value(*methods);
    return filled(std::string(*title),
                  std::string(data->substr(0, at_methods)) + std::string(last) + json.take() + "}");
}

PagePaths thinned(PagePaths const& paths, std::size_t most) {
    std::vector<std::size_t> starts; // of each ray
    for (std::size_t i = 0; i < paths.segments.size(); ++i)
        if (i == 0 || paths.segments[i].ray != paths.segments[i - 1].ray)
            starts.push_back(i);
    if (paths.segments.size() <= most)
        return paths;
    double const share = static_cast<double>(most) / static_cast<double>(paths.segments.size());
    PagePaths sample;
    for (std::size_t ray = 0; ray < starts.size(); ++ray) {
        auto const wanted = [&](std::size_t rays) {
            return std::floor(share * static_cast<double>(rays) + 0.5);
        };
        std::size_t const end = ray + 1 < starts.size() ? starts[ray + 1] : paths.segments.size();
        bool const skipped = starts.size() > 1 && !(wanted(ray + 1) > wanted(ray));
        if (skipped || (sample.rays > 0 && sample.segments.size() + end - starts[ray] > most))
            continue;
        ++sample.rays;
        for (std::size_t i = starts[ray]; i < end && sample.segments.size() < most; ++i)
            sample.segments.push_back(paths.segments[i]);
    }
    return sample;
}

} // namespace sahl
