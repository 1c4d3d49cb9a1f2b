// In: files and folders. Out: the same on the disk, for good.
#pragma once

#include "math/input_error.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>

namespace sahl {

/// Everything of this file or folder is on the disk when it returns; what hinders it is an InputError.
void sync_to_disk(std::filesystem::path const& path, std::string const& remedy);

/// Gives a file or folder, which is on the disk, another name for good; what had that name is replaced.
void move_on_disk(std::filesystem::path const& from, std::filesystem::path const& to,
                  std::string const& remedy);

/// Writes to places of a file that a library has open too, which knows where they are.
class PlacesInFile {
  public:
    explicit PlacesInFile(std::filesystem::path const& file);
    PlacesInFile(PlacesInFile const&) = delete;
    ~PlacesInFile();
    /// Parts one behind another, the first at `place`, in bytes; what hinders it, if anything.
    std::error_code write(std::uint64_t place, std::span<std::span<std::byte const> const> parts) const;
    /// Whatever has been written since the last call, of the library too, begins to go to the disk while the
    /// caller goes on, where the system offers that.
    void begin_to_sync();

  private:
    int descriptor_;
    std::uint64_t begun_ = 0; // bytes
};

} // namespace sahl
