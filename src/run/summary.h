// In: a traced scene. Out: summary.json as a tree of values, in the units of the contract.
#pragma once

#include "run/method_choice.h"
#include "run/pilots.h"
#include "run/trace_scene.h"
#include "scene/value.h"

#include <string>
#include <vector>

namespace sahl {

/// Who ran what, for the head of a summary and of a log.
struct RunFacts {
    std::string program;           // "sahl 0.1.0"
    std::string experiment_sha256; // of the file as read
    std::vector<std::string> set;  // KEY=VALUE, as given
};

/// What the checks of physics say; empty where all passed.
std::vector<std::string> failures_of(Experiment const& experiment, TraceOutcome const& outcome);

Value summary_of(Experiment const& experiment, Scene const& scene, WavelengthTable const& optics,
                 TraceOutcome const& outcome, RunFacts const& facts, MethodChoice const& choice = {},
                 Pilots const& pilots = {});

/// The options that were in force, as in the summary.
Value options_of(Experiment const& experiment, RunFacts const& facts);

} // namespace sahl
