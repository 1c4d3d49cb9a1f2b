// In: rays.h5. Out: its header and its rows, checked: whoever reads on may use any event, surface or medium
// as an index.
#include "record/hdf5_file.h"
#include "record/log_columns.h"
#include "record/log_file.h"
#include "record/log_header.h"
#include "record/ray_log.h"

#include <algorithm>

namespace sahl {

using namespace hdf5;

namespace {

constexpr std::size_t portion_rows = 65536; // read at once: 0.5 MiB a column
constexpr char const* remedy_of_reading = "trace again with log = true, or give a rays.h5 that is whole";

Handle open_file(Must const& must) {
    prepare_library();
    std::error_code ignored;
    if (!std::filesystem::exists(must.file, ignored))
        must.fail("there is no such file");
    if (must(H5Fis_hdf5(must.file.c_str()), "open it") == 0)
        must.fail("it is not an HDF5 file");
    return {must(H5Fopen(must.file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open it"), H5Fclose};
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

bool tells_digits_lost(Must const& must, hid_t file) {
    return must(H5Lexists(file, "segments", H5P_DEFAULT), "look for its columns") > 0 &&
           must(H5Lexists(file, "segments/digits_lost", H5P_DEFAULT), "look for its columns") > 0;
}

} // namespace

struct RayLogReader::State {
    /// A file that has rows: a shard, or the log itself. Opened when it is first asked.
    struct Part {
        Must must;
        hsize_t first_row = 0, rows = 0;
        std::uint64_t first_ray = 0;
        Handle file;
        std::vector<Handle> columns; // the first is `ray`
        bool digits_lost = false;    // the last is that

        Part(std::filesystem::path const& path, hsize_t first, hsize_t count = 0, std::uint64_t ray = 0)
            : must{path.string(), remedy_of_reading}, first_row(first), rows(count), first_ray(ray) {}
        hsize_t open(Handle from);
        template <class T>
        void read_column(hid_t column, hsize_t first, std::vector<T>& values) const;
        void read(hsize_t first, std::span<Segment> segments) const;
    };

    LogHeader header;
    mutable std::vector<Part> parts;
    hsize_t rows = 0;

    void open(std::filesystem::path const& path);
    Part const& opened(std::size_t part) const;
    Part const& part_of(hsize_t row) const;
    std::uint64_t ray_of(hsize_t row) const;
    hsize_t first_row_from(std::uint64_t ray) const;
    void check(hsize_t first, std::span<Segment> segments) const;
};

/// Opens the columns and returns their rows.
hsize_t RayLogReader::State::Part::open(Handle from) {
    file = std::move(from);
    hsize_t found = 0;
    digits_lost = tells_digits_lost(must, file);
    WavelengthInNm unused;
    visit_columns(unused, digits_lost, [&](ColumnInfo info, auto get, auto) {
        using T = Stored<decltype(get(Segment{}))>;
        auto [column, length] = open_column(must, file, info.name, type_of<T>());
        if (!columns.empty() && length != found)
            must.fail(std::string("the column /segments/") + info.name + " is not as long as the others");
        found = length;
        columns.push_back(std::move(column));
    });
    if (rows != 0 && rows != found)
        must.fail("it has " + std::to_string(found) + " rows where the log says " + std::to_string(rows));
    return rows = found;
}

template <class T>
void RayLogReader::State::Part::read_column(hid_t column, hsize_t first, std::vector<T>& values) const {
    hsize_t const count = values.size();
    Handle const in_file(H5Dget_space(column), H5Sclose),
        in_memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
    must(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, &first, nullptr, &count, nullptr), "select rows");
    must(H5Dread(column, type_of<T>(), in_memory, in_file, H5P_DEFAULT, values.data()), "read rows");
}

/// first   counted from the beginning of this part
void RayLogReader::State::Part::read(hsize_t first, std::span<Segment> segments) const {
    auto column = columns.begin();
    WavelengthInNm unused;
    visit_columns(unused, digits_lost, [&](ColumnInfo, auto get, auto set) {
        std::vector<Stored<decltype(get(Segment{}))>> values(segments.size());
        read_column(*column++, first, values);
        for (std::size_t i = 0; i < values.size(); ++i)
            set(segments[i], values[i]);
    });
}

void RayLogReader::State::open(std::filesystem::path const& path) {
    Must const must{path.string(), remedy_of_reading};
    Handle file = open_file(must);
    header = read_header(must, file);
    header.digits_lost = tells_digits_lost(must, file);
    std::vector<LogShard> const shards = read_shards(must, file);
    if (shards.empty())
        rows = parts.emplace_back(path, 0).open(std::move(file));
    for (LogShard const& shard : shards) {
        if (shard.rows == 0 || shard.rows > INT64_MAX - rows)
            must.fail("/shards has a file of so many rows as cannot be: " + shard.name);
        if (std::filesystem::path(shard.name).is_absolute() || shard.name.find("..") != std::string::npos)
            must.fail("/shards names a file that is not beside it: " + shard.name);
        parts.emplace_back(path.parent_path() / shard.name, rows, shard.rows, shard.first_ray);
        rows += shard.rows;
    }
}

RayLogReader::State::Part const& RayLogReader::State::opened(std::size_t number) const {
    Part& part = parts[number];
    if (part.columns.empty())
        part.open(open_file(part.must));
    return part;
}

RayLogReader::State::Part const& RayLogReader::State::part_of(hsize_t row) const {
    auto const after = std::upper_bound(parts.begin(), parts.end(), row,
                                        [](hsize_t r, Part const& part) { return r < part.first_row; });
    return opened(static_cast<std::size_t>(after - parts.begin()) - 1);
}

std::uint64_t RayLogReader::State::ray_of(hsize_t row) const {
    Part const& part = part_of(row);
    std::vector<std::uint64_t> value(1);
    part.read_column(part.columns.front(), row - part.first_row, value);
    return value.front();
}

/// The first row whose ray is this one or a later one; rows are in the order of rays.
hsize_t RayLogReader::State::first_row_from(std::uint64_t ray) const {
    auto const after = std::partition_point(parts.begin() + 1, parts.end(),
                                            [&](Part const& part) { return part.first_ray < ray; });
    hsize_t low = (after - 1)->first_row, high = low + (after - 1)->rows;
    while (low < high) {
        hsize_t const middle = low + (high - low) / 2;
        if (ray_of(middle) < ray)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

void RayLogReader::State::check(hsize_t first, std::span<Segment> segments) const {
    auto const last_event = static_cast<Event>(event_names.size() - 1);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        Segment& s = segments[i];
        if (s.born > last_event || s.ended > last_event || s.medium >= header.media.size() ||
            s.surface < -1 ||
            (s.surface >= 0 && static_cast<std::size_t>(s.surface) >= header.surfaces.size()))
            part_of(first).must.fail("row " + std::to_string(first + i) +
                                     " has an event, surface or medium that nothing names");
        auto const& starts = header.source_first_ray; // the last entry is the number of rays
        auto const next = std::upper_bound(starts.begin(), starts.end() - 1, s.ray);
        s.source = static_cast<std::uint16_t>(std::max<std::ptrdiff_t>(next - starts.begin(), 1) - 1);
    }
}

RayLogReader::RayLogReader(std::filesystem::path const& path) : state_(std::make_unique<State>()) {
    std::error_code ignored;
    bool const folder = std::filesystem::is_directory(path, ignored);
    std::filesystem::path const file = folder ? path / "rays.h5" : path;
    if (folder && !std::filesystem::exists(file, ignored))
        Must{file.string(), remedy_of_reading}.fail("this run has no ray log");
    state_->open(file);
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
        State::Part const& part = state_->part_of(first + done);
        std::uint64_t const at = first + done - part.first_row;
        std::size_t const portion =
            std::min({segments.size() - done, portion_rows, static_cast<std::size_t>(part.rows - at)});
        auto const rows = std::span(segments).subspan(done, portion);
        part.read(at, rows);
        state_->check(first + done, rows);
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
