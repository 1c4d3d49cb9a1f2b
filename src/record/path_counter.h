// In: rays of a log, one after another. Out: sums over the paths that took the same way, told apart by a hash
// of 128 bits.
#pragma once

#include "math/exact_sum.h"
#include "record/ray_log.h"
#include "trace/path_filter.h"

#include <optional>
#include <unordered_map>

namespace sahl {

/// What happened on a path so far. Among 2²⁰ different ones two are the same by chance once in 2⁸⁸.
struct PathHash {
    std::uint64_t first = 0x9E3779B97F4A7C15, second = 0xD1B54A32D192ED03;

    PathHash after(std::int32_t surface, Event event) const;
    bool operator==(PathHash const&) const = default;
};

struct PathSums {
    std::uint64_t paths = 0, rays = 0, last_ray = 0;
    ExactSum power, power_path;      // W, W·m
    double weight = 0.0;             // W: a lower bound of its power, by which it is kept or given up
    std::uint64_t first_ray = 0;     // of the first of these paths
    std::uint32_t first_segment = 0; // with which that one ends

    void add(std::uint64_t ray, double watts, double path, SumUnit unit);
    void add(PathSums const& others);
};

class PathCounter {
  public:
    struct Hasher {
        std::size_t operator()(PathHash const& hash) const { return hash.first; }
    };
    using Table = std::unordered_map<PathHash, PathSums, Hasher>;

    /// room   different paths that are remembered
    PathCounter(LogHeader const& header, PathFilter const* where, std::size_t room);
    void take(std::span<Segment const> ray);
    /// Begins anew, and counts only the paths remembered now; all others are `other`.
    void count_again();

    Table const& table() const { return table_; }
    PathSums const& other() const { return other_; } // rays: unknown
    double given_up() const { return given_up_; }    // W: no path that is not in the table has more
    SumUnit unit() const { return unit_; }
    std::uint64_t rays() const { return rays_; }
    std::uint64_t segments() const { return segments_; }
    double began() const { return began_.value(unit_); }

  private:
    void add(PathHash const& hash, std::span<Segment const> ray, std::size_t end, std::ptrdiff_t parent);
    void give_up_the_weakest();

    std::vector<std::int32_t> lone_; // by surface + 1: the first one of this name
    std::optional<SelectedPaths> selected_;
    std::size_t room_;
    SumUnit unit_;
    Table table_;
    PathSums other_;
    bool fixed_ = false;
    double given_up_ = 0.0;
    ExactSum began_;
    std::uint64_t rays_ = 0, segments_ = 0;
    std::vector<PathHash> hashes_;
    std::vector<std::ptrdiff_t> parents_;
    std::vector<char> has_children_;
};

} // namespace sahl
