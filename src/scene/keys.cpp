// In: nothing. Out: the keys of the experiment as a whole, of its options, of groups and sweeps.
#include "scene/keys.h"

namespace sahl {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range above_zero{0.0, infinity, true};
constexpr Range not_negative{0.0};
constexpr Range share{0.0, 1.0};
constexpr double largest_seed = 9007199254740992.0; // 2⁵³: up to here every whole number is a double

constexpr Key experiment_keys[] = {
    {"title", Kind::text, {}, "what the experiment is called; absent: the name of the file"},
    {"surroundings", Kind::text, "air", "the medium outside all bodies"},
    {"catalogues",
     Kind::texts,
     {},
     "glasses of your own: paths, relative to this file, of Zemax AGF files and refractiveindex.info pages "
     "(.yml)"},
    {"medium", Kind::table, {}, "media by name; each is a table [medium.NAME]"},
    {"surface", Kind::table, {}, "surfaces by name; each is a table [surface.NAME]"},
    {"trace", Kind::table, {}, "how rays are followed"},
    {"log", Kind::table, {}, "what of the rays is written"},
    {"limits", Kind::table, {}, "when a run counts as failed"},
    {"group", Kind::tables, {}, "what moves as one"},
    {"object", Kind::tables, {}, "bodies and open surfaces"},
    {"source", Kind::tables, {}, "where light comes from; `sahl trace` needs at least one"},
    {"detector", Kind::tables, {}, "where light is counted"},
    {"sweep", Kind::table, {}, "a run for each value of a key, or of several"},
    {"goal", Kind::table, {}, "runs until a figure of the summary is least, greatest or a given one"},
    {"camera", Kind::table, {}, "for pictures: where they are seen from"},
    {"light", Kind::tables, {}, "for pictures: lamps, which shine on paint"},
    {"background", Kind::table, {}, "for pictures: what is seen where nothing is"},
    {"picture", Kind::table, {}, "for pictures: how they are made"},
};

constexpr Key trace_keys[] = {
    {"max_depth",
     Kind::integer,
     64.0,
     "interactions along one path; a guard, not the main cut-off",
     {0.0, 65534.0}},
    {"min_power", Kind::number, 1e-6,
     "a branch below this share of its source ray's power is cut, and counted", share},
    {"branch", Kind::text, "split",
     "\"split\", \"roulette\" (unbiased) or \"dominant\" (strongest branch only)"},
    {"split_until", Kind::number, 0.1,
     "with roulette: split while the branch's share is above this, or depth < split_depth", share},
    {"split_depth",
     Kind::integer,
     2.0,
     "with roulette: the first so many interactions of a path always split; 0, with split_until = 1: one "
     "random branch at each",
     {0.0, 65534.0}},
    {"method", Kind::text, "auto",
     "how meshes are traced: \"auto\", \"facet\", \"interpolated\", \"quadratic\", \"fitted\" or "
     "\"recognised\""},
    {"tolerance_rad", Kind::number, 1e-6, "with auto: the direction error that is borne", above_zero},
    {"decimate", Kind::truth, false,
     "with auto, true: `trace` follows light through a mesh far finer than tolerance_rad needs in fewer "
     "triangles; pictures and charts have all"},
    {"tolerance_power", Kind::number, 1e-3, "with auto: the share of a detector's power that is borne",
     above_zero},
    {"polarised", Kind::any, "auto",
     "\"auto\": pilots tell where it would matter, or false; true is refused until polarised tracing exists"},
    {"seed", Kind::integer, 1.0, "of all random numbers", {0.0, largest_seed}},
    {"digits_lost", Kind::truth, false,
     "true: the summary and the log tell how many of the sixteen digits each path has lost, as rounding "
     "grows from "
     "one curved surface to the next"},
    {"log", Kind::truth, false, "true writes rays.h5"},
};

constexpr Key log_keys[] = {
    {"every", Kind::integer, 1.0, "each N-th ray is written", {1.0, largest_seed}},
    {"where", Kind::text, "", "a filter: only the paths that it selects are written; see filters.md"},
    {"min_power",
     Kind::number,
     0.0,
     "pieces that begin with less than this share of their ray's power are not written",
     {0.0, 1.0}},
    {"compress", Kind::truth, false, "shuffled and deflated, which every reader of HDF5 undoes by itself"},
    {"shard_rows",
     Kind::integer,
     4194304.0,
     "rows in one file, rounded up to whole chunks of 16384; a longer log is a folder of such files, which "
     "rays.h5 shows as one",
     {1.0, 1e12}},
};

constexpr Key limits_keys[] = {
    {"leak", Kind::number, 1e-6, "leaks as a share of the events; above it the exit status is 4",
     not_negative},
    {"ledger", Kind::number, 1e-12, "remainder as a share of what was emitted; above it the exit status is 4",
     not_negative},
};

constexpr Key group_keys[] = {
    {"name", Kind::text, Required{}, "unique among groups; without dots"},
    {"group", Kind::text, {}, "the group this one belongs to; its motion comes after"},
    {"scale", Kind::any, 1.0,
     "a number, or one for each axis; not 0. Groups of sources and detectors may not be scaled"},
    {"turn_deg", Kind::three, Repeated{3, 0.0}, "then about x, then about y, then about z"},
    {"move_mm", Kind::three, Repeated{3, 0.0}, "then moved"},
    {"matrix", Kind::sixteen, {}, "instead of the three: column by column, lengths in mm"},
};

constexpr Key sweep_keys[] = {
    {"mode", Kind::text, "grid",
     "of several keys: `\"grid\"`: every value of one with all of the others, the last key changing first; "
     "`\"zip\"`: first with first, second with second; their lists are of one length"},
};

constexpr Key sweep_range_keys[] = {
    {"from", Kind::number, {}, "the first value"},
    {"to", Kind::number, {}, "the last value"},
    {"steps", Kind::integer, {}, "how many values, both ends counted", {1.0, 100000.0}},
    {"values",
     Kind::any,
     {},
     "instead of the three: a list of values, of whatever may stand under the key (numbers, names of media, "
     "lists); a plain list does too"},
};

constexpr Key goal_keys[] = {
    {"minimise", Kind::text, {}, "a figure, named as in the head of `sweep.csv`, to be as small as it gets"},
    {"maximise", Kind::text, {}, "or as great as it gets"},
    {"reach", Kind::text, {}, "or to be `value`"},
    {"value", Kind::number, {}, "with `reach`: what the figure shall be"},
    {"vary", Kind::table, Required{},
     "the key to be varied: `{\"object.NAME.key[i]\" = {from = …, to = …}}`"},
    {"tolerance",
     Kind::number,
     1e-9,
     "how well the key's number is to be known, as a share of `to` − `from`; the search ends earlier where "
     "rounding hides any change of the figure",
     {1e-15, 0.1}},
    {"looks",
     Kind::integer,
     9.0,
     "runs evenly spread from `from` to `to`, side by side, that show where to search: enough for the best "
     "to stand on the right hill",
     {3.0, 100000.0}},
    {"most_runs", Kind::integer, 200.0, "after so many the search has failed", {3.0, 1000000.0}},
};

constexpr Key goal_range_keys[] = {
    {"from", Kind::number, Required{}, "one end of the search"},
    {"to", Kind::number, Required{}, "the other"},
};

} // namespace

