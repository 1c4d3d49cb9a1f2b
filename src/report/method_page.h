// In: what each method costs and how far it errs. Out: a page of its own that shows it: the chart and the
// figures under it.
#pragma once

#include "report/method_scatter.h"

#include <string>
#include <vector>

namespace sahl::report {

/// HTML that needs no other file, no network and no script.
///   note   what the errors are held against
std::string method_page(std::vector<ScatterPoint> const& points, std::string const& title,
                        std::string const& note);

} // namespace sahl::report
