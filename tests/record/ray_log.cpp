// The ray log gives back what it was given, in the same bytes whenever and however it was given.
#include "record/ray_log.h"

#include "record/log_columns.h"
#include "record/sample_log.h"
#include "support/catch.h"

#include <algorithm>
#include <chrono>
#include <thread>

using namespace sahl;

namespace {

/// Lengths pass through mm: they may come back changed by the rounding of that, two ulp at most.
bool same_length(double a, double b) {
    return a == b || std::abs(a - b) <= 2.0 * 2.3e-16 * std::abs(a);
}

bool same(Segment const& a, Segment const& b) {
    return a.ray == b.ray && a.index == b.index && a.parent == b.parent && a.depth == b.depth &&
           a.born == b.born && a.ended == b.ended && a.surface == b.surface && a.primitive == b.primitive &&
           a.medium == b.medium && a.source == b.source && a.wavelength == b.wavelength &&
           same_length(a.origin.x, b.origin.x) && same_length(a.origin.y, b.origin.y) &&
           same_length(a.origin.z, b.origin.z) && a.direction == b.direction &&
           same_length(a.length, b.length) && same_length(a.optical_path, b.optical_path) &&
           a.power_start == b.power_start && a.power_end == b.power_end;
}

} // namespace

TEST_CASE("every column of every row comes back from the ray log, across chunks") {
    sample::Folder const folder;
    auto const rows = sample::rows(60000); // about 150 000 rows: three chunks
    RayLogReader const log(sample::write(folder, rows));
    REQUIRE(rows.size() > 2 * 65536);
    REQUIRE(log.rows() == rows.size());
    CHECK(log.rays() == 60000);
    auto const back = log.read(0, UINT64_MAX);
    REQUIRE(back.size() == rows.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
        different += !same(rows[i], back[i]);
    CHECK(different == 0);
    auto const middle = log.read(65530, 12);
    REQUIRE(middle.size() == 12);
    CHECK(same(middle.front(), rows[65530]));
    CHECK(same(middle.back(), rows[65541]));
    CHECK(log.read(rows.size() - 1, 5).size() == 1);
    CHECK(log.read(rows.size() + 1, 5).empty());
    CHECK_FALSE(std::filesystem::exists(folder.path / "rays.h5.tmp"));
}

TEST_CASE("digits lost are a column of the ray log where they were followed, and only there") {
    sample::Folder const folder;
    auto rows = sample::rows(20000);
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i].digits_lost = 0.001 * static_cast<double>(i);
    LogHeader header = sample::header();
    for (bool const with : {false, true})
        for (bool const many : {false, true}) {
            CAPTURE(with, many);
            header.digits_lost = with;
            RayLogOptions options;
            options.compress = with;
            options.shard_rows = many ? chunk_rows : options.shard_rows;
            std::string const name = std::string(with ? "with" : "without") + (many ? "-shards.h5" : ".h5");
            RayLogWriter log(folder.path / name, header, options);
            log.append(rows);
            log.close();
            RayLogReader const back(folder.path / name);
            CHECK(back.header().digits_lost == with);
            auto const read = back.read(0, UINT64_MAX);
            REQUIRE(read.size() == rows.size());
            std::size_t different = 0;
            for (std::size_t i = 0; i < rows.size(); ++i)
                different +=
                    !same(rows[i], read[i]) || read[i].digits_lost != (with ? rows[i].digits_lost : 0.0);
            CHECK(different == 0);
        }
}

TEST_CASE("the header comes back from the ray log") {
    sample::Folder const folder;
    sample::write(folder, {});
    RayLogReader const log(folder.path); // the folder of the run
    LogHeader const& back = log.header();
    LogHeader const given = sample::header();
    CHECK(log.rows() == 0);
    CHECK(log.rays() == 0);
    CHECK(log.read_ray(0).empty());
    CHECK(back.program == given.program);
    CHECK(back.title == given.title);
    CHECK((back.experiment_text == given.experiment_text));
    CHECK(back.options_json == given.options_json);
    CHECK(back.experiment_sha256 == given.experiment_sha256);
    CHECK(back.seed == given.seed);
    CHECK(back.sources == given.sources);
    CHECK(back.source_power_W == given.source_power_W);
    CHECK(back.source_first_ray == given.source_first_ray);
    CHECK(back.surfaces == given.surfaces);
    CHECK(back.media == given.media);
    CHECK(back.models == given.models);
    CHECK(back.wavelengths_m == given.wavelengths_m);
    CHECK(back.refractive_index == given.refractive_index);
}

