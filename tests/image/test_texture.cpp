// Textures against closed forms: constants, linear ramps, means, and what lies beyond the borders.
#include "image/environment.h"
#include "image/texture.h"
#include "support/catch.h"

#include <cmath>
#include <limits>
#include <numbers>

using namespace sahl;

namespace {

/// One value for each pixel, by its column and row from the top.
template <class Value>
Image picture(std::uint32_t width, std::uint32_t height, Value const& value) {
    Image image{width, height, 1, {}};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            image.pixels.push_back(static_cast<float>(value(x, y)));
    return image;
}

constexpr double float_step = 1.2e-7; // a unit of single precision, which pixels are kept in

} // namespace

TEST_CASE("a texture of one colour has it everywhere, whatever looks at it", "[image]") {
    Image image{5, 3, 3, {}};
    for (int i = 0; i < 15; ++i)
        image.pixels.insert(image.pixels.end(), {0.25F, 0.5F, 2.0F});
    for (Wrap const wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        Texture const texture(image, wrap, wrap);
        for (dvec2 const uv : {dvec2(0.5, 0.5), dvec2(0.0, 1.0), dvec2(-7.3, 12.9)})
            for (double const wide : {0.0, 1e-3, 0.3, 40.0}) {
                dvec3 const colour = texture.at(uv, {wide, 0.1 * wide}, {0.0, wide});
                CHECK(length(colour - dvec3(0.25, 0.5, 2.0)) < 4 * float_step);
            }
    }
}

TEST_CASE("between pixels' centres a texture is linear, and so is it under a footprint", "[image]") {
    Texture const texture(picture(64, 32, [](double x, double y) { return 3.0 * x + 5.0 * y; }), Wrap::clamp,
                          Wrap::clamp);
    auto const ramp = [](dvec2 const& uv) {
        return 3.0 * (64.0 * uv.x - 0.5) + 5.0 * (32.0 * (1.0 - uv.y) - 0.5);
    };
    for (dvec2 const uv : {dvec2(0.5, 0.5), dvec2(0.31, 0.62), dvec2(0.7, 0.4)}) {
        CHECK(std::abs(texture.at(uv).x - ramp(uv)) < 400 * float_step);
        CHECK(std::abs(texture.at(uv, {0.02, 0.0}, {0.0, 0.05}).x - ramp(uv)) < 400 * float_step);
        CHECK(std::abs(texture.at(uv, {0.1, 0.1}, {0.01, 0.0}).x - ramp(uv)) < 400 * float_step);
    }
}

TEST_CASE("each level of a texture has the picture's mean, odd sides or not", "[image]") {
    for (auto const& [width, height] : {std::pair{64U, 64U}, {37U, 21U}, {1U, 13U}, {7U, 1U}}) {
        auto const noise = [](std::uint32_t x, std::uint32_t y) {
            return (x * 7919 + y * 104729) % 101 / 100.0;
        };
        Image const image = picture(width, height, noise);
        double sum = 0.0;
        for (float const value : image.pixels)
            sum += value;
        double const mean = sum / (width * height);
        Texture const texture(image);
        CHECK(std::abs(texture.mean().x - mean) < 8 * float_step);
        CHECK(std::abs(texture.at({0.3, 0.3}, {9.0, 0.0}, {0.0, 9.0}).x - mean) < 8 * float_step);
    }
}

TEST_CASE("a checkered texture fades to its mean with the footprint, and along it alone", "[image]") {
    // stripes across u: a footprint along v sees one stripe, a footprint along u sees their mean
    Texture const stripes(picture(64, 64, [](std::uint32_t x, std::uint32_t) { return x % 2; }));
    dvec2 const on_stripe(1.5 / 64.0, 0.5);
    CHECK(stripes.at(on_stripe).x == 1.0);
    CHECK(stripes.at(on_stripe, {0.0, 10.0 / 64.0}, {1.0 / 64.0, 0.0}).x > 0.99);
    CHECK(std::abs(stripes.at(on_stripe, {10.0 / 64.0, 0.0}, {0.0, 1.0 / 64.0}).x - 0.5) < 0.06);
    CHECK(std::abs(stripes.at(on_stripe, {0.5, 0.0}, {0.0, 0.5}).x - 0.5) < 1e-6);
}

