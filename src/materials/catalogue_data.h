// In: nothing. Out: the rows of the built-in catalogue as their makers print them; written by
// scripts/write_catalogue.py.
#pragma once

#include <span>

namespace sahl {

struct GlassRow {
    char const *maker, *name;
    int formula;   // as page_formula numbers them (materials/formulas.h)
    bool absolute; // index relative to vacuum, wavelength in vacuum
    double from_um, to_um;
    double nd, vd; // 0: not given
    std::span<double const> coefficients;
    std::span<double const> um, k; // extinction; ascending, as many of each; may be empty
};

struct MetalRow {
    char const* name;
    std::span<double const> um, n, k; // ascending, as many of each
};

std::span<GlassRow const> glass_rows();
std::span<MetalRow const> metal_rows();

} // namespace sahl
