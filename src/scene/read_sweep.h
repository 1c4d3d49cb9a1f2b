// In: the tables [sweep] and [goal]. Out: which runs an experiment asks for beside the one of the file
// itself.
#pragma once

#include "scene/experiment.h"

#include <optional>
#include <span>

namespace sahl {

/// Both throw InputError; whether the keys exist and may have these values is found by check_steps.
SweepSpec read_sweep(Value const& tree);
std::optional<GoalSpec> read_goal(Value const& tree);

/// The experiment's tree with its sweep and goal taken out and these keys set.
Value tree_at(Value const& tree, std::span<SweepAxis const> axes, std::span<Value const> values);

/// Reads the experiment at every step of its sweep and at both ends of its goal, so that nothing wrong is
/// found when half of the runs are done. Throws InputError.
void check_steps(Value const& tree, Experiment const& experiment);

} // namespace sahl
