#include "report/drawing.h"

#include "report/content.h"
#include "report/frame.h"
#include "report/html.h"
#include "report/labels.h"
#include "report/rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sahl::report {

namespace {

constexpr std::size_t most_segments = 6000, most_bodies = 300;

std::optional<Outline> outline_of(Body const& body, View const& view) {
    if (body.shape)
        return outline_of(*body.shape, body.to_world, view);
    if (body.mesh)
        return outline_of(*body.mesh, body.to_world, view);
    return std::nullopt;
}

/// Points nearer than half a pixel to the last are left out; loops that a pixel covers are nothing.
std::string path_of(Polyline const& line, Frame const& frame, bool closed) {
    std::string path;
    dvec2 last(0.0), low(INFINITY), high(-INFINITY);
    for (std::size_t i = 0; i < line.size(); ++i) {
        dvec2 const p = frame.pixel(line[i]);
        low = glm::min(low, p);
        high = glm::max(high, p);
        if (!path.empty() && length(p - last) < 0.5 && (closed || i + 1 < line.size()))
            continue;
        path += (path.empty() ? "M" : "L") + coordinate(p.x) + " " + coordinate(p.y);
        last = p;
    }
    return length(high - low) < 1.0 ? std::string() : path + (closed ? "Z" : "");
}

std::string body_svg(Body const& body, Outline const& outline, Frame const& frame) {
    std::string area, lines;
    for (Polyline const& loop : outline.area)
        area += path_of(loop, frame, true);
    for (Polyline const& line : outline.lines)
        lines += path_of(line, frame, false);
    if (outline.endless) {
        auto const& [point, direction] = *outline.endless;
        auto const ahead = clipped(frame, point, direction, INFINITY),
                   behind = clipped(frame, point, -direction, INFINITY);
        for (auto const& part : {ahead, behind})
            if (part)
                lines += path_of({part->first, part->second}, frame, false);
    }
    char const* const kind = body.detector ? "detector" : body.open ? "sheet" : "body";
    std::string out = "<g class=\"" + std::string(kind) + "\"><title>" + escaped(body.name) + "</title>";
    if (!area.empty())
        out += "<path class=\"area\" d=\"" + area + "\"/>";
    if (!lines.empty())
        out += "<path d=\"" + lines + "\"/>";
    return out + "</g>\n";
}

struct Drawn {
    Frame frame;
    Bounds content;
    std::vector<std::pair<Body const*, Outline>> bodies;
};

Drawn outlined(Scene const& scene, std::size_t bodies, Content const& content, View const& view) {
    Drawn drawn;
    drawn.frame.view = view;
    for (std::size_t i = 0; i < bodies; ++i)
        if (auto outline = outline_of(scene.bodies[i], view)) {
            drawn.content.add(*outline);
            drawn.bodies.emplace_back(&scene.bodies[i], std::move(*outline));
        }
    for (dvec3 const& p : content.points)
        drawn.content.add(view(p));
    return drawn;
}

/// Two flat drawings stand one above the other, over the page's whole width; others side by side, equally
/// high. Returns whether they are flat.
bool set_frames(std::array<Drawn, 2>& drawings) {
    std::array<double, 2> const heights{wanted_height(drawings[0].content),
                                        wanted_height(drawings[1].content)};
    bool const flat = std::max(heights[0], heights[1]) < 0.6;
    for (std::size_t i = 0; i < 2; ++i)
        drawings[i].frame =
            flat ? frame_about(drawings[i].frame.view, drawings[i].content, 1120.0, std::max(heights[i], 0.2))
                 : frame_about(drawings[i].frame.view, drawings[i].content, 550.0,
                               std::min(std::max(heights[0], heights[1]), 0.9));
    return flat;
}

std::string figure_html(Scene const& scene, Drawn const& drawn, Sample const& sample,
                        std::string const& css) {
    Frame const& frame = drawn.frame;
    std::string bodies, sources;
    std::vector<Label> labels;
    for (auto const& [body, outline] : drawn.bodies) {
        bodies += body_svg(*body, outline, frame);
        Bounds bounds;
        bounds.add(outline);
        if (!bounds.empty()) {
            dvec2 const a = frame.pixel(bounds.low), b = frame.pixel(bounds.high);
            labels.push_back(
                {body->name, {glm::min(a, b), glm::max(a, b)}, body->detector ? "of-detector" : "of-body"});
        }
    }
    for (SourceMark const& mark : source_marks(scene)) {
        dvec2 const p = frame.pixel(frame.view(mark.at));
        sources += "<circle class=\"source\" cx=\"" + coordinate(p.x) + "\" cy=\"" + coordinate(p.y) +
                   "\" r=\"4\"><title>" + escaped(mark.name) + "</title></circle>\n";
        labels.push_back({mark.name, {p - 5.0, p + 5.0}, "of-source"});
    }
    dvec3 const viewer = frame.view.towards_viewer();
    int const away = 3 - frame.view.right - frame.view.up;
    std::string const seen_from = std::string(viewer[away] > 0.0 ? "+" : "−") + "xyz"[away];
    return "<figure><svg viewBox=\"0 0 " + coordinate(frame.outer.x) + " " + coordinate(frame.outer.y) +
           "\" role=\"img\" aria-label=\"The scene seen from " + seen_from + "\">\n" +
           (css.empty() ? "" : "<style>" + css + "</style>\n") + axes_svg(frame) + bodies +
           rays_svg(sample.segments, frame) + sources +
           labels_svg(labels,
                      {{frame.left, frame.top}, {frame.left + frame.width, frame.top + frame.height}}) +
           "</svg><figcaption>Seen from " + seen_from + "</figcaption></figure>\n";
}

std::string caption(PageInput const& input, Sample const& sample, std::size_t bodies, std::uint64_t rays) {
    std::string out = "<p class=\"note\">";
    bool const all_paths = sample.segments.size() == input.paths.size();
    std::uint64_t const drawn = all_paths && input.rays_shown > 0 ? input.rays_shown : sample.rays;
    if (sample.segments.empty())
        out += "No paths were kept to be drawn.";
    else
        out += count(drawn) + (rays >= drawn ? " of " + count(rays) : "") + " rays drawn, " +
               count(sample.segments.size()) + " segments. The fainter a line, the less power it carries.";
    if (bodies < input.scene.bodies.size())
        out +=
            " The first " + count(bodies) + " of " + count(input.scene.bodies.size()) + " bodies are drawn.";
    if (!input.sweep_keys.empty())
        out += " The first run of the sweep is shown.";
    return out + "</p>\n";
}

} // namespace

std::string drawing_html(PageInput const& input, std::uint64_t rays) {
    Sample const sample = sample_of(input.paths, most_segments);
    std::size_t const bodies = std::min(input.scene.bodies.size(), most_bodies);
    Content const content = content_of(input.scene, bodies, sample);
    auto const views = best_views(content.size);
    std::array<Drawn, 2> drawings{outlined(input.scene, bodies, content, views[0]),
                                  outlined(input.scene, bodies, content, views[1])};
    bool const flat = set_frames(drawings);
    std::string css = ray_colours_css(sample.segments); // once: it holds for the whole page
    std::string out = std::string("<div class=\"") + (flat ? "views flat" : "views") + "\">\n";
    for (Drawn const& drawn : drawings)
        out += figure_html(input.scene, drawn, sample, std::exchange(css, ""));
    return out + "</div>\n" + wavelength_legend(sample.segments) + caption(input, sample, bodies, rays);
}

} // namespace sahl::report
