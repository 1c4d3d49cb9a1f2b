// In: segments in order. Out: rays.h5. Whole chunks are handed to the library ready made (H5Dwrite_chunk):
// nothing but a copy stands between rows and disk. The layout is described in docs/ray-log.md.
#include "math/input_error.h"
#include "record/hdf5_file.h"
#include "record/log_columns.h"
#include "record/ray_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cerrno>
#include <cstring>

namespace sahl {

using namespace hdf5;

namespace {

static_assert(std::endian::native == std::endian::little, "chunks are written as they lie in memory");

constexpr std::size_t chunk_rows = 16384; // 128 KiB of doubles: eight fit the chunk cache of a reader, 1 MiB
constexpr std::size_t block_rows = 32;    // few enough that they and the ends of all columns stay in L1
constexpr char const* remedy_of_writing = "see that the folder is there and has space, or choose another one";

void write_header(Must const& must, hid_t file, LogHeader const& header) {
    std::size_t const sources = header.sources.size();
    assert(header.source_power_W.size() == sources);
    assert(header.source_first_ray.size() == sources + 1 ||
           (sources == 0 && header.source_first_ray.empty()));
    assert(header.refractive_index.size() == header.media.size() * header.wavelengths_m.size());

    std::uint64_t const rays = header.source_first_ray.empty() ? 0 : header.source_first_ray.back();
    write_attribute(must, file, "schema_version", H5T_STD_I32LE, &log_schema_version);
    write_text(must, file, "program", header.program);
    write_text(must, file, "title", header.title);
    write_text(must, file, "experiment", header.experiment_text);
    write_text(must, file, "experiment_sha256", header.experiment_sha256);
    write_text(must, file, "options", header.options_json);
    write_attribute(must, file, "seed", H5T_STD_U64LE, &header.seed);
    write_attribute(must, file, "rays", H5T_STD_U64LE, &rays);

    for (char const* group : {"sources", "surfaces", "media", "models"})
        make_group(must, file, group);
    write_names(must, file, "sources/name", header.sources);
    write_table(must, file, "sources/power_W", H5T_IEEE_F64LE, {sources}, header.source_power_W.data(), "W");
    write_table(must, file, "sources/first_ray", H5T_STD_U64LE, {sources}, header.source_first_ray.data(),
                "");
    write_names(must, file, "surfaces/name", header.surfaces);
    write_names(must, file, "media/name", header.media);
    write_names(must, file, "models/path", header.models);
    std::vector<double> nm(header.wavelengths_m.size());
    std::transform(header.wavelengths_m.begin(), header.wavelengths_m.end(), nm.begin(), in_nm);
    write_table(must, file, "wavelengths_nm", H5T_IEEE_F64LE, {nm.size()}, nm.data(), "nm");
    write_table(must, file, "media/refractive_index", H5T_IEEE_F64LE, {header.media.size(), nm.size()},
                header.refractive_index.data(), "1");
}

/// Everything of this file or folder is on the disk when it returns.
void sync_to_disk(Must const& must, std::filesystem::path const& path) {
    int const descriptor = ::open(path.c_str(), O_RDONLY);
    bool const synced = descriptor >= 0 && ::fsync(descriptor) == 0;
    std::string const reason = std::strerror(errno);
    if (descriptor >= 0)
        ::close(descriptor);
    if (!synced)
        must.fail("cannot bring it to the disk (" + reason + ")");
}

} // namespace

struct RayLogWriter::State {
    struct Column {
        Handle dataset;
        std::vector<std::byte> chunk;
    };

    std::filesystem::path target, temporary;
    Must must;
    bool unfinished = false; // the temporary is there, and ours
    Handle file;
    std::vector<Column> columns;
    WavelengthInNm nm;
    std::size_t filled = 0;    // rows in the chunks in memory
    std::uint64_t written = 0; // rows in the file

