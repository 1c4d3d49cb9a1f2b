// Figures, never asserted: how fast rows become a log. The segments of rays into a glass ball lie in memory;
// they are written raw, compressed, and by HDF5's own deflate, beside a plain buffered write of the raw log's
// bytes, each brought to the disk; one after another in each round, medians of all rounds.
// usage: log_writing [RAYS [ROUNDS [FOLDER]]]
#include "benchmarks/glass_ball.h"
#include "record/hdf5_file.h"
#include "record/log_columns.h"
#include "support/cpu_clock.h"

#include <oneapi/tbb/parallel_pipeline.h>

#include <cstdio>

namespace {

using namespace sahl;
namespace fs = std::filesystem;

std::vector<Segment> segments_of(Scene const& scene, Emission const& emission,
                                 WavelengthTable const& optics) {
    TraceOptions options;
    options.min_power = 1e-4;
    TraceContext const context{scene, optics, emission, options, power_unit(emission), 1};
    SegmentBatch batch;
    trace_batch(context, 0, emission.rays(), &batch);
    return std::move(batch.segments);
}

/// As trace_scene hands them on, on all threads.
void write_log(fs::path const& file, LogHeader const& header, bool compress,
               std::span<Segment const> segments) {
    constexpr std::size_t together = 3 * chunk_rows; // about a batch of rays
    RayLogWriter log(file, header, {compress});
    std::size_t next = 0;
    using Chunks = std::shared_ptr<std::vector<LogChunk>>;
    using tbb::filter_mode;
    using tbb::make_filter;
    tbb::parallel_pipeline(
        8, make_filter<void, std::span<Segment const>>(filter_mode::serial_in_order,
                                                       [&](tbb::flow_control& control) {
                                                           auto const rest = segments.subspan(next);
                                                           if (rest.empty())
                                                               control.stop();
                                                           next += std::min(together, rest.size());
                                                           return rest.first(std::min(together, rest.size()));
                                                       }) &
               make_filter<std::span<Segment const>, std::shared_ptr<LogBlock>>(
                   filter_mode::parallel,
                   [&](std::span<Segment const> part) {
                       auto block = std::make_shared<LogBlock>(log.block());
                       block->take(part);
                       return block;
                   }) &
               make_filter<std::shared_ptr<LogBlock>, Chunks>(
                   filter_mode::serial_in_order,
                   [&](std::shared_ptr<LogBlock> const& block) {
                       return std::make_shared<std::vector<LogChunk>>(log.place(std::move(*block)));
                   }) &
               make_filter<Chunks, Chunks>(filter_mode::parallel,
                                           [&](Chunks chunks) {
                                               log.pack(*chunks);
                                               return chunks;
                                           }) &
               make_filter<Chunks, void>(filter_mode::serial_in_order,
                                         [&](Chunks const& chunks) { log.write(std::move(*chunks)); }));
    log.close();
}

/// The same columns through H5Dwrite, which compresses itself.
void write_by_library(fs::path const& file, bool shuffle, std::span<Segment const> segments) {
    using namespace hdf5;
    prepare_library();
    Must const must{file.string(), "see that there is space"};
    Handle out(must(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), "create it"), H5Fclose);
    hsize_t const total = segments.size(), chunk = chunk_rows;
    Handle const layout(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(layout, 1, &chunk);
    if (shuffle)
        H5Pset_shuffle(layout);
    H5Pset_deflate(layout, 1);
    Handle const space(H5Screate_simple(1, &total, nullptr), H5Sclose);
    std::vector<Handle> columns;
    WavelengthInNm nm;
    visit_columns(nm, false, [&](ColumnInfo info, auto get, auto) {
        columns.emplace_back(must(H5Dcreate2(out, info.name, type_of<Stored<decltype(get(Segment{}))>>(),
                                             space, H5P_DEFAULT, layout, H5P_DEFAULT),
                                  "create a column"),
                             H5Dclose);
    });
    std::vector<double> memory(chunk_rows);
    for (hsize_t first = 0; first < total; first += chunk_rows) {
        hsize_t const count = std::min<hsize_t>(chunk_rows, total - first);
        H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr);
        Handle const part(H5Screate_simple(1, &count, nullptr), H5Sclose);
        std::size_t column = 0;
        visit_columns(nm, false, [&](ColumnInfo, auto get, auto) {
            using T = Stored<decltype(get(Segment{}))>;
            T* const values = reinterpret_cast<T*>(memory.data());
            for (std::size_t i = 0; i < count; ++i)
                values[i] = static_cast<T>(get(segments[first + i]));
            must(H5Dwrite(columns[column++], type_of<T>(), part, space, H5P_DEFAULT, values), "write rows");
        });
    }
    columns.clear();
    must(out.release(), "close it");
    int const descriptor = ::open(file.c_str(), O_RDONLY);
    ::fsync(descriptor);
    ::close(descriptor);
}

void measure(std::uint64_t rays, int rounds, fs::path const& folder) {
    Scene const scene = bench::glass_ball(false, rays);
    WavelengthTable const optics(scene);
    Emission const emission(scene.sources, optics, 1);
    LogHeader const header = bench::header_of(scene, emission);
    std::vector<Segment> const segments = segments_of(scene, emission, optics);
    std::map<std::string, bench::Timing> by;
    std::map<std::string, std::uint64_t> bytes;
    auto const time = [&](char const* what, auto&& write) {
        bench::empty(folder);
        by[what].time([&] { write(folder / "rays.h5"); });
        bytes[what] = bench::bytes_in(folder);
    };
    for (int round = 0; round < rounds; ++round) {
        for (bool const plain : {round % 2 == 1, round % 2 == 0}) // neither is always the first
            if (plain)
                time("plain write", [&](fs::path const& file) { bench::plain_write(file, bytes["raw"]); });
            else
                time("raw", [&](fs::path const& file) { write_log(file, header, false, segments); });
        time("compressed", [&](fs::path const& file) { write_log(file, header, true, segments); });
        time("HDF5 deflate", [&](fs::path const& file) { write_by_library(file, false, segments); });
        time("HDF5 shuffle + deflate", [&](fs::path const& file) { write_by_library(file, true, segments); });
    }
    fs::remove_all(folder);
    std::printf("%zu rows; medians of %d rounds\n", segments.size(), rounds);
    auto const rate = [&](char const* what) {
        return 1e-6 * static_cast<double>(segments.size()) / bench::median(by[what].wall);
    };
    for (char const* what : {"plain write", "raw", "compressed", "HDF5 deflate", "HDF5 shuffle + deflate"})
        std::printf("  %-22s  %6.3f s wall  %6.3f s CPU  %5.0f MB  %6.2f M rows/s\n", what,
                    bench::median(by[what].wall), bench::median(by[what].cpu),
                    1e-6 * static_cast<double>(bytes[what]), rate(what));
    std::printf("raw rows: %.2f of the plain write's rate; compressed: %.1f x HDF5's own deflate, %.1f x its "
                "shuffle and deflate\n",
                rate("raw") / rate("plain write"), rate("compressed") / rate("HDF5 deflate"),
                rate("compressed") / rate("HDF5 shuffle + deflate"));
}

} // namespace

int main(int argc, char** argv) {
    std::uint64_t const rays = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100000;
    int const rounds = argc > 2 ? std::atoi(argv[2]) : 7;
    fs::path const folder = argc > 3 ? fs::path(argv[3]) / "sahl-benchmark-log-writing"
                                     : fs::temp_directory_path() / "sahl-benchmark-log-writing";
    measure(rays, rounds, folder);
    return 0;
}
