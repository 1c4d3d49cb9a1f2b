// The picture of a detector: colours that mean their values, axes that are right, and nothing that hides
// anything else.
#include "image/colour_map.h"
#include "image/image.h"
#include "image/text.h"
#include "image/ticks.h"
#include "support/catch.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace sahl;

namespace {

Colour pixel(Image const& image, std::size_t x, std::size_t y) {
    float const* const p = &image.pixels[3 * (y * image.width + x)];
    return {p[0], p[1], p[2]};
}

std::size_t count(Image const& picture, Colour const& colour) {
    std::size_t n = 0;
    for (std::size_t y = 0; y < picture.height; ++y)
        for (std::size_t x = 0; x < picture.width; ++x)
            n += pixel(picture, x, y) == colour;
    return n;
}

/// First pixel of a colour in reading order.
std::array<std::size_t, 2> find(Image const& picture, Colour const& colour) {
    for (std::size_t y = 0; y < picture.height; ++y)
        for (std::size_t x = 0; x < picture.width; ++x)
            if (pixel(picture, x, y) == colour)
                return {x, y};
    return {0, 0};
}

double lightness(Colour const& colour) { // CIE Y of sRGB
    auto const linear = [](float c) {
        return c <= 0.04045F ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
}

} // namespace

TEST_CASE("viridis grows lighter all the way") {
    CHECK(colour_of(0.0) == Colour{0.267F, 0.005F, 0.329F});
    CHECK(colour_of(1.0) == Colour{0.993F, 0.906F, 0.144F});
    CHECK(colour_of(-5.0) == colour_of(0.0));
    CHECK(colour_of(std::numeric_limits<double>::infinity()) == colour_of(1.0));
    for (int i = 0; i < 1000; ++i)
        CHECK(lightness(colour_of((i + 1) / 1000.0)) > lightness(colour_of(i / 1000.0)));
    Colour const invalid = colour_of(std::nan(""));
    CHECK((invalid[0] == invalid[1] && invalid[1] == invalid[2]));
}

TEST_CASE("the top row of a field is at the top of its picture and every value is a block of its colour") {
    Image const field{2, 2, 1, {0.25F, 0.5F, 0.75F, std::nanf("")}};
    Image const picture = false_colour(field, 1.0, 0, "four values", "W", 10, 10);
    CHECK(picture.channels == 3);
    CHECK(picture.width >= 512);
    auto const [x, y] = find(picture, colour_of(0.25));
    std::size_t const block = 256; // 2 × 256 = 512
    CHECK(count(picture, colour_of(std::nan(""))) == block * block);
    for (std::size_t const dx : {std::size_t{0}, block - 1})
        for (std::size_t const dy : {std::size_t{0}, block - 1}) {
            CHECK(pixel(picture, x + dx, y + dy) == colour_of(0.25));
            CHECK(pixel(picture, x + dx + block, y + dy) == colour_of(0.5));
            CHECK(pixel(picture, x + dx, y + dy + block) == colour_of(0.75));
            CHECK(pixel(picture, x + dx + block, y + dy + block) == colour_of(std::nan("")));
        }
}

TEST_CASE("a logarithmic scale gives each decade the same share of the colours") {
    Image const field{4, 1, 1, {100.0F, 10.0F, 1.0F, 0.0F}};
    Image const picture = false_colour(field, 100.0, 4, "", "W", 4, 1);
    auto const [x, y] = find(picture, colour_of(1.0));
    CHECK(pixel(picture, x + 128, y) == colour_of(0.75));
    CHECK(pixel(picture, x + 256, y) == colour_of(0.5));
    CHECK(pixel(picture, x + 384, y) == colour_of(0.0));
}

TEST_CASE("a picture has the proportions of its field") {
    auto const blocks = [](std::uint32_t width, std::uint32_t height, double width_mm, double height_mm) {
        Image field{width, height, 1, std::vector<float>(std::size_t{width} * height, std::nanf(""))};
        Image const picture = false_colour(field, 1.0, 0, "", "W", width_mm, height_mm);
        auto const [x, y] = find(picture, colour_of(std::nan("")));
        double across = 0, down = 0;
        while (pixel(picture, x + static_cast<std::size_t>(across), y) == colour_of(std::nan("")))
            ++across;
        while (pixel(picture, x, y + static_cast<std::size_t>(down)) == colour_of(std::nan("")))
            ++down;
        return std::array<double, 2>{across, down};
    };
    CHECK(blocks(256, 256, 80, 80) == std::array<double, 2>{512, 512});
    CHECK(blocks(1024, 512, 80, 40) == std::array<double, 2>{1024, 512});
    CHECK(blocks(100, 100, 20, 80)[1] / blocks(100, 100, 20, 80)[0] == Approx(4.0).epsilon(0.05));
    CHECK(blocks(512, 512, 80, 60)[0] / blocks(512, 512, 80, 60)[1] == Approx(80.0 / 60).epsilon(0.05));
    CHECK(blocks(1000, 1, 1000, 1) == std::array<double, 2>{1000, 32}); // a thin strip can be seen
    CHECK(blocks(1, 1000, 1, 1000) == std::array<double, 2>{32, 1000});
}

TEST_CASE("no label of a picture touches its rim or the field") {
    for (double const peak : {0.0, 1e-12, 0.0123, 1.0, 98765.4, 3e20})
        for (double const decades : {0.0, 1.0, 6.0}) {
            Image field{16, 12, 1, std::vector<float>(16 * 12, std::nanf(""))};
            Image const picture = false_colour(
                field, peak, decades,
                "A title that says what this is and is long enough for three lines of the picture: 60° prism",
                "W/mm²", 8e-4, 6e-4);
            Colour const ground = pixel(picture, 0, 0);
            for (std::size_t x = 0; x < picture.width; ++x)
                REQUIRE((pixel(picture, x, 0) == ground && pixel(picture, x, picture.height - 1) == ground));
            for (std::size_t y = 0; y < picture.height; ++y)
                REQUIRE((pixel(picture, 0, y) == ground && pixel(picture, picture.width - 1, y) == ground));
            std::size_t const factor = 512 / 16;
            CHECK(count(picture, colour_of(std::nan(""))) == 16 * 12 * factor * factor);
        }
}

TEST_CASE("ticks are round numbers within the axis") {
    CHECK(round_ticks(-40, 40, 10).size() == 9); // by 10
    CHECK(round_ticks(-40, 40, 10).front() == -40);
    CHECK(round_ticks(0, 1, 5).size() == 6);
    CHECK(round_ticks(0, 0.0123, 8).back() == Approx(0.012));
    CHECK(round_ticks(-0.3, 0.3, 3).size() == 3); // by 0.2
    CHECK(decade_ticks(0.001, 100, false).size() == 6);
    CHECK(decade_ticks(0.5, 20, true).size() == 5 + 10 + 1); // 0.5 … 0.9, 1 … 10, 20: 10 is counted once
}

TEST_CASE("numbers on an axis are short and their minus is a minus") {
    CHECK(tick_label(0.0) == "0");
    CHECK(tick_label(-0.0) == "0");
    CHECK(tick_label(-0.25) == "−0.25");
    CHECK(tick_label(3 * 0.1) == "0.3");
    CHECK(tick_label(1e-5) == "1e-5");
    CHECK(tick_label(2e6) == "2e6");
    CHECK(tick_label(-2e-10) == "−2e-10");
    CHECK(tick_label(98765.4, 3) == "98800");
    CHECK(tick_label(0.0123456, 3) == "0.0123");
}

TEST_CASE("letters are counted as people count them") {
    CHECK(letter_count("") == 0);
    CHECK(letter_count("60° W/mm²") == 9);
    CHECK(letter_count("λ−日") == 3);
    CHECK(letter_count("\xff\xc2") == 2); // not UTF-8: a box each
}

TEST_CASE("text that runs off the picture is cut and not written elsewhere") {
    Image image{20, 12, 3, std::vector<float>(20 * 12 * 3, 1.0F)};
    draw_text(image, -7, -5, "WWWWWWWWWWWWWW", 1.0, 0.0F);
    draw_text(image, 15, 8, "WWWW", 1.0, 0.0F);
    draw_text(image, 500, 500, "W", 1.0, 0.0F);
    CHECK(std::all_of(image.pixels.begin(), image.pixels.end(),
                      [](float v) { return v >= 0.0F && v <= 1.0F; }));
    CHECK(std::count(image.pixels.begin(), image.pixels.end(), 1.0F) < 20 * 12 * 3);
}

TEST_CASE("every letter of ASCII is drawn and no two are alike") {
    std::vector<std::vector<float>> drawn;
    for (char c = ' '; c <= '~'; ++c) {
        Image image{14, 22, 3, std::vector<float>(14 * 22 * 3, 1.0F)};
        draw_text(image, 0, 0, std::string(1, c), 2.0, 0.0F);
        CHECK((*std::min_element(image.pixels.begin(), image.pixels.end()) < 0.5F) == (c != ' '));
        drawn.push_back(image.pixels);
    }
    std::sort(drawn.begin(), drawn.end());
    CHECK(std::adjacent_find(drawn.begin(), drawn.end()) == drawn.end());
}
