// In: nothing. Out: the rows of the built-in catalogue as their makers print them; written by
// scripts/write_catalogue.py.
#pragma once

#include <span>

namespace sahl {

struct GlassRow {
    struct Extinction {
        double um, k;
    };
    char const *maker, *name;
    int formula; // 1, 2, 3: n² = …; see materials/catalogue.cpp
    double from_um, to_um;
    double nd, vd; // 0: not given
    std::span<double const> coefficients;
    std::span<Extinction const> extinction; // ascending; may be empty
};

struct MetalRow {
    struct Point {
        double um, n, k;
    };
    char const* name;
    std::span<Point const> points; // ascending
};

std::span<GlassRow const> glass_rows();
std::span<MetalRow const> metal_rows();

} // namespace sahl
