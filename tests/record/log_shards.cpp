// A long log is a folder of shards, each closed for good, that everybody reads as one.
#include "math/input_error.h"
#include "record/sample_log.h"
#include "support/catch.h"

#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <map>

using namespace sahl;
namespace fs = std::filesystem;

namespace {

constexpr RayLogOptions small_shards{false, 2 * chunk_rows};

/// By path: every file below the folder, as bytes.
std::map<std::string, std::string> files_in(fs::path const& folder) {
    std::map<std::string, std::string> files;
    for (auto const& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            files[fs::relative(entry.path(), folder).string()] = sample::bytes_of(entry.path());
    return files;
}

std::size_t different_rows(std::vector<Segment> const& a, std::vector<Segment> const& b) {
    std::size_t different = a.size() != b.size();
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        different += a[i].ray != b[i].ray || a[i].index != b[i].index || a[i].direction != b[i].direction ||
                     a[i].ended != b[i].ended || a[i].power_end != b[i].power_end;
    return different;
}

std::string complaint_of_reading(fs::path const& file) {
    try {
        RayLogReader(file).read(0, UINT64_MAX);
    } catch (InputError const& error) {
        return error.what();
    }
    return "";
}

bool says(std::string const& message, std::string const& part) {
    return message.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("rows of a log in shards come back as if it were one file", "[record]") {
    sample::Folder const folder;
    auto const rows = sample::rows(30000); // about 75 000: three shards
    auto const file = sample::write(folder, rows, SIZE_MAX, "rays.h5", small_shards);
    CHECK(fs::exists(folder.path / "rays.shards" / "00002.h5"));
    CHECK(fs::file_size(file) < 1000000); // it has no rows itself, which are 118 bytes each
    RayLogReader const log(folder.path);
    REQUIRE(log.rows() == rows.size());
    CHECK(log.rays() == 30000);
    CHECK(different_rows(log.read(0, UINT64_MAX), rows) == 0);
    auto const border = small_shards.shard_rows; // of the first two
    auto const across = log.read(border - 3, 6);
    CHECK(different_rows(across, {rows.begin() + static_cast<std::ptrdiff_t>(border) - 3,
                                  rows.begin() + static_cast<std::ptrdiff_t>(border) + 3}) == 0);
}

TEST_CASE("a ray that lies across two shards is found whole, and so are its neighbours", "[record]") {
    sample::Folder const folder;
    auto const rows = sample::rows(30000, 3);
    RayLogReader const log(sample::write(folder, rows, SIZE_MAX, "rays.h5", {false, chunk_rows}));
    std::size_t across = 0;
    for (std::size_t border = chunk_rows; border < rows.size(); border += chunk_rows) {
        across += rows[border - 1].ray == rows[border].ray;
        for (std::uint64_t ray = rows[border].ray - 6; ray <= rows[border].ray + 6; ++ray) {
            CAPTURE(border, ray);
            std::vector<Segment> expected;
            std::copy_if(rows.begin(), rows.end(), std::back_inserter(expected),
                         [&](Segment const& s) { return s.ray == ray; });
            CHECK(different_rows(log.read_ray(ray), expected) == 0);
        }
    }
    CHECK(across > 0);
}

TEST_CASE("a shard is a log by itself", "[record]") {
    sample::Folder const folder;
    auto const rows = sample::rows(30000);
    sample::write(folder, rows, SIZE_MAX, "rays.h5", small_shards);
    RayLogReader const shard(folder.path / "rays.shards" / "00001.h5");
    auto const border = static_cast<std::ptrdiff_t>(small_shards.shard_rows);
    CHECK(different_rows(shard.read(0, UINT64_MAX), {rows.begin() + border, rows.begin() + 2 * border}) == 0);
    CHECK(shard.header().title == sample::header().title);
}

TEST_CASE("shards and compressed logs have the same bytes, in whatever portions", "[record]") {
    auto const rows = sample::rows(30000);
    for (RayLogOptions const& options : {small_shards, RayLogOptions{true, 2 * chunk_rows}}) {
        sample::Folder const one, other;
        sample::write(one, rows, SIZE_MAX, "rays.h5", options);
        sample::write(other, rows, 5003, "rays.h5", options);
        auto const files = files_in(one.path);
        CHECK(files.size() >= 4);
        CHECK((files_in(other.path) == files));
    }
}

TEST_CASE("a log that just fills one file is one file", "[record]") {
    sample::Folder const folder;
    auto rows = sample::rows(30000);
    rows.resize(chunk_rows);
    sample::write(folder, rows, SIZE_MAX, "rays.h5", {false, chunk_rows});
    CHECK(files_in(folder.path).size() == 1);
    CHECK(RayLogReader(folder.path).rows() == chunk_rows);
}

TEST_CASE("a compressed log has the same rows in fewer bytes", "[record]") {
    sample::Folder const folder;
    auto const rows = sample::rows(30000);
    auto const plain = sample::write(folder, rows, SIZE_MAX, "plain.h5");
    auto const file = sample::write(folder, rows, SIZE_MAX, "rays.h5", {true});
    CHECK(different_rows(RayLogReader(file).read(0, UINT64_MAX), rows) == 0);
    CHECK(fs::file_size(file) <
          0.9 * static_cast<double>(fs::file_size(plain))); // random numbers hardly shrink
}

TEST_CASE("a writer that is killed leaves the shards that it closed, whole", "[record]") {
    sample::Folder const folder;
    auto const rows = sample::rows(30000);
    pid_t const child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        RayLogWriter log(folder.path / "rays.h5", sample::header(), {false, chunk_rows});
        log.append(rows); // five shards; before the fourth is begun, the second is on the disk
        ::raise(SIGKILL);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    CHECK_FALSE(fs::exists(folder.path / "rays.h5"));
    std::size_t whole = 0;
    for (; fs::exists(folder.path / "rays.shards.tmp" / ("0000" + std::to_string(whole) + ".h5")); ++whole) {
        RayLogReader const shard(folder.path / "rays.shards.tmp" / ("0000" + std::to_string(whole) + ".h5"));
        auto const first = rows.begin() + static_cast<std::ptrdiff_t>(whole * chunk_rows);
        CHECK(different_rows(shard.read(0, UINT64_MAX), {first, first + chunk_rows}) == 0);
    }
    CHECK(whole >= 2);

    sample::write(folder, rows, SIZE_MAX, "rays.h5", {false, chunk_rows}); // the next run is not hindered
    CHECK(RayLogReader(folder.path).rows() == rows.size());
    CHECK_FALSE(fs::exists(folder.path / "rays.shards.tmp"));
}

TEST_CASE("a log in shards that is not closed leaves nothing, and the one before it as it was", "[record]") {
    sample::Folder const folder;
    auto const rows = sample::rows(30000);
    {
        RayLogWriter log(folder.path / "rays.h5", sample::header(), small_shards);
        log.append(rows);
        CHECK(fs::exists(folder.path / "rays.shards.tmp"));
    }
    CHECK(fs::is_empty(folder.path));
    sample::write(folder, rows, SIZE_MAX, "rays.h5", small_shards);
    auto const before = files_in(folder.path);
    {
        RayLogWriter log(folder.path / "rays.h5", sample::header(), small_shards);
        log.append(rows);
    }
    CHECK((files_in(folder.path) == before));
    sample::write(folder, sample::rows(10)); // a short log takes the place of the long one
    CHECK(files_in(folder.path).size() == 1);
}

TEST_CASE("a shard that is missing, cut short or of another log is bad input that names it", "[record]") {
    sample::Folder const folder;
    auto const file = sample::write(folder, sample::rows(30000), SIZE_MAX, "rays.h5", small_shards);
    auto const shard = folder.path / "rays.shards" / "00001.h5";
    std::string expected;
    SECTION("missing") {
        expected = "there is no such file";
        fs::remove(shard);
    }
    SECTION("cut short") {
        expected = "cannot open it (truncated file";
        fs::resize_file(shard, fs::file_size(shard) / 2);
    }
    SECTION("of another log") {
        expected = "it has 10 rows where the log says 32768";
        auto rows = sample::rows(100);
        rows.resize(10);
        fs::copy_file(sample::write(folder, rows, SIZE_MAX, "short.h5"), shard,
                      fs::copy_options::overwrite_existing);
    }
    std::string const message = complaint_of_reading(file);
    INFO(message);
    CHECK(says(message, shard.string() + ": "));
    CHECK(says(message, expected));
    CHECK(says(message, "; trace again with log = true"));
}
