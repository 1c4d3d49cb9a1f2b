// In: a scene and some of its paths. Out: what of it is drawn, and how much room that takes.
#pragma once

#include "scene/scene.h"
#include "trace/segment.h"

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

/// Where a source stands; of given rays, where the first one starts.
struct SourceMark {
    std::string name;
    dvec3 at;
};
std::vector<SourceMark> source_marks(Scene const& scene);

/// What the drawings have to hold besides the outlines: where rays start, where their segments begin and end.
/// Left out is what lies further away than twice the size of all bodies and starts, as where a faint ray
/// grazes a plane without end: it would make all else a dot.
struct Content {
    std::vector<dvec3> points;
    dvec3 size{0.0}; // with the bodies
};

/// The first `bodies` bodies count.
Content content_of(Scene const& scene, std::size_t bodies, Sample const& sample);

} // namespace sahl::report
