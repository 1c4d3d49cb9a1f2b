// Images out and in again: the same pixels, the same bytes, and a plain word for every file that is not what
// it says.
#include "image/image.h"
#include "math/input_error.h"
#include "support/catch.h"

#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <thread>

using namespace sahl;
namespace fs = std::filesystem;

namespace {

/// A folder of its own that is gone afterwards.
struct Folder {
    fs::path path =
        fs::temp_directory_path() /
        ("sahl_image_" + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    Folder(Folder const&) = delete;
    Folder& operator=(Folder const&) = delete;
};

Image gradient(std::uint32_t width, std::uint32_t height, std::uint32_t channels) {
    Image image{width, height, channels, {}};
    for (std::uint32_t i = 0; i < width * height * channels; ++i)
        image.pixels.push_back(static_cast<float>(i % 256) / 255.0F);
    return image;
}

std::string bytes(fs::path const& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void write_bytes(fs::path const& file, std::string const& content) {
    std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
}

/// What reading the file complains of; empty if it does not.
std::string complaint(fs::path const& file) {
    try {
        read_image(file);
    } catch (InputError const& error) {
        return error.what();
    }
    return {};
}

bool has(std::string const& text, std::string const& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("EXR keeps every float of any number of channels") {
    Folder const folder;
    for (std::uint32_t const channels : {1U, 2U, 3U, 4U}) {
        Image image = gradient(37, 21, channels);
        image.pixels[0] = 1e30F;
        image.pixels[1] = -3.25e-12F;
        image.pixels[2] = std::numeric_limits<float>::infinity();
        write_image(folder.path / "a.exr", image);
        Image const back = read_image(folder.path / "a.exr");
        CHECK((back.width == 37 && back.height == 21 && back.channels == channels));
        CHECK(back.pixels == image.pixels);
    }
    write_image(folder.path / "seven.exr", gradient(4, 4, 7));
    CHECK(has(complaint(folder.path / "seven.exr"), "7 channels"));
}

TEST_CASE("PNG keeps values of eight bits and clamps the others") {
    Folder const folder;
    for (std::uint32_t const channels : {1U, 3U, 4U}) {
        Image const image = gradient(64, 16, channels);
        write_image(folder.path / "a.png", image);
        Image const back = read_image(folder.path / "a.png");
        CHECK((back.width == 64 && back.height == 16 && back.channels == channels));
        float worst = 0.0F;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            worst = std::max(worst, std::abs(back.pixels[i] - image.pixels[i]));
        CHECK(worst < 1e-6F); // colours are not multiplied by their alpha
    }
    write_image(folder.path / "b.PNG", Image{4, 1, 1, {-1.0F, 2.0F, 0.5F, std::nanf("")}});
    Image const back = read_image(folder.path / "b.PNG");
    CHECK(back.pixels[0] == 0.0F);
    CHECK(back.pixels[1] == 1.0F);
    CHECK(back.pixels[2] == Approx(128 / 255.0));
    CHECK(back.pixels[3] == 0.0F);
}

TEST_CASE("the first row of an image is its top") {
    Folder const folder;
    for (char const* const name : {"a.exr", "a.png"}) {
        write_image(folder.path / name, Image{1, 2, 1, {1.0F, 0.0F}});
        CHECK(read_image(folder.path / name).pixels == std::vector<float>{1.0F, 0.0F});
    }
    // A PNG's scanlines are stored from the top: a Radiance file says so itself ("-Y": from the top
    // downwards).
    write_bytes(folder.path / "a.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n") +
                                           "\x80\x40\x20\x81" + "\x80\x80\x80\x80");
    Image const radiance = read_image(folder.path / "a.hdr");
    REQUIRE(radiance.pixels.size() == 6);
    CHECK(radiance.pixels[0] == Approx(1.0).epsilon(0.01));
    CHECK(radiance.pixels[1] == Approx(0.5).epsilon(0.01));
    CHECK(radiance.pixels[3] == Approx(0.5).epsilon(0.01));
}

TEST_CASE("the same pixels give the same bytes whenever they are written") {
    Folder const folder;
    std::vector<std::pair<std::string, std::string>> const metadata{{"Software", "Sahl"}, {"seed", "7"}};
    for (char const* const ending : {".exr", ".png"}) {
        fs::path const first = folder.path / (std::string("first") + ending);
        fs::path const second = folder.path / (std::string("second") + ending);
        write_image(first, gradient(32, 32, 3), metadata);
        std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // a header's clock counts seconds
        write_image(second, gradient(32, 32, 3), metadata);
        CHECK(bytes(first) == bytes(second));
        CHECK(has(bytes(first), "Sahl"));
    }
    CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) ==
          4); // nothing is left over
}

TEST_CASE("an image that cannot be written is an error that names the file and leaves nothing") {
    Folder const folder;
    auto const problem = [&](fs::path const& file, Image const& image) {
        try {
            write_image(file, image);
        } catch (InputError const& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    Image const image = gradient(4, 4, 3);
    CHECK(has(problem(folder.path / "absent" / "a.png", image), "a.png: the image cannot be written"));
    CHECK(has(problem(folder.path / "absent" / "a.exr", image), "a.exr: the image cannot be written"));
    CHECK(has(problem(folder.path / "a.tif", image), "use .exr or .png"));
    CHECK(has(problem(folder.path / "a.jpg", image), "use .exr or .png"));
    CHECK(has(problem(folder.path / "a.png", Image{}), "0 × 0 pixels"));
    CHECK(has(problem(folder.path / "a.png", gradient(4, 4, 5)), "5 channels"));
    CHECK(fs::is_empty(folder.path));
}

TEST_CASE("a file is read only by the reader that its ending names") {
    Folder const folder;
    write_image(folder.path / "a.png", gradient(8, 8, 3));
    for (char const* const name : {"a.jpg", "a.jpeg", "a.exr", "a.hdr"}) {
        fs::copy_file(folder.path / "a.png", folder.path / name);
        std::string const message = complaint(folder.path / name);
        CHECK(has(message, name));
        CHECK(has(message, "the content is not that of a"));
    }
    fs::copy_file(folder.path / "a.png", folder.path / "a.tif");
    CHECK(has(complaint(folder.path / "a.tif"), "use .png, .jpg, .hdr or .exr"));
    CHECK(has(complaint(folder.path / "absent.png"), "absent.png: the image cannot be opened"));
    CHECK(has(complaint(folder.path), "use .png"));
    write_bytes(folder.path / "empty.png", "");
    CHECK(has(complaint(folder.path / "empty.png"), "the content is not"));
}

TEST_CASE("damaged images are errors that name the file") {
    Folder const folder;
    for (char const* const name : {"a.png", "a.exr"}) {
        write_image(folder.path / name, gradient(200, 200, 3));
        std::string const whole = bytes(folder.path / name);
        for (double const share : {0.02, 0.3, 0.8}) {
            write_bytes(folder.path / name,
                        whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
            std::string const message = complaint(folder.path / name);
            CHECK(has(message, name));
            CHECK(has(message, "the image is damaged"));
        }
    }
    write_image(folder.path / "b.png", gradient(200, 200, 3));
    std::string garbled = bytes(folder.path / "b.png");
    std::fill(garbled.end() - 100, garbled.end() - 20, 'x'); // in the pixels, before the checksum and IEND
    write_bytes(folder.path / "b.png", garbled);
    CHECK(has(complaint(folder.path / "b.png"), "b.png: the image is damaged"));
}

TEST_CASE("a header that promises more pixels than its file can hold is refused before they are allocated") {
    Folder const folder;
    std::string const start = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    write_bytes(folder.path / "a.hdr", start + "-Y 32768 +X 32768\n" + std::string(100, '\0'));
    CHECK(has(complaint(folder.path / "a.hdr"), "too short for the pixels"));
    write_bytes(folder.path / "b.hdr", start + "-Y 2 +X 32769\n" + std::string(100, '\0'));
    CHECK(has(complaint(folder.path / "b.hdr"), "32769 × 2 pixels"));
    write_bytes(folder.path / "c.hdr", start + "-Y -2 +X 5\n" + std::string(100, '\0'));
    CHECK(has(complaint(folder.path / "c.hdr"), "c.hdr"));
}

TEST_CASE("a PNG within another file is read as from its own, and says whether its values are encoded") {
    Folder const folder;
    Image const image = gradient(9, 5, 3);
    write_image(folder.path / "a.png", image);
    write_image(folder.path / "a.exr", image);
    std::string const content = bytes(folder.path / "a.png");
    auto const read = [](std::string const& text, std::uint64_t most = 1000) {
        return read_image({reinterpret_cast<unsigned char const*>(text.data()), text.size()},
                          "model.glb: /images/0", most);
    };
    Image const within = read(content), beside = read_image(folder.path / "a.png");
    CHECK(within.pixels == beside.pixels);
    CHECK((within.encoded && beside.encoded));
    CHECK_FALSE(read_image(folder.path / "a.exr").encoded);
    for (std::string const& bad : {std::string(), std::string("GIF89a"),
                                   content.substr(0, content.size() / 2), bytes(folder.path / "a.exr")})
        try {
            read(bad);
            FAIL("read");
        } catch (InputError const& error) {
            CHECK(has(error.what(), "model.glb: /images/0"));
        }
    CHECK_THROWS_AS(read(content, 44), InputError);
    CHECK_THROWS_AS(read_image(folder.path / "a.png", 44), InputError);
}
