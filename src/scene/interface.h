// In: the crossings at one place. Out: the one interface they form, from a medium before to a medium after.
#pragma once

#include "scene/scene.h"

#include <vector>

namespace sahl {

/// A piece of the way that lies in another body of the same medium than the one that follows.
struct Stretch {
    double end; // t
    std::optional<ObjectId> body;
};

/// At a face that a detector watches, whoever's surface decides what happens there.
struct Arrival {
    FaceId face;
    double t;
    dvec3 point;
    bool inside; // from inside its body; of an open surface: from the side away from its +z
};

struct Interface {
    dvec3 point{0.0};
    dvec3 normal{0.0}; // unit, facing: its dot product with the direction is ≤ 0 (unless interpolated)
    dvec3 facet_normal{0.0}; // the same of the flat triangle
    double t = 0.0;
    FaceId face;
    std::int32_t primitive = -1;
    std::optional<SurfaceId> surface;   // none: a clean boundary
    std::optional<DetectorId> detector; // it is one
    bool recovered = false;             // what was met on the way there is so to within rounding alone
    bool against_facing = false;        // the light comes against the open surface's +z
    std::optional<ObjectId> body_before, body_after;
    InlineVector<Stretch, 8>
        on_the_way;                // bodies left in silence; more than fit count as the one that follows
    std::vector<Arrival> arrivals; // on the way too
    MediumId medium_after;
    ShellSet inside_before, inside_after; // on either side of it
    // open surfaces at this place, and the side that the ray comes from; from `newly` on those that it meets
    // now
    LeftSheets left;
    std::size_t newly = 0;

    /// Open surfaces not to be met again by a ray that goes on from here, to the other side or not.
    LeftSheets left_by(bool crosses) const {
        LeftSheets sheets = left;
        for (std::size_t i = crosses ? newly : sheets.size(); i < sheets.size(); ++i)
            sheets[i].above = !sheets[i].above;
        return sheets;
    }
};

enum class Meeting : std::uint8_t { interface, nothing, leak, too_deep };

/// The next place where something happens: crossings between equal media without a surface are passed in
/// silence.
///   inside   the shells that the ray is in; body: the one whose medium it runs through, body_at(scene,
///   inside)
///   ahead    what Bvh::look_ahead saw of this ray, if it was asked
/// `found` is written if the answer is `interface`, its arrivals always, its t also after a leak.
Meeting next_interface(Scene const& scene, dvec3 const& origin, dvec3 const& direction,
                       ShellSet const& inside, std::optional<ObjectId> body, LeftSheets const& left,
                       Interface& found, SeenAhead const* ahead = nullptr);

} // namespace sahl