KeyTable const keys::experiment{"the experiment", "The top of the file.", experiment_keys};
KeyTable const keys::trace{"[trace]", "How rays are followed.", trace_keys};
KeyTable const keys::log{"[log]", "What goes into the log that `log = true` in [trace] asks for, and how.",
                         log_keys};
KeyTable const keys::limits{"[limits]", "When a check of the physics fails.", limits_keys};
KeyTable const keys::group{
    "[[group]]",
    "Moves its objects, sources, detectors and groups as one: first their own motion, then the group's.",
    group_keys};
KeyTable const keys::sweep{"[sweep]",
                           "Beside this, entries `\"object.NAME.key[i]\" = {from = …, to = …, steps = …}` or "
                           "`= [value, …]`: a run for "
                           "each value, or for each point of the grid where there are several entries.",
                           sweep_keys};
KeyTable const keys::sweep_range{"sweep range", "The values of one key of a sweep.", sweep_range_keys};
KeyTable const keys::goal{
    "[goal]",
    "Varies one number until a figure of the summary is least, greatest or a given one; exactly one of "
    "`minimise`, `maximise`, `reach`.",
    goal_keys};
KeyTable const keys::goal_range{"goal range", "Where a goal seeks.", goal_range_keys};
std::span<KeyTable const* const> key_tables() {
    static constexpr KeyTable const* all[] = {
        &keys::experiment,   &keys::medium,       &keys::sellmeier,  &keys::cauchy,
        &keys::surface,      &keys::paint,        &keys::checker,    &keys::trace,
        &keys::log,          &keys::limits,       &keys::group,      &keys::object,
        &keys::material,     &keys::shape,        &keys::sphere,     &keys::box,
        &keys::cylinder,     &keys::lens,         &keys::prism,      &keys::plane,
        &keys::rectangle,    &keys::disk,         &keys::cone,       &keys::corner_cube,
        &keys::quadric,      &keys::conic_mirror, &keys::source,     &keys::beam,
        &keys::profile,      &keys::point,        &keys::lambertian, &keys::spectrum,
        &keys::polarisation, &keys::detector,     &keys::far_field,  &keys::sweep,
        &keys::sweep_range,  &keys::goal,         &keys::goal_range, &keys::camera,
        &keys::light,        &keys::light_point,  &keys::light_spot, &keys::light_directional,
        &keys::background,   &keys::picture,      &keys::caustics};
    return all;
}

} // namespace sahl
