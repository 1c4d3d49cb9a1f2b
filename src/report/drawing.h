// In: a scene and some of its paths. Out: two drawings of them, as inline SVG with its caption.
#pragma once

#include "report/page.h"

#include <string>
#include <vector>

namespace sahl::report {

/// Bodies as outlines, detectors dashed, sources as rings, rays in the colour of their wavelength, the
/// fainter the less power they carry. A sentence says how much of it all is shown.
///   rays   of the whole run, for that sentence; 0: not known
std::string drawing_html(PageInput const& input, std::uint64_t rays);

} // namespace sahl::report
