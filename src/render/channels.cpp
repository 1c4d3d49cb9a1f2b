#include "render/channels.h"

#include "materials/colour.h"

#include <algorithm>

namespace sahl {

bool is_coloured(Scene const& scene, Interface const& interface) {
    if (!interface.surface)
        return false;
    auto const& kind = scene.surfaces[interface.surface->value].kind;
    return std::holds_alternative<Metal>(kind) || std::holds_alternative<Tinted>(kind) ||
           std::holds_alternative<ThinWall>(kind);
}

ColouredBranches coloured_branches(Scene const& scene, WavelengthTable const& optics,
                                   Interface const& interface, dvec3 const& direction, MediumId medium,
                                   Channels const& channels) {
    ColouredBranches all;
    std::optional<Outgoing> back, across;
    for (int c = 0; c < 3; ++c) {
        Branches const branches = interact(scene, optics, interface, direction, medium,
                                           channels[static_cast<std::size_t>(c)], {0, 0, 0});
        for (Outgoing const& outgoing : branches.outgoing) {
            (outgoing.crosses ? all.across : all.back)[c] = outgoing.share;
            auto& one = outgoing.crosses ? across : back;
            if (!one)
                one = outgoing;
        }
    }
    if (across)
        all.outgoing.push_back(*across);
    if (back)
        all.outgoing.push_back(*back);
    return all;
}

void tint(ColouredBranches& branches, Scene const& scene, WavelengthTable const& optics,
          Interface const& interface, Channels const& channels, dvec3 const& colour) {
    auto const& kind = scene.surfaces[interface.surface->value].kind;
    Colour mirrored{0.0, 0.0, 0.0};
    if (auto const* const boundary = std::get_if<Tinted>(&kind))
        mirrored = boundary->mirrored;
    else if (auto const* const wall = std::get_if<ThinWall>(&kind))
        mirrored = wall->mirrored;
    for (int c = 0; c < 3; ++c) {
        double const wavelength = optics.wavelengths()[channels[static_cast<std::size_t>(c)].value];
        double const here = at_wavelength({colour.x, colour.y, colour.z}, wavelength);
        branches.across[c] *= here;
        branches.back[c] =
            std::max(0.0, branches.back[c] - at_wavelength(mirrored, wavelength) * (1.0 - here));
    }
}

} // namespace sahl
