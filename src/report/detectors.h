// In: the detectors of a summary and the pictures of them. Out: a card for each, picture beside numbers.
#pragma once

#include "report/page.h"

#include <optional>
#include <string>

namespace sahl::report {

/// The first picture whose file is called after the detector, whatever its folder and ending; what a
/// file name must not hold stands in it as an underscore.
std::optional<std::string> picture_of(std::string const& detector, std::vector<std::string> const& pictures);

std::string picture_html(std::string const& detector, std::string const& picture);

/// Empty where the summary has no detectors.
std::string detectors_html(PageInput const& input);

} // namespace sahl::report
