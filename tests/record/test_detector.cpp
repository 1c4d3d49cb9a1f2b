// What a detector says of the light that met it, against sums done by hand.
#include "record/detector.h"
#include "support/catch.h"
#include "support/dice.h"

#include <algorithm>
#include <numeric>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr SumUnit watt{-90};

DetectorSpec screen(std::uint32_t columns, std::uint32_t rows) {
    DetectorSpec spec;
    spec.size = {0.04, 0.02};
    spec.columns = columns;
    spec.rows = rows;
    return spec;
}

DetectorHit hit_at(dvec2 at, double power, std::uint64_t ray = 0, dvec3 const& direction = {0.0, 0.0, -1.0}) {
    return {{0}, {0}, {0}, ray, at, direction, power, 1.0};
}

/// The pixels that have light, by number: row · columns + column.
std::vector<std::size_t> lit(DetectorRecord const& record) {
    std::vector<std::size_t> pixels;
    std::vector<double> const field = record.irradiance();
    for (std::size_t i = 0; i < field.size(); ++i)
        if (field[i] > 0.0)
            pixels.push_back(i);
    return pixels;
}

std::size_t pixel_of(dvec2 at, std::uint32_t columns, std::uint32_t rows) {
    DetectorRecord record(screen(columns, rows), watt, 1, 1);
    record.add(hit_at(at, 1.0));
    REQUIRE(lit(record).size() == 1);
    return lit(record).front();
}

} // namespace

TEST_CASE("a detector without light has no spot, no peak and no sigma") {
    DetectorRecord const record(screen(4, 2), watt, 1, 1);
    CHECK(!spot_of(record.all(), watt));
    CHECK(record.peak() == 0.0);
    CHECK(record.sigma() == 0.0);
    CHECK(record.irradiance() == std::vector<double>(8, 0.0));
    DetectorRecord dark(screen(4, 2), watt, 1, 1);
    dark.add(hit_at({0.0, 0.0}, 0.0)); // a ray without power
    CHECK(!spot_of(dark.all(), watt));
    CHECK(dark.sigma() == 0.0);
}

TEST_CASE("centroid, rms radius, mean direction and path are the power's") {
    DetectorRecord record(screen(8, 8), watt, 1, 1);
    record.add({{0}, {0}, {0}, 0, {0.001, 0.002}, {0.6, 0.0, -0.8}, 1.0, 2.0});
    record.add({{0}, {0}, {0}, 1, {0.005, -0.002}, {-0.6, 0.0, -0.8}, 3.0, 4.0});
    auto const spot = spot_of(record.all(), watt);
    REQUIRE(spot);
    CHECK(spot->power == 4.0);
    CHECK(spot->hits == 2);
    CHECK(spot->centroid.x == Approx(0.004));
    CHECK(spot->centroid.y == Approx(-0.001));
    // variances: x 0.75 · 0.25 · 4², y the same with 4; in mm
    CHECK(spot->rms_radius == Approx(1e-3 * std::sqrt(0.1875 * 32.0)));
    dvec3 const mean = normalize(dvec3(0.25 * 0.6 - 0.75 * 0.6, 0.0, -0.8));
    CHECK(length(spot->mean_direction - mean) < 1e-15);
    CHECK(spot->mean_optical_path == Approx(3.5));
}

TEST_CASE("a small spot far from the centre keeps its size") {
    // r² of the spot is 1e-13 of that of its place: 1e-3 of it is left in doubles, as much as is asked for
    // here
    DetectorRecord record(screen(8, 8), watt, 1, 1);
    for (int k = 0; k < 1000; ++k)
        record.add(hit_at(dvec2(0.019, 0.009) + 6e-9 * dvec2(std::cos(0.1 * k), std::sin(0.1 * k)), 1e-3,
                          static_cast<std::uint64_t>(k)));
    auto const spot = spot_of(record.all(), watt);
    REQUIRE(spot);
    CHECK(spot->rms_radius == Approx(6e-9).epsilon(0.05));
    DetectorRecord point(screen(8, 8), watt, 1, 1);
    for (int k = 0; k < 1000; ++k)
        point.add(hit_at({0.0123, -0.0071}, 1e-3, static_cast<std::uint64_t>(k)));
    CHECK(spot_of(point.all(), watt)->rms_radius < 1e-9);
}

