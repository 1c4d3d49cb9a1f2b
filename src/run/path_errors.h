// In: the same rays traced twice. Out: how far their directions differ, where they meet the same sequence of
// events.
#pragma once

#include "trace/tracer.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

/// Whole trees of some rays; what carries less than a hundredth of its ray is left out.
using Trees = std::vector<std::vector<Segment>>;

/// `count` rays of each source, evenly spread.
///   shift   0 … 1: where between two that are traced the first one lies, so that others are seen
std::vector<std::uint64_t> spread_rays(Emission const& emission, std::uint64_t count, double shift);

Trees trees_of(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
               TraceOptions const& options, std::span<std::uint64_t const> rays);

struct PathErrors {
    double greatest = 0.0,
           rms = 0.0;     // rad, over all segments beyond the first of each ray whose events are the same
    double leaving = 0.0; // rad, RMS of the segments among these that escape or arrive at a detector
    std::uint64_t segments = 0;
    std::uint64_t rays = 0, changed = 0; // whose sequence of events is not the same
    std::vector<double> by_ray;          // the greatest of each, −1 where its events are others
    /// The greatest, lengthened as the tail of the distribution grows: what few rays among a thousand exceed.
    double tail() const;
    double changed_share() const {
        return rays ? static_cast<double>(changed) / static_cast<double>(rays) : 0.0;
    }
};

/// `same_faces`: surfaces have the same numbers in both.
PathErrors compare_paths(Trees const& one, Trees const& other, bool same_faces);

} // namespace sahl
