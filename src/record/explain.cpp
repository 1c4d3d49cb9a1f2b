// In: the tree of one ray, as logged. Out: the tree as text, with the reason for every split and every end.
#include "record/explain.h"

#include "record/log_columns.h"
#include "record/ray_tree.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sahl {

namespace {

constexpr double degrees = 180.0 / 3.14159265358979323846;

std::string number(double value, int digits = 6) {
    char text[32];
    return {text, std::to_chars(text, std::end(text), value, std::chars_format::general, digits).ptr};
}

std::string angle(double radians) {
    char text[32];
    return std::string(
               text,
               std::to_chars(text, std::end(text), radians * degrees, std::chars_format::fixed, 2).ptr) +
           "°";
}

std::string percent(double share) {
    return number(100.0 * share, 4) + " %";
}

std::string triple(dvec3 const& v, int digits = 6) {
    return "(" + number(v.x, digits) + ", " + number(v.y, digits) + ", " + number(v.z, digits) + ")";
}

std::string length_mm(double metres) {
    return number(in_mm(metres)) + " mm";
}

std::string medium_name(LogHeader const& header, std::size_t medium) {
    return medium < header.media.size() ? header.media[medium] : "medium " + std::to_string(medium);
}

std::string surface_name(LogHeader const& header, std::int32_t surface) {
    auto const number = static_cast<std::size_t>(surface);
    return number < header.surfaces.size() ? header.surfaces[number] : "surface " + std::to_string(surface);
}

std::string with_index(RayTree const& tree, std::size_t medium, double wavelength) {
    auto const n = index_of(tree.header, medium, wavelength);
    return medium_name(tree.header, medium) + (n ? " (n " + number(*n) + ")" : "");
}

/// What each event says of a segment that it ended, before the place where it did.
std::string_view verb_of(Event ended, bool splits) {
    switch (ended) {
    case Event::refracted:
        return splits ? "split by " : "refracted by ";
    case Event::reflected:
        return "reflected by ";
    case Event::total_internal:
        return "meets ";
    case Event::absorbed:
        return "absorbed by ";
    case Event::detected:
        return "detected by ";
    case Event::passed:
        return "passed through ";
    case Event::scattered:
        return "scattered by ";
    default:
        return "";
    }
}

/// The index that a row ends in, and that of the medium behind, as far as the log tells them.
std::string both_indices(RayTree const& tree, std::size_t row, std::size_t behind) {
    Segment const& in = tree.rows[row];
    auto const n_before = index_of(tree.header, in.medium, in.wavelength);
    auto const n_after = index_of(tree.header, behind, in.wavelength);
    return n_before && n_after ? ", n " + number(*n_before) + " → " + number(*n_after) : "";
}

/// Angles of incidence and refraction, and both indices, as far as the log tells them.
std::string angles(RayTree const& tree, std::size_t row) {
    Segment const& in = tree.rows[row];
    auto const normal = normal_at_end(tree, row);
    if (!normal)
        return "";
    double const incidence = angle_to(in.direction, *normal);
    if (in.ended == Event::total_internal) {
        auto const behind = beyond(tree, row, incidence);
        if (!behind)
            return "total internal reflection: incidence " + angle(incidence);
        return "total internal reflection: incidence " + angle(incidence) + " exceeds the critical angle " +
               angle(behind->critical_angle) + " against " + medium_name(tree.header, behind->medium) +
               both_indices(tree, row, behind->medium) + (behind->seen ? "" : ", where it came in from");
    }
    std::string text = "incidence " + angle(incidence);
    if (auto const* bent = child_born(tree, row, {Event::refracted})) {
        text += ", refraction " + angle(angle_to(bent->direction, *normal));
        text += both_indices(tree, row, bent->medium);
    }
    return text;
}

/// The shares of the arriving power that the branches carry, and what is then left as absorbed.
std::string shares(RayTree const& tree, std::size_t row) {
    double const arriving = tree.rows[row].power_end;
    if (tree.children[row].empty())
        return "its branches are not in the log";
    if (!(arriving > 0.0))
        return "";
    std::string text;
    double left = 1.0;
    for (std::size_t const child : tree.children[row]) {
        Segment const& branch = tree.rows[child];
        double const share = branch.power_start / arriving;
        bool const through = branch.born == Event::refracted || branch.born == Event::passed;
        text += (text.empty() ? "" : ", ") + std::string(through ? "T " : "R ") + percent(share);
        left -= share;
    }
    if (tree.whole && left > 1e-12) // sums of shares are rounded to about 1e-16 each
        text += ", absorbed " + percent(left);
    return text;
}

using Normals = std::map<std::string, dvec3>;

/// Where nothing goes on from that would tell the normal.
std::string incidence_on(Segment const& in, std::string const& surface, Normals const& normals) {
    auto const found = normals.find(surface);
    return found == normals.end() ? "" : "incidence " + angle(angle_to(in.direction, found->second));
}

std::string end_of(RayTree const& tree, std::size_t row, Normals const& normals) {
    Segment const& s = tree.rows[row];
    switch (s.ended) {
    case Event::escaped:
        return "escaped towards " + triple(s.direction);
    case Event::cut_power:
        return "cut: power below the limit";
    case Event::cut_depth:
        return "cut: too many interactions, " + std::to_string(s.depth);
    case Event::leak:
        return "lost: no consistent next crossing was found (a leak, counted as error)";
    case Event::invalid:
        return "lost: a number was not finite (invalid, counted as error)";
    case Event::none:
    case Event::emitted:
        return "its end is not recorded";
    default:
        break;
    }
    std::string text = s.surface < 0 ? std::string(name_of(s.ended))
                                     : std::string(verb_of(s.ended, tree.children[row].size() > 1)) +
                                           surface_name(tree.header, s.surface);
    text += " at " + triple(in_mm(1.0) * (s.origin + s.length * s.direction)) + " mm";
    bool const for_good = s.ended == Event::absorbed || s.ended == Event::detected;
    std::string bent =
        for_good || s.ended == Event::passed || s.ended == Event::scattered ? "" : angles(tree, row);
    if (bent.empty() && s.surface >= 0)
        bent = incidence_on(s, surface_name(tree.header, s.surface), normals);
    std::string const carried = for_good ? "" : shares(tree, row);
    return text + (bent.empty() ? "" : ": " + bent) +
           (carried.empty() ? "" : (bent.empty() ? ": " : "; ") + carried);
}

std::string power_of(RayTree const& tree, std::size_t row) {
    Segment const& s = tree.rows[row];
    Segment const& root = tree.rows.front();
    bool const of_ray = root.parent < 0 && root.power_start > 0.0;
    auto const with_share = [&](double power) {
        return number(power) + " W" + (of_ray ? " (" + percent(power / root.power_start) + ")" : "");
    };
    std::string text = "power " + with_share(s.power_start);
    if (s.power_end != s.power_start && s.power_start > 0.0)
        text += " → " + with_share(s.power_end) + ", absorbed " + percent(1.0 - s.power_end / s.power_start) +
                " on the way";
    return text;
}

std::string title_of(RayTree const& tree, std::size_t row) {
    Segment const& s = tree.rows[row];
    std::string text = "#" + std::to_string(s.index) + " " + std::string(name_of(s.born)) + " in " +
                       with_index(tree, s.medium, s.wavelength);
    if (s.parent >= 0 && !tree.parents[row])
        text += ", from #" + std::to_string(s.parent) + ", which is not in the log";
    if (!std::isfinite(s.length))
        return text + ", without end";
    return s.length == 0.0
               ? text
               : text + ", " + length_mm(s.length) + ", optical path " + length_mm(s.optical_path);
}

std::string missing(RayTree const& tree) {
    if (tree.whole)
        return "";
    if (tree.header.min_power > 0.0)
        return "; pieces below " + percent(tree.header.min_power) + " of its power are not in the log";
    return "; some of its rows are not in the log";
}

std::string heading(RayTree const& tree) {
    Segment const& root = tree.rows.front();
    std::string text = "ray " + std::to_string(root.ray);
    if (root.source < tree.header.sources.size())
        text += " of " + tree.header.sources[root.source];
    return text + ", " + number(in_nm(root.wavelength), 10) + " nm, " + std::to_string(tree.rows.size()) +
           (tree.rows.size() == 1 ? " segment" : " segments") + missing(tree) + "\n";
}

} // namespace

