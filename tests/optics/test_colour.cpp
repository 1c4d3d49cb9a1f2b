// Colours of known light, against what the CIE and the makers of sRGB print.
#include "optics/colour.h"
#include "support/catch.h"

#include <cmath>

using namespace sahl;

namespace {

template <class Power>
dvec3 seen(Power power) { // every nanometre
    dvec3 sum(0.0);
    for (int nm = 380; nm <= 780; ++nm)
        sum += power(nm * 1e-9) * colour_matching(nm * 1e-9);
    return sum;
}

dvec2 chromaticity(dvec3 const& xyz) {
    return dvec2(xyz.x, xyz.y) / (xyz.x + xyz.y + xyz.z);
}

} // namespace

TEST_CASE("D65 and black bodies have the chromaticities that the CIE prints", "[colour]") {
    auto const check = [](auto power, double x, double y) {
        dvec2 const xy = chromaticity(seen(power));
        CAPTURE(xy.x, xy.y);
        CHECK(std::abs(xy.x - x) <
              1.0e-4); // four digits are printed; sums of 1 nm and of 5 nm differ in the last
        CHECK(std::abs(xy.y - y) < 1.0e-4);
    };
    check(illuminant_d65, 0.3127, 0.3290);
    check([](double) { return 1.0; }, 1.0 / 3.0, 1.0 / 3.0); // illuminant E
    check([](double x) { return black_body(x, 6500.0); }, 0.3135, 0.3237);
    check([](double x) { return black_body(x, 2855.5); }, 0.4476, 0.4074); // illuminant A
}

TEST_CASE("a black body peaks where Wien says, and falls as Rayleigh and Jeans say", "[colour]") {
    double const peak = 2.897771955e-3 / 5000.0; // CODATA 2018
    CHECK(black_body(peak, 5000.0) > black_body(peak * 1.001, 5000.0));
    CHECK(black_body(peak, 5000.0) > black_body(peak * 0.999, 5000.0));
    CHECK(black_body(2e-2, 5000.0) / black_body(1e-2, 5000.0) == Approx(1.0 / 16.0).epsilon(1e-4)); // λ⁻⁴
    CHECK(black_body(1e-8, 300.0) == 0.0);
}

TEST_CASE("the eye sees most at 555 nm and nothing beyond the table", "[colour]") {
    CHECK(colour_matching(555e-9).y == Approx(1.0).epsilon(1e-12));
    CHECK(colour_matching(379e-9) == dvec3(0.0));
    CHECK(colour_matching(781e-9) == dvec3(0.0));
    CHECK(illuminant_d65(560e-9) == Approx(100.0).epsilon(1e-12));
    CHECK(illuminant_d65(299e-9) == 0.0);
}

TEST_CASE("D65 is white in sRGB, red light is red, darkness is black", "[colour]") {
    dvec3 const white = srgb_of(seen(illuminant_d65)), red = srgb_of(colour_matching(650e-9));
    for (int i = 0; i < 3; ++i)
        CHECK(white[i] == Approx(1.0).margin(0.002)); // the matrix has four digits
    CHECK(red.x == Approx(1.0));
    CHECK(red.y == 0.0);
    CHECK(red.z == 0.0);
    CHECK(srgb_of(dvec3(0.0)) == dvec3(0.0));
}

TEST_CASE("D65 is the table of the CIE at its ends too, and half way between its entries") {
    // CIE 15, table of D65 at intervals of 5 nm; ours has every second entry
    std::pair<double, double> const table[] = {
        {300, 0.0341},  {305, 1.6643},  {310, 3.2945},  {315, 11.7652}, {320, 20.236},  {325, 28.6447},
        {330, 37.0535}, {335, 38.5011}, {340, 39.9488}, {345, 42.4302}, {350, 44.9117}, {355, 45.775},
        {360, 46.6383}, {365, 49.3637}, {370, 52.0891}, {375, 51.0323}, {785, 63.8434}, {790, 64.304},
        {795, 61.8779}, {800, 59.4519}, {805, 55.7054}, {810, 51.959},  {815, 54.6998}, {820, 57.4406},
        {825, 58.8765}, {830, 60.3125}};
    for (auto const& [nm, power] : table)
        CHECK(illuminant_d65(nm * 1e-9) == Approx(power).margin(6e-5)); // four decimals, and half of one
}
