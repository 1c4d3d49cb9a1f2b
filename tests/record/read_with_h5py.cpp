// Somebody with Python and h5py alone reads the same numbers from the log.
#include "record/sample_log.h"
#include "support/catch.h"

#include <cstdlib>
#include <sstream>

using namespace sahl;

TEST_CASE("h5py reads names and sums from the ray log, whole, compressed and in shards") {
    if (std::system("/usr/bin/python3 -c 'import h5py' > /dev/null 2>&1") != 0) {
        WARN("skipped: no /usr/bin/python3 with h5py");
        return;
    }
    sample::Folder const folder;
    auto rows = sample::rows(30000);
    double power = 0.0;
    std::string ended_on;
    LogHeader const header = sample::header();
    for (Segment& s : rows) {
        s.power_start = std::ldexp(std::floor(s.power_start * 1024.0), -10); // sums are exact in any order
        power += s.parent < 0 ? s.power_start : 0.0;
        if (s.ray == 0)
            ended_on += (ended_on.empty() ? "" : "|") +
                        (s.surface < 0 ? "-" : header.surfaces[static_cast<std::size_t>(s.surface)]);
    }
    auto const options = GENERATE(RayLogOptions{}, RayLogOptions{true}, RayLogOptions{false, 2 * chunk_rows},
                                  RayLogOptions{true, chunk_rows});
    auto const file = sample::write(folder, rows, SIZE_MAX, "rays.h5", options);
    auto const answer = folder.path / "answer.txt";
    std::string const command = "PYTHONIOENCODING=utf-8 /usr/bin/python3 '" SAHL_SOURCE_DIR
                                "/tests/record/read_with_h5py.py' '" +
                                file.string() + "' > '" + answer.string() + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    std::istringstream line(sample::bytes_of(answer));
    std::size_t count = 0;
    double sum = 0.0, index = 0.0;
    std::string names;
    line >> count >> sum >> index;
    std::getline(line >> std::ws, names);
    CHECK(count == rows.size());
    CHECK(sum == power);
    CHECK(index == 1.5223);
    CHECK(names == ended_on);
}
