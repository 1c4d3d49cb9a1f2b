// In: the tables [sweep] and [goal]. Out: axes with their values, a goal, each checked.
#include "scene/read_sweep.h"

#include "math/input_error.h"
#include "scene/read_experiment.h"
#include "scene/read_table.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr std::size_t most_runs = 1'000'000; // more folders than a file system bears with ease

std::vector<Value> range_values(Fields const& fields) {
    for (auto const key : {"from", "to", "steps"})
        if (!fields.has(key))
            throw InputError(fields.place().text(), "'" + std::string(key) + "' is missing in [sweep]",
                             "give {from = …, to = …, steps = …} or {values = […]}");
    double const from = fields.number("from"), to = fields.number("to");
    auto const steps = fields.integer("steps");
    std::vector<Value> values;
    for (std::int64_t i = 0; i < steps; ++i) {
        // divided last, so that whole numbers stay whole
        double const way =
            steps == 1 ? 0.0 : (to - from) * static_cast<double>(i) / static_cast<double>(steps - 1);
        values.push_back({i + 1 == steps && steps > 1 ? to : from + way, fields.place()});
    }
    return values;
}

std::vector<Value> values_of(Value const& entry) {
    if (auto const* list = std::get_if<Array>(&entry.data))
        return *list;
    Fields const fields(entry, keys::sweep_range);
    if (!fields.has("values"))
        return range_values(fields);
    for (auto const key : {"from", "to", "steps"})
        if (fields.has(key))
            throw InputError(fields.place(key).text(), fields.called(key) + " stands beside values",
                             "give either values from a list, or from, to and steps");
    auto const* list = std::get_if<Array>(&fields.at("values").data);
    if (!list)
        throw InputError(fields.place("values").text(),
                         fields.called("values") + " is " + quoted_value(fields.at("values")), "give a list");
    return *list;
}

/// Keys of an experiment that can be swept have a dot, those of [sweep] itself have none; but for the few
/// that stand at the top of the file.
bool is_axis(std::string const& key) {
    return key.find('.') != std::string::npos || key == "title" || key == "surroundings";
}

void check_lengths(SweepSpec const& sweep) {
    SweepAxis const& first = sweep.axes.front();
    double grid = 1.0;
    for (SweepAxis const& axis : sweep.axes) {
        grid *= static_cast<double>(axis.values.size());
        if (sweep.zip && axis.values.size() != first.values.size())
            throw InputError(axis.place.text(),
                             axis.key + " has " + std::to_string(axis.values.size()) + " values, " +
                                 first.key + " has " + std::to_string(first.values.size()),
                             "give lists of one length, or mode = \"grid\"");
    }
    if (!sweep.zip && grid > static_cast<double>(most_runs))
        throw InputError(first.place.text(), "this grid has more than a million runs", "give fewer steps");
}

} // namespace

std::size_t SweepSpec::runs() const {
    if (axes.empty())
        return 0;
    if (zip)
        return axes.front().values.size();
    std::size_t runs = 1;
    for (SweepAxis const& axis : axes)
        runs *= axis.values.size();
    return runs;
}

std::vector<Value> SweepSpec::point(std::size_t run) const {
    std::vector<Value> values(axes.size());
    for (std::size_t i = axes.size(); i-- > 0;) {
        std::size_t const size = axes[i].values.size();
        values[i] = axes[i].values[zip ? run : run % size];
        run = zip ? run : run / size;
    }
    return values;
}

SweepSpec read_sweep(Value const& tree) {
    SweepSpec sweep;
    Value const* const table = tree.find("sweep");
    if (!table)
        return sweep;
    Value own{Table{}, table->place};
    for (auto const& [key, entry] : std::get<Table>(table->data)) {
        if (!is_axis(key)) {
            std::get<Table>(own.data).emplace_back(key, entry);
            continue;
        }
        SweepAxis axis{key, values_of(entry), entry.place};
        if (axis.values.empty())
            throw InputError(axis.place.text(), "this sweep has no values", "give at least one");
        sweep.axes.push_back(std::move(axis));
    }
    Fields const fields(own, keys::sweep);
    sweep.zip = fields.choice<bool>("mode", {{"grid", false}, {"zip", true}});
    if (!sweep.empty())
        check_lengths(sweep);
    return sweep;
}

std::optional<GoalSpec> read_goal(Value const& tree) {
    Value const* const table = tree.find("goal");
    if (!table)
        return {};
    if (Value const* const sweep = tree.find("sweep"))
        throw InputError(sweep->place.text(), "a sweep stands beside a goal", "keep one of the two");
    Fields const fields(*table, keys::goal);
    GoalSpec goal;
    goal.place = table->place;
    std::string const aim = fields.only_one_of({"minimise", "maximise", "reach"});
    goal.aim = aim == "minimise" ? Aim::minimise : aim == "maximise" ? Aim::maximise : Aim::reach;
    goal.figure = fields.text(aim);
    if (fields.has("value") != (goal.aim == Aim::reach))
        throw InputError(fields.place("value").text(), "reach and value belong together",
                         "give reach = \"FIGURE\", value = …");
    if (goal.aim == Aim::reach)
        goal.value = fields.number("value");
    auto const& varied = std::get<Table>(fields.at("vary").data);
    if (varied.size() != 1)
        throw InputError(fields.place("vary").text(),
                         "a goal varies one key, and here are " + std::to_string(varied.size()),
                         "give vary = {\"object.NAME.key[i]\" = {from = …, to = …}}");
    goal.key = varied.front().first;
    Fields const range(varied.front().second, keys::goal_range);
    goal.from = range.number("from");
    goal.to = range.number("to");
    if (goal.from == goal.to)
        throw InputError(range.place().text(), "from and to are the same number",
                         "give the ends of what is searched");
    goal.tolerance = fields.number("tolerance");
    goal.looks = static_cast<std::uint64_t>(fields.integer("looks"));
    goal.most_runs = static_cast<std::uint64_t>(fields.integer("most_runs"));
    if (goal.most_runs < goal.looks)
        throw InputError(fields.place("most_runs").text(), "most_runs is below looks",
                         "give at least as many runs as looks");
    return goal;
}

Value tree_at(Value const& tree, std::span<SweepAxis const> axes, std::span<Value const> values) {
    Value step = tree;
    std::erase_if(std::get<Table>(step.data),
                  [](auto const& entry) { return entry.first == "sweep" || entry.first == "goal"; });
    for (std::size_t i = 0; i < axes.size(); ++i)
        set_key(step, axes[i].key, values[i]);
    return step;
}

void check_steps(Value const& tree, Experiment const& experiment) {
    SweepSpec const& sweep = experiment.sweep;
    for (std::size_t run = 0; run < sweep.runs(); ++run)
        read_experiment(tree_at(tree, sweep.axes, sweep.point(run)), experiment.file);
    if (!experiment.goal)
        return;
    GoalSpec const& goal = *experiment.goal;
    SweepAxis const axis{goal.key, {}, goal.place};
    for (double const end : {goal.from, goal.to}) {
        Value const value{end, goal.place};
        read_experiment(tree_at(tree, {&axis, 1}, {&value, 1}), experiment.file);
    }
}

} // namespace sahl
