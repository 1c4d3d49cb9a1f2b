#include "run/goal.h"

#include "math/brent.h"
#include "math/input_error.h"
#include "run/one_run.h"
#include "run/side_by_side.h"
#include "run/sweep_table.h"
#include "run/unfinished.h"
#include "run/values.h"
#include "scene/model_cache.h"
#include "scene/read_sweep.h"
#include "scene/read_table.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace sahl {

namespace fs = std::filesystem;

namespace {

/// Where a goal may be sought: three neighbours of which the middle is best, or two about the value.
struct Bracket {
    double low, high, at_low, at_high;
};

class Seeker {
  public:
    Seeker(ExperimentSource const& source, GoalSpec const& goal, RunOptions const& options,
           fs::path const& folder)
        : source_(source), goal_(goal), options_(options), folder_(folder) {
        options_.threads = threads_of(options.threads);
        options_.progress = {};
        options_.models = &models_;
    }

    std::vector<SweepRow> const& rows() const { return rows_; }
    std::vector<std::string> const& keys() const { return keys_; }

    ExperimentSource at(double x) const {
        SweepAxis const axis{goal_.key, {}, goal_.place};
        Value const value{x, goal_.place};
        ExperimentSource step = source_;
        step.tree = tree_at(source_.tree, {&axis, 1}, {&value, 1});
        step.set.push_back(goal_.key + "=" + to_json(value));
        return step;
    }

    Bracket look() {
        std::vector<double> xs, ys(goal_.looks);
        for (std::uint64_t i = 0; i < goal_.looks; ++i)
            xs.push_back(i + 1 == goal_.looks
                             ? goal_.to
                             : goal_.from + (goal_.to - goal_.from) * static_cast<double>(i) /
                                                static_cast<double>(goal_.looks - 1));
        rows_.resize(goal_.looks);
        side_by_side(goal_.looks, options_.threads, [&](std::size_t i) {
            rows_[i] = row_at(xs[i]);
            ys[i] = distance(rows_[i].summary);
            tell();
        });
        return goal_.aim == Aim::reach ? about_value(xs, ys) : about_least(xs, ys);
    }

    double narrow(Bracket const& bracket) {
        auto const f = [&](double x) {
            rows_.push_back(row_at(x));
            tell();
            double const y = distance(rows_.back().summary);
            if (std::isnan(y))
                throw InputError(goal_.place.text(),
                                 "no value of " + goal_.figure + " at " + goal_.key + " = " + to_json(of(x)) +
                                     ": no light came",
                                 "narrow from and to, so that there is light between them");
            return y;
        };
        double const tolerance = goal_.tolerance * std::abs(goal_.to - goal_.from);
        auto const left = static_cast<unsigned>(goal_.most_runs - goal_.looks);
        auto const found =
            goal_.aim == Aim::reach
                ? brent_zero(f, bracket.low, bracket.at_low, bracket.high, bracket.at_high, tolerance, left)
                : brent_minimum(f, bracket.low, bracket.high, tolerance, left);
        if (!found)
            throw InputError(goal_.place.text(),
                             "the goal is not come to after " + std::to_string(rows_.size()) + " runs",
                             "give a wider tolerance, more most_runs, or narrow from and to");
        return best(found->x);
    }

  private:
    /// The best of all that were looked at: rounding may let an early run stand a trifle better.
    double best(double found) const {
        double x = found, y = INFINITY;
        for (SweepRow const& row : rows_) {
            double const here =
                goal_.aim == Aim::reach ? std::abs(distance(row.summary)) : distance(row.summary);
            if (here < y) {
                y = here;
                x = std::get<double>(row.values.front().data);
            }
        }
        return x;
    }

    SweepRow row_at(double x) const {
        if (auto kept = options_.resume ? kept_look(folder_, x) : std::nullopt)
            return {{of(x)}, std::move(*kept)};
        ExperimentSource const step = at(x);
        SweepRow row{{of(x)}, run_once(step, read_experiment(step.tree, step.file), options_, {}).summary};
        keep_look(folder_, x, row.summary);
        return row;
    }

    /// What is to be least, or 0; NaN where the run has no such figure.
    double distance(Value const& summary) const {
        Figures const figures = figures_of(summary);
        auto const figure = std::find_if(figures.begin(), figures.end(),
                                         [&](auto const& f) { return f.first == goal_.figure; });
        double const y = figure == figures.end() ? NAN : figure->second;
        return goal_.aim == Aim::maximise ? -y : goal_.aim == Aim::reach ? y - goal_.value : y;
    }

    void tell() {
        std::scoped_lock const lock(mutex_);
        if (options_.sweep_progress)
            options_.sweep_progress(++made_, goal_.most_runs);
    }

    void check_figure(std::vector<double> const& ys) const {
        if (!std::all_of(ys.begin(), ys.end(), [](double y) { return std::isnan(y); }))
            return;
        std::vector<std::string> known;
        for (SweepRow const& row : rows_)
            for (auto const& [name, value] : figures_of(row.summary))
                if (std::find(known.begin(), known.end(), name) == known.end())
                    known.push_back(name);
        throw InputError(goal_.place.text(), "no run's summary has a figure '" + goal_.figure + "'",
                         did_you_mean(goal_.figure, known) +
                             " Figures are named as in the head of sweep.csv; one that needs light is "
                             "missing where none comes");
    }

