#include "trace/look_ahead.h"

#include <algorithm>

namespace sahl {

namespace {

// Set by a scan of 235 136 triangles, where half or twice of each made no clear difference.
constexpr double least_cosine = 0.95;
constexpr double farthest_start = 0.05; // of the mesh's size
constexpr std::size_t least_together = 6;

} // namespace

LookAhead::LookAhead(Scene const& scene) : bvh_(*scene.bvh) {
    double const near = farthest_start * bvh_.size_seen_ahead();
    near_ = near * near;
}

void LookAhead::begin(std::size_t branches, bool first) {
    // where most of the last generation went alone, this one will, too
    bool const scattered = !first && 2 * together_ < added_;
    wants_ = near_ > 0.0 && branches >= least_together && !scattered;
    added_ = together_ = 0;
    if (!wants_)
        return seen_.clear();
    seen_.resize(std::max(seen_.size(), branches));
    for (SeenAhead& seen : seen_)
        seen.known = false;
}

bool LookAhead::fits(Packet const& packet, Branch const& branch) const {
    Bvh::Line const& first = packet.lines.front();
    dvec3 const off = branch.origin - *first.origin;
    return dot(branch.direction, *first.direction) > least_cosine && dot(off, off) < near_;
}

void LookAhead::add(std::size_t number, Branch const& branch) {
    ++added_;
    Packet* into = nullptr;
    for (Packet& packet : packets_)
        if (!packet.numbers.empty() && fits(packet, branch)) {
            into = &packet;
            break;
        }
    if (!into) {
        for (Packet& packet : packets_)
            if (packet.numbers.empty())
                into = &packet;
    }
    if (!into) {
        into = &packets_[next_];
        next_ = (next_ + 1) % packets_.size();
        look(*into);
    }
    into->numbers.push_back(static_cast<std::uint32_t>(number));
    into->lines.push_back({&branch.origin, &branch.direction, &branch.inside});
    if (into->numbers.full())
        look(*into);
}

void LookAhead::look(Packet& packet) {
    std::size_t const count = packet.numbers.size();
    if (count >= least_together) {
        std::array<SeenAhead, Bvh::most_together> seen;
        bvh_.look_ahead({packet.lines.begin(), count}, std::span(seen).first(count));
        for (std::size_t i = 0; i < count; ++i)
            seen_[packet.numbers[i]] = seen[i];
        together_ += count;
    }
    packet.numbers.clear();
    packet.lines.clear();
}

void LookAhead::end() {
    for (Packet& packet : packets_)
        look(packet);
}

} // namespace sahl
