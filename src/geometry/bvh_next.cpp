#include "geometry/bvh_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

namespace sahl {

[[gnu::always_inline]] inline double Bvh::State::ask(std::uint32_t index, Question const& question,
                                                     Reach reach, Candidate& found) const {
    Placed const& object = objects[index];
    SeenAhead const* const ahead = question.ahead;
    if (!ahead || !ahead->known || index != seen_ahead)
        return object.next(question.origin, question.direction, question.inside, reach, question.left, index,
                           found);
    if (ahead->crossing && ahead->crossing->t <= reach.to)
        found = object.candidate(*ahead->crossing, object.local(question.origin, question.direction));
    return INFINITY;
}

/// A lone object is met directly: nothing lies before it, and nothing touches it.
void Bvh::State::next_of_lone(Question const& question, NextHit& hit) const {
    Candidate found;
    double const contradiction = ask(0, question, {question.from, INFINITY}, found);
    if (found.t == INFINITY || contradiction < found.t) {
        hit.proof = contradiction < INFINITY || !question.inside.empty() ? Proof::leak : Proof::clean;
        hit.t = contradiction;
        return;
    }
    objects.front().finish(found, question.origin, question.direction, question.from,
                           hit.at_one_place.emplace_back());
    hit.t = std::max(found.t, question.from);
    hit.blur = found.blur;
    hit.proof = found.recovered ? Proof::recovered : Proof::clean;
}

namespace {

/// t beyond which nothing can be at one place with it.
double beyond(Candidate const& found) {
    return found.t + 2.0 * std::min(found.blur, std::abs(found.t) + 1.0);
}

/// The nearest crossings so far.
struct Nearest {
    InlineVector<Candidate, 16> candidates;
    double horizon = INFINITY; // nothing beyond it can be at the nearest place
    double dropped = INFINITY; // the nearest t that one for which there was no room may have

