// In: rays.h5. Out: its header and its rows, checked: whoever reads on may use any event, surface or medium
// as an index.
#include "record/hdf5_file.h"
#include "record/log_columns.h"
#include "record/ray_log.h"

#include <algorithm>

namespace sahl {

using namespace hdf5;

namespace {

constexpr std::size_t portion_rows = 65536; // read at once: 0.5 MiB a column
constexpr char const* remedy_of_reading = "trace again with log = true, or give a rays.h5 that is whole";

LogHeader read_header(Must const& must, hid_t file) {
    std::int32_t version = 0;
    read_attribute(must, file, "schema_version", type_of<std::int32_t>(), &version);
    if (version != log_schema_version)
        must.fail("its schema_version is " + std::to_string(version) + ", this program reads " +
                  std::to_string(log_schema_version));
    LogHeader header;
    header.program = read_text(must, file, "program");
    header.title = read_text(must, file, "title");
    header.experiment_text = read_text(must, file, "experiment");
    header.experiment_sha256 = read_text(must, file, "experiment_sha256");
    header.options_json = read_text(must, file, "options");
    read_attribute(must, file, "seed", type_of<std::uint64_t>(), &header.seed);
    header.sources = read_names(must, file, "sources/name");
    std::size_t const sources = header.sources.size();
    header.source_power_W = read_numbers<double>(must, file, "sources/power_W", sources);
    header.source_first_ray = read_numbers<std::uint64_t>(must, file, "sources/first_ray", sources);
    std::uint64_t& rays = header.source_first_ray.emplace_back();
    read_attribute(must, file, "rays", type_of<std::uint64_t>(), &rays);
    if (!std::is_sorted(header.source_first_ray.begin(), header.source_first_ray.end()))
        must.fail("/sources/first_ray does not increase up to the number of rays");
    header.surfaces = read_names(must, file, "surfaces/name");
    header.media = read_names(must, file, "media/name");
    header.models = read_names(must, file, "models/path");
    std::size_t const wavelengths = open_table(must, file, "wavelengths_nm").values;
    header.wavelengths_m = read_numbers<double>(must, file, "wavelengths_nm", wavelengths);
    for (double& wavelength : header.wavelengths_m)
        wavelength = from_nm(wavelength);
    header.refractive_index =
        read_numbers<double>(must, file, "media/refractive_index", header.media.size() * wavelengths);
    return header;
}

/// Opens a column and returns it with its rows. A chunk that is missing would read as zeros: count them.
std::pair<Handle, hsize_t> open_column(Must const& must, hid_t file, char const* name, hid_t type) {
    std::string const place = std::string("/segments/") + name;
    Handle column(must(H5Dopen2(file, place.c_str(), H5P_DEFAULT), "open the column " + place), H5Dclose);
    Handle const space(H5Dget_space(column), H5Sclose);
    Handle const layout(H5Dget_create_plist(column), H5Pclose);
    hsize_t rows = 0, chunk = 0, chunks = 0;
    if (H5Sget_simple_extent_ndims(space) != 1 ||
        H5Tequal(Handle(H5Dget_type(column), H5Tclose), type) <= 0 || H5Pget_chunk(layout, 1, &chunk) != 1 ||
        chunk == 0)
        must.fail("the column " + place + " has not the type or the layout that is documented");
    must(H5Sget_simple_extent_dims(space, &rows, nullptr), "tell the rows of " + place);
    if (rows > 0)
        must(H5Dget_num_chunks(column, space, &chunks), "count the chunks of " + place);
    if (chunks != rows / chunk + (rows % chunk != 0))
        must.fail("the column " + place + " lacks some of its rows");
    return {std::move(column), rows};
}

} // namespace

struct RayLogReader::State {
    Must must;
    Handle file;
    LogHeader header;
    std::vector<Handle> columns; // the first is `ray`
    hsize_t rows = 0;

    template <class T>
    void read_column(hid_t column, hsize_t first, std::vector<T>& values) const;
    std::uint64_t ray_of(hsize_t row) const;
    hsize_t first_row_from(std::uint64_t ray) const;
    void read_rows(hsize_t first, std::span<Segment> segments) const;
};

template <class T>
void RayLogReader::State::read_column(hid_t column, hsize_t first, std::vector<T>& values) const {
    hsize_t const count = values.size();
    Handle const in_file(H5Dget_space(column), H5Sclose),
        in_memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
    must(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &first, nullptr, &count, nullptr), "select rows");
    must(H5Dread(column, type_of<T>(), in_memory, in_file, H5P_DEFAULT, values.data()), "read rows");
}

