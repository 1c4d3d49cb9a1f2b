// In: what a path meets. Out: how far rounding may have moved it by then; see spread.h.
#include "trace/spread.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// a · bᵀ
dmat3 outer(dvec3 const& a, dvec3 const& b) {
    return {b.x * a, b.y * a, b.z * a};
}

double trace_of(dmat3 const& m) {
    return m[0][0] + m[1][1] + m[2][2];
}

constexpr double far_above_one = 1e100; // whose square is still a double

} // namespace

Spread::Spread(double unit) : place_(1.0), heading_(1.0), unit_(unit) {}

void Spread::go(double t, dvec3 const& direction, dvec3 const& facet_normal) {
    double const way = t / unit_;
    dmat3 const moved = mixed_ + way * heading_; // place · headingᵀ behind the way
    dmat3 const place = place_ + way * (glm::transpose(mixed_) + moved);
    // a neighbour meets the surface a little sooner or later; along a face that is grazed, by as much as it
    // is wide
    double const slope = dot(facet_normal, direction);
    if (std::abs(slope) < 1e-150) {
        place_ = place;
        mixed_ = moved;
        return;
    }
    dmat3 const onto = dmat3(1.0) - outer(direction, facet_normal / slope);
    place_ = onto * place * glm::transpose(onto);
    mixed_ = onto * moved;
}

void Spread::turn(dvec3 const& direction, Bend const& bend, Event event) {
    dvec3 const& n = bend.normal;
    double const along = dot(direction, n); // ≤ 0
    dmat3 turning = unit_ * bend.turning;
    // d(direction) behind = by_heading · d(direction) + by_normal · dn
    dmat3 by_heading(1.0), by_normal(0.0);
    if (event == Event::refracted) {
        double const ratio = bend.n_before / bend.n_after;
        double const squared = 1.0 - ratio * ratio * (1.0 - along * along);
        double const leaves = std::sqrt(std::max(squared, 1e-300));
        double const by_along = -ratio - ratio * ratio * along / leaves; // of the factor of n, per d(along)
        double const factor = -ratio * along - leaves;
        by_heading = ratio * dmat3(1.0) + by_along * outer(n, n);
        by_normal = by_along * outer(n, direction) + factor * dmat3(1.0);
    } else if (event == Event::scattered) { // drawn about the normal, whatever came
        by_heading = dmat3(0.0);
        by_normal = dmat3(1.0);
    } else if (event != Event::passed) {
        by_heading -= 2.0 * outer(n, n);
        by_normal = -2.0 * (outer(n, direction) + along * dmat3(1.0));
    }
    dmat3 const by_place = by_normal * turning;
    dmat3 const cross = by_heading * glm::transpose(mixed_) * glm::transpose(by_place);
    heading_ = by_heading * heading_ * glm::transpose(by_heading) + cross + glm::transpose(cross) +
               by_place * place_ * glm::transpose(by_place);
    mixed_ = mixed_ * glm::transpose(by_heading) + place_ * glm::transpose(by_place);
    keep_small();
    dmat3 const rounding(std::pow(10.0, -2.0 * decades_)); // this interaction's own
    place_ += rounding;
    heading_ += rounding;
}

void Spread::keep_small() {
    double const size = std::sqrt(std::max(trace_of(place_), trace_of(heading_)));
    if (!(size > far_above_one) || !std::isfinite(size))
        return;
    decades_ += std::log10(size);
    double const shrink = 1.0 / (size * size);
    place_ *= shrink;
    mixed_ *= shrink;
    heading_ *= shrink;
}

double Spread::digits_lost() const {
    double const worst = std::max(trace_of(place_), trace_of(heading_)) / 3.0; // each axis had one rounding
    return std::max(0.0, decades_ + 0.5 * std::log10(worst));
}

void DigitsLost::count(double digits, std::uint64_t of_ray, std::uint16_t at_depth, dvec3 const& begins) {
    // a number that is none has no digits left either
    ++segments[digits < none_left ? static_cast<std::size_t>(digits) : none_left];
    if (digits > most) {
        most = digits;
        ray = of_ray;
        depth = at_depth;
        at = begins;
    }
}

void DigitsLost::add(DigitsLost const& other) {
    for (std::size_t i = 0; i < segments.size(); ++i)
        segments[i] += other.segments[i];
    if (other.most > most) {
        auto const counted = segments;
        *this = other;
        segments = counted;
    }
}

} // namespace sahl
