// In: the text of a path filter (docs/filters.md). Out: its conditions and how they are joined, names not yet
// looked up; or an error that points at the word that is wrong.
#pragma once

#include "trace/event.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sahl {

/// A piece of the text, for messages that point at it.
struct FilterSpan {
    std::size_t at = 0, length = 0; // bytes
};

struct FilterName {
    std::string text;   // of a word "lens", "lens.*"; empty: any
    bool exact = false; // it stood in quotes: no other name will do
    FilterSpan span{};
};

/// One event of a path, as it is described: `reflected(lens.front)`, `3 reflected`, `hits(lens)`, `any`.
struct FilterStep {
    std::uint32_t events = 0;  // bit by code
    bool at_something = false; // only where the path meets a surface
    FilterName surface{};
    std::uint32_t times = 1;
};

constexpr std::uint32_t every_event = (1U << event_names.size()) - 1U;

enum class Compare { less, at_most, equal, unequal, at_least, more, within };

struct Comparison {
    Compare how = Compare::at_least;
    double value = 1.0, to = 0.0; // `to`: with within, [value, to]

    bool holds(double x) const;
};

enum class FilterQuestion {
    count,    // how often the first step occurs
    through,  // in how many pieces it runs through a medium
    source,   // whether it comes from a source
    ends,     // whether the first step ends it
    order,    // whether the steps occur, others between them or not
    run,      // whether they occur directly one after another
    path,     // whether they are the path, from its source to its end
    quantity, // a number
};

enum class Quantity { wavelength_nm, power_W, share, depth, optical_path_mm, ray };

struct FilterCondition {
    FilterQuestion question = FilterQuestion::count;
    std::vector<FilterStep> steps{};
    FilterName name{}; // of a medium or a source
    Quantity quantity = Quantity::depth;
    Comparison comparison{};
};

/// How conditions are joined: a program for a stack of truths.
struct FilterJoin {
    enum class Kind { condition, negate, both, either } kind = Kind::condition;
    std::size_t condition = 0;
};

struct FilterSyntax {
    std::string text, place; // where it stands, for messages
    std::vector<FilterCondition> conditions{};
    std::vector<FilterJoin> program{}; // empty: every path is selected
};

/// Throws InputError, which shows the text with a mark under the word that is wrong. An empty text selects
/// every path.
///   place   the file and line, or the option, that the text comes from
FilterSyntax parse_filter(std::string_view text, std::string const& place);

/// The same kind of error about a part of a filter that was parsed.
[[noreturn]] void refuse_filter(std::string_view text, std::string const& place, FilterSpan span,
                                std::string const& problem, std::string const& remedy);

/// A name as it has to be written in a filter: in quotes where it is not a plain word.
std::string as_filter_name(std::string const& name);

} // namespace sahl
