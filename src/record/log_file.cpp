// In: chunks of rows. Out: one HDF5 file of them; see log_file.h.
#include "record/log_file.h"

#include "record/log_header.h"

#include <bit>
#include <cstring>

namespace sahl {

using namespace hdf5;

namespace {

static_assert(std::endian::native == std::endian::little, "chunks are written as they lie in memory");

constexpr unsigned deflate_level = 1; // what the file says of its chunks; readers need not know it
// Chunks begin where a page of memory does: the system then takes a chunk in a few large pieces.
constexpr hsize_t page = 4096;

/// Objects of HDF5 1.10, whose structures have checksums: a flipped bit in one is an error when it is read.
Handle create_file(Must const& must, std::filesystem::path const& path) {
    prepare_library();
    Handle const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
    H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
    H5Pset_alignment(access, chunk_rows, page); // chunk_rows: bytes of the smallest chunk
    return {must(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, timeless(H5P_FILE_CREATE), access), "create it"),
            H5Fclose};
}

void close_file(Must const& must, Handle& file) {
    must(H5Fflush(file, H5F_SCOPE_GLOBAL), "write it out");
    must(file.release(), "close it");
}

/// Creates every column in /segments.
///   layout(type, name)   the creation properties of a column
std::vector<Handle> create_columns(Must const& must, hid_t file, hid_t space, bool digits_lost,
                                   auto&& layout) {
    Handle const group = make_group(must, file, "segments");
    std::vector<Handle> columns;
    WavelengthInNm unused;
    visit_columns(unused, digits_lost, [&](ColumnInfo info, auto get, auto) {
        hid_t const type = type_of<Stored<decltype(get(Segment{}))>>();
        Handle const properties = layout(type, info.name);
        Handle& column = columns.emplace_back(
            must(H5Dcreate2(group, info.name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                 std::string("create the column ") + info.name),
            H5Dclose);
        write_text(must, column, "unit", info.unit);
        write_text(must, column, "meaning", info.meaning);
    });
    return columns;
}

} // namespace

LogFile::LogFile(Must const& must, std::filesystem::path path, LogHeader const& header,
                 RayLogOptions const& options, std::uint64_t first_row)
    : must_(must), path_(std::move(path)), file_(create_file(must, path_)), places_(path_) {
    unfinished_ = true;
    write_header(must, file_, header);
    write_attribute(must, file_, "first_row", H5T_STD_U64LE, &first_row);
    hsize_t const none = 0, chunk = chunk_rows, unlimited = H5S_UNLIMITED;
    Handle const space(must(H5Screate_simple(1, &none, &unlimited), "describe the columns"), H5Sclose);
    columns_ = create_columns(must, file_, space, header.digits_lost, [&](hid_t, char const*) {
        Handle layout = timeless(H5P_DATASET_CREATE);
        must(H5Pset_chunk(layout, 1, &chunk), "describe the columns");
        if (options.compress) {
            must(H5Pset_shuffle(layout), "describe the columns");
            must(H5Pset_deflate(layout, deflate_level), "describe the columns");
        } else { // a chunk has its place before it is written, and nothing else is written there
            must(H5Pset_alloc_time(layout, H5D_ALLOC_TIME_EARLY), "describe the columns");
            must(H5Pset_fill_time(layout, H5D_FILL_TIME_NEVER), "describe the columns");
        }
        return layout;
    });
}

/// What was not closed is emptied first: on a full disk the library could not close it otherwise.
LogFile::~LogFile() {
    if (!unfinished_)
        return;
    std::error_code ignored;
    std::filesystem::resize_file(path_, 0, ignored);
    columns_.clear();
    file_.release();
    std::filesystem::remove(path_, ignored);
}

void LogFile::write(LogChunk const& chunk) {
    if (rows_ == 0)
        std::memcpy(&first_ray_, chunk.slices.front().column(0).data(), sizeof first_ray_);
    hsize_t const first = rows_, rows = rows_ + chunk.rows();
    for (Handle const& column : columns_)
        must_(H5Dset_extent(column, &rows), "write rows");
    if (chunk.compressed.empty())
        write_raw(chunk);
    for (std::size_t i = 0; i < chunk.compressed.size(); ++i) {
        std::vector<std::byte> const& bytes = chunk.compressed[i];
        must_(H5Dwrite_chunk(columns_[i], H5P_DEFAULT, 0, &first, bytes.size(), bytes.data()), "write rows");
    }
    rows_ = rows;
    places_.begin_to_sync();
}

/// Columns whose places lie one behind another are written at once. Rows that are missing in the last chunk
/// are zero: nothing has ever been written there.
void LogFile::write_raw(LogChunk const& chunk) {
    std::vector<std::span<std::byte const>> parts;
    std::uint64_t begin = 0, end = 0;
    auto const put = [&] {
        if (std::error_code const problem = places_.write(begin, parts))
            must_.fail("cannot write rows (" + problem.message() + ")");
        parts.clear();
    };
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        hsize_t const first = rows_;
        unsigned filters = 0;
        haddr_t place = 0;
        hsize_t bytes = 0;
        must_(H5Dget_chunk_info_by_coord(columns_[i], &first, &filters, &place, &bytes), "write rows");
        if (place != end) {
            put();
            begin = end = place;
        }
        for (LogSlice const& slice : chunk.slices) {
            parts.push_back(slice.column(i));
            end += parts.back().size();
        }
    }
    put();
}

