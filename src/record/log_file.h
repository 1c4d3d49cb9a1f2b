// In: chunks of rows. Out: one HDF5 file of them. The library says where a chunk's place is, and it is
// written there from where its rows lie; compressed ones are handed to the library ready made
// (H5Dwrite_chunk). The layout is described in docs/ray-log.md.
#pragma once

#include "record/disk.h"
#include "record/hdf5_file.h"
#include "record/ray_log.h"

#include <filesystem>

namespace sahl {

/// A file of a log's rows that is being written. Destroyed unclosed, it removes the file.
class LogFile {
  public:
    /// first_row   number of its first row in the whole log
    LogFile(hdf5::Must const& must, std::filesystem::path path, LogHeader const& header,
            RayLogOptions const& options, std::uint64_t first_row);
    LogFile(LogFile const&) = delete;
    ~LogFile();
    void write(LogChunk const& chunk);
    /// Everything is with the system when it returns, though not on the disk.
    void close();
    std::filesystem::path const& path() const { return path_; }
    std::uint64_t rows() const { return rows_; }
    std::uint64_t first_ray() const { return first_ray_; } // of its first row

  private:
    void write_raw(LogChunk const& chunk);

    hdf5::Must const& must_;
    std::filesystem::path path_;
    bool unfinished_ = false; // the file is there, and is not closed
    hdf5::Handle file_;
    std::vector<hdf5::Handle> columns_;
    PlacesInFile places_;
    std::uint64_t rows_ = 0, first_ray_ = 0;
};

/// A part of a log that is a file of its own, as the log's table /shards has it.
struct LogShard {
    std::string name; // relative to the folder of the log
    std::uint64_t rows = 0, first_ray = 0;
};

/// A file that shows the rows of all shards as one, by HDF5's virtual datasets.
void write_log_of_shards(hdf5::Must const& must, std::filesystem::path const& path, LogHeader const& header,
                         std::vector<LogShard> const& shards);
/// The table of shards; empty if the log's rows are in the file itself.
std::vector<LogShard> read_shards(hdf5::Must const& must, hid_t file);

} // namespace sahl
