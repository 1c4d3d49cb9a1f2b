// In: pixels or a file. Out: a file or pixels. The only door to OpenImageIO: readers and writers are asked
// for by name, so that no file is handed to a parser that its ending does not promise.
#include "image/image.h"

#include "math/input_error.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <new>
#include <sstream>
#include <string_view>
#include <system_error>

namespace sahl {
namespace {

constexpr int max_side = 32768;
constexpr int max_channels = 4;

struct Format {
    std::string_view ending, reader, magic; // magic: the first bytes of every file of the format
    bool writable;
    bool encoded; // values follow sRGB's curve
};
constexpr std::array<Format, 5> formats{{{".exr", "openexr", "\x76\x2f\x31\x01", true, false},
                                         {".png", "png", "\x89PNG\r\n\x1a\n", true, true},
                                         {".jpg", "jpeg", "\xff\xd8\xff", false, true},
                                         {".jpeg", "jpeg", "\xff\xd8\xff", false, true},
                                         {".hdr", "hdr", "#?", false, false}}};

/// The format that the ending of `file` stands for, whatever the case of its letters.
Format const* format_of(std::filesystem::path const& file) {
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    auto const found =
        std::find_if(formats.begin(), formats.end(), [&](Format const& f) { return f.ending == ending; });
    return found == formats.end() ? nullptr : &*found;
}

unsigned char to_byte(float value) { // NaN becomes 0
    return static_cast<unsigned char>(std::lround(255.0F * (value > 0.0F ? std::min(value, 1.0F) : 0.0F)));
}

/// Writes `image` to `file`; returns OpenImageIO's complaint, empty if all went well.
std::string write_pixels(std::string const& file, Format const& format, Image const& image,
                         std::vector<std::pair<std::string, std::string>> const& metadata,
                         std::vector<std::string> const& channel_names, bool half_colours) {
    auto const out = OIIO::ImageOutput::create(std::string(format.reader));
    if (!out)
        return OIIO::geterror();
    bool const bytes = format.reader == "png";
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height),
                         static_cast<int>(image.channels),
                         bytes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
    if (bytes) {
        spec.attribute("oiio:ColorSpace", "sRGB");
        spec.attribute("oiio:UnassociatedAlpha", 1);
    } else {
        spec.attribute("compression", "zip");
        spec.attribute("DateTime", ""); // else the time of writing goes into the file
    }
    if (!channel_names.empty())
        spec.channelnames = channel_names;
    if (half_colours && !bytes) {
        spec.channelformats.assign(image.channels, OIIO::TypeDesc::FLOAT);
        std::fill_n(spec.channelformats.begin(), std::min(image.channels, 3U), OIIO::TypeDesc::HALF);
    }
    for (auto const& [key, value] : metadata)
        spec.attribute(key, value);
    if (!out->open(file, spec))
        return out->geterror();
    bool written = false;
    if (bytes) {
        std::vector<unsigned char> encoded(image.pixels.size());
        std::transform(image.pixels.begin(), image.pixels.end(), encoded.begin(), to_byte);
        written = out->write_image(OIIO::TypeDesc::UINT8, encoded.data());
    } else {
        written = out->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data());
    }
    return written && out->close() ? std::string() : out->geterror();
}

/// Whether all chunks of a PNG are there, up to its IEND: libpng's way out of a file that is cut off leaks
/// memory.
bool png_is_whole(std::istream& stream, std::uintmax_t size) {
    std::uintmax_t at = 8; // after the magic
    for (std::array<unsigned char, 8> head{}; at + 12 <= size;) {
        stream.seekg(static_cast<std::streamoff>(at));
        stream.read(reinterpret_cast<char*>(head.data()), head.size());
        at += 12 + (std::uintmax_t{head[0]} << 24 | std::uintmax_t{head[1]} << 16 |
                    std::uintmax_t{head[2]} << 8 | head[3]);
        if (std::equal(head.begin() + 4, head.end(), "IEND"))
            return at <= size;
    }
    return false;
}

/// Throws unless it starts as its format does and is not cut off.
void check_content(std::istream& stream, std::uintmax_t size, Format const& format,
                   std::string const& place) {
    std::string start(format.magic.size(), '\0');
    stream.read(start.data(), static_cast<std::streamsize>(start.size()));
    if (!stream || start != format.magic)
        throw InputError(place, "the content is not that of a " + std::string(format.ending) + " file",
                         "give the file the ending of its format, or export it again");
    if (format.reader == "png" && !png_is_whole(stream, size))
        throw InputError(place, "the image is damaged: the file ends too early", "export it again");
}

/// Throws unless the file is there, starts as its format does and is not cut off; returns its size in bytes.
std::uintmax_t check_file(std::filesystem::path const& file, Format const& format) {
    std::ifstream stream(file, std::ios::binary);
    std::error_code failed;
    std::uintmax_t const size = std::filesystem::file_size(file, failed);
    if (!stream || failed)
        throw InputError(file.string(), "the image cannot be opened", "check the path and its permissions");
    check_content(stream, size, format, file.string());
    return size;
}

