// In: a scene and some of its paths. Out: two drawings of them, as inline SVG with its caption.
#pragma once

#include "report/page.h"

#include <string>
#include <vector>

namespace sahl::report {

/// Of the segments of a log, those of every n-th ray, so that they are at most `most`; of a lone ray with
/// more than that the first ones. Returned in their order.
struct Sample {
    std::vector<Segment const*> segments;
    std::uint64_t rays = 0;
};
Sample sample_of(std::vector<Segment> const& paths, std::size_t most);

/// Bodies as outlines, detectors dashed, sources as rings, rays in the colour of their wavelength, the
/// fainter the less power they carry. A sentence says how much of it all is shown.
///   rays   of the whole run, for that sentence; 0: not known
std::string drawing_html(PageInput const& input, std::uint64_t rays);

} // namespace sahl::report
