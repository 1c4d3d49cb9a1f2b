// In: an interface and a ray that meets it. Out: the branches that leave it, with their shares of the power.
#pragma once

#include "scene/interface.h"
#include "trace/event.h"
#include "trace/wavelengths.h"

namespace sahl {

struct Outgoing {
    dvec3 direction{0.0};
    double share = 0.0; // of the power that arrives
    Event event = Event::none;
    bool crosses = false;     // to the other side
    double power = 0.0;       // W, once it is chosen which branches go on
    Event fate = Event::none; // cut_power: it ends where it begins
};

/// Refracted before reflected. For surfaces that absorb, `absorbed` is their share, found on its own and not
/// as what is left: so a ledger can tell an absorber from an error.
struct Branches {
    InlineVector<Outgoing, 2> outgoing;
    double absorbed = 0.0;
    Event ended = Event::none;
    bool by_facet = false; // the interface's facet_normal held, where its normal would have sent light astray
};

/// Random numbers for one interaction; only a diffuse surface draws.
struct Draw {
    std::uint64_t seed, ray, place;
};

Branches interact(Scene const& scene, WavelengthTable const& optics, Interface const& interface,
                  dvec3 const& direction, MediumId medium, WavelengthId wavelength, Draw const& draw);

} // namespace sahl
