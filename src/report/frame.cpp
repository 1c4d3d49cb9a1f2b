#include "report/frame.h"

#include "image/ticks.h"
#include "report/html.h"

#include <algorithm>
#include <cmath>

namespace sahl::report {

namespace {

constexpr double margin =
    0.10; // on each side, of the longer extent: room for labels and for rays that escape
constexpr double smallest = 1e-6; // m, of a frame: a drawing of a single point needs some size
constexpr double left = 58, right = 14, top = 12, bottom = 42; // pixels, for ticks and names
constexpr double pixels_per_tick = 70, pixels_per_row = 45;

std::string text(double x, double y, char const* kind, std::string const& content) {
    return "<text class=\"" + std::string(kind) + "\" x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) +
           "\">" + content + "</text>\n";
}

std::string line(dvec2 const& a, dvec2 const& b, char const* kind) {
    return "<line class=\"" + std::string(kind) + "\" x1=\"" + coordinate(a.x) + "\" y1=\"" +
           coordinate(a.y) + "\" x2=\"" + coordinate(b.x) + "\" y2=\"" + coordinate(b.y) + "\"/>\n";
}

constexpr std::array<char const*, 3> axis_names{"x", "y", "z"};

/// A round length of a quarter of the frame at most.
std::string scale_bar(Frame const& frame) {
    auto const lengths = round_ticks(0.0, 1e3 * frame.width / frame.scale / 4.0, 2);
    if (lengths.empty() || lengths.back() <= 0.0)
        return {};
    double const pixels = lengths.back() * 1e-3 * frame.scale;
    dvec2 const end(frame.left + frame.width - 12.0, frame.top + frame.height - 12.0);
    dvec2 const start(end.x - pixels, end.y), up(0.0, 4.0);
    return line(start, end, "bar") + line(start - up, start + up, "bar") + line(end - up, end + up, "bar") +
           text(0.5 * (start.x + end.x), end.y - 7.0, "middle halo", tick_label(lengths.back()) + " mm");
}

} // namespace

void Bounds::add(dvec2 const& p) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
        return;
    low = glm::min(low, p);
    high = glm::max(high, p);
}

void Bounds::add(Outline const& outline) {
    for (auto const* lines : {&outline.area, &outline.lines})
        for (Polyline const& polyline : *lines)
            for (dvec2 const& p : polyline)
                add(p);
}

std::array<View, 2> best_views(dvec3 const& size) {
    std::array<View, 3> views{{{0, 1}, {2, 1}, {2, 0}}};
    double const least =
        1e-3 * std::max({size.x, size.y, size.z}); // so that planes of flat scenes differ in area
    auto const extent = [&](int axis) { return std::max(size[axis], least); };
    auto const area = [&](View const& v) { return extent(v.right) * extent(v.up); };
    std::stable_sort(views.begin(), views.end(),
                     [&](View const& a, View const& b) { return area(a) > area(b); });
    for (View& view : views)
        if (extent(view.up) > 1.5 * extent(view.right))
            std::swap(view.right, view.up);
    return {views[0], views[1]};
}

namespace {

dvec2 size_with_margin(Bounds const& content) {
    return content.size() + 2.0 * margin * std::max({content.size().x, content.size().y, smallest});
}

} // namespace

double wanted_height(Bounds const& content) {
    dvec2 const size = size_with_margin(content);
    return size.y / size.x;
}

Frame frame_about(View const& view, Bounds content, double width, double height) {
    if (content.empty())
        content.add(dvec2(0.0));
    Frame frame;
    frame.view = view;
    frame.left = left;
    frame.top = top;
    frame.width = width - left - right;
    frame.height = frame.width * height;
    frame.outer = {width, top + frame.height + bottom};
    dvec2 const least = size_with_margin(content);
    frame.scale = std::min(frame.width / least.x, frame.height / least.y);
    dvec2 const middle = 0.5 * (content.low + content.high);
    dvec2 const size = dvec2(frame.width, frame.height) / frame.scale;
    frame.world = {middle - 0.5 * size, middle + 0.5 * size};
    return frame;
}

std::optional<std::pair<dvec2, dvec2>> clipped(Frame const& frame, dvec2 const& origin,
                                               dvec2 const& direction, double end) {
    if (!std::isfinite(origin.x + origin.y + direction.x + direction.y))
        return std::nullopt;
    double first = 0.0, last = end; // Liang and Barsky: the parameters between which it is inside
    for (int axis = 0; axis < 2; ++axis) {
        if (direction[axis] == 0.0) {
            if (origin[axis] < frame.world.low[axis] || origin[axis] > frame.world.high[axis])
                return std::nullopt;
            continue;
        }
        double const a = (frame.world.low[axis] - origin[axis]) / direction[axis];
        double const b = (frame.world.high[axis] - origin[axis]) / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    if (!(first <= last) || !std::isfinite(last))
        return std::nullopt;
    return std::pair(origin + first * direction, origin + last * direction);
}

std::string axes_svg(Frame const& frame) {
    std::string out;
    double const foot = frame.top + frame.height, end = frame.left + frame.width;
    auto const ticks = [](double low, double high, double most) {
        return round_ticks(1e3 * low, 1e3 * high, std::max(2, static_cast<int>(most)));
    };
    for (double const mm : ticks(frame.world.low.x, frame.world.high.x, frame.width / pixels_per_tick)) {
        double const x = frame.pixel({1e-3 * mm, 0.0}).x;
        out += line({x, frame.top}, {x, foot}, "grid") + line({x, foot}, {x, foot + 5.0}, "axis") +
               text(x, foot + 18.0, "middle", tick_label(mm));
    }
    for (double const mm : ticks(frame.world.low.y, frame.world.high.y, frame.height / pixels_per_row)) {
        double const y = frame.pixel({0.0, 1e-3 * mm}).y;
        out += line({frame.left, y}, {end, y}, "grid") +
               line({frame.left - 5.0, y}, {frame.left, y}, "axis") +
               text(frame.left - 8.0, y + 4.0, "end", tick_label(mm));
    }
    out += "<rect class=\"axis\" x=\"" + coordinate(frame.left) + "\" y=\"" + coordinate(frame.top) +
           "\" width=\"" + coordinate(frame.width) + "\" height=\"" + coordinate(frame.height) + "\"/>\n";
    out += text(frame.left + 0.5 * frame.width, foot + 36.0, "middle name",
                std::string(axis_names[static_cast<std::size_t>(frame.view.right)]) + " (mm)");
    double const middle = frame.top + 0.5 * frame.height;
    out += "<text class=\"middle name\" transform=\"translate(13 " + coordinate(middle) + ") rotate(-90)\">" +
           axis_names[static_cast<std::size_t>(frame.view.up)] + " (mm)</text>\n";
    return out + scale_bar(frame);
}

} // namespace sahl::report
