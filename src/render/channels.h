// In: the wavelengths of a picture. Out: what red, green and blue light become between two interfaces and at
// one.
#pragma once

#include "trace/interact.h"

#include <array>
#include <cmath>

namespace sahl {

/// The wavelength at which each of the three colours is traced; all the same where a tree is of one
/// wavelength.
using Channels = std::array<WavelengthId, 3>;

/// Beer–Lambert's law for each colour. length   m
inline dvec3 absorbed_on_way(WavelengthTable const& optics, MediumId medium, Channels const& channels,
                             double length) {
    dvec3 const alpha(optics.absorption(medium, channels[0]), optics.absorption(medium, channels[1]),
                      optics.absorption(medium, channels[2]));
    if (alpha == dvec3(0.0))
        return dvec3(1.0);
    return {std::exp(-alpha.x * length), std::exp(-alpha.y * length), std::exp(-alpha.z * length)};
}

/// Does this surface treat wavelengths differently?
bool is_coloured(Scene const& scene, Interface const& interface);

/// What goes on from an interface, for each colour: refracted before reflected, at most one each.
struct ColouredBranches {
    InlineVector<Outgoing, 2> outgoing;
    dvec3 back{0.0}, across{0.0}; // shares
};
ColouredBranches coloured_branches(Scene const& scene, WavelengthTable const& optics,
                                   Interface const& interface, dvec3 const& direction, MediumId medium,
                                   Channels const& channels);

/// A picture's colour where the surface has one: it multiplies what glass lets through and what metal
/// mirrors, as the base colour does (glTF 2.0, KHR_materials_transmission).
void tint(ColouredBranches& branches, Scene const& scene, WavelengthTable const& optics,
          Interface const& interface, Channels const& channels, dvec3 const& colour);

} // namespace sahl
