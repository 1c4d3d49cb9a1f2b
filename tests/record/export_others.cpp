// A log's rays in the formats of other programs: what each file holds are the log's rows again.
#include "support/catch.h"
#include "support/gltf.h"

#include "record/export_text.h"
#include "record/export_vtp.h"
#include "record/log_columns.h"
#include "run/export_rays.h"
#include "scene/read_gltf.h"

#include <cmath>
#include <cstring>
#include <sstream>

using namespace sahl;
using namespace sahl::bench;
namespace fs = std::filesystem;

namespace {

std::string const bench_text = R"(
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 5}}
medium = "N-BK7"
[[source]]
name = "beam"
beam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 4, pattern = "hexagonal", rays = 30}
lines = ["F", "C"]
[[detector]]
name = "screen"
at_mm = [0, 0, 8]
facing = [0, 0, -1]
size_mm = [4, 4]
[trace]
log = true
)";

struct Run {
    TemporaryFolder folder{"export-others"};
    ExperimentSource source = load_experiment(folder.write("bench.toml", bench_text));
    std::vector<Segment> rows;

    Run() {
        RunOptions options;
        options.out = folder.path / "out";
        run_experiment(source, options);
        rows = log().read(0, log().rows());
    }
    RayLogReader log() const { return RayLogReader(folder.path / "out"); }
    std::string text(char const* name) const {
        std::ifstream in(folder.path / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

std::vector<std::string> lines_of(std::string const& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

double number(Value const& value) {
    return std::holds_alternative<std::int64_t>(value.data)
               ? static_cast<double>(std::get<std::int64_t>(value.data))
               : std::get<double>(value.data);
}

/// A block of a .vtp by its name: where its numbers begin.
char const* block(std::string const& file, std::string const& name) {
    std::size_t const element = file.find("Name=\"" + name + "\"");
    REQUIRE(element != std::string::npos);
    std::size_t const offset = std::stoul(file.substr(file.find("offset=\"", element) + 8));
    return file.data() + file.find("<AppendedData encoding=\"raw\">\n_") + 31 + offset;
}

template <class T>
T at(char const* begin, std::size_t i) {
    T value;
    std::memcpy(&value, begin + i * sizeof(T), sizeof(T));
    return value;
}

} // namespace

TEST_CASE("JSON Lines hold a log's rows, to the same doubles", "[log]") {
    Run const run;
    export_json_lines(run.log(), run.folder.path / "rays.jsonl");
    auto const lines = lines_of(run.text("rays.jsonl"));
    REQUIRE(lines.size() == run.rows.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        Value const row = parse_json(lines[i], "rays.jsonl");
        Segment const& segment = run.rows[i];
        CHECK(number(*row.find("ray")) == static_cast<double>(segment.ray));
        CHECK(number(*row.find("dx")) == segment.direction.x);
        CHECK(number(*row.find("x_mm")) == in_mm(segment.origin.x));
        CHECK(std::get<std::string>(row.find("ended")->data) == name_of(segment.ended));
        bool const escapes = !std::isfinite(segment.length);
        CHECK(std::holds_alternative<std::monostate>(row.find("end_mm")->data) == escapes);
        CHECK(std::holds_alternative<std::monostate>(row.find("surface")->data) == (segment.surface < 0));
        if (!escapes)
            CHECK(number(*row.find("length_mm")) == in_mm(segment.length));
    }
}

TEST_CASE("SolTrace's columns hold where light arrives, and how", "[log]") {
    Run const run;
    export_soltrace(run.log(), run.folder.path / "rays.csv");
    auto const lines = lines_of(run.text("rays.csv"));
    CHECK(lines[0] == "Pos X,Pos Y,Pos Z,Cos X,Cos Y,Cos Z,Element,Stage,Ray Number");
    std::size_t line = 1;
    for (Segment const& segment : run.rows) {
        if (segment.surface < 0) // escapes, and branches that were cut
            continue;
        REQUIRE(line < lines.size());
        std::vector<double> numbers;
        std::istringstream in(lines[line++]);
        for (std::string field; std::getline(in, field, ',');)
            numbers.push_back(std::stod(field));
        REQUIRE(numbers.size() == 9);
        dvec3 const end = segment.origin + segment.length * segment.direction;
        CHECK(dvec3(numbers[0], numbers[1], numbers[2]) == end);
        CHECK(dvec3(numbers[3], numbers[4], numbers[5]) == segment.direction);
        CHECK(std::abs(numbers[6]) == segment.surface + 1);
        CHECK((numbers[6] < 0.0) == (segment.ended == Event::detected));
        CHECK(numbers[8] == static_cast<double>(segment.ray + 1));
    }
    CHECK(line == lines.size());
}

TEST_CASE("a .vtp holds a log's lines and their values, unrounded", "[log]") {
    Run const run;
    export_vtp(run.log(), run.folder.path / "rays.vtp");
    std::string const file = run.text("rays.vtp");
    std::size_t const n = run.rows.size();
    CHECK(file.find("NumberOfPoints=\"" + std::to_string(2 * n) + "\"") != std::string::npos);
    char const *const points = block(file, "points"), *const powers = block(file, "power_end_W"),
                      *const depths = block(file, "depth"), *const ends = block(file, "connectivity"),
                      *const offsets = block(file, "offsets"), *const nm = block(file, "wavelength_nm");
    CHECK(at<std::uint64_t>(points, 0) == n * 6 * sizeof(double));
    for (std::size_t i = 0; i < n; ++i) {
        Segment const& segment = run.rows[i];
        CHECK(at<double>(points + 8, 6 * i + 2) == in_mm(segment.origin.z));
        if (std::isfinite(segment.length))
            CHECK(at<double>(points + 8, 6 * i + 5) ==
                  in_mm((segment.origin + segment.length * segment.direction).z));
        CHECK(at<double>(powers + 8, i) == segment.power_end);
        CHECK(at<double>(nm + 8, i) == in_nm(segment.wavelength));
        CHECK(at<std::uint16_t>(depths + 8, i) == segment.depth);
        CHECK(at<std::int64_t>(ends + 8, 2 * i + 1) == static_cast<std::int64_t>(2 * i + 1));
        CHECK(at<std::int64_t>(offsets + 8, i) == static_cast<std::int64_t>(2 * i + 2));
    }
    CHECK(file.compare(file.size() - 27, 27, "</AppendedData>\n</VTKFile>\n") == 0);
}

TEST_CASE("a log's .glb has its rays as coloured lines beside the bodies", "[log]") {
    Run const run;
    for (ColourBy const by : {ColourBy::wavelength, ColourBy::power, ColourBy::depth}) {
        export_rays_glb(run.log(), run.source, 24, by, run.folder.path / "rays.glb");
        std::string const file = run.text("rays.glb");
        std::uint32_t size = 0;
        std::memcpy(&size, file.data() + 12, 4);
        Value const json = parse_json(file.substr(20, size), "rays.glb");
        auto const& meshes = std::get<Array>(json.find("meshes")->data);
        REQUIRE(meshes.size() == 3); // ball, screen, rays
        Value const& primitive = std::get<Array>(meshes[2].find("primitives")->data)[0];
        CHECK(number(*primitive.find("mode")) == 1.0);
        auto const& accessors = std::get<Array>(json.find("accessors")->data);
        auto const places = static_cast<std::size_t>(number(*primitive.find("attributes")->find("POSITION")));
        CHECK(number(*accessors[places].find("count")) == 2.0 * static_cast<double>(run.rows.size()));
    }
    Model const model = read_gltf(run.folder.path / "rays.glb");
    CHECK(model.instances.front().name == "ball");
    // two wavelengths, two colours
    RayColours colours(ColourBy::wavelength);
    CHECK(colours.of(run.rows.front()).first[2] > colours.of(run.rows.back()).first[2]);
    RayColours by_power(ColourBy::power);
    for (Segment const& segment : run.rows)
        by_power.look_at(segment);
    Segment faint = run.rows.front();
    faint.power_start = 1e-9;
    CHECK(by_power.of(faint).first != by_power.of(run.rows.front()).first);
}
