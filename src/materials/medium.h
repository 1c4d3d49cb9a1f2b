// In: nothing. Out: what a body is made of: its name, its index and its absorption by wavelength.
#pragma once

#include "materials/dispersion.h"

#include <string>
#include <utility>
#include <vector>

namespace sahl {

struct Medium {
    std::string name;
    Dispersion index = ConstantIndex{1.0};
    std::vector<std::pair<double, double>>
        absorption; // wavelength in m ascending, α in 1/m; empty: none; one: constant
    std::pair<double, double> range{0.0, 0.0}; // m, where the formula holds; (0, 0): not stated
};

/// α in 1/m at `wavelength` (m): linear in between, constant beyond the ends, 0 without a table.
double absorption_coefficient(Medium const& medium, double wavelength);

} // namespace sahl
