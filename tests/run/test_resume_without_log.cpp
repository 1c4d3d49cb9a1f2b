// A run without a log, and a goal, that were killed go on with what they knew, to the same results.
#include "run/run.h"
#include "run/unfinished.h"
#include "run/workshop.h"

using namespace sahl;
using bench::bytes_of, bench::results_in;
namespace fs = std::filesystem;

namespace {

/// Long enough to be killed on the way.
std::string ball(int rays) {
    return R"(
trace = {min_power = 1e-4}
[[object]]
name = "ball"
shape = {sphere = {radius_mm = 5}}
medium = "N-SF11"
[[source]]
name = "beam"
beam = {from_mm = [0, 0, -10], toward = [0, 0, 1], radius_mm = 4.99, pattern = "random", rays = )" +
           std::to_string(rays) + R"(}
lines = ["d"]
[[detector]]
name = "screen"
at_mm = [0, 0, 20]
facing = [0, 0, -1]
size_mm = [40, 40]
pixels = [32, 32]
spot = true
)";
}

std::string const goal = R"(
[goal]
minimise = "detectors.screen.rms_radius_mm"
vary = {"object.ball.move_mm[2]" = {from = -5, to = 9}}
looks = 12
)";

std::vector<std::string> const often{"--keep-every", "0"};

std::size_t looks_kept(bench::Workshop const& workshop) {
    std::error_code none;
    std::size_t count = 0;
    for (auto const& entry : fs::directory_iterator(workshop.partial / unfinished_folder, none))
        count += entry.path().extension() == ".json";
    return count;
}

} // namespace

TEST_CASE("a run without a log that was killed goes on from what it knew, to the same results",
          "[run][resume]") {
    bench::Workshop const reference(ball(400000)), killed(ball(400000));
    REQUIRE(reference.finish(reference.start()) == 0);
    fs::path const known = killed.partial / unfinished_folder / "known.bin";
    REQUIRE(killed.kill_when([&] { return fs::exists(known); }, 0, often));
    SECTION("from what it knew") {
        auto const first = killed.go_on();
        REQUIRE(first);
        CHECK(*first > 4096); // a batch had been done and kept before
    }
    SECTION("killed once more on the way") {
        pid_t const child = killed.start({"--resume", "--keep-every", "0"});
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        ::kill(child, SIGKILL);
        killed.finish(child);
        if (!fs::exists(killed.out))
            REQUIRE(killed.finish(killed.start({"--resume"})) == 0);
    }
    SECTION("from its first ray where that is damaged") {
        std::ofstream(known, std::ios::binary) << "nothing of use";
        REQUIRE(killed.finish(killed.start({"--resume"})) == 0);
    }
    SECTION("from its first ray without --resume") {
        REQUIRE(killed.finish(killed.start()) == 0);
    }
    CHECK((results_in(killed.out) == results_in(reference.out)));
    CHECK_FALSE(fs::exists(killed.partial));
    CHECK_FALSE(fs::exists(killed.out / unfinished_folder));
}

TEST_CASE("a run that is told to stop keeps all that it has done, and goes on to the same results",
          "[run][resume]") {
    bench::Workshop const reference(ball(60000)), stopped(ball(60000));
    REQUIRE(reference.finish(reference.start()) == 0);
    std::atomic<bool> stop = false;
    RunOptions options;
    options.out = stopped.out;
    options.keep_every_s = 1e6;
    options.stop = &stop;
    std::uint64_t last = 0;
    options.progress = [&](std::uint64_t done, std::uint64_t) {
        last = done;
        stop = done >= 20000;
    };
    try {
        run_experiment(load_experiment(stopped.experiment), options);
        FAIL("it did not stop");
    } catch (RunStopped const& was) {
        CHECK(was.kept == stopped.partial);
    }
    CHECK_FALSE(fs::exists(stopped.out));
    CHECK(stopped.go_on() == last + 4096); // the next batch after those that were done
    CHECK((results_in(stopped.out) == results_in(reference.out)));
}

TEST_CASE("Ctrl-C and what batch systems send stop a run with their own statuses, for --resume",
          "[run][resume]") {
    bench::Workshop const reference(ball(400000)), stopped(ball(400000));
    REQUIRE(reference.finish(reference.start()) == 0);
    int const signal = GENERATE(SIGINT, SIGTERM);
    fs::path const known = stopped.partial / unfinished_folder / "known.bin";
    CHECK(stopped.signal_when(
              signal, [&] { return fs::exists(known); }, 0, often) == 128 + signal);
    CHECK(fs::exists(known));
    REQUIRE(stopped.finish(stopped.start({"--resume"})) == 0);
    CHECK((results_in(stopped.out) == results_in(reference.out)));
}

TEST_CASE("a sweep that is told to stop keeps the runs that it has made", "[run][resume]") {
    bench::Workshop const sweep(ball(20000) +
                                "[sweep]\n\"object.ball.move_mm[2]\" = {from = -5, to = 9, steps = 8}\n");
    std::atomic<bool> stop = false;
    RunOptions options;
    options.out = sweep.out;
    options.stop = &stop;
    options.threads = 1;
    options.sweep_progress = [&](std::size_t done, std::size_t) { stop = done >= 3; };
    CHECK_THROWS_AS(run_experiment(load_experiment(sweep.experiment), options), RunStopped);
    CHECK(fs::exists(sweep.partial / "runs/002/summary.json"));
    CHECK_FALSE(fs::exists(sweep.partial / "runs/003/summary.json"));
    CHECK_FALSE(fs::exists(sweep.out));
}

TEST_CASE("a goal that was killed keeps the runs that it has made", "[run][resume]") {
    bench::Workshop const reference(ball(20000) + goal), killed(ball(20000) + goal);
    REQUIRE(reference.finish(reference.start()) == 0);
    REQUIRE(killed.kill_when([&] { return looks_kept(killed) >= 3; }, 0));
    bool const tampered = GENERATE(false, true); // shows that what was kept is not made again
    if (tampered)
        for (auto const& entry : fs::directory_iterator(killed.partial / unfinished_folder)) {
            Value look = parse_json(bytes_of(entry.path()), "look");
            for (auto& [key, value] : std::get<Table>(look.data))
                if (key == "segments")
                    value.data = std::int64_t{7};
            std::ofstream(entry.path()) << to_json(look);
        }
    REQUIRE(killed.finish(killed.start({"--resume"})) == 0);
    auto const expected = results_in(reference.out), found = results_in(killed.out);
    CHECK((found.at("goal.csv") == expected.at("goal.csv")) != tampered);
    CHECK((found.at("summary.json") == expected.at("summary.json")));
    CHECK_FALSE(fs::exists(killed.out / unfinished_folder));
}
