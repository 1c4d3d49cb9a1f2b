#include "record/log_manifest.h"

#include "math/input_error.h"
#include "record/crc32.h"
#include "record/disk.h"
#include "scene/value.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>

namespace sahl {

namespace fs = std::filesystem;

namespace {

constexpr char const* checkpoint_name = "checkpoint.bin";
constexpr std::size_t portion = std::size_t{1} << 20;

Value number(std::uint64_t n) {
    return {static_cast<std::int64_t>(n), {}};
}

Value text(std::string t) {
    return {std::move(t), {}};
}

std::string hexadecimal(std::uint32_t n) {
    char digits[12];
    std::snprintf(digits, sizeof digits, "%08x", n);
    return digits;
}

std::string bytes_of(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_whole(fs::path const& file, std::string const& bytes, std::string const& remedy) {
    fs::path temporary = file;
    temporary += ".tmp";
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out << bytes;
    out.close();
    if (!out)
        throw InputError(file.string(), "cannot be written", remedy);
    sync_to_disk(temporary, remedy);
    move_on_disk(temporary, file, remedy);
}

std::uint32_t crc32_of_bytes(std::string const& bytes) {
    return crc32_after(0, std::as_bytes(std::span(bytes)));
}

/// The text under a key, or nothing.
std::string text_at(Value const& table, char const* key) {
    Value const* const value = table.find(key);
    auto const* found = value ? std::get_if<std::string>(&value->data) : nullptr;
    return found ? *found : std::string();
}

std::uint64_t number_at(Value const& table, char const* key) {
    Value const* const value = table.find(key);
    auto const* found = value ? std::get_if<std::int64_t>(&value->data) : nullptr;
    return found ? static_cast<std::uint64_t>(*found) : 0;
}

bool is_of_run(Value const& manifest, LogHeader const& header) {
    return text_at(manifest, "program") == header.program &&
           text_at(manifest, "experiment_sha256") == header.experiment_sha256 &&
           text_at(manifest, "options") == header.options_json;
}

bool is_whole(fs::path const& file, ListedShard const& listed) {
    std::error_code problem;
    return fs::file_size(file, problem) == listed.bytes && !problem && crc32_of(file) == listed.crc32;
}

} // namespace

std::uint32_t crc32_of(fs::path const& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw InputError(file.string(), "cannot be read", "see that it is there and that you may read it");
    std::vector<char> bytes(portion);
    std::uint32_t crc = 0;
    while (in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || in.gcount() > 0)
        crc = crc32_after(crc, std::as_bytes(std::span(bytes)).first(static_cast<std::size_t>(in.gcount())));
    return crc;
}

void write_manifest(fs::path const& folder, LogHeader const& header, LogManifest const& manifest,
                    std::string const& remedy) {
    Array shards;
    std::uint64_t first_row = 0;
    for (ListedShard const& shard : manifest.shards) {
        shards.push_back({Table{{"name", text(shard.name)},
                                {"first_row", number(first_row)},
                                {"rows", number(shard.rows)},
                                {"first_ray", number(shard.first_ray)},
                                {"bytes", number(shard.bytes)},
                                {"crc32", text(hexadecimal(shard.crc32))}},
                          {}});
        first_row += shard.rows;
    }
    Table table{{"schema_version", number(1)},
                {"program", text(header.program)},
                {"experiment_sha256", text(header.experiment_sha256)},
                {"options", text(header.options_json)},
                {"shard_rows", number(manifest.shard_rows)},
                {"complete", {manifest.complete, {}}},
                {"rows", number(first_row)},
                {"shards", {std::move(shards), {}}}};
    if (manifest.checkpoint) {
        // a name of its own: the manifest that stands there until this one does still has the one it lists
        std::string const name = std::to_string(manifest.checkpoint->rows) + "." + checkpoint_name;
        std::string const& state = manifest.checkpoint->state;
        write_whole(folder / name, state, remedy);
        table.emplace_back("checkpoint", Value{Table{{"name", text(name)},
                                                     {"rows", number(manifest.checkpoint->rows)},
                                                     {"crc32", text(hexadecimal(crc32_of_bytes(state)))}},
                                               {}});
    }
    write_whole(folder / manifest_name, to_json({std::move(table), {}}) + "\n", remedy);
    std::error_code ignored;
    for (fs::directory_entry const& entry : fs::directory_iterator(folder)) {
        std::string const name = entry.path().filename().string();
        bool const listed =
            manifest.checkpoint && name == std::to_string(manifest.checkpoint->rows) + "." + checkpoint_name;
        if (name.ends_with(checkpoint_name) && !listed)
            fs::remove(entry.path(), ignored);
    }
}

std::optional<LogManifest> read_manifest(fs::path const& folder, LogHeader const& header,
                                         std::uint64_t shard_rows) {
    std::error_code problem;
    if (!fs::is_regular_file(folder / manifest_name, problem))
        return std::nullopt;
    Value table;
    try {
        table = parse_json(bytes_of(folder / manifest_name), (folder / manifest_name).string());
    } catch (InputError const&) { // half a file, from a disk that failed
        return std::nullopt;
    }
    Value const* const shards = table.find("shards");
    Value const* const point = table.find("checkpoint");
    if (number_at(table, "schema_version") != 1 || !is_of_run(table, header) ||
        number_at(table, "shard_rows") != shard_rows || !shards ||
        !std::holds_alternative<Array>(shards->data) || !point)
        return std::nullopt;
    LogManifest manifest{shard_rows, false, {}, {}};
    for (Value const& entry : std::get<Array>(shards->data)) {
        ListedShard const shard{
            text_at(entry, "name"), number_at(entry, "rows"), number_at(entry, "first_ray"),
            number_at(entry, "bytes"),
            static_cast<std::uint32_t>(std::strtoul(text_at(entry, "crc32").c_str(), nullptr, 16))};
        if (fs::path(shard.name).filename() != shard.name || shard.rows != shard_rows ||
            !is_whole(folder / shard.name, shard))
            break;
        manifest.shards.push_back(shard);
    }
    LogCheckpoint checkpoint{number_at(*point, "rows"), {}};
    fs::path const name = text_at(*point, "name");
    if (name.empty() || name.filename() != name || checkpoint.rows > manifest.shards.size() * shard_rows)
        return std::nullopt; // a shard is gone that its rays would not be traced again for
    checkpoint.state = bytes_of(folder / name);
    if (hexadecimal(crc32_of_bytes(checkpoint.state)) != text_at(*point, "crc32"))
        return std::nullopt;
    manifest.checkpoint = std::move(checkpoint);
    return manifest;
}

} // namespace sahl
