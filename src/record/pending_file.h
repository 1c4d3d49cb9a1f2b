// In: bytes, portion by portion. Out: a file that is there when all of it is.
#pragma once

#include "math/input_error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace sahl {

/// A file that takes its name when it is complete, and leaves nothing behind otherwise.
class PendingFile {
  public:
    explicit PendingFile(std::filesystem::path target) : target_(std::move(target)), temporary_(target_) {
        temporary_ += ".tmp";
        stream_.open(temporary_, std::ios::binary | std::ios::trunc);
        check("cannot create it");
    }
    ~PendingFile() {
        stream_.close();
        std::error_code ignored;
        if (!finished_)
            std::filesystem::remove(temporary_, ignored);
    }
    void write(std::string_view bytes) {
        stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        check("cannot write rows");
    }
    void finish() {
        stream_.close();
        check("cannot write rows");
        std::error_code problem;
        std::filesystem::rename(temporary_, target_, problem);
        if (problem)
            fail("cannot put it in its place (" + problem.message() + ")");
        finished_ = true;
    }

  private:
    void check(std::string const& problem) {
        if (!stream_)
            fail(problem + " (" + std::strerror(errno) + ")");
    }
    [[noreturn]] void fail(std::string const& problem) {
        throw InputError(target_.string(), problem,
                         "see that the folder is there and has space, or choose another one");
    }

    std::filesystem::path target_, temporary_;
    std::ofstream stream_;
    bool finished_ = false;
};

} // namespace sahl
