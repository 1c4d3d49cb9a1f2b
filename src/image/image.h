// In: pixels. Out: EXR and PNG files, and pixels again. image/image.cpp is the only door to OpenImageIO.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sahl {

/// Row-major, first row at the top; `channels` floats a pixel.
struct Image {
    std::uint32_t width = 0, height = 0, channels = 1;
    std::vector<float> pixels;
    bool encoded =
        false; // as PNG and JPEG are: values follow sRGB's curve; otherwise they are proportional to light
};

/// Writes to a temporary name and renames. The format is that of the ending: .exr (32-bit float, ZIP) or .png
/// (8 bits, values clamped to [0, 1] as they stand: encode to sRGB first). `metadata` goes into the header.
/// `channel_names`: of all of them, or none; an EXR keeps them.
/// `half_colours`: the first three channels of an EXR have 16 bits.
/// The same pixels give the same bytes. Throws InputError where the file cannot be written.
void write_image(std::filesystem::path const& file, Image const& image,
                 std::vector<std::pair<std::string, std::string>> const& metadata = {},
                 std::vector<std::string> const& channel_names = {}, bool half_colours = false);

/// Reads EXR, PNG, JPEG or HDR, by the ending, never another format; at most 32768 × 32768, 4 channels and
/// `most_pixels`. Throws InputError.
Image read_image(std::filesystem::path const& file, std::uint64_t most_pixels = std::uint64_t{1} << 30);

/// Reads a PNG or JPEG that lies within another file, told by its first bytes. Throws InputError with
/// `place`.
Image read_image(std::span<unsigned char const> bytes, std::string const& place,
                 std::uint64_t most_pixels = std::uint64_t{1} << 30);

/// A map of a scalar field that a person can look at: viridis (colour-blind safe, monotonic in lightness),
/// from 0 to `peak`, or logarithmic over `decades` below it, with a colour bar, its ticks and their unit at
/// the right, a title and the extent of both axes.
Image false_colour(Image const& field, double peak, double decades, std::string const& title,
                   std::string const& unit, double width_mm, double height_mm);

} // namespace sahl
