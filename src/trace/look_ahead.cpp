#include "trace/look_ahead.h"

#include <algorithm>

namespace sahl {

namespace {

// Set by a scan of 235 136 triangles, where half or twice of each made no clear difference.
constexpr double least_cosine = 0.95;
constexpr double farthest_start = 0.05; // of the mesh's size
constexpr std::size_t least_together = 6;
constexpr std::size_t least_in_turn = 4; // so many doubles there are in a register

} // namespace

LookAhead::LookAhead(Scene const& scene) : bvh_(*scene.bvh) {
    double const near = farthest_start * bvh_.size_seen_ahead();
    near_ = near * near;
}

void LookAhead::begin(std::size_t branches, bool first, bool may_go_alike) {
    // where most of the last generation went alone, this one will, too
    bool const scattered = !first && 2 * together_ < added_;
    in_packets_ = near_ > 0.0 && may_go_alike && branches >= least_together && !scattered;
    wants_ = in_packets_ || (bvh_.looks_ahead_in_turn() && branches >= least_in_turn);
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

LookAhead::Packet& LookAhead::packet_for(Branch const& branch) {
    for (Packet& packet : packets_)
        if (!packet.numbers.empty() && fits(packet, branch))
            return packet;
    for (Packet& packet : packets_)
        if (packet.numbers.empty())
            return packet;
    Packet& given_up = packets_[next_];
    next_ = (next_ + 1) % packets_.size();
    look(given_up);
    return given_up;
}

void LookAhead::add(std::size_t number, Branch const& branch) {
    Bvh::Line const line{&branch.origin, &branch.direction, &branch.inside};
    if (!in_packets_)
        return look_in_turn(static_cast<std::uint32_t>(number), line);
    ++added_;
    Packet& into = packet_for(branch);
    into.numbers.push_back(static_cast<std::uint32_t>(number));
    into.lines.push_back(line);
    if (into.numbers.full())
        look(into);
}

void LookAhead::look(Packet& packet) {
    std::size_t const count = packet.numbers.size();
    if (count >= least_together) {
        std::array<SeenAhead, Bvh::most_together> seen;
        bvh_.look_ahead({packet.lines.begin(), count}, std::span(seen).first(count));
        for (std::size_t i = 0; i < count; ++i)
            seen_[packet.numbers[i]] = seen[i];
        together_ += count;
    } else {
        for (std::size_t i = 0; i < count; ++i)
            look_in_turn(packet.numbers[i], packet.lines[i]);
    }
    packet.numbers.clear();
    packet.lines.clear();
}

void LookAhead::look_in_turn(std::uint32_t number, Bvh::Line const& line) {
    alone_.numbers.push_back(number);
    alone_.lines.push_back(line);
    if (alone_.numbers.full())
        look_in_turn();
}

void LookAhead::look_in_turn() {
    std::size_t const count = alone_.numbers.size();
    std::array<SeenAhead*, Bvh::most_together> seen;
    for (std::size_t i = 0; i < count; ++i)
        seen[i] = &seen_[alone_.numbers[i]];
    bvh_.look_ahead_in_turn({alone_.lines.begin(), count}, std::span(seen).first(count));
    alone_.numbers.clear();
    alone_.lines.clear();
}

void LookAhead::end() {
    for (Packet& packet : packets_)
        look(packet);
    if (!alone_.numbers.empty())
        look_in_turn();
}

} // namespace sahl
