// In: what is wrong with a user's input. Out: the one exception that carries it to the program's main.
#pragma once

#include <stdexcept>
#include <string>

namespace sahl {

/// Bad input: where (file and line, or file and JSON pointer), what is wrong and why, and what to do about
/// it. what() reads `place: problem; remedy`.
class InputError : public std::runtime_error {
  public:
    InputError(std::string const& place, std::string const& problem, std::string const& remedy)
        : std::runtime_error(place + ": " + problem + (remedy.empty() ? "" : "; " + remedy)) {}
};

} // namespace sahl
