// In: files and folders. Out: the same on the disk, for good; see disk.h.
#include "record/disk.h"

#include <fcntl.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

namespace sahl {

void sync_to_disk(std::filesystem::path const& path, std::string const& remedy) {
    int const descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    bool const synced = descriptor >= 0 && ::fsync(descriptor) == 0;
    std::string const reason = std::strerror(errno);
    if (descriptor >= 0)
        ::close(descriptor);
    if (!synced)
        throw InputError(path.string(), "cannot bring it to the disk (" + reason + ")", remedy);
}

void move_on_disk(std::filesystem::path const& from, std::filesystem::path const& to,
                  std::string const& remedy) {
    std::error_code problem;
    if (std::filesystem::is_directory(to, problem))
        std::filesystem::remove_all(to, problem);
    std::filesystem::rename(from, to, problem);
    if (problem)
        throw InputError(to.string(), "cannot put it in its place (" + problem.message() + ")", remedy);
    sync_to_disk(std::filesystem::absolute(to).parent_path(), remedy);
}

PlacesInFile::PlacesInFile(std::filesystem::path const& file)
    : descriptor_(::open(file.c_str(), O_WRONLY | O_CLOEXEC)) {}

PlacesInFile::~PlacesInFile() {
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

std::error_code PlacesInFile::write(std::uint64_t place,
                                    std::span<std::span<std::byte const> const> parts) const {
    constexpr std::size_t at_once = 64; // parts; every system takes that many
    std::vector<iovec> rest;
    for (auto const& part : parts) // which are only read
        rest.push_back({const_cast<std::byte*>(part.data()), part.size()});
    for (std::size_t first = 0; first < rest.size();) {
        auto done =
            ::pwritev(descriptor_, &rest[first], static_cast<int>(std::min(at_once, rest.size() - first)),
                      static_cast<off_t>(place));
        if (done < 0 && errno == EINTR)
            continue;
        if (done < 0)
            return {errno, std::generic_category()};
        place += static_cast<std::uint64_t>(done);
        for (; first < rest.size() && static_cast<std::size_t>(done) >= rest[first].iov_len; ++first)
            done -= static_cast<ssize_t>(rest[first].iov_len);
        if (done > 0) {
            rest[first].iov_base = static_cast<std::byte*>(rest[first].iov_base) + done;
            rest[first].iov_len -= static_cast<std::size_t>(done);
        }
    }
    return {};
}

void PlacesInFile::begin_to_sync() {
#ifdef SYNC_FILE_RANGE_WRITE
    auto const end = ::lseek(descriptor_, 0, SEEK_END);
    if (end <= static_cast<off_t>(begun_))
        return;
    ::sync_file_range(descriptor_, static_cast<off_t>(begun_), end - static_cast<off_t>(begun_),
                      SYNC_FILE_RANGE_WRITE);
    begun_ = static_cast<std::uint64_t>(end);
#endif
}

} // namespace sahl
