// In: segments and the frame they are drawn in. Out: their lines as SVG, and the colours of their wavelengths
// as CSS.
#pragma once

#include "report/frame.h"
#include "trace/segment.h"

#include <string>
#include <vector>

namespace sahl::report {

/// One path element for all lines of one colour and one opacity, the faintest first. Opacity falls with the
/// logarithm of the power: full at the strongest segment, a third less for each factor of ten, never below
/// 0.08.
std::string rays_svg(std::vector<Segment const*> const& segments, Frame const& frame);

/// Rules for the classes that rays_svg and the legend use, for light and dark pages.
std::string ray_colours_css(std::vector<Segment const*> const& segments);

/// A swatch for each wavelength; where there are more than twelve, the shortest and the longest.
std::string wavelength_legend(std::vector<Segment const*> const& segments);

} // namespace sahl::report
