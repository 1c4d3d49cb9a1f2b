// In: what samples see. Out: a picture and its layers.
#pragma once

#include "image/image.h"
#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace sahl {

/// Sums over a pixel's samples, in their order. Every pixel belongs to one tile, and so to one thread.
struct FilmPixel {
    dvec3 light{0.0}, plain{0.0}; // with their weights, and without
    double weight = 0.0;
    std::uint32_t samples = 0;
    // sums over samples, each of the same weight
    double depth = 0.0;
    dvec3 normal{0.0};
    double pieces = 0.0, cut = 0.0;

    bool seen() const { return samples > 0; }
};

struct Film {
    std::uint32_t columns = 0, rows = 0;
    double filter_mean = 1.0; // of samples' weights, were there many
    std::vector<FilmPixel> pixels;

    Film(std::uint32_t width, std::uint32_t height, double mean_weight)
        : columns(width), rows(height), filter_mean(mean_weight), pixels(std::size_t{width} * height) {}

    /// Linear RGB; black where there is no sample. The weights, some of which may be negative, count for what
    /// differs from the plain mean: where samples agree it is just that, however few they are.
    dvec3 mean(FilmPixel const& pixel) const;
    FilmPixel& at(std::uint32_t x, std::uint32_t y) { return pixels[std::size_t{y} * columns + x]; }
    FilmPixel const& at(std::uint32_t x, std::uint32_t y) const {
        return pixels[std::size_t{y} * columns + x];
    }
};

/// 8 bits' worth: 2^exposure times the light, each colour cut at 1, encoded as sRGB.
Image srgb_picture(Film const& film, double exposure);

/// Linear light (R, G, B), depth in m (Z: infinite where nothing is), the normal in the world (normal.X …),
/// and by sample the pieces of its ray tree and the share of it that was cut.
Image linear_layers(Film const& film);
std::vector<std::string> layer_names();

/// Linear light in, sRGB (IEC 61966-2-1) in [0, 1] out, each colour cut there.
dvec3 encoded_srgb(dvec3 const& linear);

} // namespace sahl
