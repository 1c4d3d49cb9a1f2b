// Spectra and binary ray files as an experiment names them.
#include "math/input_error.h"
#include "scene/read_experiment.h"
#include "scene/read_sources.h"
#include "support/bench.h"
#include "support/catch.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>

using namespace sahl;
using namespace sahl::bench;

namespace {

Experiment read(std::filesystem::path const& folder, std::string const& source) {
    std::string const text = "[[source]]\nname = \"s\"\nrays = [[0, 0, 0, 0, 0, 1]]\n" + source;
    return read_experiment(parse_toml(text, "spectra.toml"), folder / "spectra.toml");
}

void write(std::filesystem::path const& file, std::string const& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

/// An IES TM-25 file, as its standard lays it out, of rays with radiant flux.
struct Tm25 {
    std::string bytes;
    template <class T>
    void put(T value) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        bytes.append(raw, sizeof(T));
    }
    explicit Tm25(std::vector<std::vector<float>> const& rays, std::int32_t version = 2013) {
        bytes = "TM25";
        put(version);
        put<std::int32_t>(0);
        put(100.0F); // lm
        put(2.5F);   // W
        put<std::uint64_t>(rays.size());
        bytes.append(28, ' ');
        put<std::int32_t>(0);
        put<std::int32_t>(1); // one wavelength
        put(532.0F);
        put(0.0F);
        put(0.0F);
        put<std::int32_t>(1); // spectral tables
        put<std::int32_t>(1); // additional columns
        put<std::int32_t>(32);
        bytes.append(168, '\0');
        for (int flag : {1, 1, 1, 0, 1, 0, 0, 0}) // place, direction, radiant and luminous flux
            put<std::int32_t>(flag);
        bytes.append(9 * 4000, '\0');
        put<std::int32_t>(1);
        put(532.0F);
        put(1.0F);
        bytes.append(32 - 12, '\0');
        bytes.append(512 + 32, '\0');
        for (auto const& ray : rays)
            for (float number : ray)
                put(number);
    }
};

} // namespace

TEST_CASE("a spectrum is traced at the middles of its bins, with the power in each", "[sources]") {
    auto const source =
        read({}, "spectrum = {table = [[400, 0], [500, 1], [600, 0]], bins = 4}\n").sources.front();
    REQUIRE(source.wavelengths.size() == 4);
    double const total = std::accumulate(source.wavelengths.begin(), source.wavelengths.end(), 0.0,
                                         [](double sum, auto const& w) { return sum + w.second; });
    double const share[] = {0.125, 0.375, 0.375, 0.125}; // of a triangle
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(source.wavelengths[i].first == Approx((425.0 + 50.0 * static_cast<double>(i)) * 1e-9));
        CHECK(source.wavelengths[i].second / total == Approx(share[i]).epsilon(1e-12));
    }
}

TEST_CASE("a spectrum beside wavelengths or lines gives their weights", "[sources]") {
    auto const source = read({}, "wavelengths_nm = [450, 500]\nspectrum = {table = [[400, 0], [500, 1]]}\n");
    auto const& weights = source.sources.front().wavelengths;
    CHECK(weights[0].second / weights[1].second == Approx(0.5));
    CHECK(
        read({}, "lines = [\"F\", \"d\", \"C\"]\nspectrum = \"D65\"\n").sources.front().wavelengths.size() ==
        3);
    CHECK_THROWS_AS(read({}, "wavelengths_nm = [900]\nspectrum = \"D65\"\n"), InputError);
}

TEST_CASE("a spectrum may stand in a CSV file", "[sources]") {
    Folder const folder;
    write(folder.path() / "lamp.csv", "nm,power\n# of a triangle\n400,0\n500,1\n600,0\n");
    auto const from_file = read(folder.path(), "spectrum = \"lamp.csv\"\n").sources.front().wavelengths;
    auto const from_table =
        read({}, "spectrum = {table = [[400, 0], [500, 1], [600, 0]]}\n").sources.front().wavelengths;
    CHECK(from_file == from_table);
    for (std::string const bad : {"400,1\n", "400,1\n300,1\n", "400,1\n500,-1\n", "400,1\n500\n",
                                  "400,x\n500,1\n", "400,nan\n500,1\n", ""}) {
        CAPTURE(bad);
        write(folder.path() / "lamp.csv", bad);
        CHECK_THROWS_AS(read(folder.path(), "spectrum = \"lamp.csv\"\n"), InputError);
    }
}

TEST_CASE("rays of an IES TM-25 file come in metres, with their powers and wavelength", "[sources]") {
    Folder const folder;
    auto const file = folder.path() / "led.tm25ray";
    write(file, Tm25({{1, 2, 3, 0, 0, 1, 0.5F, 70, 9}, {-1, 0, 0, 0.6F, 0, 0.8F, 0.25F, 35, 9}}).bytes);
    RayList const list = read_ray_file(file, {});
    REQUIRE(list.rays.size() == 2);
    CHECK(length(list.rays[0].origin - dvec3(1e-3, 2e-3, 3e-3)) < 1e-18);
    CHECK(list.rays[0].weight == 0.5);
    CHECK(length(list.rays[1].direction - dvec3(0.6, 0.0, 0.8)) < 1e-7); // floats
    CHECK(std::abs(length(list.rays[1].direction) - 1.0) < 4e-16);
    CHECK(list.power == 0.75);
    REQUIRE(list.wavelength);
    CHECK(*list.wavelength == Approx(532e-9));
}

TEST_CASE("a broken IES TM-25 file is refused wherever it ends", "[sources]") {
    Folder const folder;
    auto const file = folder.path() / "led.tm25ray";
    std::string const whole = Tm25({{1, 2, 3, 0, 0, 1, 0.5F, 70, 9}}).bytes;
    auto const refused = [&](std::string const& bytes) {
        write(file, bytes);
        CHECK_THROWS_AS(read_ray_file(file, {}), InputError);
    };
    for (std::size_t size = 0; size < 300; ++size)
        refused(whole.substr(0, size));
    for (std::size_t short_of = 1; short_of < 700; ++short_of)
        refused(whole.substr(0, whole.size() - short_of));
    refused(whole + "more");
    refused(Tm25({{1, 2, 3, 0, 0, 1, 0.5F, 70, 9}}, 2020).bytes);
    refused(Tm25({{1, 2, 3, 0, 0, 0, 0.5F, 70, 9}}).bytes); // no direction
    refused(Tm25({{1, 2, NAN, 0, 0, 1, 0.5F, 70, 9}}).bytes);
    refused(Tm25({{1, 2, 3, 0, 0, 1, -0.5F, 70, 9}}).bytes);
    std::string endless = whole;
    for (std::size_t byte = 20; byte < 28; ++byte) // the number of rays
        endless[byte] = '\xFF';
    refused(endless);
}
