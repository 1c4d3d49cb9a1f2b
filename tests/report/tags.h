// In: a page. Out: whether it is well formed, and what stands in it. Knows just enough of HTML to judge our
// own pages.
#pragma once

#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace sahl::sample {

/// Why the text is not well-formed, or nothing. Demanded: every tag is closed in order or by "/>", attributes
/// are quoted and unique, "<" and "&" stand only in tags and in the five entities, no control characters.
inline std::string fault_of(std::string_view page) {
    std::vector<std::string> open;
    auto const excerpt = [&](std::size_t at) { return " at: " + std::string(page.substr(at, 60)); };
    if (page.starts_with("<!DOCTYPE html>"))
        page.remove_prefix(15);
    for (std::size_t i = 0; i < page.size();) {
        char const c = page[i];
        if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
            return "control character" + excerpt(i);
        if (c == '&') {
            auto const end = page.find(';', i);
            std::string_view const entity = page.substr(i, end - i + 1);
            if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;" &&
                entity != "&#39;")
                return "stray &" + excerpt(i);
        }
        if (c != '<') {
            ++i;
            continue;
        }
        bool const closing = i + 1 < page.size() && page[i + 1] == '/';
        std::size_t at = i + (closing ? 2 : 1);
        std::string name;
        while (at < page.size() && (std::isalnum(static_cast<unsigned char>(page[at]))))
            name += page[at++];
        if (name.empty())
            return "stray <" + excerpt(i);
        std::vector<std::string> attributes;
        bool alone = false;
        while (at < page.size() && page[at] != '>') {
            if (page[at] == ' ' || page[at] == '\n') {
                ++at;
            } else if (page[at] == '/' && at + 1 < page.size() && page[at + 1] == '>') {
                alone = true;
                ++at;
            } else {
                auto const equals = page.find("=\"", at);
                auto const end = equals == page.npos ? page.npos : page.find('"', equals + 2);
                if (end == page.npos)
                    return "attribute without a quoted value" + excerpt(i);
                std::string const attribute(page.substr(at, equals - at));
                for (char const letter : attribute)
                    if (!std::isalpha(static_cast<unsigned char>(letter)) && letter != '-' &&
                        !std::isdigit(static_cast<unsigned char>(letter)))
                        return "odd attribute '" + attribute + "'" + excerpt(i);
                for (std::string const& known : attributes)
                    if (known == attribute)
                        return "attribute twice" + excerpt(i);
                if (page.substr(equals + 2, end - equals - 2).find('<') != page.npos)
                    return "< in an attribute" + excerpt(i);
                attributes.push_back(attribute);
                at = end + 1;
            }
        }
        if (at >= page.size())
            return "tag without end" + excerpt(i);
        if (closing && (open.empty() || open.back() != name))
            return "</" + name + "> closes nothing" + excerpt(i);
        if (closing)
            open.pop_back();
        else if (!alone)
            open.push_back(name);
        i = at + 1;
    }
    return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

inline std::size_t times(std::string_view page, std::string_view part) {
    std::size_t found = 0;
    for (auto at = page.find(part); at != page.npos; at = page.find(part, at + 1))
        ++found;
    return found;
}

} // namespace sahl::sample
