// In: what a drawing is to show, in metres. Out: the frame about it, in metres and in pixels, with its axes.
#pragma once

#include "report/outline.h"

#include <array>
#include <limits>
#include <optional>
#include <string>

namespace sahl::report {

struct Bounds {
    dvec2 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void add(dvec2 const& p); // skips what is not finite
    void add(Outline const& outline);
    bool empty() const { return !(low.x <= high.x); }
    dvec2 size() const { return empty() ? dvec2(0.0) : high - low; }
};

/// The two coordinate planes that show most of something of this size (m), the best first. The y axis points
/// up where there is one; a plane that is much higher than wide is turned.
std::array<View, 2> best_views(dvec3 const& size);

/// Where a drawing stands in its SVG: `world` (m) fills the rectangle from (left, top), all axes to one
/// scale.
struct Frame {
    View view;
    Bounds world;
    double left = 0.0, top = 0.0, width = 0.0, height = 0.0; // pixels
    double scale = 1.0;                                      // pixels per metre
    dvec2 outer{0.0};                                        // pixels, of the drawing with ticks and names

    dvec2 pixel(dvec2 const& p) const {
        return {left + (p.x - world.low.x) * scale, top + (world.high.y - p.y) * scale};
    }
};

/// Height over width of a frame that fits `content` with a margin.
double wanted_height(Bounds const& content);

/// A frame `width` pixels wide, with its axes, over all of `content` with a margin.
///   height   of the drawing proper, as a share of its width
Frame frame_about(View const& view, Bounds content, double width, double height);

/// The part of the ray from `origin` along `direction` up to the parameter `end` (may be infinite) inside the
/// frame.
std::optional<std::pair<dvec2, dvec2>> clipped(Frame const& frame, dvec2 const& origin,
                                               dvec2 const& direction, double end);

/// Border, grid, ticks in mm, names of the axes and a bar of a round length, as SVG.
std::string axes_svg(Frame const& frame);

} // namespace sahl::report
