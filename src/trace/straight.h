// In: a place in a scene and a lamp. Out: the interfaces between the two, on a line that nothing bends.
#pragma once

#include "scene/interface.h"

namespace sahl {

/// Where a line starts: on a surface, on the side from which that was met.
struct StraightStart {
    dvec3 origin{0.0};
    std::optional<ObjectId> body; // whose medium the line begins in
    ShellSet inside;
    LeftSheets left;

    /// The side that `interface` was met from.
    explicit StraightStart(Interface const& interface)
        : origin(interface.point), body(interface.body_before), inside(interface.inside_before),
          left(interface.left_by(false)) {}
};

/// Goes from interface to interface up to `distance` (m, may be infinite) as though none turned light.
///   visit(interface, medium)   `medium` is the one before it, its t the length of the piece; false: that is
///                              enough
///   last(medium, length)       the piece that ends at the lamp
///   interface                  is written over: it is large, and made once by who asks often
/// Returns whether the lamp was reached.
template <class Visit, class Last>
bool straight_on(Scene const& scene, StraightStart at, dvec3 const& direction, double distance,
                 Interface& interface, Visit visit, Last last) {
    for (;;) {
        Meeting const meeting =
            next_interface(scene, at.origin, direction, at.inside, at.body, at.left, interface);
        MediumId const medium = medium_of(scene, at.body);
        if (meeting == Meeting::leak || meeting == Meeting::too_deep)
            return false;
        if (meeting == Meeting::nothing || interface.t >= distance) {
            last(medium, distance);
            return true;
        }
        if (!visit(interface, medium))
            return false;
        distance -= interface.t;
        at.origin = interface.point;
        at.body = interface.body_after;
        at.inside = interface.inside_after;
        at.left = interface.left_by(true);
    }
}

} // namespace sahl
