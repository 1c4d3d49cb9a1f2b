// A log exported to CSV has the columns of the log, names for codes, and numbers that read back the same.
#include "record/export_csv.h"

#include "math/input_error.h"
#include "record/log_columns.h"
#include "record/sample_log.h"
#include "support/catch.h"

#include <sstream>

using namespace sahl;

namespace {

/// Fields of a CSV line; quotes as in RFC 4180.
std::vector<std::string> fields_of(std::string const& line) {
    std::vector<std::string> fields(1);
    bool inside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && inside && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (line[i] == '"')
            inside = !inside;
        else if (line[i] == ',' && !inside)
            fields.emplace_back();
        else
            fields.back() += line[i];
    }
    return fields;
}

} // namespace

TEST_CASE("the CSV export has the columns of the log in their order, and reads back as the same numbers") {
    sample::Folder const folder;
    auto const rows = sample::rows(20000); // more than one portion
    RayLogReader const log(sample::write(folder, rows));
    auto const out = folder.path / "paths.csv";
    export_csv(log, out);
    CHECK_FALSE(std::filesystem::exists(folder.path / "paths.csv.tmp"));

    std::istringstream text(sample::bytes_of(out));
    std::string line;
    std::getline(text, line);
    CHECK(
        line ==
        "ray,segment,parent,depth,born,ended,surface,primitive,medium,wavelength_nm,x_mm,y_mm,z_mm,dx,dy,dz,"
        "length_mm,optical_path_mm,power_start_W,power_end_W,end_x_mm,end_y_mm,end_z_mm");
    auto const header = sample::header();
    auto const logged = log.read(0, UINT64_MAX);
    std::size_t row = 0, wrong = 0;
    for (; std::getline(text, line); ++row) {
        auto const f = fields_of(line);
        REQUIRE(f.size() == 23);
        REQUIRE(row < logged.size());
        Segment const& s = logged[row];
        wrong += f[0] != std::to_string(s.ray) || f[1] != std::to_string(s.index) ||
                 f[2] != std::to_string(s.parent);
        wrong += f[3] != std::to_string(s.depth) || f[4] != name_of(s.born) || f[5] != name_of(s.ended);
        wrong += f[6] != (s.surface < 0 ? "" : header.surfaces[static_cast<std::size_t>(s.surface)]);
        wrong += f[7] != std::to_string(s.primitive) || f[8] != header.media[s.medium];
        double const numbers[] = {in_nm(s.wavelength), in_mm(s.origin.x), in_mm(s.origin.y),
                                  in_mm(s.origin.z),   s.direction.x,     s.direction.y,
                                  s.direction.z,       in_mm(s.length),   in_mm(s.optical_path),
                                  s.power_start,       s.power_end};
        for (std::size_t k = 0; k < std::size(numbers); ++k)
            wrong += std::stod(f[9 + k]) != numbers[k];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            int const a = static_cast<int>(axis);
            wrong += std::isinf(s.length)
                         ? !f[20 + axis].empty()
                         : std::stod(f[20 + axis]) != in_mm((s.origin + s.length * s.direction)[a]);
        }
        wrong += std::isinf(s.length) && f[16] != "inf";
    }
    CHECK(row == rows.size());
    CHECK(wrong == 0);
}

TEST_CASE("a CSV export that cannot be written says where") {
    sample::Folder const folder;
    RayLogReader const log(sample::write(folder, {}));
    std::string message;
    try {
        export_csv(log, folder.path / "nowhere" / "paths.csv");
    } catch (InputError const& error) {
        message = error.what();
    }
    INFO(message);
    CHECK(message.find("paths.csv: cannot create it (No such file or directory)") != std::string::npos);
}
