// In: segments in order. Out: rays.h5, and its rows again.
// The layout is described in docs/ray-log.md; columns and codes are those of the contract.
#pragma once

#include "trace/segment.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// What a log needs to be understood without the experiment: names by id, and who wrote it.
struct LogHeader {
    std::string program; // "sahl 0.1.0"
    std::string title;
    std::string experiment_text; // the file as read
    std::string options_json;    // what was run, with --set and all options
    std::string experiment_sha256;
    std::uint64_t seed = 0;
    std::vector<std::string> sources;
    std::vector<double> source_power_W;
    std::vector<std::uint64_t>
        source_first_ray;                 // number of each source's first ray; one more entry: the total
    std::vector<std::string> surfaces;    // by FaceId: "lens.front"
    std::vector<std::string> media;       // by MediumId
    std::vector<std::string> models;      // paths of the model files, as the experiment names them
    std::vector<double> wavelengths_m;    // all distinct ones
    std::vector<double> refractive_index; // row-major [medium][wavelength]
};

/// Writes rays.h5 under a temporary name beside `file`; close() syncs and renames it. Destroyed unclosed, it
/// removes what it wrote. The same rows give the same bytes, in whatever portions they come.
class RayLogWriter {
  public:
    RayLogWriter(std::filesystem::path file, LogHeader const& header);
    RayLogWriter(RayLogWriter&&) noexcept;
    ~RayLogWriter();
    void append(std::span<Segment const> segments);
    void close();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Reads rays.h5; a bad file is an InputError.
class RayLogReader {
  public:
    /// `path` is the file, or the folder of a run that has a rays.h5.
    explicit RayLogReader(std::filesystem::path const& path);
    RayLogReader(RayLogReader&&) noexcept;
    ~RayLogReader();
    LogHeader const& header() const;
    std::uint64_t rows() const;
    std::uint64_t rays() const; // number of the last ray + 1; 0 for an empty log
    /// Rows [first, first + count), clamped to the end.
    std::vector<Segment> read(std::uint64_t first, std::uint64_t count) const;
    /// All rows of one ray, found by bisection; empty if the log has none.
    std::vector<Segment> read_ray(std::uint64_t ray) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace sahl
