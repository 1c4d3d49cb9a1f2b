// In: nothing. Out: the pieces of path that a batch of rays leaves behind, as the log keeps them, in SI
// units.
#pragma once

#include "math/vec.h"
#include "trace/event.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sahl {

/// A straight piece of path from where it is born to where it ends.
struct Segment {
    std::uint64_t ray = 0;
    std::uint32_t index = 0;  // in the ray's tree: breadth first, then by parent, refracted before reflected
    std::int32_t parent = -1; // index of the parent, −1 for the root
    std::uint16_t depth = 0;  // interactions so far
    Event born = Event::none, ended = Event::none;
    std::int32_t surface = -1;                 // FaceId it ends on, −1: nothing
    std::int32_t primitive = -1;               // triangle, −1: none
    std::uint16_t medium = 0;                  // MediumId it runs through
    std::uint16_t source = 0;                  // SourceId
    double wavelength = 0.0;                   // m, in standard air
    dvec3 origin{0.0};                         // m
    dvec3 direction{0.0};                      // unit
    double length = 0.0;                       // m, inf if it escapes
    double optical_path = 0.0;                 // m, from the source to its end; inf if it escapes
    double power_start = 0.0, power_end = 0.0; // W, before and after absorption on the way
    double digits_lost = 0.0;                  // at its end, where that is followed
};

/// Takes the segments of rays with consecutive numbers, portion by portion in the order of the log: by ray,
/// then by index.
class SegmentSink {
  public:
    virtual void take(std::span<Segment const> segments) = 0;

  protected:
    ~SegmentSink() = default;
};

/// Keeps them all.
struct SegmentBatch final : SegmentSink {
    std::vector<Segment> segments;
    void take(std::span<Segment const> more) override {
        segments.insert(segments.end(), more.begin(), more.end());
    }
};

} // namespace sahl
