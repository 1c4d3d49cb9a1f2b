#include "optics/colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sahl {

namespace {

constexpr double second_radiation_constant = 1.438776877e-2; // m K, CODATA 2018

constexpr double d65_first_nm = 300.0, d65_step_nm = 10.0;
// clang-format off
constexpr std::array<double, 54> d65{
    0.0341, 3.2945, 20.236, 37.0535, 39.9488, 44.9117, 46.6383, 52.0891, 49.9755, 54.6482, 82.7549, 91.486, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923, 108.811, 109.354, 107.802, 104.79, 107.689, 104.405, 104.046, 100.0, 96.3342, 95.788, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349, 61.604, 69.8856, 75.087, 63.5927, 46.4182, 66.8054, 63.3828, 64.304, 59.4519, 51.959, 57.4406, 60.3125};

constexpr double observer_first_nm = 380.0, observer_step_nm = 5.0;
constexpr std::array<std::array<double, 3>, 81> observer{{
    {0.001368, 0.000039, 0.006450},
    {0.002236, 0.000064, 0.010550},
    {0.004243, 0.00012, 0.02005},
    {0.00765, 0.000217, 0.03621},
    {0.01431, 0.000396, 0.06785},
    {0.02319, 0.00064, 0.1102},
    {0.04351, 0.00121, 0.2074},
    {0.07763, 0.00218, 0.3713},
    {0.13438, 0.004, 0.6456},
    {0.21477, 0.0073, 1.03905},
    {0.2839, 0.0116, 1.3856},
    {0.3285, 0.01684, 1.62296},
    {0.34828, 0.023, 1.74706},
    {0.34806, 0.0298, 1.7826},
    {0.3362, 0.038, 1.77211},
    {0.3187, 0.048, 1.7441},
    {0.2908, 0.06, 1.6692},
    {0.2511, 0.0739, 1.5281},
    {0.19536, 0.09098, 1.28764},
    {0.1421, 0.1126, 1.0419},
    {0.09564, 0.13902, 0.81295},
    {0.05795, 0.1693, 0.6162},
    {0.03201, 0.20802, 0.46518},
    {0.0147, 0.2586, 0.3533},
    {0.0049, 0.323, 0.272},
    {0.0024, 0.4073, 0.2123},
    {0.0093, 0.503, 0.1582},
    {0.0291, 0.6082, 0.1117},
    {0.06327, 0.71, 0.07825},
    {0.1096, 0.7932, 0.05725},
    {0.1655, 0.862, 0.04216},
    {0.22575, 0.91485, 0.02984},
    {0.2904, 0.954, 0.0203},
    {0.3597, 0.9803, 0.0134},
    {0.43345, 0.99495, 0.00875},
    {0.51205, 1.0, 0.00575},
    {0.5945, 0.995, 0.0039},
    {0.6784, 0.9786, 0.00275},
    {0.7621, 0.952, 0.0021},
    {0.8425, 0.9154, 0.0018},
    {0.9163, 0.87, 0.00165},
    {0.9786, 0.8163, 0.0014},
    {1.0263, 0.757, 0.0011},
    {1.0567, 0.6949, 0.001},
    {1.0622, 0.631, 0.0008},
    {1.0456, 0.5668, 0.0006},
    {1.0026, 0.503, 0.00034},
    {0.9384, 0.4412, 0.00024},
    {0.85445, 0.381, 0.00019},
    {0.7514, 0.321, 0.0001},
    {0.6424, 0.265, 0.00005},
    {0.5419, 0.217, 0.00003},
    {0.4479, 0.175, 0.00002},
    {0.3608, 0.1382, 0.00001},
    {0.2835, 0.107, 0.0},
    {0.2187, 0.0816, 0.0},
    {0.1649, 0.061, 0.0},
    {0.1212, 0.04458, 0.0},
    {0.0874, 0.032, 0.0},
    {0.0636, 0.0232, 0.0},
    {0.04677, 0.017, 0.0},
    {0.0329, 0.01192, 0.0},
    {0.0227, 0.00821, 0.0},
    {0.01584, 0.005723, 0.0},
    {0.011359, 0.004102, 0.0},
    {0.008111, 0.002929, 0.0},
    {0.00579, 0.002091, 0.0},
    {0.004109, 0.001484, 0.0},
    {0.002899, 0.001047, 0.0},
    {0.002049, 0.00074, 0.0},
    {0.00144, 0.00052, 0.0},
    {0.001, 0.000361, 0.0},
    {0.00069, 0.000249, 0.0},
    {0.000476, 0.000172, 0.0},
    {0.000332, 0.00012, 0.0},
    {0.000235, 0.000085, 0.0},
    {0.000166, 0.00006, 0.0},
    {0.000117, 0.000042, 0.0},
    {0.000083, 0.00003, 0.0},
    {0.000059, 0.000021, 0.0},
    {0.000042, 0.000015, 0.0},
}};
// clang-format on

/// Place `x` of a table whose entries stand at 0, 1, …: between the two beside it; nothing outside.
template <class Entry, class Table>
Entry between(Table const& table, double x, Entry nothing,
              Entry (*entry)(typename Table::value_type const&)) {
    auto const last = static_cast<double>(table.size() - 1);
    if (std::abs(x - last) < 1e-12) // nm to m and back
        x = last;
    if (std::abs(x) < 1e-12)
        x = 0.0;
    if (!(x >= 0.0 && x <= last))
        return nothing;
    auto const below = static_cast<std::size_t>(std::min(std::floor(x), last - 1.0));
    double const share = x - static_cast<double>(below);
    return (1.0 - share) * entry(table[below]) + share * entry(table[below + 1]);
}

double number(double const& x) {
    return x;
}

dvec3 vector(std::array<double, 3> const& x) {
    return {x[0], x[1], x[2]};
}

double encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

} // namespace

double black_body(double wavelength, double temperature) {
    double const x = second_radiation_constant / (wavelength * temperature);
    return std::pow(wavelength * 1e9, -5.0) / std::expm1(x);
}

double illuminant_d65(double wavelength) {
    return between<double>(d65, (wavelength * 1e9 - d65_first_nm) / d65_step_nm, 0.0, number);
}

dvec3 colour_matching(double wavelength) {
    return between<dvec3>(observer, (wavelength * 1e9 - observer_first_nm) / observer_step_nm, dvec3(0.0),
                          vector);
}

dvec3 srgb_of(dvec3 const& xyz) {
    dvec3 rgb(3.2406 * xyz.x - 1.5372 * xyz.y - 0.4986 * xyz.z,
              -0.9689 * xyz.x + 1.8758 * xyz.y + 0.0415 * xyz.z,
              0.0557 * xyz.x - 0.2040 * xyz.y + 1.0570 * xyz.z);
    double const brightest = std::max({rgb.x, rgb.y, rgb.z});
    if (!(brightest > 0.0))
        return dvec3(0.0);
    rgb /= brightest;
    return {encoded(std::max(0.0, rgb.x)), encoded(std::max(0.0, rgb.y)), encoded(std::max(0.0, rgb.z))};
}

} // namespace sahl
