#include "record/path_counter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sahl {

namespace {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
constexpr std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
    return x ^ (x >> 31);
}

double finite_or_none(double x) {
    return std::isfinite(x) ? x : 0.0; // an invalid ray may have anything
}

} // namespace

PathHash PathHash::after(std::int32_t surface, Event event) const {
    std::uint64_t const step =
        static_cast<std::uint64_t>(surface + 1) << 8 | static_cast<std::uint64_t>(event);
    return {mixed(first + step * 0x9E3779B97F4A7C15 + 1), mixed((second ^ step) * 0xD6E8FEB86659FD93 + 1)};
}

void PathSums::add(std::uint64_t ray, double watts, double path, SumUnit unit) {
    rays += paths == 0 || ray != last_ray;
    last_ray = ray;
    ++paths;
    power.add(watts, unit);
    power_path.add(watts * path, unit);
    weight += watts;
}

void PathSums::add(PathSums const& others) {
    paths += others.paths;
    power.add(others.power);
    power_path.add(others.power_path);
}

PathCounter::PathCounter(LogHeader const& header, PathFilter const* where, std::size_t room)
    : room_(room), unit_(SumUnit::for_total(
                       std::accumulate(header.source_power_W.begin(), header.source_power_W.end(), 0.0))) {
    auto const& names = header.surfaces;
    lone_.push_back(-1);
    std::unordered_map<std::string, std::int32_t> first;
    for (std::size_t i = 0; i < names.size(); ++i)
        lone_.push_back(first.try_emplace(names[i], static_cast<std::int32_t>(i)).first->second);
    if (where)
        selected_.emplace(*where);
}

void PathCounter::take(std::span<Segment const> ray) {
    ++rays_;
    segments_ += ray.size();
    began_.add(finite_or_none(ray.front().power_start), unit_);
    hashes_.resize(ray.size());
    parents_.resize(ray.size());
    has_children_.assign(ray.size(), 0);
    for (std::size_t i = 0; i < ray.size(); ++i) {
        std::ptrdiff_t const parent = parents_[i] = parent_position(ray, i);
        if (parent < 0) {
            hashes_[i] = PathHash();
            continue;
        }
        auto const above = static_cast<std::size_t>(parent);
        has_children_[above] = 1;
        hashes_[i] =
            hashes_[above].after(lone_[static_cast<std::size_t>(ray[above].surface + 1)], ray[i].born);
    }
    if (selected_)
        selected_->take(ray);
    for (std::size_t i = 0; i < ray.size(); ++i)
        if (!has_children_[i] && (!selected_ || selected_->path_to(i)))
            add(hashes_[i].after(lone_[static_cast<std::size_t>(ray[i].surface + 1)], ray[i].ended), ray, i,
                parents_[i]);
}

void PathCounter::add(PathHash const& hash, std::span<Segment const> ray, std::size_t end,
                      std::ptrdiff_t parent) {
    double const watts = finite_or_none(ray[end].power_end);
    double const path = finite_or_none(path_length(ray, end, parent));
    if (fixed_) {
        auto const found = table_.find(hash);
        (found == table_.end() ? other_ : found->second).add(ray[end].ray, watts, path, unit_);
        return;
    }
    auto const [place, is_new] = table_.try_emplace(hash);
    if (is_new) {
        place->second.first_ray = ray[end].ray;
        place->second.first_segment = ray[end].index;
    }
    place->second.add(ray[end].ray, watts, path, unit_);
    if (table_.size() > 2 * room_)
        give_up_the_weakest();
}

/// Takes the same weight from all, so much that half of them have none left: at least room_ times that weight
/// goes, so that all that is ever taken from one is at most a share 1 / room_ of the whole.
void PathCounter::give_up_the_weakest() {
    std::vector<double> weights;
    weights.reserve(table_.size());
    for (auto const& [hash, sums] : table_)
        weights.push_back(sums.weight);
    auto const middle = weights.begin() + static_cast<std::ptrdiff_t>(room_);
    std::nth_element(weights.begin(), middle, weights.end(), std::greater<>());
    double const less = *middle;
    given_up_ += less;
    for (auto place = table_.begin(); place != table_.end();) {
        place->second.weight -= less;
        if (place->second.weight > 0.0) {
            ++place;
        } else {
            other_.add(place->second);
            place = table_.erase(place);
        }
    }
}

void PathCounter::count_again() {
    for (auto& [hash, sums] : table_) {
        PathSums empty;
        empty.first_ray = sums.first_ray;
        empty.first_segment = sums.first_segment;
        sums = empty;
    }
    other_ = {};
    began_ = {};
    rays_ = segments_ = 0;
    fixed_ = true;
}

} // namespace sahl