    void take(Candidate const& found) {
        if (candidates.full()) { // keep the nearer ones
            auto* const farthest = std::max_element(candidates.begin(), candidates.end(),
                                                    [](auto const& a, auto const& b) { return a.t < b.t; });
            Candidate const& out = found.t >= farthest->t ? found : *farthest;
            dropped = std::min(dropped, out.t - out.blur);
            if (&out == &found)
                return;
            candidates.erase(farthest);
        }
        candidates.push_back(found);
        horizon = std::min(horizon, beyond(found));
    }
};

} // namespace

/// Where nothing touches, and one crossing is clearly the nearest, as nearly always. False: something has to
/// be looked at more closely.
bool Bvh::State::next_plainly(Question const& question, NextHit& hit) const {
    std::array<Candidate, 2> found; // the nearest, and room for another
    std::size_t nearest = 0;
    double horizon = INFINITY, contradiction = INFINITY;
    double second = INFINITY; // the nearest t that any other may have
    visit(question, horizon, 0, [&](std::uint32_t index) {
        Candidate& other = found[1 - nearest];
        other.t = INFINITY;
        contradiction = std::min(contradiction, ask(index, question, {question.from, horizon}, other));
        if (other.t == INFINITY)
            return;
        other.object = index;
        horizon = std::min(horizon, beyond(other));
        Candidate const& best = found[nearest];
        bool const nearer = other.t < best.t;
        Candidate const& farther = nearer ? best : other;
        second = std::min(second, farther.t - farther.blur);
        if (nearer)
            nearest = 1 - nearest;
    });
    Candidate const& best = found[nearest];
    if (contradiction < INFINITY)
        return false;
    if (best.t == INFINITY)
        return question.inside.empty(); // otherwise a shell is never left
    if (!(second > best.t + 2.0 * best.blur))
        return false;
    objects[best.object].finish(best, question.origin, question.direction, question.from,
                                hit.at_one_place.emplace_back());
    hit.t = std::max(best.t, question.from);
    hit.blur = best.blur;
    hit.proof = best.recovered ? Proof::recovered : Proof::clean;
    return true;
}

NextHit Bvh::next(dvec3 const& origin, dvec3 const& direction, ShellSet const& inside, LeftSheets const& left,
                  double from, SeenAhead const* ahead) const {
    State::Question const question{origin, direction, inside, left, from, ahead};
    NextHit hit; // the one that is returned: it is large
    if (state_->lone && left.empty())
        state_->next_of_lone(question, hit);
    else if (!state_->apart || !state_->next_plainly(question, hit))
        state_->next_among(question, hit);
    return hit;
}

/// Among all, of which several may lie at one place.
void Bvh::State::next_among(Question const& question, NextHit& hit) const {
    dvec3 const &origin = question.origin, &direction = question.direction;
    ShellSet const& inside = question.inside;
    double const from = question.from;
    Nearest nearest_ones;
    auto& candidates = nearest_ones.candidates;
    double& horizon = nearest_ones.horizon;
    double contradiction = INFINITY;

    auto const take = [&](Candidate const& found) {
        nearest_ones.take(found);
        if (found.primitive < 0 || found.open || !touch(found, found))
            return;
        // another shell of the mesh lies on this one
        Placed const& object = objects[found.object];
        Candidate second;
        object.next(origin, direction, object.after(found, inside), {found.t, horizon}, {}, found.object,
                    second);
        second.object = found.object;
        if (second.t <= found.t + found.blur + second.blur && touch(second, second))
            nearest_ones.take(second);
    };

    std::uint32_t asked = 0;
    InlineVector<Candidate, MeshCluster::most> members;
    InlineVector<std::uint32_t, MeshCluster::most> alone;
    if (cluster && cluster->next(objects, origin, direction, inside, from, members, alone)) {
        for (Candidate const& each : members)
            take(each);
        asked = in_cluster;
        for (std::size_t i = 0; !alone.empty() && i < bounded.size(); ++i)
            if (std::find(alone.begin(), alone.end(), bounded[i]) != alone.end())
                asked &= ~(1u << i);
    }
    visit(question, horizon, asked, [&](std::uint32_t index) {
        Candidate found;
        contradiction = std::min(contradiction, ask(index, question, {from, horizon}, found));
        if (found.t == INFINITY)
            return;
        found.object = index;
        take(found);
    });

    // a ray that starts closer to a face than float tells, and comes to it at a slope that float does not
    // tell either: what touches there may not have been proposed
    for (std::size_t i = 0, count = candidates.size(); i < count; ++i) {
        std::span<std::uint32_t const> const touching = touch.at(candidates[i]);
        Candidate const& found = candidates[i];
        if (touching.empty() || !objects[found.object].grazes(found, origin, direction))
            continue;
        for (std::uint32_t const other : touching) {
            bool const known = std::any_of(candidates.begin(), candidates.end(),
                                           [&](Candidate const& c) { return c.object == other; });
            Candidate second;
            if (!known)
                objects[other].next_exact(origin, direction, inside, {from, horizon}, second);
            second.object = other;
            if (second.t < INFINITY)
                take(second);
        }
    }

    if (candidates.empty()) {
        hit.proof = contradiction < INFINITY || !inside.empty() ? Proof::leak : Proof::clean;
        hit.t = contradiction;
        return;
    }
    if (candidates.size() == 1 && contradiction == INFINITY) { // as nearly always
        Candidate const& only = candidates.front();
        objects[only.object].finish(only, origin, direction, from, hit.at_one_place.emplace_back());
        hit.t = std::max(only.t, from);
        hit.blur = only.blur;
        hit.proof = only.recovered ? Proof::recovered : Proof::clean;
        return;
    }
    auto const rank = [&](Candidate const& c) {
        // bodies are left before others are entered: what only seems to overlap by rounding does not
        return std::tuple(!objects[c.object].geometry.detector, !c.open, !c.open && c.enters, c.object);
    };
    Candidate const nearest =
        *std::min_element(candidates.begin(), candidates.end(), [&](auto const& a, auto const& b) {
            return std::pair(a.t, rank(a)) < std::pair(b.t, rank(b));
        });
    // at the same place as well: what a torn mesh lies on does not hide that it was entered through a hole
    if (contradiction < INFINITY && contradiction <= nearest.t + nearest.blur) {
        hit.proof = Proof::leak;
        hit.t = contradiction;
        return;
    }
    hit.fits = nearest_ones.dropped > nearest.t + nearest.blur;
    // in the order in which they count
    std::sort(candidates.begin(), candidates.end(),
              [&](auto const& a, auto const& b) { return rank(a) < rank(b); });
    InlineVector<Candidate, 8> together;
    for (Candidate const& c : candidates) {
        if (c.object != nearest.object && c.t > nearest.t + nearest.blur + c.blur)
            continue;
        if (c.object != nearest.object && !touch(c, nearest)) {
            hit.fits = hit.fits && !(c.open && hit.beside.full());
            if (c.open && hit.fits)
                hit.beside.push_back({c.object, c.enters});
        } else if (!together.full()) {
            together.push_back(c);
        } else {
            hit.fits = false;
        }
    }
    for (Candidate const& c : together)
        objects[c.object].finish(c, origin, direction, from, hit.at_one_place.emplace_back());
    hit.t = std::max(nearest.t, from);
    hit.blur = nearest.blur;
    hit.proof = nearest.recovered ? Proof::recovered : Proof::clean;
}

} // namespace sahl
