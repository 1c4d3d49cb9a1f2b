// In: an experiment with meshes. Out: the same rays by every method: what a segment costs, and how far it
// errs.
#pragma once

#include "run/run.h"

#include <optional>
#include <string>
#include <vector>

namespace sahl {

struct MethodFigures {
    std::string method;
    double ns_per_segment = 0.0;      // CPU, one thread, median
    std::uint64_t segments = 0;       // that were timed
    double rms = 0.0, greatest = 0.0; // rad; 0 of what the others are held against
    double leaving = 0.0;             // rad, RMS of what escapes or is detected alone
    double changed = 0.0;             // share of rays that meet other events
    bool reference = false;
    bool front = false; // no other method is both faster and nearer
};

struct MethodChart {
    std::string title, reference; // what errors are held against
    std::uint64_t rays = 0;       // that were compared
    std::vector<std::string> warnings;
    std::vector<MethodFigures> methods;
};

/// exact   an experiment with the same sources and exact shapes in place of the meshes; without one the
/// errors are
///         against the finest method: recognised, else fitted. It is timed too, as `exact`. Throws
///         InputError where no object is a closed mesh.
MethodChart method_chart(ExperimentSource const& source, std::optional<ExperimentSource> const& exact);

/// For the files of a chart: a table, and the same with its head. Columns in docs/curved.md.
std::string chart_csv(MethodChart const& chart);
Value chart_value(MethodChart const& chart);

} // namespace sahl
