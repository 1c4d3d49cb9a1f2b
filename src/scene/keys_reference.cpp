// In: the tables of keys. Out: their description in words, for messages and for docs/experiment.md.
#include "scene/keys.h"
#include "scene/value.h"

#include "math/overloaded.h"

#include <cmath>

namespace sahl {

namespace {

std::string written(double number) {
    bool const whole = number == std::floor(number) && std::abs(number) < 1e16;
    return whole ? to_json({static_cast<std::int64_t>(number), {}}) : to_json({number, {}});
}

std::string range_text(Range const& range) {
    bool const has_low = std::isfinite(range.low), has_high = std::isfinite(range.high);
    std::string const low = range.above ? "above " : has_high ? "from " : "of at least ";
    return (has_low ? " " + low + written(range.low) : "") +
           (has_high ? (has_low ? (range.above ? " and up to " : " to ") : " up to ") + written(range.high)
                     : "");
}

std::string list_text(Key const& key, std::string const& count) {
    std::string const range = range_text(key.range);
    return "a list of " + count + "numbers" + (range.empty() ? "" : ", each" + range);
}

std::string default_text(Default const& fallback) {
    return std::visit(Overloaded{[](std::monostate) { return std::string(); },
                                 [](Required) { return std::string("required"); },
                                 [](bool truth) { return std::string(truth ? "`true`" : "`false`"); },
                                 [](double number) { return "`" + written(number) + "`"; },
                                 [](std::string_view text) { return "`\"" + std::string(text) + "\"`"; },
                                 [](Repeated const& repeated) {
                                     std::string items = written(repeated.value);
                                     for (int i = 1; i < repeated.count; ++i)
                                         items += ", " + written(repeated.value);
                                     return "`[" + items + "]`";
                                 }},
                      fallback);
}

} // namespace

std::string expected(Key const& key) {
    switch (key.kind) {
    case Kind::truth:
        return "true or false";
    case Kind::integer:
        return "a whole number" + range_text(key.range);
    case Kind::number:
        return "a number" + range_text(key.range);
    case Kind::text:
        return "text in quotes";
    case Kind::numbers:
        return list_text(key, "");
    case Kind::two:
        return list_text(key, "2 ");
    case Kind::three:
        return list_text(key, "3 ");
    case Kind::four:
        return list_text(key, "4 ");
    case Kind::sixteen:
        return list_text(key, "16 ");
    case Kind::pairs:
        return "a list of pairs, [[number, number], …]";
    case Kind::texts:
        return "a list of texts in quotes";
    case Kind::table:
        return "a table {…}";
    case Kind::tables:
        return "tables [[" + std::string(key.name) + "]]";
    case Kind::any:
        return "see the meaning";
    }
    return {};
}

std::string keys_reference() {
    std::string page;
    for (KeyTable const* table : key_tables()) {
        page += "\n## " + std::string(table->title) + "\n\n" + std::string(table->about) + "\n";
        if (!table->keys.empty())
            page += "\n| key | what stands there | default | meaning |\n|---|---|---|---|\n";
        for (Key const& key : table->keys)
            page += "| `" + std::string(key.name) + "` | " + expected(key) + " | " +
                    default_text(key.fallback) + " | " + std::string(key.meaning) + " |\n";
    }
    return page;
}

} // namespace sahl
