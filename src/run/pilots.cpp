#include "run/pilots.h"

#include "run/values.h"

namespace sahl {

Pilots send_pilots(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
                   TraceOptions const& options) {
    Pilots pilots;
    if (options.polarised == Polarised::automatic)
        pilots.polarisation = polarisation_moves(scene, optics, emission, options);
    pilots.dispersion = dispersions(scene, optics, emission, options);
    return pilots;
}

Value pilots_value(Pilots const& pilots) {
    Value polarisation = nothing();
    if (pilots.polarisation) {
        Array moves;
        for (PolarisationMove const& move : *pilots.polarisation)
            moves.push_back(of(Table{{"what", of(move.what)}, {"share", of(move.share)}}));
        polarisation = of(std::move(moves));
    }
    Table dispersion;
    for (SourceDispersion const& source : pilots.dispersion)
        dispersion.emplace_back(source.source, of(Table{{"turn_rad", of(source.turn)},
                                                        {"sequence_changed", of(source.sequence_changed)}}));
    return of(Table{{"polarisation", std::move(polarisation)}, {"dispersion", of(std::move(dispersion))}});
}

} // namespace sahl
