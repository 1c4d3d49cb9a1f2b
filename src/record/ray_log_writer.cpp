// In: segments in order. Out: rays.h5, and its shards if it is long; docs/ray-log.md describes the layout.
// A shard is closed by the thread that writes; another one brings it to the disk meanwhile.
#include "record/disk.h"
#include "record/log_file.h"
#include "record/log_manifest.h"
#include "record/ray_log.h"

#include <cassert>
#include <cstdio>
#include <deque>
#include <future>
#include <mutex>

namespace sahl {

namespace fs = std::filesystem;

namespace {

constexpr char const* remedy_of_writing = "see that the folder is there and has space, or choose another one";

fs::path with_ending(fs::path path, char const* ending) {
    return path += ending;
}

} // namespace

struct RayLogWriter::State {
    fs::path const target, temporary, shards, unfinished_shards;
    hdf5::Must const must;
    LogHeader const header;
    RayLogOptions const options;
    std::shared_ptr<LogMemory> const memory = std::make_shared<LogMemory>(header.digits_lost);
    LogChunker chunker{memory};
    std::optional<LogFile> open;
    std::vector<LogShard> closed;
    std::future<void> syncing; // the last of the closed; it alone touches `manifest` until it is done
    LogManifest manifest;
    std::optional<Resumed> resumed;
    std::uint64_t placed = 0; // rows
    std::mutex mutex;         // of those remembered: one thread places rows, another closes shards
    std::deque<LogCheckpoint> remembered;
    bool finished = false, left = false;

