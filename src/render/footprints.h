// In: the trees of camera rays, as they grow. Out: for each branch, what its sample stands for on the surface
// that it meets.
#pragma once

#include "render/footprint.h"
#include "trace/tree_watch.h"
#include "trace/wavelengths.h"

#include <vector>

namespace sahl {

/// Carries the footprints of a group's branches along, generation by generation, as a TreeWatch is told of
/// them.
class Footprints {
  public:
    Footprints(Scene const& scene, WavelengthTable const& optics) : scene_(scene), optics_(optics) {}

    void plant(std::vector<Footprint> roots);
    /// Branch `number` meets a surface: its footprint there, whose places lie in the surface's plane.
    ///   interface   must stay until the branch's children are pushed
    Footprint const& meet(std::size_t number, Branch const& branch, Interface const& interface,
                          WavelengthId wavelength);
    /// Of branch `number` at its start.
    Footprint const& of(std::size_t number) const { return now_[number]; }
    /// A child of the branch that met a surface last.
    void push(Outgoing const& outgoing);
    void next_generation();

  private:
    struct Bend {
        dvec3 normal{0.0};
        dmat3 turning{0.0}; // 1/m, dn = turning · dx along the surface
    };
    Bend bend_of(Outgoing const& outgoing, double n_leaves) const;

    Scene const& scene_;
    WavelengthTable const& optics_;
    std::vector<Footprint> now_, next_;
    // the branch that met a surface last: its footprint there, and what it met
    Footprint here_;
    Interface const* interface_ = nullptr;
    dvec3 direction_{0.0};
    double n_incident_ = 1.0;
    WavelengthId wavelength_{};
};

} // namespace sahl
