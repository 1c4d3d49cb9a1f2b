// Samples lie as densely as their filter is high, whatever their pattern.
#include "render/pixel_samples.h"
#include "support/catch.h"

#include <cmath>

using namespace sahl;

TEST_CASE("samples weigh pictures as their filter does", "[render]") {
    // the mean of x² and of cos 2x under each filter, against an integral of the filter itself
    for (PixelFilter const filter :
         {PixelFilter::box, PixelFilter::tent, PixelFilter::gaussian, PixelFilter::mitchell}) {
        double area = 0.0, square = 0.0, wave = 0.0;
        int const n = 40000;
        for (int i = 0; i < n; ++i) {
            double const x = filter_radius(filter) * (2.0 * (i + 0.5) / n - 1.0), f = filter_value(filter, x);
            area += f;
            square += f * x * x;
            wave += f * std::cos(2.0 * x);
        }
        for (SamplePattern const pattern :
             {SamplePattern::regular, SamplePattern::jittered, SamplePattern::sobol}) {
            PictureOptions options;
            options.samples = 65536;
            options.filter = filter;
            options.pattern = pattern;
            PixelSamples const samples(options, 7);
            double weight = 0.0, mean_square = 0.0, mean_wave = 0.0;
            for (std::uint32_t i = 0; i < options.samples; ++i) {
                PixelSample const sample = samples.at(3, i);
                double const x = sample.offset.x;
                weight += sample.weight;
                mean_square += sample.weight * x * x;
                mean_wave += sample.weight * std::cos(2.0 * sample.offset.y);
            }
            // 256 strata a side: what the last of them leaves out is 1/256 of x² at the end, 4 at the most
            CHECK(mean_square / weight == Approx(square / area).margin(4.0 / 256.0));
            CHECK(mean_wave / weight == Approx(wave / area).margin(4.0 / 256.0));
        }
    }
}

TEST_CASE("a single sample looks at the middle of its pixel", "[render]") {
    for (SamplePattern const pattern : {SamplePattern::regular, SamplePattern::sobol}) {
        PictureOptions options;
        options.samples = 1;
        options.pattern = pattern;
        dvec2 const offset = PixelSamples(options, 1).at(5, 0).offset;
        CHECK(std::abs(offset.x) < 1e-12);
        CHECK(std::abs(offset.y) < 1e-12);
    }
}
