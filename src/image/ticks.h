// In: the range of an axis. Out: the round numbers to mark on it, and how to write them.
#pragma once

#include <string>
#include <vector>

namespace sahl {

/// The whole multiples, within [low, high], of the smallest 1, 2 or 5 times a power of ten that gives no more
/// than `most`.
std::vector<double> round_ticks(double low, double high, int most);

/// The powers of ten within [low, high], 0 < low < high; with their multiples by 2 to 9 where `minor`.
std::vector<double> decade_ticks(double low, double high, bool minor);

/// A finite number to `digits` digits, 6 at most, with a true minus and a short exponent: −0.25, 3700, 1e-5,
/// 2e6.
std::string tick_label(double value, int digits = 6);

} // namespace sahl