TEST_CASE("the same rows give the same bytes, in whatever portions and a second later") {
    sample::Folder const folder;
    auto const rows = sample::rows(30000);
    std::string const once = sample::bytes_of(sample::write(folder, rows));
    std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // time stamps in HDF5 count seconds
    CHECK((sample::bytes_of(sample::write(folder, rows, 4097, "portions.h5")) == once));
    CHECK((sample::bytes_of(sample::write(folder, rows, 31, "crumbs.h5")) == once));
}

TEST_CASE("small and large portions by turns give the same bytes, compressed or not") {
    sample::Folder const folder;
    auto const rows = sample::rows(40000);
    for (bool const compress : {false, true}) {
        std::string const once =
            sample::bytes_of(sample::write(folder, rows, SIZE_MAX, "once.h5", {compress}));
        RayLogWriter log(folder.path / "turns.h5", sample::header(), {compress});
        std::size_t done = 0;
        for (std::size_t turn = 0; done < rows.size(); ++turn) {
            std::size_t const portion = std::array<std::size_t, 5>{7, 9000, 1, 16384, 300}[turn % 5];
            std::size_t const count = std::min(portion, rows.size() - done);
            log.append(std::span(rows).subspan(done, count));
            done += count;
        }
        log.close();
        CHECK((sample::bytes_of(folder.path / "turns.h5") == once));
    }
}

TEST_CASE("rows read from a log and written again give the same bytes") {
    sample::Folder const folder;
    auto const first = sample::write(folder, sample::rows(30000));
    auto const again = sample::write(folder, RayLogReader(first).read(0, UINT64_MAX), SIZE_MAX, "again.h5");
    CHECK((sample::bytes_of(first) == sample::bytes_of(again)));
}

TEST_CASE("a ray is found by its number in a log that has only some of them") {
    sample::Folder const folder;
    auto const rows = sample::rows(30000, 7);
    RayLogReader const log(sample::write(folder, rows));
    CHECK(log.rays() == 29999 * 7 + 1);
    for (std::uint64_t const ray : {0, 7, 7000, 7 * 12345, 7 * 29999}) {
        CAPTURE(ray);
        std::vector<Segment> expected;
        std::copy_if(rows.begin(), rows.end(), std::back_inserter(expected),
                     [&](Segment const& s) { return s.ray == ray; });
        auto const tree = log.read_ray(ray);
        CHECK(!expected.empty());
        CHECK(std::equal(tree.begin(), tree.end(), expected.begin(), expected.end(), same));
    }
    for (std::uint64_t const absent :
         {std::uint64_t{1}, std::uint64_t{6}, std::uint64_t{7 * 29999 + 1}, UINT64_MAX})
        CHECK(log.read_ray(absent).empty());
}

TEST_CASE(
    "a wavelength is logged as the decimal that the experiment says, and comes back as the same double") {
    for (double const nm : {587.5618, 486.1327, 656.2725, 632.8, 400.0, 1064.0, 10600.0, 193.368, 0.154}) {
        CAPTURE(nm);
        CHECK(in_nm(nm * 1e-9) == nm);
        CHECK(from_nm(in_nm(nm * 1e-9)) == nm * 1e-9);
        CHECK(in_nm(nm / 1e9) == nm);
    }
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(200e-9, 2000e-9);
    int moved_far = 0, unstable = 0;
    for (int i = 0; i < 100000; ++i) {
        double const metres = any(random), nm = in_nm(metres);
        moved_far += std::abs(from_nm(nm) - metres) > 4.5e-16 * metres; // two ulp at most
        unstable += in_nm(from_nm(nm)) != nm;
    }
    CHECK(moved_far == 0);
    CHECK(unstable == 0);
}

TEST_CASE("metres read back from millimetres give the same millimetres again") {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> exponent(-12.0, 6.0);
    int changed = 0;
    for (int i = 0; i < 100000; ++i) {
        double const mm = in_mm(std::pow(10.0, exponent(random)));
        changed += in_mm(from_mm(mm)) != mm;
    }
    CHECK(changed == 0);
    CHECK(from_mm(INFINITY) == INFINITY);
    CHECK(from_mm(-50.0) == -0.05);
}