    Bracket about_least(std::vector<double> const& xs, std::vector<double> const& ys) const {
        check_figure(ys);
        std::size_t best = 0;
        for (std::size_t i = 1; i < ys.size(); ++i)
            if (std::isnan(ys[best]) || ys[i] < ys[best])
                best = i;
        std::size_t low = best > 0 && !std::isnan(ys[best - 1]) ? best - 1 : best;
        std::size_t high = best + 1 < ys.size() && !std::isnan(ys[best + 1]) ? best + 1 : best;
        if (low == high)
            throw InputError(goal_.place.text(), "light comes at one of the looks alone",
                             "narrow from and to, or give more looks");
        return {xs[low], xs[high], ys[low], ys[high]};
    }

    Bracket about_value(std::vector<double> const& xs, std::vector<double> const& ys) const {
        check_figure(ys);
        double least = INFINITY, most = -INFINITY;
        for (std::size_t i = 0; i < ys.size(); ++i) {
            if (i > 0 && ys[i - 1] * ys[i] <= 0.0)
                return {xs[i - 1], xs[i], ys[i - 1], ys[i]};
            if (std::isnan(ys[i]))
                continue;
            least = std::min(least, ys[i] + goal_.value);
            most = std::max(most, ys[i] + goal_.value);
        }
        throw InputError(goal_.place.text(),
                         goal_.figure + " does not pass " + to_json(of(goal_.value)) +
                             " between from and to: "
                             "it runs from " +
                             to_json(of(least)) + " to " + to_json(of(most)),
                         "widen from and to, or give more looks");
    }

    ExperimentSource const& source_;
    GoalSpec const& goal_;
    ModelCache models_;
    RunOptions options_;
    fs::path const& folder_; // where looks are kept, or empty
    std::vector<SweepRow> rows_;
    std::vector<std::string> keys_{goal_.key};
    std::mutex mutex_;
    std::size_t made_ = 0;
};

/// What a user should know of a goal that was come to: one at an end of the search is none, and neither is a
/// jump.
std::optional<std::string> remark_on(GoalSpec const& goal, Bracket const& bracket, double x, double y) {
    double const span = std::abs(goal.to - goal.from);
    for (double const end : {goal.from, goal.to})
        if (goal.aim != Aim::reach && std::abs(x - end) <= 4.0 * goal.tolerance * span)
            return goal.figure + " is best at the end of the search, " + goal.key + " = " + to_json(of(end)) +
                   ": there may be better beyond; widen from and to";
    double const step = std::abs(bracket.at_high - bracket.at_low);
    if (goal.aim == Aim::reach && std::abs(y - goal.value) > std::max(1e-3, 10.0 * goal.tolerance) * step)
        return goal.figure + " jumps over " + to_json(of(goal.value)) + " at " + goal.key + " = " +
               to_json(of(x)) + ": it is " + to_json(of(y)) + " there";
    return {};
}

Value goal_value(GoalSpec const& goal, double x, Value const& summary, std::size_t runs) {
    constexpr char const* aims[] = {"minimise", "maximise", "reach"};
    Figures const figures = figures_of(summary);
    auto const figure =
        std::find_if(figures.begin(), figures.end(), [&](auto const& f) { return f.first == goal.figure; });
    Table table{{"aim", of(std::string(aims[static_cast<std::size_t>(goal.aim)]))},
                {"figure", of(goal.figure)},
                {"key", of(goal.key)},
                {"at", of(x)},
                {"value", figure == figures.end() ? nothing() : of(figure->second)},
                {"wanted", goal.aim == Aim::reach ? of(goal.value) : nothing()},
                {"runs", of(std::uint64_t{runs})}};
    return of(std::move(table));
}

} // namespace

RunResult run_goal(ExperimentSource const& source, Experiment const& experiment, RunOptions const& options,
                   fs::path const& folder) {
    GoalSpec const& goal = *experiment.goal;
    RunOptions seeking = options;
    seeking.log_file.reset(); // of the run that is found alone
    Seeker seeker(source, goal, seeking, folder);
    Bracket const bracket = seeker.look();
    double const x = seeker.narrow(bracket);
    ExperimentSource const step = seeker.at(x);
    OneRun run = run_once(step, read_experiment(step.tree, step.file), options, folder);
    Figures const figures = figures_of(run.summary);
    auto const figure =
        std::find_if(figures.begin(), figures.end(), [&](auto const& f) { return f.first == goal.figure; });
    if (figure != figures.end())
        if (auto remark = remark_on(goal, bracket, x, figure->second))
            for (auto& [key, value] : std::get<Table>(run.summary.data))
                if (key == "warnings")
                    std::get<Array>(value.data).push_back(of(std::move(*remark)));
    // once more at the same place, for its files: it is no run of the search
    std::get<Table>(run.summary.data)
        .emplace_back("goal", goal_value(goal, x, run.summary, seeker.rows().size()));
    if (!folder.empty()) {
        write_text(folder / "summary.json", to_json(run.summary) + "\n");
        write_text(folder / "goal.csv", sweep_csv(seeker.keys(), seeker.rows()));
    }
    write_page(folder, run, run.summary, {}, {});
    return {std::move(run.summary), std::move(run.failures)};
}

} // namespace sahl