std::uint64_t RayLogReader::State::ray_of(hsize_t row) const {
    std::vector<std::uint64_t> value(1);
    read_column(columns.front(), row, value);
    return value.front();
}

/// The first row whose ray is this one or a later one; rows are in the order of rays.
hsize_t RayLogReader::State::first_row_from(std::uint64_t ray) const {
    hsize_t low = 0, high = rows;
    while (low < high) {
        hsize_t const middle = low + (high - low) / 2;
        if (ray_of(middle) < ray)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

void RayLogReader::State::read_rows(hsize_t first, std::span<Segment> segments) const {
    auto column = columns.begin();
    WavelengthInNm unused;
    visit_columns(unused, [&](ColumnInfo, auto get, auto set) {
        std::vector<Stored<decltype(get(Segment{}))>> values(segments.size());
        read_column(*column++, first, values);
        for (std::size_t i = 0; i < values.size(); ++i)
            set(segments[i], values[i]);
    });
    auto const last_event = static_cast<Event>(event_names.size() - 1);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        Segment& s = segments[i];
        if (s.born > last_event || s.ended > last_event || s.medium >= header.media.size() ||
            s.surface < -1 ||
            (s.surface >= 0 && static_cast<std::size_t>(s.surface) >= header.surfaces.size()))
            must.fail("row " + std::to_string(first + i) +
                      " has an event, surface or medium that nothing names");
        auto const& starts = header.source_first_ray; // the last entry is the number of rays
        auto const next = std::upper_bound(starts.begin(), starts.end() - 1, s.ray);
        s.source = static_cast<std::uint16_t>(std::max<std::ptrdiff_t>(next - starts.begin(), 1) - 1);
    }
}

RayLogReader::RayLogReader(std::filesystem::path const& path) : state_(std::make_unique<State>()) {
    prepare_library();
    State& log = *state_;
    std::error_code ignored;
    bool const folder = std::filesystem::is_directory(path, ignored);
    std::filesystem::path const file = folder ? path / "rays.h5" : path;
    log.must = {file.string(), remedy_of_reading};
    if (!std::filesystem::exists(file, ignored))
        log.must.fail(folder ? "this run has no ray log" : "there is no such file");
    if (log.must(H5Fis_hdf5(file.c_str()), "open it") == 0)
        log.must.fail("it is not an HDF5 file");
    log.file = Handle(log.must(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open it"), H5Fclose);
    log.header = read_header(log.must, log.file);
    WavelengthInNm unused;
    visit_columns(unused, [&](ColumnInfo info, auto get, auto) {
        using T = Stored<decltype(get(Segment{}))>;
        auto [column, rows] = open_column(log.must, log.file, info.name, type_of<T>());
        if (!log.columns.empty() && rows != log.rows)
            log.must.fail(std::string("the column /segments/") + info.name + " is not as long as the others");
        log.rows = rows;
        log.columns.push_back(std::move(column));
    });
}

RayLogReader::RayLogReader(RayLogReader&&) noexcept = default;
RayLogReader::~RayLogReader() = default;

LogHeader const& RayLogReader::header() const {
    return state_->header;
}

std::uint64_t RayLogReader::rows() const {
    return state_->rows;
}

std::uint64_t RayLogReader::rays() const {
    return rows() == 0 ? 0 : state_->ray_of(rows() - 1) + 1;
}

std::vector<Segment> RayLogReader::read(std::uint64_t first, std::uint64_t count) const {
    first = std::min(first, rows());
    std::vector<Segment> segments(std::min(count, rows() - first));
    for (std::size_t done = 0; done < segments.size();) {
        std::size_t const portion = std::min(segments.size() - done, portion_rows);
        state_->read_rows(first + done, std::span(segments).subspan(done, portion));
        done += portion;
    }
    return segments;
}

std::vector<Segment> RayLogReader::read_ray(std::uint64_t ray) const {
    std::uint64_t const first = state_->first_row_from(ray);
    std::uint64_t const after = ray == UINT64_MAX ? rows() : state_->first_row_from(ray + 1);
    return read(first, after - first);
}

} // namespace sahl
