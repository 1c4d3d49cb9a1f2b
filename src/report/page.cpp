#include "report/page.h"

#include "report/detectors.h"
#include "report/drawing.h"
#include "report/html.h"
#include "report/ledger.h"
#include "report/style.h"
#include "report/sweep.h"

#include <map>

namespace sahl {

namespace report {

namespace {

/// A heading and what stands under it; nothing where that is empty.
std::string section(char const* heading, std::string const& content) {
    return content.empty() ? ""
                           : "<section><h2>" + std::string(heading) + "</h2>\n" + content + "</section>\n";
}

std::optional<std::uint64_t> count_at(Value const& summary, char const* key) {
    auto const number = number_at(summary, {key});
    return number && *number >= 0.0 && *number < 1e18 ? std::optional(static_cast<std::uint64_t>(*number))
                                                      : std::nullopt;
}

std::string tile(std::string const& value, char const* name) {
    return value.empty() ? "" : "<div><b>" + value + "</b><span>" + name + "</span></div>";
}

std::string head_html(Value const& summary) {
    auto const counted = [&](char const* key) {
        auto const number = count_at(summary, key);
        return number ? count(*number) : std::string();
    };
    auto const seconds = number_at(summary, {"seconds"});
    auto const rate = number_at(summary, {"segments_per_second"});
    std::string out =
        "<header><h1>" + escaped(text_at(summary, {"title"}).value_or("Untitled run")) + "</h1>\n";
    if (auto const program = text_at(summary, {"program"}))
        out += "<p class=\"note\">Traced by " + escaped(*program) + "</p>\n";
    return out + "<div class=\"tiles\">" + tile(counted("rays"), "rays") +
           tile(counted("segments"), "segments") + tile(seconds ? figure(*seconds, 3) + " s" : "", "time") +
           tile(rate ? figure(*rate / 1e6, 3) + " M/s" : "", "segments per second") +
           tile(counted("threads"), "threads") + tile(counted("seed"), "seed") + "</div>\n</header>\n";
}

/// A list of sentences in a box of its kind.
std::string box_html(Value const& summary, char const* key, char const* kind, std::string const& name) {
    Value const* const found = at(summary, {key});
    auto const* list = found ? std::get_if<Array>(&found->data) : nullptr;
    if (!list || list->empty())
        return {};
    std::string out = "<aside class=\"box " + std::string(kind) + "\"><b>" + name + "</b><ul>\n";
    for (Value const& sentence : *list)
        out += "<li>" + shown(&sentence) + "</li>\n";
    return out + "</ul></aside>\n";
}

std::string events_html(Value const& summary) {
    HtmlTable table{{"segments ended by", "count", "share"}, {}};
    double const all = events_of(summary);
    std::string recovered;
    for (auto const& [name, value] : entries_at(summary, "events")) {
        auto const number = number_at(*value, {});
        if (!number || *number <= 0.0)
            continue;
        std::string const counted = count(static_cast<std::uint64_t>(*number));
        if (name == "recovered")
            recovered = "<p class=\"note\">" + counted +
                        " hits were in doubt and found again by the exact search.</p>";
        else
            table.rows.push_back({escaped(name), counted, all > 0.0 ? per_cent(*number / all) : "–"});
    }
    return table.rows.empty() ? recovered : html_of(table) + recovered;
}

std::string lost_rays_html(Value const& summary) {
    HtmlTable table{{"ray", "event", "at (mm)", "power (W)"}, {}};
    for (auto const& [unused, ray] : entries_at(summary, "lost_rays"))
        table.rows.push_back({shown(at(*ray, {"ray"})), shown(at(*ray, {"event"})),
                              shown(at(*ray, {"at_mm"})), shown(at(*ray, {"power_W"}))});
    return table.rows.empty() ? "" : html_of(table);
}

std::string escaped_html(Value const& summary) {
    HtmlTable table{{"wavelength (nm)", "mean direction"}, {}};
    for (auto const& [wavelength, direction] : entries_at(summary, "escaped_direction"))
        table.rows.push_back({escaped(wavelength), shown(direction)});
    return table.rows.empty() ? "" : html_of(table);
}

std::string mesh_text(Value const* model) {
    if (!model)
        return "–";
    auto const triangles = number_at(*model, {"triangles"});
    Value const* const closed = at(*model, {"closed"});
    bool const open = closed && std::holds_alternative<bool>(closed->data) && !std::get<bool>(closed->data);
    return triangles
               ? count(static_cast<std::uint64_t>(*triangles)) + " triangles" + (open ? ", not closed" : "")
               : "–";
}

std::string objects_html(Value const& summary) {
    std::map<std::string, Value const*> models; // there may be a hundred thousand instances of one
    for (auto const& [name, model] : entries_at(summary, "models"))
        models.emplace(name, model);
    bool const meshes = !models.empty();
    HtmlTable table{{"object", "medium", "method", "error of directions (rad)"}, {}};
    if (meshes)
        table.headings.emplace_back("mesh");
    for (auto const& [name, object] : entries_at(summary, "objects")) {
        Value const* const bound = at(*object, {"error_bound_rad"});
        table.rows.push_back({escaped(name), shown(at(*object, {"medium"})), shown(at(*object, {"method"})),
                              bound ? shown(bound) : "not stated"});
        if (meshes)
            table.rows.back().push_back(mesh_text(models.count(name) ? models.at(name) : nullptr));
    }
    return table.rows.empty() ? "" : html_of(table);
}

std::string options_html(Value const& summary) {
    Value const* const options = at(summary, {"options"});
    auto const hash = text_at(summary, {"experiment_sha256"});
    std::string out;
    if (hash)
        out += "<p class=\"note\">SHA-256 of the experiment: " + escaped(*hash) + "</p>\n";
    if (options)
        out += "<pre>" + escaped(to_json(*options)) + "</pre>\n";
    return out.empty() ? "" : "<details><summary>How it was run</summary>" + out + "</details>\n";
}

} // namespace

} // namespace report

std::string report_page(PageInput const& input) {
    using namespace report;
    Value const& summary = input.summary;
    std::string const title = escaped(text_at(summary, {"title"}).value_or("Untitled run"));
    std::string out =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' data:; "
        "style-src 'unsafe-inline'\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
        title + "</title>\n<style>" + std::string(style_sheet) + "</style></head>\n<body><main>\n";
    out += head_html(summary) + box_html(summary, "failures", "bad", "A check of the physics failed") +
           box_html(summary, "warnings", "warnings", "Warnings");
    out += section("Scene and paths", drawing_html(input, count_at(summary, "rays").value_or(0)));
    out += section(input.sweep.empty() ? "Where the power went" : "Where the power of all runs went",
                   ledger_html(summary));
    out += section("Sweep", sweep_html(input));
    out += section("Detectors", detectors_html(input));
    out += section("Objects", objects_html(summary)) + "<div class=\"two\">" +
           section("Events", events_html(summary)) + section("Lost rays", lost_rays_html(summary)) +
           section("Mean direction of escaped light", escaped_html(summary)) + "</div>\n";
    return out + options_html(summary) + "</main></body></html>\n";
}

} // namespace sahl
