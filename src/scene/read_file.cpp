// In: paths. Out: bytes, or why there are none.
#include "scene/read_file.h"

#include "math/input_error.h"
#include "math/nearest_name.h"
#include "scene/read_table.h"

#include <algorithm>
#include <fstream>

namespace sahl {

std::filesystem::path existing_file(std::filesystem::path const& folder, std::string const& name,
                                    Place const& place) {
    namespace fs = std::filesystem;
    fs::path const path = (folder / name).lexically_normal();
    std::error_code error;
    if (fs::is_regular_file(path, error))
        return path;
    std::vector<std::string> beside;
    for (fs::directory_iterator it(path.has_parent_path() ? path.parent_path() : ".", error), end;
         !error && it != end && beside.size() < 1000; it.increment(error))
        beside.push_back(it->path().filename().string());
    std::sort(beside.begin(), beside.end());
    std::string const wanted = path.filename().string(), nearest = nearest_name(wanted, beside);
    bool const near = !nearest.empty() && 2 * edit_distance(wanted, nearest) <= wanted.size();
    throw InputError(place.text(), "there is no file " + path.string(),
                     near
                         ? did_you_mean(wanted, beside)
                         : "correct the path, which is relative to the experiment's file, or bring the file: "
                           "the experiment's page may say from where");
}

std::string file_text(std::filesystem::path const& path) {
    constexpr std::uintmax_t most = std::uintmax_t(1) << 30;
    std::error_code error;
    if (!std::filesystem::exists(path, error))
        throw InputError(path.string(), "there is no such file", "check the path");
    if (!std::filesystem::is_regular_file(path, error))
        throw InputError(path.string(), "this is not a file", "name a file");
    std::uintmax_t const size = std::filesystem::file_size(path, error);
    if (error || size > most)
        throw InputError(path.string(), "this file has more than 1 GiB", "split it");
    std::ifstream in(path, std::ios::binary);
    std::string text(size, '\0');
    in.read(text.data(), static_cast<std::streamsize>(size));
    if (!in)
        throw InputError(path.string(), "this file cannot be read", "check its permissions");
    return text;
}

} // namespace sahl
