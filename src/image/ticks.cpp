// In: the range of an axis. Out: the round numbers to mark on it. Bounds count as inside to within rounding.
#include "image/ticks.h"

#include <cmath>
#include <cstdio>

namespace sahl {
namespace {

constexpr double slack = 1e-9; // of a step: far above rounding, far below what can be seen

} // namespace

std::vector<double> round_ticks(double low, double high, int most) {
    double const least_step = (high - low) / most;
    double const power = std::pow(10.0, std::floor(std::log10(least_step)));
    double step = power;
    for (double const factor : {2.0, 5.0, 10.0})
        if (step < least_step * (1 - slack))
            step = factor * power;
    std::vector<double> ticks;
    for (double k = std::ceil(low / step - slack); k <= high / step + slack; ++k)
        ticks.push_back(k * step);
    return ticks;
}

std::vector<double> decade_ticks(double low, double high, bool minor) {
    std::vector<double> ticks;
    for (double power = std::floor(std::log10(low)); std::pow(10.0, power) <= high * (1 + slack); ++power) {
        for (int m = 1; m <= (minor ? 9 : 1); ++m) {
            double const tick = m * std::pow(10.0, power);
            if (tick >= low * (1 - slack) && tick <= high * (1 + slack))
                ticks.push_back(tick);
        }
    }
    return ticks;
}

std::string tick_label(double value, int digits) {
    double const unit =
        value == 0.0 ? 1.0 : std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - digits);
    double const rounded = std::round(value / unit) * unit;
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", rounded == 0.0 ? 0.0 : rounded); // no −0
    std::string label = text;
    if (std::size_t const e = label.find('e'); e != std::string::npos) {
        std::size_t const first = label.find_first_not_of("+-0", e + 1);
        label = label.substr(0, e + 1) + (label[e + 1] == '-' ? "-" : "") + label.substr(first);
    }
    return label.front() == '-' ? "−" + label.substr(1) : label;
}

} // namespace sahl
