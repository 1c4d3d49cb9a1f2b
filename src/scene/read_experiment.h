// In: an experiment file, TOML or JSON. Out: an Experiment, or an InputError that names the place and the
// remedy.
#pragma once

#include "scene/experiment.h"
#include "scene/value.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace sahl {

/// The file as a tree of values (by its ending: .json is JSON, all else TOML). `text` receives the bytes as
/// read.
Value read_experiment_file(std::filesystem::path const& path, std::string& text);

/// Sets one key, written as in --set and [sweep]: `trace.seed`, `object.prism.turn_deg[2]`,
/// `source.laser.beam.rays`. Lists of named tables (object, source, detector, group) are addressed by name;
/// tables that are missing on the way are made; an element past the end of an array, or a name that does not
/// exist, is an InputError with the nearest name.
void set_key(Value& experiment, std::string_view key, Value value);

/// `KEY=VALUE` of --set: VALUE is read as a TOML value, and as a plain string where it is none.
void set_key_from_text(Value& experiment, std::string_view assignment);

/// Checks every key and value and resolves every name. Keys are those of the reference in docs/experiment.md.
/// Throws InputError: unknown or ill-typed key, value out of range, unknown name (with the nearest known one)
/// …
Experiment read_experiment(Value const& tree, std::filesystem::path const& file);

/// Throws InputError where there is no source of light: a picture and an export do without.
void need_sources(Experiment const& experiment);

} // namespace sahl
