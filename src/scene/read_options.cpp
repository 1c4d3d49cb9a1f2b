// In: the tables [trace], [log], [limits]. Out: options; what this version lacks is refused by name.
#include "scene/read_options.h"

#include "math/input_error.h"
#include "scene/read_table.h"

#include <cmath>

namespace sahl {

namespace {

/// The table under `key`, or an empty one.
Value const& table_or_empty(Value const& tree, std::string_view key) {
    static Value const empty = empty_table();
    Value const* table = tree.find(key);
    return table ? *table : empty;
}

Polarised read_polarised(Fields const& fields) {
    if (!fields.has("polarised"))
        return Polarised::automatic;
    Value const& value = fields.at("polarised");
    if (auto const* text = std::get_if<std::string>(&value.data); text && *text == "auto")
        return Polarised::automatic;
    auto const* truth = std::get_if<bool>(&value.data);
    if (!truth)
        throw InputError(value.place.text(), fields.called("polarised") + " is " + quoted_value(value),
                         "give \"auto\" or false");
    if (*truth)
        throw InputError(value.place.text(), "polarised tracing does not exist yet",
                         "give \"auto\", which tells by how much each detector's power would move, or false");
    return Polarised::no;
}

Method read_method(Fields const& fields) {
    return fields.choice<Method>("method", {{"auto", Method::automatic},
                                            {"facet", Method::facet},
                                            {"interpolated", Method::interpolated},
                                            {"quadratic", Method::quadratic},
                                            {"fitted", Method::fitted},
                                            {"recognised", Method::recognised}});
}

} // namespace

TraceOptions read_trace(Value const& tree) {
    Fields const fields(table_or_empty(tree, "trace"), keys::trace);
    TraceOptions options;
    options.max_depth = static_cast<std::uint32_t>(fields.integer("max_depth"));
    options.min_power = fields.number("min_power");
    options.branch = fields.choice<BranchPolicy>("branch", {{"split", BranchPolicy::split},
                                                            {"roulette", BranchPolicy::roulette},
                                                            {"dominant", BranchPolicy::dominant}});
    options.split_until = fields.number("split_until");
    options.split_depth = static_cast<std::uint32_t>(fields.integer("split_depth"));
    options.method = read_method(fields);
    options.tolerance = fields.number("tolerance_rad");
    options.tolerance_power = fields.number("tolerance_power");
    options.decimate = fields.truth("decimate");
    if (options.decimate && options.method != Method::automatic)
        throw InputError(fields.place("decimate").text(),
                         fields.called("decimate") + " goes by what auto knows of the tolerance",
                         "leave `method` at \"auto\", or give an object decimate_mm");
    options.polarised = read_polarised(fields);
    options.seed = static_cast<std::uint64_t>(fields.integer("seed"));
    options.digits_lost = fields.truth("digits_lost");
    return options;
}

LogOptions read_log(Value const& tree) {
    Fields const trace(table_or_empty(tree, "trace"), keys::trace);
    Fields const fields(table_or_empty(tree, "log"), keys::log);
    LogOptions log;
    log.on = trace.truth("log");
    log.every = static_cast<std::uint64_t>(fields.integer("every"));
    log.where = {fields.text("where"), fields.place("where")};
    log.min_power = fields.number("min_power");
    log.compress = fields.truth("compress");
    log.shard_rows = static_cast<std::uint64_t>(fields.integer("shard_rows"));
    return log;
}

Limits read_limits(Value const& tree) {
    Fields const fields(table_or_empty(tree, "limits"), keys::limits);
    return {fields.number("leak"), fields.number("ledger")};
}

} // namespace sahl
