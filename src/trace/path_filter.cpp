#include "trace/path_filter.h"

#include "math/nearest_name.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sahl {

namespace {

/// Whether a name with * and ? stands for another; greedy, which is enough for a lone pattern.
bool fits(std::string_view pattern, std::string_view name) {
    std::size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resume = n;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++p;
            ++n;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            n = ++resume;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

/// A name stands for itself, and that of an object for all of its surfaces; of a medium with a catalogue,
/// "SCHOTT:N-BK7", for the medium.
bool is_called(FilterName const& wanted, std::string_view name) {
    if (wanted.exact)
        return wanted.text == name;
    return fits(wanted.text, name) || fits(wanted.text + ".*", name) || fits("*:" + wanted.text, name);
}

std::vector<char> ids_called(FilterSyntax const& syntax, FilterName const& wanted,
                             std::vector<std::string> const& names, std::string const& kind) {
    std::vector<char> ids;
    bool found = false;
    std::vector<std::string> known = names;
    for (std::string const& name : names) {
        ids.push_back(is_called(wanted, name));
        found = found || ids.back();
        known.push_back(name.substr(0, name.find('.')));
    }
    bool const any = !wanted.exact && wanted.text.find_first_not_of('*') == std::string::npos;
    if (!found && !any) // where there is none at all, `any` is still no mistake
        refuse_filter(syntax.text, syntax.place, wanted.span,
                      "no " + kind + " is called '" + wanted.text + "'",
                      known.empty() ? "there is none at all"
                                    : "did you mean '" + nearest_name(wanted.text, known) + "'?");
    return ids;
}

std::vector<std::uint32_t> events_by_surface(FilterSyntax const& syntax, FilterStep const& step,
                                             FilterNames const& names) {
    std::vector<std::uint32_t> events(names.surfaces.size() + 1, step.events);
    if (step.at_something) {
        auto const ids = ids_called(syntax, step.surface, names.surfaces, "surface or detector");
        events.front() = 0;
        for (std::size_t i = 0; i < ids.size(); ++i)
            events[i + 1] = ids[i] ? step.events : 0;
    }
    return events;
}

constexpr double in_nm(double metres) {
    return std::round(metres * 1e9 * 1e10) / 1e10;
}

} // namespace

std::string lone_filter_name(std::vector<std::string> const& names, std::size_t id) {
    std::string const written = as_filter_name(names[id]);
    bool const alone = std::none_of(names.begin(), names.end(), [&](std::string const& name) {
        return name != names[id] && is_called({names[id], false}, name);
    });
    return alone || written.front() == '"' ? written : '"' + written + '"';
}

PathFilter::PathFilter(FilterSyntax syntax, FilterNames const& names) : syntax_(std::move(syntax)) {
    for (FilterCondition const& condition : syntax_.conditions) {
        Prepared& prepared = prepared_.emplace_back();
        for (FilterStep const& step : condition.steps) {
            prepared.steps.insert(prepared.steps.end(), step.times,
                                  static_cast<std::uint32_t>(prepared.events.size()));
            prepared.events.push_back(events_by_surface(syntax_, step, names));
        }
        if (condition.question == FilterQuestion::through)
            prepared.ids = ids_called(syntax_, condition.name, names.media, "medium");
        if (condition.question == FilterQuestion::source)
            prepared.ids = ids_called(syntax_, condition.name, names.sources, "source");
    }
}

void PathFilter::take_step(std::span<Word> state, std::int32_t surface, Event event) const {
    for (std::size_t i = 0; i < prepared_.size(); ++i) {
        Prepared const& prepared = prepared_[i];
        auto const occurs = [&](std::size_t step) {
            return prepared.events[prepared.steps[step]][static_cast<std::size_t>(surface + 1)] >>
                       static_cast<unsigned>(event) &
                   1U;
        };
        Word& word = state[i];
        switch (syntax_.conditions[i].question) {
        case FilterQuestion::count:
            word += occurs(0);
            break;
        case FilterQuestion::ends:
            word = occurs(0);
            break;
        case FilterQuestion::order:
            word += word < prepared.steps.size() && occurs(word) ? 1 : 0;
            break;
        case FilterQuestion::path: // the number of steps so far; one too many where it went another way
            word = word < prepared.steps.size() && occurs(word) ? word + 1 : prepared.steps.size() + 1;
            break;
        case FilterQuestion::run: { // bit k: the last k + 1 events are the first k + 1 steps; once all, for
                                    // good
            std::size_t const last = prepared.steps.size() - 1;
            Word going = 0;
            for (Word open = word << 1 | 1; open != 0; open &= open - 1)
                if (auto const k = static_cast<std::size_t>(std::countr_zero(open)); k <= last && occurs(k))
                    going |= Word{1} << k;
            word = going | (word & (Word{1} << last));
            break;
        }
        default:
            break;
        }
    }
}

void PathFilter::run_through(std::span<Word> state, std::uint16_t medium) const {
    for (std::size_t i = 0; i < prepared_.size(); ++i)
        if (syntax_.conditions[i].question == FilterQuestion::through)
            state[i] += static_cast<Word>(prepared_[i].ids[medium]);
}

bool PathFilter::holds(FilterCondition const& condition, Prepared const& prepared, Word state,
                       Segment const& end, double optical_path, double ray_power) const {
    auto const number = [&] {
        switch (condition.quantity) {
        case Quantity::wavelength_nm:
            return in_nm(end.wavelength);
        case Quantity::power_W:
            return end.power_end;
        case Quantity::share:
            return ray_power > 0.0 ? end.power_end / ray_power : 0.0;
        case Quantity::depth:
            return static_cast<double>(end.depth);
        case Quantity::optical_path_mm:
            return optical_path * 1e3;
        case Quantity::ray:
            return static_cast<double>(end.ray);
        }
        return 0.0;
    };
    switch (condition.question) {
    case FilterQuestion::count:
    case FilterQuestion::through:
        return condition.comparison.holds(static_cast<double>(state));
    case FilterQuestion::source:
        return end.source < prepared.ids.size() && prepared.ids[end.source];
    case FilterQuestion::ends:
        return state != 0;
    case FilterQuestion::order:
    case FilterQuestion::path:
        return state == prepared.steps.size();
    case FilterQuestion::run:
        return (state >> (prepared.steps.size() - 1) & 1U) != 0;
    case FilterQuestion::quantity:
        return condition.comparison.holds(number());
    }
    return false;
}

std::ptrdiff_t parent_position(std::span<Segment const> ray, std::size_t segment) {
    std::int64_t const wanted = ray[segment].parent;
    if (wanted < 0)
        return -1;
    auto const guess = static_cast<std::size_t>(wanted);
    if (guess < segment && std::int64_t{ray[guess].index} == wanted) // nothing is missing
        return static_cast<std::ptrdiff_t>(guess);
    auto const self = ray.begin() + static_cast<std::ptrdiff_t>(segment);
    auto const parent = std::lower_bound(
        ray.begin(), self, wanted, [](Segment const& s, std::int64_t index) { return s.index < index; });
    return parent != self && std::int64_t{parent->index} == wanted ? parent - ray.begin() : -1;
}

double path_length(std::span<Segment const> ray, std::size_t end, std::ptrdiff_t parent) {
    if (std::isfinite(ray[end].optical_path))
        return ray[end].optical_path;
    return parent < 0 ? 0.0 : ray[static_cast<std::size_t>(parent)].optical_path;
}

std::span<PathFilter::Word> SelectedPaths::state(std::size_t segment) {
    std::size_t const words = filter_.prepared_.size();
    return std::span(states_).subspan(segment * words, words);
}

void SelectedPaths::take(std::span<Segment const> ray) {
    ray_ = ray;
    parents_.resize(ray.size());
    states_.resize(ray.size() * filter_.prepared_.size());
    has_children_.assign(ray.size(), 0);
    for (std::size_t i = 0; i < ray.size(); ++i) {
        auto const own = state(i);
        std::ptrdiff_t const parent = parents_[i] = parent_position(ray, i);
        if (parent < 0) {
            std::fill(own.begin(), own.end(), 0);
        } else {
            auto const above = static_cast<std::size_t>(parent);
            has_children_[above] = 1;
            std::copy_n(state(above).begin(), own.size(), own.begin());
            filter_.take_step(own, ray[above].surface, ray[i].born);
        }
        filter_.run_through(own, ray[i].medium);
    }
}

bool SelectedPaths::path_to(std::size_t segment) {
    Segment const& end = ray_[segment];
    end_state_.assign(state(segment).begin(), state(segment).end());
    filter_.take_step(end_state_, end.surface, end.ended);
    double const optical_path = path_length(ray_, segment, parents_[segment]);
    truths_.clear();
    for (FilterJoin const& join : filter_.syntax_.program) {
        if (join.kind == FilterJoin::Kind::condition) {
            std::size_t const i = join.condition;
            truths_.push_back(filter_.holds(filter_.syntax_.conditions[i], filter_.prepared_[i],
                                            end_state_[i], end, optical_path, ray_.front().power_start));
        } else if (join.kind == FilterJoin::Kind::negate) {
            truths_.back() = !truths_.back();
        } else {
            char const last = truths_.back();
            truths_.pop_back();
            char& first = truths_.back();
            first = join.kind == FilterJoin::Kind::both ? first && last : first || last;
        }
    }
    return truths_.empty() || truths_.back();
}

std::vector<char> const& SelectedPaths::kept() {
    kept_.assign(ray_.size(), 0);
    for (std::size_t i = ray_.size(); i-- > 0;) { // children come after their parents
        if (!has_children_[i])
            kept_[i] = path_to(i);
        if (kept_[i] && parents_[i] >= 0)
            kept_[static_cast<std::size_t>(parents_[i])] = 1;
    }
    return kept_;
}

} // namespace sahl
