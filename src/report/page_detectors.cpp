// In: what detectors recorded, and the runs of a sweep. Out: both as the page shows them. See page_data.h.
#include "report/page_data.h"

#include <algorithm>

namespace sahl::report {

namespace {

char const* name_of(DetectorKind kind) {
    return kind == DetectorKind::rectangle ? "rectangle"
           : kind == DetectorKind::sphere  ? "sphere"
                                           : "surface";
}

void write_recorded(JsonText& json, PageDetector const& recorded) {
    if (!recorded.irradiance.empty())
        json.entry("columns", recorded.columns)
            .entry("rows", recorded.rows)
            .entry("pixels_in_one", recorded.pixels_in_one)
            .array("irradiance", recorded.irradiance);
    if (!recorded.encircled_mm.empty())
        json.array("encircled_mm", recorded.encircled_mm);
    if (!recorded.far_field.intensities.empty())
        json.key("far_field")
            .open('{')
            .entry("rings", recorded.far_field.rings)
            .entry("sectors", recorded.far_field.sectors)
            .entry("largest_deg", recorded.far_field.largest_deg)
            .array("W_per_sr", recorded.far_field.intensities)
            .close('}');
    if (!recorded.optical_path.powers.empty())
        json.key("optical_path")
            .open('{')
            .entry("from_mm", recorded.optical_path.from_mm)
            .entry("to_mm", recorded.optical_path.to_mm)
            .array("powers_W", recorded.optical_path.powers)
            .close('}');
}

/// The parts of a run's summary that a sweep is looked at by.
void write_row(JsonText& json, SweepRow const& row) {
    json.open('{').key("values").open('[');
    for (Value const& value : row.values)
        json.value(value);
    json.close(']');
    for (char const* key : {"energy_W", "escaped_direction", "passed"})
        if (Value const* const found = row.summary.find(key))
            json.entry(key, *found);
    json.key("detectors").open('{');
    if (Value const* const detectors = row.summary.find("detectors"))
        if (auto const* table = std::get_if<Table>(&detectors->data))
            for (auto const& [name, figures] : *table) {
                json.key(name).open('{');
                if (auto const* entries = std::get_if<Table>(&figures.data))
                    for (auto const& [key, value] : *entries)
                        if (!key.starts_with("by_"))
                            json.entry(key, value);
                json.close('}');
            }
    json.close('}').close('}');
}

} // namespace

void write_detectors(JsonText& json, Scene const& scene, std::vector<PageDetector> const& recorded) {
    json.key("detectors").open('[');
    for (DetectorSpec const& spec : scene.detectors) {
        json.open('{')
            .entry("name", spec.name)
            .entry("kind", name_of(spec.kind))
            .entry("absorbs", spec.absorbs);
        json.entry("back", spec.back).entry("where", spec.where.text);
        json.key("at_mm").value(spec.to_world.offset, 1e3);
        if (spec.kind == DetectorKind::rectangle) {
            json.key("x")
                .value(normalize(spec.to_world.linear[0]))
                .key("y")
                .value(normalize(spec.to_world.linear[1]));
            json.key("size_mm").open('[').value(1e3 * spec.size.x).value(1e3 * spec.size.y).close(']');
        }
        if (spec.kind == DetectorKind::sphere)
            json.entry("radius_mm", 1e3 * spec.radius);
        if (!spec.surface.empty())
            json.entry("surface", spec.surface);
        auto const found = std::find_if(recorded.begin(), recorded.end(),
                                        [&](PageDetector const& d) { return d.name == spec.name; });
        if (found != recorded.end())
            write_recorded(json, *found);
        json.close('}');
    }
    json.close(']');
}

void write_sweep(JsonText& json, std::vector<std::string> const& keys, std::vector<SweepRow> const& rows) {
    if (keys.empty())
        return;
    json.key("sweep").open('{').key("keys").open('[');
    for (std::string const& key : keys)
        json.value(key);
    json.close(']').key("rows").open('[');
    for (SweepRow const& row : rows)
        write_row(json, row);
    json.close(']').close('}');
}

} // namespace sahl::report
