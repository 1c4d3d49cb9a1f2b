#include "run/trace_scene.h"

#include "math/archive.h"
#include "run/follow_again.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

namespace sahl {

namespace {

constexpr std::size_t lost_rays_named = 20; // in the summary; all are counted

constexpr unsigned batches_waiting = 32; // at most, for others before them or for the disk: they fill memory

/// A batch on its way: what became of it, and its rows where there is a log.
struct Traced {
    std::optional<BatchResult> result;
    std::optional<LogBlock> rows;
    std::vector<TwiceSums> twice; // by detector; empty where nothing is left to chance
};
using Chunks = std::vector<LogChunk>;

} // namespace

SumUnit power_unit(Emission const& emission) {
    return SumUnit::for_total(emission.power());
}

TraceOutcome trace_scene(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
                         TraceOptions const& options, unsigned threads, RayLogWriter* log,
                         LogOptions const& logged, Progress const& progress, KnownSoFar const* known,
                         std::atomic<bool> const* stop) {
    auto const start = std::chrono::steady_clock::now();
    SumUnit const unit = power_unit(emission);
    PathFilters const filters = path_filters(scene, log ? logged.where : WrittenFilter{});
    TraceContext const context{scene,
                               optics,
                               emission,
                               options,
                               unit,
                               log ? logged.every : 0,
                               logged.min_power,
                               filters.log || filters.at_detectors ? &filters : nullptr};
    TraceOutcome outcome{Tally(unit, scene.bodies.size(), scene.faces.size(), optics.wavelengths().size()),
                         {},
                         {},
                         emission.rays(),
                         true,
                         0.0,
                         threads ? threads : static_cast<unsigned>(tbb::this_task_arena::max_concurrency())};
    bool const chance = left_to_chance(scene, options) && !scene.detectors.empty();
    bool holes_sought = false;
    for (DetectorSpec const& detector : scene.detectors)
        outcome.detectors.emplace_back(detector, unit, optics.wavelengths().size(), scene.sources.size());

    std::uint64_t const batches = (emission.rays() + rays_per_batch - 1) / rays_per_batch;
    std::uint64_t next_batch = 0, rays_done = 0;
    auto const known_so_far = [&](auto& archive) { // of the rays that are done
        archive(rays_done, outcome.tally, outcome.digits, outcome.lost, holes_sought, outcome.holes);
        for (DetectorRecord& detector : outcome.detectors)
            archive(detector);
    };
    std::string const* const before = log && log->resumed()            ? &log->resumed()->state
                                      : !log && known && known->before ? &*known->before
                                                                       : nullptr;
    if (before) {
        ArchiveReader archive(*before);
        known_so_far(archive);
        next_batch = rays_done / rays_per_batch; // a stop lies between two of them
    }
    auto const keep = [&] {
        ArchiveWriter archive;
        known_so_far(archive);
        log ? log->remember(archive.bytes()) : known->keep(archive.bytes());
    };
    tbb::global_control const limit(tbb::global_control::max_allowed_parallelism, outcome.threads);
    auto const number = [&](tbb::flow_control& control) {
        if (next_batch >= batches || (stop && *stop))
            control.stop();
        return next_batch++;
    };
    auto const trace = [&](std::uint64_t batch) {
        std::uint64_t const first = batch * rays_per_batch,
                            count = std::min(rays_per_batch, emission.rays() - first);
        Traced traced;
        if (log)
            traced.rows.emplace(log->block());
        traced.result.emplace(trace_batch(context, first, count, log ? &*traced.rows : nullptr));
        if (chance)
            traced.twice = follow_again(context, first, count, traced.result->hits);
        return std::make_shared<Traced>(std::move(traced));
    };
    auto const record = [&](std::shared_ptr<Traced> const& traced) { // in the order of batches
        bool const fills_shard = log && log->fills_shard(traced->rows->rows());
        if (fills_shard || (!log && known && rays_done > 0 && known->due()))
            keep();
        outcome.tally.add(traced->result->tally);
        outcome.digits.add(traced->result->digits);
        for (DetectorHit const& hit : traced->result->hits)
            outcome.detectors[hit.detector.value].add(hit);
        for (std::size_t i = 0; i < traced->twice.size(); ++i)
            outcome.detectors[i].add(traced->twice[i]);
        for (LostRay const& ray : traced->result->lost) {
            if (outcome.lost.size() < lost_rays_named)
                outcome.lost.push_back(ray);
            if (!holes_sought) // few runs lose any
                outcome.holes = holes_of(scene);
            holes_sought = true;
            count_leak(outcome.holes, ray);
        }
        rays_done = std::min(rays_done + rays_per_batch, emission.rays());
        if (progress)
            progress(rays_done, emission.rays());
        return log ? std::make_shared<Chunks>(log->place(std::move(*traced->rows))) : nullptr;
    };
    auto const pack = [&](std::shared_ptr<Chunks> chunks) {
        log->pack(*chunks);
        return chunks;
    };
    auto const write = [&](std::shared_ptr<Chunks> const& chunks) { log->write(std::move(*chunks)); };
    using tbb::filter_mode;
    using tbb::make_filter;
    auto const traced = make_filter<void, std::uint64_t>(filter_mode::serial_in_order, number) &
                        make_filter<std::uint64_t, std::shared_ptr<Traced>>(filter_mode::parallel, trace);
    auto const recorded =
        make_filter<std::shared_ptr<Traced>, std::shared_ptr<Chunks>>(filter_mode::serial_in_order, record);
    auto const kept =
        log ? make_filter<std::shared_ptr<Chunks>, std::shared_ptr<Chunks>>(filter_mode::parallel, pack) &
                  make_filter<std::shared_ptr<Chunks>, void>(filter_mode::serial_in_order, write)
            : make_filter<std::shared_ptr<Chunks>, void>(filter_mode::parallel, [](auto const&) {});
    auto const run = [&] {
        tbb::parallel_pipeline(std::min(4U * outcome.threads, outcome.threads + batches_waiting),
                               traced & recorded & kept);
    };
    // in an arena of this size already, that of runs side by side: in one of its own the thread that waits
    // for all of them could not help the last
    if (static_cast<unsigned>(tbb::this_task_arena::max_concurrency()) == outcome.threads)
        run();
    else
        tbb::task_arena(static_cast<int>(outcome.threads)).execute(run);
    outcome.whole = rays_done >= emission.rays();
    if (!outcome.whole && !log && known && rays_done > 0)
        keep();
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return outcome;
}

} // namespace sahl
