#include "trace/filter_syntax.h"

#include "math/nearest_name.h"
#include "trace/filter_words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace sahl {

namespace {

constexpr std::size_t most_nested = 200;       // brackets and negations; the parser calls itself for each
constexpr std::uint32_t most_steps = 1U << 20; // of one order, a path has 65535 at most
constexpr std::size_t most_in_run = 64;        // its progress is bits of a word

constexpr std::array<std::pair<std::string_view, Quantity>, 6> quantities{
    {{"wavelength_nm", Quantity::wavelength_nm},
     {"power_W", Quantity::power_W},
     {"share", Quantity::share},
     {"depth", Quantity::depth},
     {"optical_path_mm", Quantity::optical_path_mm},
     {"ray", Quantity::ray}}};

constexpr std::array<std::pair<std::string_view, Compare>, 7> comparisons{{{"<", Compare::less},
                                                                           {"<=", Compare::at_most},
                                                                           {"=", Compare::equal},
                                                                           {"==", Compare::equal},
                                                                           {"!=", Compare::unequal},
                                                                           {">=", Compare::at_least},
                                                                           {">", Compare::more}}};

template <class Table>
auto const* named(Table const& table, std::string_view word) {
    auto const found =
        std::find_if(table.begin(), table.end(), [&](auto const& e) { return e.first == word; });
    return found == table.end() ? nullptr : &found->second;
}

/// The events that can be asked for: what a path is made of behind its source.
std::optional<Event> event_called(std::string_view word) {
    auto const found = std::find(event_names.begin() + 2, event_names.end(), word);
    if (found == event_names.end())
        return std::nullopt;
    return static_cast<Event>(found - event_names.begin());
}

std::vector<std::string> known_words(bool steps_only) {
    std::vector<std::string> words(event_names.begin() + 2, event_names.end());
    words.insert(words.end(), {"hits"});
    if (steps_only)
        words.insert(words.end(), {"any"});
    else
        words.insert(words.end(), {"through", "source", "ends", "order", "run", "path", "not"});
    for (auto const& [word, unused] : quantities)
        if (!steps_only)
            words.emplace_back(word);
    return words;
}

std::optional<double> number_of(std::string_view text) {
    double value = 0.0;
    auto const [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

class Parser {
  public:
    Parser(std::string_view text, std::string const& place)
        : words_(filter_words(text, place)), syntax_{std::string(text), place} {}

    FilterSyntax parse() {
        if (words_.size() == 1)
            return std::move(syntax_);
        either();
        if (!at_end())
            refuse("'" + now().text + "' has no place here", "join conditions with and, or");
        return std::move(syntax_);
    }

  private:
    FilterWord const& now() const { return words_[next_]; }
    bool at_end() const { return now().kind == FilterWord::Kind::end; }
    bool take(std::string_view what) {
        bool const there = now().is(what);
        next_ += there ? 1 : 0;
        return there;
    }
    [[noreturn]] void refuse(std::string const& problem, std::string const& remedy) const {
        refuse_filter(syntax_.text, syntax_.place, now().span, problem, remedy);
    }
    void need(std::string_view symbol) {
        if (!take(symbol))
            refuse(missing("'" + std::string(symbol) + "'"), "see docs/filters.md");
    }
    std::string missing(std::string const& what) const {
        return at_end() ? what + " is missing at the end"
                        : what + " should stand here, not '" + now().text + "'";
    }
    void join(FilterJoin::Kind kind) { syntax_.program.push_back({kind, 0}); }

    void either() {
        both();
        while (take("or")) {
            both();
            join(FilterJoin::Kind::either);
        }
    }
    void both() {
        negated();
        while (take("and")) {
            negated();
            join(FilterJoin::Kind::both);
        }
    }
    void negated() {
        if (++nested_ > most_nested)
            refuse("this filter is nested too deeply", "write it with fewer brackets");
        if (take("not")) {
            negated();
            join(FilterJoin::Kind::negate);
        } else if (take("(")) {
            either();
            need(")");
        } else {
            syntax_.program.push_back({FilterJoin::Kind::condition, syntax_.conditions.size()});
            syntax_.conditions.push_back(condition());
        }
        --nested_;
    }

    FilterCondition condition();
    FilterCondition ending();
    FilterStep step(std::optional<Event> event);
    std::vector<FilterStep> steps(FilterQuestion question);
    FilterName name(std::string const& of);
    FilterName name_in_brackets(std::string const& of);
    std::optional<Comparison> comparison();
    double number();

    std::vector<FilterWord> words_;
    FilterSyntax syntax_;
    std::size_t next_ = 0, nested_ = 0;
};

FilterCondition Parser::condition() {
    FilterCondition made;
    std::string const word = now().kind == FilterWord::Kind::word ? now().text : "";
    if (auto const* quantity = named(quantities, word)) {
        ++next_;
        made.question = FilterQuestion::quantity;
        made.quantity = *quantity;
        auto const compared = comparison();
        if (!compared)
            refuse(missing("a comparison of " + word),
                   "compare it: " + word + " < 1, or " + word + " in [1, 2]");
        made.comparison = *compared;
        return made;
    }
    if (take("ends"))
        return ending();
    for (auto const& [called, question] :
         {std::pair{"order", FilterQuestion::order}, std::pair{"run", FilterQuestion::run},
          std::pair{"path", FilterQuestion::path}})
        if (take(called)) {
            made.question = question;
            made.steps = steps(question);
            return made;
        }
    if (take("source")) {
        made.question = FilterQuestion::source;
        made.name = name_in_brackets("a source");
        return made;
    }
    auto const event = event_called(word);
    if (take("through")) {
        made.question = FilterQuestion::through;
        made.name = name_in_brackets("a medium");
    } else if (event || word == "hits") {
        made.steps = {step(event)};
    } else {
        std::string const nearest = word.empty() ? "" : nearest_name(word, known_words(false));
        refuse(at_end() ? "a condition is missing at the end" : "'" + now().text + "' is no condition",
               nearest.empty() ? "give one such as hits(lens.front), reflected >= 2 or ends(screen)"
                               : "did you mean '" + nearest + "'?");
    }
    made.comparison = comparison().value_or(Comparison{});
    return made;
}

/// What stands behind `ends`: an event, or a surface.
FilterCondition Parser::ending() {
    FilterCondition made;
    made.question = FilterQuestion::ends;
    need("(");
    auto const event = now().kind == FilterWord::Kind::word ? event_called(now().text) : std::nullopt;
    if (event)
        made.steps = {step(event)};
    else
        made.steps = {{every_event, true, name("a surface, a detector or an event")}};
    need(")");
    return made;
}

/// At the word of the event, or at `hits`.
FilterStep Parser::step(std::optional<Event> event) {
    ++next_;
    if (!event)
        return {every_event, true, name_in_brackets("a surface or a detector")};
    FilterStep made{1U << static_cast<unsigned>(*event)};
    if (now().is("(")) {
        made.at_something = true;
        made.surface = name_in_brackets("a surface or a detector");
    }
    return made;
}

std::vector<FilterStep> Parser::steps(FilterQuestion question) {
    std::vector<FilterStep> list;
    std::size_t total = 0;
    need("(");
    do {
        std::uint32_t times = 1;
        FilterSpan const start = now().span;
        auto const count = now().kind == FilterWord::Kind::word ? number_of(now().text) : std::nullopt;
        if (count) {
            if (!(*count >= 1.0 && *count <= most_steps) || *count != std::floor(*count))
                refuse("'" + now().text + "' is no number of times", "give a whole number from 1 on");
            times = static_cast<std::uint32_t>(*count);
            ++next_;
        }
        auto const event = now().kind == FilterWord::Kind::word ? event_called(now().text) : std::nullopt;
        if (event || now().is("hits")) {
            list.push_back(step(event));
        } else if (take("any")) {
            list.push_back({every_event});
        } else {
            std::string const nearest =
                now().kind == FilterWord::Kind::word ? nearest_name(now().text, known_words(true)) : "";
            refuse(missing("an event"), nearest.empty()
                                            ? "give one such as reflected(lens.front), hits(lens) or any"
                                            : "did you mean '" + nearest + "'?");
        }
        list.back().times = times;
        total += times;
        std::size_t const most = question == FilterQuestion::run ? most_in_run : most_steps;
        if (total > most)
            refuse_filter(syntax_.text, syntax_.place, start,
                          "these are more than " + std::to_string(most) + " events", "give fewer");
    } while (take(","));
    need(")");
    return list;
}

FilterName Parser::name(std::string const& of) {
    using Kind = FilterWord::Kind;
    if (now().kind != Kind::word && now().kind != Kind::quoted)
        refuse(missing("the name of " + of), "give one, or * for any");
    FilterName made{now().text, now().kind == Kind::quoted, now().span};
    ++next_;
    return made;
}

FilterName Parser::name_in_brackets(std::string const& of) {
    need("(");
    FilterName made = name(of);
    need(")");
    return made;
}

std::optional<Comparison> Parser::comparison() {
    if (take("in")) {
        need("[");
        Comparison range{Compare::within, number(), 0.0};
        need(",");
        FilterSpan const upper = now().span;
        range.to = number();
        if (range.to < range.value)
            refuse_filter(syntax_.text, syntax_.place, upper, "this range ends before it begins",
                          "give the lower bound first");
        need("]");
        return range;
    }
    auto const* how = now().kind == FilterWord::Kind::symbol ? named(comparisons, now().text) : nullptr;
    if (!how)
        return std::nullopt;
    ++next_;
    return Comparison{*how, number(), 0.0};
}

double Parser::number() {
    auto const value = now().kind == FilterWord::Kind::word ? number_of(now().text) : std::nullopt;
    if (!value)
        refuse(missing("a number"), "give one, such as 2 or 1e-3");
    ++next_;
    return *value;
}

} // namespace

bool Comparison::holds(double x) const {
    switch (how) {
    case Compare::less:
        return x < value;
    case Compare::at_most:
        return x <= value;
    case Compare::equal:
        return x == value;
    case Compare::unequal:
        return x != value;
    case Compare::at_least:
        return x >= value;
    case Compare::more:
        return x > value;
    case Compare::within:
        return x >= value && x <= to;
    }
    return false;
}

FilterSyntax parse_filter(std::string_view text, std::string const& place) {
    return Parser(text, place).parse();
}

} // namespace sahl