void LogFile::close() {
    columns_.clear();
    close_file(must_, file_);
    unfinished_ = false;
}

void write_log_of_shards(Must const& must, std::filesystem::path const& path, LogHeader const& header,
                         std::vector<LogShard> const& shards) {
    Handle file = create_file(must, path);
    write_header(must, file, header);
    std::vector<std::string> names;
    std::vector<std::uint64_t> rows, first_rays;
    hsize_t total = 0;
    for (LogShard const& shard : shards) {
        names.push_back(shard.name);
        rows.push_back(shard.rows);
        first_rays.push_back(shard.first_ray);
        total += shard.rows;
    }
    make_group(must, file, "shards");
    write_names(must, file, "shards/name", names);
    write_table(must, file, "shards/rows", H5T_STD_U64LE, {rows.size()}, rows.data(), "");
    write_table(must, file, "shards/first_ray", H5T_STD_U64LE, {rows.size()}, first_rays.data(), "");

    Handle const space(must(H5Screate_simple(1, &total, nullptr), "describe the columns"), H5Sclose);
    create_columns(must, file, space, header.digits_lost, [&](hid_t, char const* name) {
        Handle layout = timeless(H5P_DATASET_CREATE);
        std::string const place = std::string("/segments/") + name;
        hsize_t first = 0;
        for (LogShard const& shard : shards) {
            hsize_t const count = shard.rows;
            Handle const there(H5Screate_simple(1, &count, nullptr), H5Sclose);
            must(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr),
                 "describe the columns");
            must(H5Pset_virtual(layout, space, shard.name.c_str(), place.c_str(), there),
                 "describe the columns");
            first += count;
        }
        H5Sselect_all(space);
        return layout;
    });
    close_file(must, file);
}

std::vector<LogShard> read_shards(Must const& must, hid_t file) {
    if (must(H5Lexists(file, "shards", H5P_DEFAULT), "look for its shards") == 0)
        return {};
    std::vector<std::string> const names = read_names(must, file, "shards/name");
    auto const rows = read_numbers<std::uint64_t>(must, file, "shards/rows", names.size());
    auto const first_rays = read_numbers<std::uint64_t>(must, file, "shards/first_ray", names.size());
    std::vector<LogShard> shards;
    for (std::size_t i = 0; i < names.size(); ++i)
        shards.push_back({names[i], rows[i], first_rays[i]});
    return shards;
}

} // namespace sahl
