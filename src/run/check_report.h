// In: a scene that is built. Out: the parts of a check's report as values, and what there is to say of them.
#pragma once

#include "run/check_census.h"
#include "run/health_report.h"

namespace sahl {

struct Checked {
    Scene const& scene;
    WavelengthTable const& optics;
    Emission const& emission;
    Census const& census;
};

Value objects_value(Checked const& checked);
Value media_value(Checked const& checked);
Value sources_value(Checked const& checked);
Value detectors_value(Checked const& checked);
Value contacts_value(Scene const& scene);

/// What pilot rays show: sources that meet nothing, detectors seen from behind, bodies that light cannot
/// enter, rays that are lost. Where a sweep follows, what is not reached yet may be by and by: that is a
/// note.
Remarks census_remarks(Checked const& checked, double leak_limit, bool sweep = false);

} // namespace sahl
