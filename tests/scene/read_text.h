// In: the text of an experiment. Out: the experiment read from it, or what its error says. For tests.
#pragma once

#include "math/input_error.h"
#include "scene/read_experiment.h"

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace sahl {

/// A folder that is gone with its owner.
class TemporaryFolder {
  public:
    TemporaryFolder()
        : path(std::filesystem::temp_directory_path() /
               ("sahl_test_" + std::to_string(std::random_device{}()))) {
        std::filesystem::create_directories(path);
    }
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;
    ~TemporaryFolder() { std::filesystem::remove_all(path); }

    void write(std::filesystem::path const& name, std::string const& text) const {
        std::filesystem::create_directories((path / name).parent_path());
        std::ofstream(path / name, std::ios::binary) << text;
    }

    std::filesystem::path path;
};

inline Experiment read_text(std::string const& toml, std::filesystem::path const& file = "test.toml") {
    return read_experiment(parse_toml(toml, "test.toml"), file);
}

/// What the InputError says that `action` throws; empty where it throws none.
template <class Action>
std::string error_of(Action action) {
    try {
        action();
    } catch (InputError const& error) {
        return error.what();
    }
    return {};
}

/// A source of one ray, for experiments that are about something else.
inline constexpr char const one_source[] =
    "[[source]]\nname = \"s\"\nbeam = {from_mm = [0, 0, -50], toward = [0, 0, 1]}\n";

} // namespace sahl
