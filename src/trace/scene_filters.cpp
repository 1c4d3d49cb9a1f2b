#include "trace/scene_filters.h"

#include <utility>

namespace sahl {

PathFilters path_filters(Scene const& scene, WrittenFilter const& log) {
    FilterNames names;
    for (Face const& face : scene.faces)
        names.surfaces.push_back(face.name);
    for (Medium const& medium : scene.media)
        names.media.push_back(medium.name);
    for (SourceSpec const& source : scene.sources)
        names.sources.push_back(source.name);
    auto const made = [&](WrittenFilter const& written) -> std::optional<PathFilter> {
        PathFilter filter(parse_filter(written.text, written.place.text()), names);
        return filter.selects_all() ? std::nullopt : std::optional(std::move(filter));
    };
    PathFilters filters{made(log), {}};
    for (DetectorSpec const& detector : scene.detectors) {
        filters.detectors.push_back(made(detector.where));
        filters.at_detectors = filters.at_detectors || filters.detectors.back();
    }
    return filters;
}

} // namespace sahl
