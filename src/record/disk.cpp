// In: files and folders. Out: the same on the disk, for good; see disk.h.
#include "record/disk.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

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

} // namespace sahl
