// A run with a log that is killed leaves every closed shard whole, and going on with it gives the bytes of
// one that was not killed.
#include "math/input_error.h"
#include "record/log_manifest.h"
#include "run/workshop.h"
#include "support/dice.h"

using namespace sahl;
using bench::bytes_of, bench::results_in;
namespace fs = std::filesystem;

namespace {

/// 12.8 rows a ray, 1280 rays a shard; everything that a detector may keep.
std::string ball(int rays) {
    return R"(
trace = {min_power = 1e-4, log = true}
log = {shard_rows = 16384}
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
optical_path = 20
far_field = {}
[[detector]]
name = "sky"
sphere = true
far_field = {rings = 18, sectors = 4}
)";
}

constexpr int few = 10300, many = 60000; // 8 and 47 shards

struct Workshop : bench::Workshop {
    explicit Workshop(int rays = few) : bench::Workshop(ball(rays)) {}
};

std::string complaint_of(std::function<void()> const& action) {
    try {
        action();
    } catch (InputError const& error) {
        return error.what();
    }
    return "";
}

/// Of so many kills `late` come when two shards or more are closed.
void kill_and_go_on(int rays, int kills, int late) {
    Workshop const reference(rays), killed(rays);
    REQUIRE(reference.finish(reference.start()) == 0);
    auto const expected = results_in(reference.out);
    int const shards = rays / 1280;
    REQUIRE(static_cast<int>(expected.size()) > shards);
    RayLogReader const whole(reference.out);
    bench::Dice dice(7);
    int after_two = 0, at_all = 0;
    for (int kill = 0; kill < kills; ++kill) {
        CAPTURE(kill);
        int const closed = kill < late ? 2 + static_cast<int>(dice.uniform() * (shards - 7)) : 0;
        if (!killed.kill_one(closed, static_cast<long>(dice.uniform() * (closed > 0 ? 8000 : 60000))))
            continue; // it was done before: no kill
        ++at_all;
        after_two += killed.whole_shards(whole) >= 2;
        REQUIRE(killed.finish(killed.start({"--resume"})) == 0);
        CHECK((results_in(killed.out) == expected));
        CHECK_FALSE(fs::exists(killed.partial));
    }
    CAPTURE(at_all, after_two);
    CHECK(at_all >= kills * 9 / 10);
    CHECK(after_two >= kills * 3 / 5);
}

} // namespace

TEST_CASE("a run killed at a few moments goes on to the same bytes", "[run][resume]") {
    kill_and_go_on(few, 2, 1);
}

TEST_CASE("a run killed at fifty moments goes on to the same bytes each time", "[run][resume][slow]") {
    kill_and_go_on(many, 56, 44);
}

TEST_CASE("a run that goes on does not trace the rays of closed shards again", "[run][resume]") {
    Workshop const workshop(2 * few);
    REQUIRE(workshop.kill_one(7, 0));
    auto const first = workshop.go_on();
    REQUIRE(first);
    CHECK(*first > 4096); // a batch fills three shards: the first is long in the log
}

TEST_CASE("a run with a log that is told to stop leaves its closed shards, and goes on to the same bytes",
          "[run][resume]") {
    Workshop const reference(many), stopped(many);
    REQUIRE(reference.finish(reference.start()) == 0);
    REQUIRE(stopped.signal_when(
                SIGTERM, [&] { return fs::exists(stopped.shards / stopped.shard(1)); }, 0) == 128 + SIGTERM);
    CHECK(stopped.whole_shards(RayLogReader(reference.out)) >= 2);
    REQUIRE(stopped.finish(stopped.start({"--resume"})) == 0);
    CHECK((results_in(stopped.out) == results_in(reference.out)));
}

TEST_CASE("a damaged shard is made again, and so is everything where the checkpoint is damaged",
          "[run][resume]") {
    Workshop const reference, damaged;
    REQUIRE(reference.finish(reference.start()) == 0);
    auto const expected = results_in(reference.out);
    REQUIRE(damaged.kill_one(4, 0));
    SECTION("the last shard") {
        auto const manifest = bytes_of(damaged.shards / manifest_name);
        int last = 0;
        while (manifest.find(damaged.shard(last + 1)) != std::string::npos)
            ++last;
        std::fstream file(damaged.shards / damaged.shard(last),
                          std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(5000).put('x').put('y');
    }
    SECTION("the first shard") {
        fs::resize_file(damaged.shards / damaged.shard(0), 1000);
    }
    SECTION("the checkpoint") {
        for (auto const& entry : fs::directory_iterator(damaged.shards))
            if (entry.path().extension() == ".bin")
                std::ofstream(entry.path(), std::ios::binary) << "nothing";
    }
    SECTION("the manifest") {
        std::ofstream(damaged.shards / manifest_name) << "{\"schema_version\": 1, \"shards\": [";
    }
    REQUIRE(damaged.finish(damaged.start({"--resume"})) == 0);
    CHECK((results_in(damaged.out) == expected));
}

TEST_CASE("without --resume a killed run begins anew, and with it there need be none", "[run][resume]") {
    Workshop const workshop;
    REQUIRE(workshop.finish(workshop.start({"--resume"})) == 0);
    auto const expected = results_in(workshop.out);
    REQUIRE(workshop.kill_one(3, 0));
    REQUIRE(workshop.finish(workshop.start()) == 0);
    CHECK((results_in(workshop.out) == expected));
}

TEST_CASE("an unfinished run of another experiment is not gone on with, nor removed", "[run][resume]") {
    Workshop const workshop;
    REQUIRE(workshop.kill_one(3, 0));
    RunOptions options;
    options.out = workshop.out;
    options.resume = true;
    std::string const said = complaint_of(
        [&] { run_experiment(load_experiment(workshop.experiment, {"trace.seed=2"}), options); });
    CHECK(said.find("is of another experiment") != std::string::npos);
    CHECK(fs::exists(workshop.shards / workshop.shard(1)));
}

TEST_CASE("a log's manifest has the size and the checksum of each shard", "[record][resume]") {
    Workshop const workshop;
    REQUIRE(workshop.finish(workshop.start()) == 0);
    fs::path const shards = workshop.out / "rays.shards";
    Value const manifest = parse_json(bytes_of(shards / manifest_name), "manifest");
    CHECK(std::get<bool>(manifest.find("complete")->data));
    std::size_t listed = 0;
    for (Value const& shard : std::get<Array>(manifest.find("shards")->data)) {
        fs::path const file = shards / std::get<std::string>(shard.find("name")->data);
        char crc[16];
        std::snprintf(crc, sizeof crc, "%08x", crc32_of(file));
        CHECK(std::get<std::string>(shard.find("crc32")->data) == crc);
        CHECK(std::get<std::int64_t>(shard.find("bytes")->data) ==
              static_cast<std::int64_t>(fs::file_size(file)));
        ++listed;
    }
    CHECK(listed + 1 ==
          static_cast<std::size_t>(std::distance(fs::directory_iterator(shards), {}))); // and itself
    std::ofstream(workshop.folder.path() / "check") << "123456789";
    CHECK(crc32_of(workshop.folder.path() / "check") == 0xCBF43926u); // the check value of CRC-32/ISO-HDLC
}