void check_size(std::string const& place, OIIO::ImageSpec const& spec, std::uintmax_t file_size,
                std::uint64_t most_pixels) {
    std::string const size = std::to_string(spec.width) + " × " + std::to_string(spec.height);
    if (spec.width < 1 || spec.height < 1 || spec.width > max_side || spec.height > max_side ||
        spec.depth > 1)
        throw InputError(
            place, "the image has " + size + " pixels, more than " + std::to_string(max_side) + " a side",
            "make it smaller");
    if (spec.image_pixels() > most_pixels)
        throw InputError(
            place, "the image has " + size + " pixels, more than " + std::to_string(most_pixels) + " in all",
            "make it smaller");
    if (spec.nchannels < 1 || spec.nchannels > max_channels || spec.deep)
        throw InputError(place, "the image has " + std::to_string(spec.nchannels) + " channels",
                         "save a flat image of 1 to 4 channels");
    // None of the formats packs more into a byte than DWA does: blocks of 8 × 8 pixels, then deflate, 1032 to
    // one at best.
    if (spec.image_pixels() / (64 * 1032) > file_size)
        throw InputError(place, "the file is too short for the pixels that its header promises",
                         "export it again");
}

/// What all readers do once it is settled that the content may be opened.
///   memory   where the content is, if not in the file of that name
Image read_pixels(std::string const& name, Format const& format, std::uintmax_t file_size,
                  std::uint64_t most_pixels, OIIO::Filesystem::IOProxy* memory) {
    auto const in = OIIO::ImageInput::create(std::string(format.reader));
    OIIO::ImageSpec spec, wishes;
    wishes.attribute("oiio:UnassociatedAlpha", 1); // colours as they stand in the file, not times their alpha
    auto const broken = [&] {
        std::string const reason = in ? in->geterror() : OIIO::geterror();
        return InputError(name, "the image is damaged: " + reason.substr(0, reason.find('\n')),
                          "export it again");
    };
    if (memory && in && (!in->supports("ioproxy") || !in->set_ioproxy(memory)))
        throw InputError(name, "this OpenImageIO reads " + std::string(format.reader) + " from files alone",
                         "put the picture beside the model, as a file of its own");
    if (!in || !in->open(memory ? "within" + std::string(format.ending) : name, spec, wishes))
        throw broken();
    check_size(name, spec, file_size, most_pixels);

    Image image{static_cast<std::uint32_t>(spec.width),
                static_cast<std::uint32_t>(spec.height),
                static_cast<std::uint32_t>(spec.nchannels),
                {},
                format.encoded};
    try {
        image.pixels.resize(static_cast<std::size_t>(spec.image_pixels()) * image.channels);
        if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data()))
            throw broken();
    } catch (std::bad_alloc const&) {
        throw InputError(name, "the image does not fit into memory", "make it smaller");
    }
    return image;
}

} // namespace

void write_image(std::filesystem::path const& file, Image const& image,
                 std::vector<std::pair<std::string, std::string>> const& metadata,
                 std::vector<std::string> const& channel_names, bool half_colours) {
    Format const* const format = format_of(file);
    if (format == nullptr || !format->writable)
        throw InputError(file.string(), "no image can be written with this ending", "use .exr or .png");
    if (image.pixels.empty() || (format->reader == "png" && image.channels > max_channels))
        throw InputError(file.string(),
                         "an image of " + std::to_string(image.width) + " × " + std::to_string(image.height) +
                             " pixels and " + std::to_string(image.channels) + " channels cannot be written",
                         image.pixels.empty() ? "give it at least one pixel"
                                              : "use .exr for more than 4 channels");

    std::filesystem::path part = file;
    part += ".part";
    std::string problem = write_pixels(part.string(), *format, image, metadata, channel_names, half_colours);
    std::error_code failed;
    if (problem.empty()) {
        std::filesystem::rename(part, file, failed);
        problem = failed ? failed.message() : std::string();
    }
    if (!problem.empty()) {
        std::filesystem::remove(part, failed);
        throw InputError(file.string(), "the image cannot be written: " + problem,
                         "check that the folder exists, is writable and has room");
    }
}

Image read_image(std::filesystem::path const& file, std::uint64_t most_pixels) {
    Format const* const format = format_of(file);
    if (format == nullptr)
        throw InputError(file.string(), "this is not an image that can be read",
                         "use .png, .jpg, .hdr or .exr");
    std::uintmax_t const size = check_file(file, *format);
    return read_pixels(file.string(), *format, size, most_pixels, nullptr);
}

Image read_image(std::span<unsigned char const> bytes, std::string const& place, std::uint64_t most_pixels) {
    std::string_view const content(reinterpret_cast<char const*>(bytes.data()), bytes.size());
    auto const format = std::find_if(formats.begin(), formats.end(), [&](Format const& f) {
        return f.encoded && content.starts_with(f.magic);
    });
    if (format == formats.end())
        throw InputError(place, "the content is neither that of a PNG nor that of a JPEG", "export it again");
    std::istringstream stream{std::string(content)};
    check_content(stream, bytes.size(), *format, place);
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    return read_pixels(place, *format, bytes.size(), most_pixels, &memory);
}

} // namespace sahl