    State(fs::path const& file, LogHeader const& given, RayLogOptions const& chosen, LogStart start)
        : target(file), temporary(with_ending(file, ".tmp")),
          shards(fs::path(file).replace_extension(".shards")),
          unfinished_shards(with_ending(shards, ".tmp")), must{file.string(), remedy_of_writing},
          header(given), options(chosen) {
        assert(options.shard_rows > 0 && options.shard_rows % chunk_rows == 0);
        manifest.shard_rows = options.shard_rows;
        if (start == LogStart::where_it_was_stopped)
            go_on();
        if (closed.empty())
            open.emplace(must, temporary, header, options, 0);
        else
            open_shard();
    }
    State(State const&) = delete;
    ~State();
    void go_on();
    std::string next_shard() const; // its name
    void open_shard();
    void write(LogChunk const& chunk);
    void close_shard();
};

/// Takes up the shards that a stopped log left whole.
void RayLogWriter::State::go_on() {
    auto found = read_manifest(unfinished_shards, header, options.shard_rows);
    if (!found)
        return;
    manifest.shards = std::move(found->shards);
    for (ListedShard const& shard : manifest.shards)
        closed.push_back({(shards.filename() / shard.name).string(), shard.rows, shard.first_ray});
    placed = found->checkpoint->rows;
    chunker.pass_over(closed.size() * options.shard_rows - placed);
    resumed = Resumed{std::move(found->checkpoint->state), placed};
}

std::string RayLogWriter::State::next_shard() const {
    char name[24];
    std::snprintf(name, sizeof name, "%05zu.h5", closed.size());
    return name;
}

RayLogWriter::State::~State() {
    if (syncing.valid())
        syncing.wait();
    open.reset();
    if (finished)
        return;
    std::error_code ignored;
    fs::remove(temporary, ignored);
    if (!closed.empty() && !left)
        fs::remove_all(unfinished_shards, ignored);
}

void RayLogWriter::State::write(LogChunk const& chunk) {
    if (open->rows() == options.shard_rows) {
        close_shard();
        open_shard();
    }
    open->write(chunk);
}

void RayLogWriter::State::open_shard() {
    open.emplace(must, with_ending(unfinished_shards / next_shard(), ".tmp"), header, options,
                 closed.size() * options.shard_rows);
}

/// Closes the open file, which becomes the next shard as soon as it is on the disk.
void RayLogWriter::State::close_shard() {
    open->close();
    if (closed.empty()) {
        std::error_code problem;
        fs::remove_all(unfinished_shards, problem);
        fs::create_directory(unfinished_shards, problem);
        if (problem)
            must.fail("cannot make the folder of its shards (" + problem.message() + ")");
    } else if (syncing.valid()) {
        syncing.get();
    }
    ListedShard listed{next_shard(), open->rows(), open->first_ray(), 0, 0};
    closed.push_back({(shards.filename() / listed.name).string(), listed.rows, listed.first_ray});
    {
        std::lock_guard const lock(mutex); // the last that all rows of are in closed shards, or begin in them
        while (!remembered.empty() && remembered.front().rows <= closed.size() * options.shard_rows) {
            manifest.checkpoint = std::move(remembered.front());
            remembered.pop_front();
        }
    }
    syncing = std::async(std::launch::async, [this, listed, from = open->path()]() mutable {
        fs::path const to = unfinished_shards / listed.name;
        sync_to_disk(from, remedy_of_writing);
        listed.bytes = fs::file_size(from);
        listed.crc32 = crc32_of(from);
        move_on_disk(from, to, remedy_of_writing);
        manifest.shards.push_back(listed);
        write_manifest(unfinished_shards, header, manifest, remedy_of_writing);
    });
}

RayLogWriter::RayLogWriter(fs::path file, LogHeader const& header, RayLogOptions const& options,
                           LogStart start)
    : state_(std::make_unique<State>(file, header, options, start)) {}

RayLogWriter::RayLogWriter(RayLogWriter&&) noexcept = default;
RayLogWriter::~RayLogWriter() = default;

LogBlock RayLogWriter::block() const {
    return LogBlock(state_->memory);
}

std::optional<RayLogWriter::Resumed> const& RayLogWriter::resumed() const {
    return state_->resumed;
}

bool RayLogWriter::fills_shard(std::uint64_t rows) const {
    std::uint64_t const shard = state_->options.shard_rows;
    return state_->placed / shard != (state_->placed + rows) / shard;
}

void RayLogWriter::remember(std::string state) {
    std::lock_guard const lock(state_->mutex);
    state_->remembered.push_back({state_->placed, std::move(state)});
}

std::vector<LogChunk> RayLogWriter::place(LogBlock block) {
    state_->placed += block.rows();
    return state_->chunker.add(std::move(block));
}

void RayLogWriter::pack(std::vector<LogChunk>& chunks) const {
    if (state_->options.compress)
        for (LogChunk& chunk : chunks)
            compress(chunk);
}

void RayLogWriter::write(std::vector<LogChunk> chunks) {
    for (LogChunk const& chunk : chunks)
        state_->write(chunk);
}

void RayLogWriter::append(std::span<Segment const> segments) {
    while (!segments.empty()) { // in portions, so that memory stays small
        auto const part = segments.first(std::min(segments.size(), chunk_rows));
        LogBlock rows = block();
        rows.take(part);
        std::vector<LogChunk> chunks = place(std::move(rows));
        pack(chunks);
        write(std::move(chunks));
        segments = segments.subspan(part.size());
    }
}

void RayLogWriter::leave() {
    state_->left = true;
}

void RayLogWriter::close() {
    State& log = *state_;
    std::vector<LogChunk> rest = log.chunker.rest();
    pack(rest);
    write(std::move(rest));
    std::error_code ignored;
    if (log.closed.empty()) {
        log.open->close();
    } else {
        if (log.open->rows() > 0) // none where it was stopped after its last row
            log.close_shard();
        log.open.reset();
        if (log.syncing.valid())
            log.syncing.get();
        log.manifest.complete = true;
        log.manifest.checkpoint.reset();
        write_manifest(log.unfinished_shards, log.header, log.manifest, remedy_of_writing);
        write_log_of_shards(log.must, log.temporary, log.header, log.closed);
        move_on_disk(log.unfinished_shards, log.shards, remedy_of_writing);
    }
    sync_to_disk(log.temporary, remedy_of_writing);
    move_on_disk(log.temporary, log.target, remedy_of_writing);
    log.finished = true;
    if (log.closed.empty())
        fs::remove_all(log.shards, ignored); // those of a longer log that had this name
}

} // namespace sahl
