// In: what a page is to show. Out: its parts as JSON. Lengths are in mm, wavelengths in nm.
#pragma once

#include "report/json_text.h"
#include "report/page.h"

namespace sahl::report {

void write_names(JsonText& json, LogHeader const& names);
void write_rays(JsonText& json, PagePaths const& paths, LogHeader const& names);
void write_bodies(JsonText& json, Scene const& scene);
void write_detectors(JsonText& json, Scene const& scene, std::vector<PageDetector> const& recorded);
void write_sweep(JsonText& json, std::vector<std::string> const& keys, std::vector<SweepRow> const& rows);

} // namespace sahl::report
