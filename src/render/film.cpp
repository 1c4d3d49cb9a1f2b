#include "render/film.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

double encoded(double linear) {
    if (!(linear > 0.0)) // nor where it is not a number
        return 0.0;
    linear = std::min(linear, 1.0);
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

void put(std::vector<float>& pixels, dvec3 const& v) {
    for (int i = 0; i < 3; ++i)
        pixels.push_back(static_cast<float>(v[i]));
}

} // namespace

dvec3 Film::mean(FilmPixel const& pixel) const {
    if (!pixel.seen())
        return dvec3(0.0);
    dvec3 const plain = pixel.plain / static_cast<double>(pixel.samples);
    return plain + (pixel.light - pixel.weight * plain) / (pixel.samples * filter_mean);
}

dvec3 encoded_srgb(dvec3 const& linear) {
    return {encoded(linear.x), encoded(linear.y), encoded(linear.z)};
}

Image srgb_picture(Film const& film, double exposure) {
    Image image{film.columns, film.rows, 3, {}};
    image.pixels.reserve(film.pixels.size() * 3);
    for (FilmPixel const& pixel : film.pixels)
        put(image.pixels, encoded_srgb(std::exp2(exposure) * film.mean(pixel)));
    return image;
}

std::vector<std::string> layer_names() {
    return {"R", "G", "B", "Z", "normal.X", "normal.Y", "normal.Z", "tree.pieces", "tree.cut"};
}

Image linear_layers(Film const& film) {
    Image image{film.columns, film.rows, static_cast<std::uint32_t>(layer_names().size()), {}};
    image.pixels.reserve(film.pixels.size() * image.channels);
    for (FilmPixel const& pixel : film.pixels) {
        double const share = pixel.seen() ? 1.0 / pixel.samples : 0.0;
        put(image.pixels, film.mean(pixel));
        image.pixels.push_back(static_cast<float>(pixel.seen() ? share * pixel.depth : INFINITY));
        put(image.pixels, length(pixel.normal) > 0.0 ? normalize(pixel.normal) : dvec3(0.0));
        image.pixels.push_back(static_cast<float>(share * pixel.pieces));
        image.pixels.push_back(static_cast<float>(share * pixel.cut));
    }
    return image;
}

} // namespace sahl