TEST_CASE("pixels lie as a person sees them: rows from the top, columns from the left, borders to the right "
          "and below") {
    CHECK(pixel_of({-0.019, 0.009}, 4, 2) == 0);
    CHECK(pixel_of({0.019, 0.009}, 4, 2) == 3);
    CHECK(pixel_of({-0.019, -0.009}, 4, 2) == 4);
    CHECK(pixel_of({0.019, -0.009}, 4, 2) == 7);
    CHECK(pixel_of({0.0, 0.0}, 4, 2) == 6); // the middle is a border
    CHECK(pixel_of({-0.01, 0.005}, 4, 2) == 1);
    // the rim belongs to the last pixel, and so does what rounding puts beyond it
    for (double beyond : {0.0, 1e-17, 1e-9}) {
        CHECK(pixel_of({-0.02 - beyond, 0.01 + beyond}, 4, 2) == 0);
        CHECK(pixel_of({0.02 + beyond, 0.01 + beyond}, 4, 2) == 3);
        CHECK(pixel_of({0.02 + beyond, -0.01 - beyond}, 4, 2) == 7);
    }
    CHECK(pixel_of({0.013, 0.004}, 1, 1) == 0);
}

TEST_CASE("the picture adds up to the power, and its peak is its brightest pixel") {
    Dice dice(1);
    DetectorRecord record(screen(16, 8), watt, 1, 1);
    double total = 0.0;
    for (std::uint64_t k = 0; k < 5000; ++k) {
        double const power = dice.log_between(1e-6, 1e-3);
        total += power;
        record.add(hit_at({dice.between(-0.02, 0.02), dice.between(-0.01, 0.01)}, power, k));
    }
    std::vector<double> const field = record.irradiance();
    double const pixel_area = 0.04 * 0.02 / 128.0;
    CHECK(std::accumulate(field.begin(), field.end(), 0.0) * pixel_area == Approx(total).epsilon(1e-12));
    CHECK(record.peak() == *std::max_element(field.begin(), field.end()));
    CHECK(spot_of(record.all(), watt)->power == Approx(total).epsilon(1e-13));
}

TEST_CASE("what came by wavelength and by source adds up to all, bit for bit") {
    Dice dice(2);
    DetectorRecord record(screen(4, 4), watt, 3, 2);
    for (std::uint64_t k = 0; k < 1000; ++k)
        record.add({{0},
                    {static_cast<std::uint32_t>(dice.below(3))},
                    {static_cast<std::uint32_t>(dice.below(2))},
                    k,
                    {dice.between(-0.02, 0.02), dice.between(-0.01, 0.01)},
                    dice.direction(),
                    dice.uniform(),
                    dice.uniform()});
    for (std::vector<Moments> const* parts : {&record.by_wavelength(), &record.by_source()}) {
        Moments sum;
        for (Moments const& part : *parts) {
            sum.hits += part.hits;
            sum.power.add(part.power);
            sum.power_x.add(part.power_x);
            sum.power_r2.add(part.power_r2);
            sum.power_path.add(part.power_path);
        }
        CHECK(sum.hits == record.all().hits);
        CHECK(sum.power == record.all().power);
        CHECK(sum.power_x == record.all().power_x);
        CHECK(sum.power_r2 == record.all().power_r2);
        CHECK(sum.power_path == record.all().power_path);
    }
}

TEST_CASE("sigma is 0 for light that comes again, however rays differ, and right for light that is drawn") {
    Dice dice(3);
    std::uint64_t const rays = 20'000;
    DetectorRecord sure(screen(1, 1), watt, 1, 1), drawn(screen(1, 1), watt, 1, 1);
    TwiceSums sure_twice, drawn_twice;
    auto const draw = [&] { return dice.uniform() < 0.3 ? 1.0 / rays : 0.0; };
    for (std::uint64_t k = 0; k < rays; ++k) {
        double const power = k % 7 == 0 ? 1.0 / rays : 0.0;
        sure.add(hit_at({0.0, 0.0}, 0.25 * power, k));
        sure.add(hit_at({0.0, 0.0}, 0.75 * power, k)); // a ray may come in pieces
        sure_twice.add(power, power, watt);
        double const once = draw();
        drawn.add(hit_at({0.0, 0.0}, once, k));
        if (k % 4 == 0)
            drawn_twice.add(once, draw(), watt);
    }
    sure.add(sure_twice);
    drawn.add(drawn_twice);
    CHECK(sure.sigma() == 0.0);
    // the sum of `rays` draws with chance 0.3
    CHECK(drawn.sigma() == Approx(std::sqrt(0.3 * 0.7 / rays)).epsilon(0.05));
}

TEST_CASE("where no ray that was followed twice brought light, all light counts as chance") {
    DetectorRecord record(screen(1, 1), watt, 1, 1);
    record.add(hit_at({0.0, 0.0}, 0.3, 7));
    record.add(hit_at({0.0, 0.0}, 0.4, 9));
    CHECK(record.sigma() == 0.0); // nothing is drawn
    record.add(TwiceSums{});
    CHECK(record.sigma() == Approx(0.5));
}
