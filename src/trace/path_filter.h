// In: a path filter and the names of a scene or a log; the segments of a ray. Out: which of its paths are
// selected.
#pragma once

#include "trace/filter_syntax.h"
#include "trace/segment.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sahl {

/// By id.
struct FilterNames {
    std::vector<std::string> surfaces, media, sources;
};

/// One of the names as it has to be written in a filter that means this one alone.
std::string lone_filter_name(std::vector<std::string> const& names, std::size_t id);

/// A path is what leads from a source to one end: a segment without children, and those that it descends
/// from. At each interaction it goes on by one event, which is the one that began the next segment; the last
/// event is the one that ended it.
class PathFilter {
  public:
    /// Throws InputError, pointing at the word, where a name is not known.
    PathFilter(FilterSyntax syntax, FilterNames const& names);

    bool selects_all() const { return syntax_.program.empty(); }
    std::string const& text() const { return syntax_.text; }

  private:
    friend class SelectedPaths;
    using Word = std::uint64_t; // what a condition has to remember on the way

    struct Prepared {
        std::vector<std::vector<std::uint32_t>> events; // by different step, by surface + 1: bit by code
        std::vector<std::uint32_t> steps;               // of an order, run or path, repeated ones apart
        std::vector<char> ids;                          // of media or sources that have the name
    };

    void take_step(std::span<Word> state, std::int32_t surface, Event event) const;
    void run_through(std::span<Word> state, std::uint16_t medium) const;
    bool holds(FilterCondition const& condition, Prepared const& prepared, Word state, Segment const& end,
               double optical_path, double ray_power) const;

    FilterSyntax syntax_;
    std::vector<Prepared> prepared_; // by condition
};

/// The paths of one ray through a filter.
class SelectedPaths {
  public:
    explicit SelectedPaths(PathFilter const& filter) : filter_(filter) {}

    /// Takes all segments of one ray, in the order of the log; where a parent is missing, a path begins. They
    /// must stay until the last question.
    void take(std::span<Segment const> ray);
    /// Whether the path that ends with this one of them is selected, be it an end of the tree or not.
    bool path_to(std::size_t segment);
    /// By segment: whether a selected path leads through it.
    std::vector<char> const& kept();

  private:
    std::span<PathFilter::Word> state(std::size_t segment);

    PathFilter const& filter_;
    std::span<Segment const> ray_;
    std::vector<std::ptrdiff_t> parents_; // −1: none
    std::vector<PathFilter::Word> states_, end_state_;
    std::vector<char> kept_, truths_, has_children_;
};

/// Position of a segment's parent among those of its ray, in the order of the log; −1 where it is not there.
std::ptrdiff_t parent_position(std::span<Segment const> ray, std::size_t segment);

/// m; from the source to the path's end, and of one that escapes to the last surface.
double path_length(std::span<Segment const> ray, std::size_t end, std::ptrdiff_t parent);

} // namespace sahl
