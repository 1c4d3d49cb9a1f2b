// In: names as written and names that are known. Out: the words of a message, or the refusal of a name.
#include "scene/read_table.h"

#include "math/input_error.h"
#include "math/nearest_name.h"

#include <algorithm>

namespace sahl {

namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return result;
}

} // namespace

std::string did_you_mean(std::string_view word, std::vector<std::string> const& known) {
    std::string const low = lower(word);
    std::vector<std::string> lowered;
    for (auto const& name : known)
        lowered.push_back(lower(name));
    auto best = std::find_if(lowered.begin(), lowered.end(), [&](auto const& name) {
        return name.rfind(low + "_", 0) == 0 ||
               (name.size() > low.size() && name.ends_with(low) && name[name.size() - low.size() - 1] == '-');
    });
    if (best == lowered.end())
        best = std::find(lowered.begin(), lowered.end(), nearest_name(low, lowered));
    return best == lowered.end()
               ? std::string()
               : "did you mean '" + known[static_cast<std::size_t>(best - lowered.begin())] + "'?";
}

std::string listed(std::vector<std::string> const& names) {
    std::string text;
    for (auto const& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

void check_name(std::string const& name, Place const& place) {
    auto const cannot_be_in_a_key = [](char c) {
        return c == '.' || c == '[' || c == ']' || c == '=' || static_cast<unsigned char>(c) < 32;
    };
    if (name.empty() || std::any_of(name.begin(), name.end(), cannot_be_in_a_key))
        throw InputError(place.text(),
                         "\"" + name + "\" cannot be a name, since keys are written object.NAME.key[0]",
                         "give one without dots, brackets and '=', for instance \"lens1\"");
}

} // namespace sahl