    explicit State(std::filesystem::path const& path)
        : target(path), temporary(path.string() + ".tmp"), must{path.string(), remedy_of_writing} {}
    State(State const&) = delete;
    ~State();
    void create(LogHeader const& header);
    void pack(std::span<Segment const> segments);
    void write_chunks();
};

/// Removes what was not closed. It is emptied first: on a full disk the library could not close it otherwise.
RayLogWriter::State::~State() {
    if (!unfinished)
        return;
    std::error_code ignored;
    std::filesystem::resize_file(temporary, 0, ignored);
    columns.clear();
    file.release();
    std::filesystem::remove(temporary, ignored);
}

void RayLogWriter::State::create(LogHeader const& header) {
    prepare_library();
    Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    file = Handle(
        must(H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, timeless(H5P_FILE_CREATE), access), "create it"),
        H5Fclose);
    unfinished = true;
    write_header(must, file, header);
    Handle const group = make_group(must, file, "segments");
    hsize_t const none = 0, chunk = chunk_rows, unlimited = H5S_UNLIMITED;
    Handle const space(must(H5Screate_simple(1, &none, &unlimited), "describe the columns"), H5Sclose);
    Handle const layout = timeless(H5P_DATASET_CREATE);
    must(H5Pset_chunk(layout, 1, &chunk), "describe the columns");
    visit_columns(nm, [&](ColumnInfo info, auto get, auto) {
        using T = Stored<decltype(get(Segment{}))>;
        Handle dataset(
            must(H5Dcreate2(group, info.name, type_of<T>(), space, H5P_DEFAULT, layout, H5P_DEFAULT),
                 std::string("create the column ") + info.name),
            H5Dclose);
        write_text(must, dataset, "unit", info.unit);
        write_text(must, dataset, "meaning", info.meaning);
        columns.push_back({std::move(dataset), std::vector<std::byte>(chunk_rows * sizeof(T))});
    });
}

/// Puts segments, no more than the chunks have room for, behind those that are there.
void RayLogWriter::State::pack(std::span<Segment const> segments) {
    auto column = columns.begin();
    visit_columns(nm, [&](ColumnInfo, auto get, auto) {
        using T = Stored<decltype(get(Segment{}))>;
        std::byte* place = (column++)->chunk.data() + filled * sizeof(T);
        for (Segment const& segment : segments) {
            T const value = static_cast<T>(get(segment));
            std::memcpy(place, &value, sizeof value);
            place += sizeof value;
        }
    });
    filled += segments.size();
}

/// Writes the chunks in memory; what the last one lacks in rows is zero.
void RayLogWriter::State::write_chunks() {
    hsize_t const first = written, rows = written + filled;
    for (Column& column : columns) {
        std::size_t const value = column.chunk.size() / chunk_rows;
        std::fill(column.chunk.begin() + static_cast<std::ptrdiff_t>(filled * value), column.chunk.end(),
                  std::byte{0});
        must(H5Dset_extent(column.dataset, &rows), "write rows");
        must(H5Dwrite_chunk(column.dataset, H5P_DEFAULT, 0, &first, column.chunk.size(), column.chunk.data()),
             "write rows");
    }
    written = rows;
    filled = 0;
}

RayLogWriter::RayLogWriter(std::filesystem::path file, LogHeader const& header)
    : state_(std::make_unique<State>(file)) {
    state_->create(header);
}

RayLogWriter::RayLogWriter(RayLogWriter&&) noexcept = default;
RayLogWriter::~RayLogWriter() = default;

void RayLogWriter::append(std::span<Segment const> segments) {
    while (!segments.empty()) {
        std::size_t const count = std::min({segments.size(), block_rows, chunk_rows - state_->filled});
        state_->pack(segments.first(count));
        segments = segments.subspan(count);
        if (state_->filled == chunk_rows)
            state_->write_chunks();
    }
}

void RayLogWriter::close() {
    State& log = *state_;
    if (log.filled > 0)
        log.write_chunks();
    log.must(H5Fflush(log.file, H5F_SCOPE_GLOBAL), "write it out");
    log.columns.clear();
    log.must(log.file.release(), "close it");
    sync_to_disk(log.must, log.temporary);
    std::error_code problem;
    std::filesystem::rename(log.temporary, log.target, problem);
    if (problem)
        log.must.fail("cannot put it in its place (" + problem.message() + ")");
    log.unfinished = false;
    sync_to_disk(log.must, std::filesystem::absolute(log.target).parent_path());
}

} // namespace sahl
