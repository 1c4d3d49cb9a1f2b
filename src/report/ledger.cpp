#include "report/ledger.h"

#include "report/html.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sahl::report {

namespace {

constexpr double default_ledger_limit = 1e-12, default_leak_limit = 1e-6; // as in the experiment's [limits]
constexpr std::size_t most_absorbers = 40;

constexpr std::array<char const*, 5> meanings{
    "met an absorbing detector", "was lost in media and at surfaces", "left the scene",
    "branches too weak or too deep to follow", "leaks and invalid rays"};

double limit(Value const& summary, char const* name, double otherwise) {
    return number_at(summary, {"options", name}).value_or(otherwise);
}

double lost_of(Value const& summary) {
    return number_at(summary, {"events", "leak"}).value_or(0.0) +
           number_at(summary, {"events", "invalid"}).value_or(0.0);
}

std::string verdict(bool good, std::string const& text) {
    return std::string("<p class=\"") + (good ? "good" : "bad") + "\">" + (good ? "✓ " : "⚑ ") + text +
           "</p>\n";
}

std::string verdicts(Value const& summary) {
    std::string out;
    if (auto const closes = ledger_closes(summary)) {
        auto const emitted = number_at(summary, {"energy_W", "emitted"});
        auto const remainder = number_at(summary, {"energy_W", "remainder"});
        std::string const share = emitted && remainder && *emitted > 0.0
                                      ? figure(std::abs(*remainder) / *emitted, 3)
                                      : "not stated";
        out += verdict(*closes, std::string("The ledger ") + (*closes ? "closes" : "does not close") +
                                    ": remainder " + share + " of the emitted power; limit " +
                                    figure(limit(summary, "limit_ledger", default_ledger_limit)) + ".");
    }
    if (auto const within = leaks_within_limit(summary); within && !*within)
        out += verdict(
            false, "Segments that leaked or were invalid: " +
                       count(static_cast<std::uint64_t>(lost_of(summary))) + ". That is above the limit of " +
                       figure(limit(summary, "limit_leak", default_leak_limit)) + " of the events.");
    return out;
}

std::string bar(std::array<double, 5> const& widths) {
    std::string out = "<div class=\"bar\">";
    for (std::size_t i = 0; i < widths.size(); ++i)
        if (widths[i] > 0.0) {
            std::array<char, 32> width{};
            std::snprintf(width.data(), width.size(), "%.8f", widths[i]);
            out += "<span class=\"" + std::string(ledger_terms[i]) + "\" style=\"width:" + width.data() +
                   "%\" title=\"" + ledger_terms[i] + " " + coordinate(widths[i]) + " %\"></span>";
        }
    return out + "</div>\n";
}

/// The numbers of a tree of tables, each with the keys that lead to it.
void leaves(Value const& value, std::string const& place, std::vector<std::pair<double, std::string>>& out) {
    if (auto const number = number_at(value, {}); number && *number > 0.0)
        out.emplace_back(*number, place);
    for (auto const& [key, entry] :
         std::holds_alternative<Table>(value.data) ? std::get<Table>(value.data) : Table())
        leaves(entry, place.empty() ? key : place + " › " + key, out);
}

std::string absorbed_html(Value const& summary, double emitted) {
    std::vector<std::pair<double, std::string>> places;
    if (Value const* absorbed = at(summary, {"absorbed_W"}))
        leaves(*absorbed, "", places);
    if (places.empty())
        return {};
    std::stable_sort(places.begin(), places.end(),
                     [](auto const& a, auto const& b) { return a.first > b.first; });
    HtmlTable table{{"absorbed in", "W", "share of emitted"}, {}};
    for (auto const& [power, place] : places) {
        if (table.rows.size() == most_absorbers)
            break;
        table.rows.push_back(
            {escaped(place), figure(power), emitted > 0.0 ? per_cent(power / emitted) : "–"});
    }
    std::string const more = places.size() > most_absorbers ? "<p class=\"note\">The strongest of " +
                                                                  count(places.size()) + " places.</p>"
                                                            : "";
    return "<details><summary>Where light was absorbed</summary>" + html_of(table) + more + "</details>\n";
}

} // namespace

std::optional<std::array<double, 5>> bar_widths(Value const& summary) {
    std::array<double, 5> widths{};
    double sum = 0.0;
    for (std::size_t i = 0; i < widths.size(); ++i)
        sum += widths[i] = std::max(0.0, number_at(summary, {"energy_W", ledger_terms[i]}).value_or(0.0));
    if (!(sum > 0.0) || !std::isfinite(sum))
        return std::nullopt;
    for (double& width : widths)
        width *= 100.0 / sum;
    return widths;
}

std::optional<bool> ledger_closes(Value const& summary) {
    if (!at(summary, {"energy_W"}))
        return std::nullopt;
    auto const emitted = number_at(summary, {"energy_W", "emitted"});
    auto const remainder = number_at(summary, {"energy_W", "remainder"});
    return emitted && remainder &&
           std::abs(*remainder) <= limit(summary, "limit_ledger", default_ledger_limit) * *emitted;
}

double events_of(Value const& summary) {
    double all = 0.0;
    for (auto const& [name, value] : entries_at(summary, "events"))
        if (name != "recovered")
            all += number_at(*value, {}).value_or(0.0);
    return all;
}

std::optional<bool> leaks_within_limit(Value const& summary) {
    double const all = events_of(summary);
    if (all <= 0.0)
        return std::nullopt;
    return lost_of(summary) <= limit(summary, "limit_leak", default_leak_limit) * all;
}

std::string ledger_html(Value const& summary) {
    if (!at(summary, {"energy_W"}))
        return {};
    std::string out = verdicts(summary);
    double const emitted = number_at(summary, {"energy_W", "emitted"}).value_or(0.0);
    if (auto const widths = bar_widths(summary))
        out += bar(*widths);
    auto const row = [&](std::string const& term, char const* key, char const* meaning) {
        auto const power = number_at(summary, {"energy_W", key});
        return std::vector<std::string>{term, power ? figure(*power) : "–",
                                        power && emitted > 0.0 ? per_cent(*power / emitted) : "–", meaning};
    };
    HtmlTable table{{"", "W", "share", ""}, {row("emitted", "emitted", "by all sources")}};
    for (std::size_t i = 0; i < ledger_terms.size(); ++i)
        table.rows.push_back(
            row("<span class=\"swatch " + std::string(ledger_terms[i]) + "\"></span>" + ledger_terms[i],
                ledger_terms[i], meanings[i]));
    table.rows.push_back(row("remainder", "remainder", "what is then left: rounding"));
    return out + html_of(table) + absorbed_html(summary, emitted);
}

} // namespace sahl::report