TEST_CASE("beyond its borders a texture repeats, is mirrored or stays as it is", "[image]") {
    Image const image = picture(4, 1, [](double x, double) { return x; });
    auto const at = [&](Wrap wrap, double u) { return Texture(image, wrap, wrap).at({u, 0.5}).x; };
    CHECK(at(Wrap::repeat, 0.375) == 1.0);
    CHECK(at(Wrap::repeat, 5.375) == 1.0);
    CHECK(at(Wrap::repeat, -2.625) == 1.0);
    CHECK(at(Wrap::repeat, 0.0) == 1.5); // half of the last and half of the first
    CHECK(at(Wrap::mirror, 1.625) == 1.0);
    CHECK(at(Wrap::mirror, -0.375) == 1.0);
    CHECK(at(Wrap::mirror, 0.0) == 0.0);
    CHECK(at(Wrap::clamp, 7.0) == 3.0);
    CHECK(at(Wrap::clamp, -7.0) == 0.0);
    CHECK(at(Wrap::clamp, std::numeric_limits<double>::quiet_NaN()) == 0.0);
    CHECK(at(Wrap::repeat, std::numeric_limits<double>::infinity()) == 1.5);
}

TEST_CASE("v runs upwards: a picture's first row is at v = 1", "[image]") {
    Texture const texture(picture(1, 2, [](double, double y) { return y; }), Wrap::clamp, Wrap::clamp);
    CHECK(texture.at({0.5, 0.9}).x == 0.0);
    CHECK(texture.at({0.5, 0.1}).x == 1.0);
}

TEST_CASE("encoded pictures are made linear before they are averaged", "[image]") {
    CHECK(std::abs(linear_of_srgb(0.5) - 0.21404114048223255) < 1e-15);
    CHECK(linear_of_srgb(1.0) == 1.0);
    CHECK(std::abs(linear_of_srgb(0.04045) - linear_of_srgb(0.04046)) < 1e-6);
    Image image = picture(2, 1, [](double x, double) { return x; });
    image.encoded = true;
    CHECK(Texture(image).mean().x == 0.5);
    image.pixels = {0.5F, 0.5F};
    CHECK(std::abs(Texture(image).mean().x - 0.21404114) < float_step);
}

TEST_CASE("an environment shows its centre along -z, its right half on the right and its top above",
          "[image]") {
    Image image{256, 128, 3, {}};
    for (std::uint32_t y = 0; y < 128; ++y)
        for (std::uint32_t x = 0; x < 256; ++x) {
            float const u = (static_cast<float>(x) + 0.5F) / 256.0F,
                        v = 1.0F - (static_cast<float>(y) + 0.5F) / 128.0F;
            image.pixels.insert(image.pixels.end(), {u, v, 1.0F});
        }
    Environment const sky(image);
    CHECK(length(sky.at({0, 0, -1}) - dvec3(0.5, 0.5, 1.0)) < 1e-6);
    CHECK(length(sky.at({1, 0, 0}) - dvec3(0.75, 0.5, 1.0)) < 1e-6);
    CHECK(length(sky.at({-1, 0, 0}) - dvec3(0.25, 0.5, 1.0)) < 1e-6);
    double const half = std::sqrt(0.5);
    CHECK(length(sky.at({0, half, -half}) - dvec3(0.5, 0.75, 1.0)) < 1e-6);
    CHECK(sky.at({0, 1, 0}).y > 0.99);
    // turned so that its own up is the world's z
    Environment const turned(image, dmat3(dvec3(1, 0, 0), dvec3(0, 0, -1), dvec3(0, 1, 0)));
    CHECK(length(turned.at({0, 1, 0}) - dvec3(0.5, 0.5, 1.0)) < 1e-6);
    CHECK(turned.at({0, 0, 1}).y > 0.99);
}

TEST_CASE("an environment has no seam behind, and none where its footprint lies across it", "[image]") {
    auto const wave = [](double x, double) {
        return 1.0 + std::cos(2.0 * std::numbers::pi * (x + 0.5) / 512.0);
    };
    Environment const sky(picture(512, 256, wave));
    for (double const angle : {3.0, 3.1, 3.14, std::numbers::pi, 3.15, 3.2, 3.3}) {
        dvec3 const d(std::sin(angle), 0.0, -std::cos(angle)), along(std::cos(angle), 0.0, std::sin(angle));
        double const expected = 1.0 + std::cos(angle + std::numbers::pi);
        CHECK(std::abs(sky.at(d).x - expected) < 1e-4); // the chord below an arc of one pixel
        CHECK(std::abs(sky.at(d, 0.05 * along, {0, 0.01, 0}).x - expected) < 1e-3); // its mean over 0.05 rad
    }
}

TEST_CASE("about an environment's pole all longitudes count", "[image]") {
    Environment const sky(picture(512, 256, [](std::uint32_t x, std::uint32_t) { return x % 2; }));
    for (double const off : {0.0, 1e-9, 1e-4}) {
        dvec3 const d = normalize(dvec3(off, 1.0, 0.3 * off));
        CHECK(std::abs(sky.at(d, {0.02, 0, 0}, {0, 0, 0.02}).x - 0.5) < 0.02);
    }
}
