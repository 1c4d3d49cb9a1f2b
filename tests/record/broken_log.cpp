// What is wrong with a ray log is said with its name; what cannot be written leaves nothing behind.
#include "math/input_error.h"
#include "record/hdf5_file.h"
#include "record/sample_log.h"
#include "support/catch.h"

#include <sys/resource.h>

#include <csignal>
#include <functional>

using namespace sahl;

namespace {

std::string complaint(std::function<void()> const& action) {
    try {
        action();
    } catch (InputError const& error) {
        return error.what();
    }
    return "";
}

std::string complaint_of_reading(std::filesystem::path const& file) {
    return complaint([&] { RayLogReader(file).read(0, UINT64_MAX); });
}

bool says(std::string const& message, std::string const& part) {
    return message.find(part) != std::string::npos;
}

void change(std::filesystem::path const& file, std::function<void(hid_t)> const& how) {
    hdf5::Handle const open(H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    REQUIRE(open >= 0);
    how(open);
}

} // namespace

TEST_CASE("a broken ray log is bad input that names the file and what is wrong") {
    sample::Folder const folder;
    auto const file = sample::write(folder, sample::rows(100));
    std::string expected, message;

    SECTION("absent") {
        expected = "there is no such file";
        std::filesystem::remove(file);
        CHECK(says(complaint_of_reading(folder.path), "this run has no ray log"));
    }
    SECTION("not HDF5") {
        expected = "it is not an HDF5 file";
        std::ofstream(file) << "ray,segment\n0,0\n";
    }
    SECTION("truncated") {
        expected = "cannot open it (truncated file";
        std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    }
    SECTION("another schema version") {
        expected = "its schema_version is 3, this program reads 2";
        change(file, [](hid_t log) {
            hdf5::Handle const version(H5Aopen(log, "schema_version", H5P_DEFAULT), H5Aclose);
            int const three = 3;
            REQUIRE(H5Awrite(version, H5T_NATIVE_INT, &three) >= 0);
        });
    }
    SECTION("no schema version") {
        expected = "cannot read the attribute schema_version";
        change(file, [](hid_t log) { REQUIRE(H5Adelete(log, "schema_version") >= 0); });
    }
    SECTION("a column missing") {
        expected = "cannot open the column /segments/dy (object 'dy' doesn't exist)";
        change(file, [](hid_t log) { REQUIRE(H5Ldelete(log, "segments/dy", H5P_DEFAULT) >= 0); });
    }
    SECTION("a column of another type") {
        expected = "the column /segments/dy has not the type or the layout that is documented";
        change(file, [](hid_t log) {
            REQUIRE(H5Ldelete(log, "segments/dy", H5P_DEFAULT) >= 0);
            REQUIRE(H5Lcreate_hard(log, "segments/ray", log, "segments/dy", H5P_DEFAULT, H5P_DEFAULT) >= 0);
        });
    }
    SECTION("columns of different length") {
        expected = "the column /segments/dy is not as long as the others";
        change(file, [](hid_t log) {
            hdf5::Handle const column(H5Dopen2(log, "segments/dy", H5P_DEFAULT), H5Dclose);
            hsize_t const rows = 3;
            REQUIRE(H5Dset_extent(column, &rows) >= 0);
        });
    }
    SECTION("a column that claims more rows than it has") {
        expected = "the column /segments/dy lacks some of its rows";
        sample::write(folder, sample::rows(100), SIZE_MAX, "rays.h5", {true}); // raw ones have places at once
        change(file, [](hid_t log) {
            hdf5::Handle const column(H5Dopen2(log, "segments/dy", H5P_DEFAULT), H5Dclose);
            hsize_t const rows = hsize_t{1} << 50;
            REQUIRE(H5Dset_extent(column, &rows) >= 0);
        });
    }
    SECTION("fewer names than numbers") {
        expected = "nothing names";
        change(file, [](hid_t log) {
            REQUIRE(H5Ldelete(log, "surfaces/name", H5P_DEFAULT) >= 0);
            hdf5::write_names({"", ""}, log, "surfaces/name", {"one"});
        });
    }
    SECTION("a table without its values") {
        expected = "/sources/power_W should have 2 numbers";
        change(file, [](hid_t log) {
            REQUIRE(H5Ldelete(log, "sources/power_W", H5P_DEFAULT) >= 0);
            hdf5::write_table({"", ""}, log, "sources/power_W", H5T_IEEE_F64LE, {0}, nullptr, "W");
        });
    }
    message = complaint_of_reading(file);
    INFO(message);
    CHECK(says(message, file.string() + ": "));
    CHECK(says(message, expected));
    CHECK(says(message, "; trace again with log = true"));
}

TEST_CASE("a log with a wrong byte is read or refused, whichever byte it is", "[record]") {
    sample::Folder const folder;
    auto const file = folder.path / "rays.h5";
    LogHeader header = sample::header();
    header.experiment_text.resize(100);
    RayLogWriter log(file, header, {true});
    log.append(sample::rows(40));
    log.close();
    std::string const whole = sample::bytes_of(file);
    std::size_t refused = 0, tried = 0;
    std::mt19937_64 random(11);
    for (std::size_t at = 0; at < whole.size(); at += 1 + random() % 100) {
        std::string broken = whole;
        broken[at] = static_cast<char>(random());
        std::ofstream(file, std::ios::binary) << broken;
        refused += !complaint_of_reading(file).empty();
        ++tried;
    }
    CHECK(tried > 300);
    CHECK(refused > 50); // elsewhere a byte is text, a number, or not used
}

TEST_CASE("a log that is not closed leaves no file") {
    sample::Folder const folder;
    {
        RayLogWriter log(folder.path / "rays.h5", sample::header());
        log.append(sample::rows(40000));
        CHECK(std::filesystem::exists(folder.path / "rays.h5.tmp"));
    }
    CHECK(std::filesystem::is_empty(folder.path));
}

TEST_CASE("a log that is not closed leaves the one before it as it was") {
    sample::Folder const folder;
    auto const file = sample::write(folder, sample::rows(10));
    std::string const before = sample::bytes_of(file);
    { RayLogWriter log(file, sample::header()); }
    CHECK((sample::bytes_of(file) == before));
}

TEST_CASE("a log in a folder that is not there is bad input") {
    sample::Folder const folder;
    auto const file = folder.path / "nowhere" / "rays.h5";
    std::string const message = complaint([&] { RayLogWriter(file, sample::header()); });
    INFO(message);
    CHECK(says(message, file.string() + ": cannot create it (No such file or directory); "));
}

TEST_CASE("a log that finds no more space is bad input that names the file, and leaves nothing") {
    sample::Folder const folder;
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
    auto const handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit const small{4 << 20, before.rlim_max}; // 4 MiB stand for a full disk
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
    std::string const message = complaint([&] {
        RayLogWriter log(folder.path / "rays.h5", sample::header());
        log.append(sample::rows(60000));
        log.close();
    });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    INFO(message);
    CHECK(says(message, "rays.h5: cannot write rows (File too large); "));
    CHECK(std::filesystem::is_empty(folder.path));
    auto const rows = sample::rows(1000);
    CHECK(RayLogReader(sample::write(folder, rows)).rows() == rows.size()); // the library is still in order
}