std::string explain_ray(LogHeader const& header, std::vector<Segment> const& rows,
                        std::vector<char> const* drawn, std::map<std::string, dvec3> const& normals) {
    if (rows.empty())
        return "";
    RayTree const tree = grow_tree(header, rows);
    struct Entry {
        std::size_t row;
        std::string first, rest; // what stands left of its first line, and of all below it
    };
    std::vector<Entry> todo; // the next one last; no recursion, a light guide may be 10⁴ deep
    for (std::size_t row = rows.size(); row-- > 0;)
        if (!tree.parents[row] && (!drawn || (*drawn)[row]))
            todo.push_back({row, "", ""});
    std::string text = heading(tree);
    if (drawn)
        text.insert(text.size() - 1, ", of which " +
                                         std::to_string(std::count(drawn->begin(), drawn->end(), char{1})) +
                                         " are on selected paths");
    while (!todo.empty()) {
        Entry const entry = std::move(todo.back());
        todo.pop_back();
        std::vector<std::size_t> children = tree.children[entry.row];
        if (drawn)
            std::erase_if(children, [&](std::size_t child) { return !(*drawn)[child]; });
        std::string const margin = entry.rest + (children.empty() ? "   " : "│  ");
        text += entry.first + title_of(tree, entry.row) + "\n";
        text += margin + power_of(tree, entry.row) + "\n";
        text += margin + end_of(tree, entry.row, normals) + "\n";
        for (std::size_t k = children.size(); k-- > 0;) {
            bool const only = children.size() == 1, last = k + 1 == children.size();
            todo.push_back({children[k],
                            entry.rest + (only   ? ""
                                          : last ? "└─ "
                                                 : "├─ "),
                            entry.rest + (only   ? ""
                                          : last ? "   "
                                                 : "│  ")});
        }
    }
    return text;
}

} // namespace sahl
