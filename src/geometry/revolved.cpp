// The height over the surface along a line is taken in the implicit form E = z' − c/2 (s + ε z'²), where
// s = r², ε = 1 + k and z' = z − Σ a s^i: a polynomial, with no root that ends at the rim. Its other sheet,
// where w = 1 − ε c z' < 0, is replaced by its value at w = 0, which has the sign of the height.
#include "geometry/revolved.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace sahl {

namespace {

struct Interval {
    double low, high;
    double magnitude() const { return std::max(std::abs(low), std::abs(high)); }
};

Interval hull(double a, double b) {
    return a < b ? Interval{a, b} : Interval{b, a};
}

Interval operator*(double a, Interval const& b) {
    return hull(a * b.low, a * b.high);
}

Interval operator*(Interval const& a, Interval const& b) {
    auto const [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    return {low, high};
}

Interval operator-(Interval const& a, Interval const& b) {
    return {a.low - b.high, a.high - b.low};
}

/// Σ a s^i and its derivative.
std::pair<double, double> polynomial(std::vector<double> const& terms, double s) {
    double value = 0.0, slope = 0.0;
    for (std::size_t i = terms.size(); i-- > 0;) {
        auto const order = static_cast<double>(i + 2);
        value = value * s + terms[i];
        slope = slope * s + order * terms[i];
    }
    return {value * s * s, slope * s};
}

/// (P(s1) − P(s0)) / (s1 − s0) without cancellation.
double divided(std::vector<double> const& terms, double s0, double s1) {
    double sum = 0.0, difference = 1.0, power = s0; // difference of s¹ is 1
    for (double const term : terms) {
        difference = s1 * difference + power;
        power *= s0;
        sum += term * difference;
    }
    return sum;
}

std::vector<double> without_end_zeros(std::vector<double> terms) {
    while (!terms.empty() && terms.back() == 0.0)
        terms.pop_back();
    return terms;
}

} // namespace

Revolved front_of(Lens const& lens) {
    return {lens.r1 == 0.0 ? 0.0 : 1.0 / lens.r1, lens.conic1, without_end_zeros(lens.aspheric1)};
}

Revolved back_of(Lens const& lens) {
    return {lens.r2 == 0.0 ? 0.0 : 1.0 / lens.r2, lens.conic2, without_end_zeros(lens.aspheric2)};
}

Revolved form_of(ConicMirror const& mirror) {
    return {mirror.radius == 0.0 ? 0.0 : 1.0 / mirror.radius, mirror.conic, {}};
}

double Revolved::reach() const {
    double const squared = (1.0 + conic) * curvature * curvature;
    return squared > 0.0 ? 1.0 / std::sqrt(squared) : INFINITY;
}

double Revolved::sag(double r) const {
    double const s = r * r, under = 1.0 - (1.0 + conic) * curvature * curvature * s;
    return curvature * s / (1.0 + std::sqrt(std::max(0.0, under))) + polynomial(terms, s).first;
}

RevolvedSheet::RevolvedSheet(Revolved form, double aperture, double hole)
    : form_(std::move(form)), aperture_(aperture), hole_(hole), rim_(form_.sag(aperture)) {
    std::tie(low_, high_) = std::minmax(0.0, rim_);
    if (form_.terms.empty())
        return;
    constexpr int steps = 512;
    double largest_step = 0.0, before = 0.0;
    for (int i = 1; i <= steps; ++i) {
        double const z = form_.sag(aperture * i / steps);
        low_ = std::min(low_, z);
        high_ = std::max(high_, z);
        largest_step = std::max(largest_step, std::abs(z - before));
        before = z;
    }
    low_ -= largest_step; // an extremum between two samples rises by no more
    high_ += largest_step;
}

bool RevolvedSheet::covers(dvec3 const& p) const {
    double const s = p.x * p.x + p.y * p.y;
    return s <= aperture_ * aperture_ && s >= hole_ * hole_;
}

/// The height over the surface to first order, times `steepness`; and its gradient: (across x, across y, w),
/// of that length.
struct RevolvedSheet::Height {
    double value, across, w, steepness;
};

RevolvedSheet::Height RevolvedSheet::height(dvec3 const& p) const {
    double const c = form_.curvature, epsilon = 1.0 + form_.conic, s = p.x * p.x + p.y * p.y;
    auto const [bulge, slope] = polynomial(form_.terms, s);
    double const z = p.z - bulge, w = 1.0 - epsilon * c * z, near = std::max(0.0, w);
    double const across = c + 2.0 * near * slope;
    double const value =
        w >= 0.0 ? z - 0.5 * c * (s + epsilon * z * z) : std::copysign(INFINITY, epsilon * c);
    return {value, across, near, std::sqrt(across * across * s + near * near)};
}

double RevolvedSheet::distance(dvec3 const& p) const {
    Height const here = height(p);
    return here.value / here.steepness;
}

bool RevolvedSheet::is_near(dvec3 const& p, double rounding) const {
    Height const here = height(p);
    return std::abs(here.value) <= rounding * here.steepness;
}

dvec3 RevolvedSheet::normal(dvec3 const& p) const {
    Height const here = height(p);
    return (1.0 / here.steepness) * dvec3(-here.across * p.x, -here.across * p.y, here.w);
}

dvec3 RevolvedSheet::settle(dvec3& point) const {
    for (int pass = 0; pass < 2; ++pass) {
        Height const here = height(point);
        if (!std::isfinite(here.value))
            break;
        double const share = here.value / (here.steepness * here.steepness);
        point -= share * dvec3(-here.across * point.x, -here.across * point.y, here.w);
        // as far as rounding puts a root off, what is left is its square
        if (std::abs(here.value) <= 1e-9 * aperture_ * here.steepness)
            break;
    }
    return normal(point);
}

/// The height along a line, from the implicit form; from where the line starts if that is on the surface.
class RevolvedSheet::Line {
  public:
    Line(RevolvedSheet const& sheet, dvec3 const& origin, dvec3 const& direction, double rounding)
        : sheet_(sheet), terms_(sheet.form_.terms), c_(sheet.form_.curvature),
          epsilon_(1.0 + sheet.form_.conic), o_(origin), d_(direction), a_(d_.x * d_.x + d_.y * d_.y),
          b_(d_.x * o_.x + d_.y * o_.y), s0_(o_.x * o_.x + o_.y * o_.y),
          limit_(sheet.aperture_ * sheet.aperture_), scale_(sheet.aperture_ + length(origin)) {
        z0_ = o_.z - polynomial(terms_, s0_).first;
        double const border = 2.0 * rounding * sheet.aperture_; // r² grows by as much
        on_ = s0_ <= limit_ + border && sheet.is_near(o_, rounding);
        if (on_) // at the rim too it starts within the stretch
            limit_ += 2.0 * border;
        find_stretch();
    }

    Roots roots(bool extended) {
        if (!stretch_) {
            if (extended)
                cross_plane(-INFINITY, INFINITY);
            return roots_;
        }
        bool const begins = end_above(from_), ends = end_above(to_);
        if (extended && d_.z != 0.0 && begins != (d_.z < 0.0))
            cross_plane(-INFINITY, from_);
        if (!terms_.empty() || !meet_conic(begins, ends))
            search(begins, ends);
        if (extended && d_.z != 0.0 && ends != (d_.z > 0.0))
            cross_plane(to_, INFINITY);
        return roots_;
    }

  private:
    void search(bool begins, bool ends) {
        if (on_ && from_ < 0.0 && to_ > 0.0) {
            double const rate = slope_at(0.0);
            bool const after = rate != 0.0 ? rate > 0.0 : height(1e-6 * to_) >= 0.0;
            bool const before = rate != 0.0 ? rate < 0.0 : after;
            split(from_, begins, 0.0, before, 70);
            if (before != after)
                add(0.0, after);
            split(0.0, after, to_, ends, 70);
        } else {
            split(from_, begins, to_, ends, 60);
        }
    }

    /// Without aspheric terms the height is a quadratic along the line: its roots in closed form, from the
    /// middle of the stretch, where all digits are there, and a step of Newton's method. False, and nothing
    /// added, where rounding leaves in doubt how many there are, which `begins` and `ends` tell: near a
    /// tangent, near the equator, and where a root lies at an end.
    bool meet_conic(bool begins, bool ends) {
        double const base = on_ ? 0.0 : 0.5 * (from_ + to_);
        dvec3 const p = o_ + base * d_;
        double const square = -0.5 * c_ * (a_ + epsilon_ * d_.z * d_.z);
        double const half = 0.5 * (d_.z - c_ * (p.x * d_.x + p.y * d_.y + epsilon_ * p.z * d_.z));
        double const constant = on_ ? 0.0 : p.z - 0.5 * c_ * (p.x * p.x + p.y * p.y + epsilon_ * p.z * p.z);
        double const discriminant = half * half - square * constant;
        double const doubt = 1e-8 * (half * half + std::abs(square * constant)) + 1e-10 * (a_ + d_.z * d_.z);
        if (std::abs(discriminant) <= doubt)
            return false;
        if (discriminant < 0.0)
            return begins == ends;
        double const root = std::sqrt(discriminant), q = half > 0.0 ? -half - root : root - half;
        double const one = base + q / square, other = on_ ? 0.0 : base + constant / q;
        std::array<Root, 2> found;
        std::size_t count = 0;
        bool above = begins;
        // at its roots the quadratic's slope is ∓ twice that of the discriminant
        bool const one_first = one <= other;
        bool rises = one_first == (half <= 0.0);
        double const end = 1e-9 * (to_ - from_) + 1e-13 * std::max(std::abs(from_), std::abs(to_));
        for (double t : {one_first ? one : other, one_first ? other : one}) {
            double const z = o_.z + t * d_.z, w = 1.0 - epsilon_ * c_ * z;
            if (std::abs(t - from_) <= end || std::abs(t - to_) <= end)
                return false;
            if (t > from_ && t < to_ && w > -1e-6) {
                if (w < 1e-6 || rises == above) // it cannot rise above where it is already
                    return false;
                above = rises;
                double const x = o_.x + t * d_.x, y = o_.y + t * d_.y;
                found[count++] = {t, 2.0 * root / std::sqrt(c_ * c_ * (x * x + y * y) + w * w), rises};
            }
            rises = !rises;
        }
        for (std::size_t i = 0; i < count && above == ends; ++i)
            roots_.push_back(found[i]);
        return above == ends;
    }

    /// Where the line is within the aperture and between the lowest and highest place of the surface.
    void find_stretch() {
        double const room = 0.01 * (sheet_.high_ - sheet_.low_) + 1e-3 * sheet_.aperture_;
        from_ = -INFINITY;
        to_ = INFINITY;
        if (a_ > 0.0) {
            double const turn = o_.x * d_.y - o_.y * d_.x, disc = limit_ * a_ - turn * turn;
            stretch_ = disc > 0.0;
            double const half = std::sqrt(std::max(0.0, disc)), by_a = 1.0 / a_;
            from_ = (-b_ - half) * by_a;
            to_ = (-b_ + half) * by_a;
        } else {
            stretch_ = s0_ <= limit_;
        }
        double const by_z = 1.0 / d_.z;
        double const one = (sheet_.low_ - room - o_.z) * by_z, other = (sheet_.high_ + room - o_.z) * by_z;
        if (d_.z == 0.0) {
            stretch_ = stretch_ && o_.z > sheet_.low_ - room && o_.z < sheet_.high_ + room;
        } else {
            side_from_ = std::min(one, other) <= from_;
            side_to_ = std::max(one, other) >= to_;
            from_ = std::max(from_, std::min(one, other));
            to_ = std::min(to_, std::max(one, other));
        }
        stretch_ = stretch_ && from_ < to_;
    }

    /// At the aperture it is the rim that counts, as for the plane beyond.
    bool end_above(double t) const {
        bool const at_side = t == from_ ? side_from_ : side_to_;
        if (at_side)
            return o_.z + t * d_.z >= sheet_.rim_;
        return (d_.z > 0.0) == (t == to_);
    }

    void cross_plane(double from, double to) {
        double const t = (sheet_.rim_ - o_.z) / d_.z;
        if (d_.z != 0.0 && !roots_.full())
            roots_.push_back({std::clamp(t, from, to), std::abs(d_.z), d_.z > 0.0});
    }

    double height(double t) const {
        double s = 0.0, z = 0.0, value = 0.0;
        if (on_) {
            double const by_t = 2.0 * b_ + t * a_;
            s = std::max(0.0, s0_ + t * by_t);
            double const rise = t * (d_.z - by_t * divided(terms_, s0_, s));
            z = z0_ + rise;
            value = rise - 0.5 * c_ * (t * by_t + epsilon_ * (z + z0_) * rise);
        } else {
            dvec3 const p = o_ + t * d_;
            s = p.x * p.x + p.y * p.y;
            z = p.z - polynomial(terms_, s).first;
            value = z - 0.5 * c_ * (s + epsilon_ * z * z);
        }
        double const w = 1.0 - epsilon_ * c_ * z;
        return w >= 0.0 ? value : value + w * w / (2.0 * epsilon_ * c_);
    }

    double slope_at(double t) const {
        dvec3 const p = o_ + t * d_;
        double const s = p.x * p.x + p.y * p.y, across = 2.0 * (b_ + t * a_);
        auto const [bulge, steep] = polynomial(terms_, s);
        double const w = std::max(0.0, 1.0 - epsilon_ * c_ * (p.z - bulge));
        return (d_.z - steep * across) * w - 0.5 * c_ * across;
    }

    /// Bounds of the slope from `from` to `to`.
    Interval slopes(double from, double to) const {
        auto const squared = [&](double t) { return std::max(0.0, s0_ + t * (2.0 * b_ + t * a_)); };
        Interval s = hull(squared(from), squared(to));
        if (a_ > 0.0 && b_ + from * a_ < 0.0 && b_ + to * a_ > 0.0)
            s.low = std::max(0.0, s0_ - b_ * b_ / a_);
        Interval const across = 2.0 * hull(b_ + from * a_, b_ + to * a_);
        Interval bulge{0.0, 0.0}, steep{0.0, 0.0};
        double low = s.low, high = s.high; // s^(i−1)
        for (std::size_t i = 0; i < terms_.size(); ++i) {
            Interval const rate = (static_cast<double>(i + 2) * terms_[i]) * Interval{low, high};
            steep = {steep.low + rate.low, steep.high + rate.high};
            low *= s.low;
            high *= s.high;
            Interval const part = terms_[i] * Interval{low, high};
            bulge = {bulge.low + part.low, bulge.high + part.high};
        }
        Interval const z = hull(o_.z + from * d_.z, o_.z + to * d_.z) - bulge;
        Interval w = Interval{1.0, 1.0} - (epsilon_ * c_) * z;
        w = {std::max(0.0, w.low), std::max(0.0, w.high)};
        return (Interval{d_.z, d_.z} - steep * across) * w - (0.5 * c_) * across;
    }

    void split(double from, bool begins, double to, bool ends, int depth) {
        Interval const rate = slopes(from, to);
        double const half = 0.5 * (to - from), middle = from + half;
        double const ulp = 2.3e-16 * std::max(std::abs(from), std::abs(to));
        bool const small = half <= ulp || (!on_ && half * rate.magnitude() <= 2.3e-16 * scale_);
        if (rate.low > 0.0 || rate.high < 0.0 || depth == 0 || small) {
            if (begins != ends)
                add(refined(from, to, ends), ends);
            return;
        }
        double const value = height(middle);
        bool const above = value >= 0.0;
        if (begins == ends && above == begins && std::abs(value) > half * rate.magnitude())
            return;
        split(from, begins, middle, above, depth - 1);
        split(middle, above, to, ends, depth - 1);
    }

    /// Newton's method that halves the bracket where it would leave it.
    double refined(double from, double to, bool rises) const {
        double t = 0.5 * (from + to);
        for (int pass = 0; pass < 80; ++pass) {
            double const value = height(t);
            if (value == 0.0)
                return t;
            ((value > 0.0) == rises ? to : from) = t;
            double const newton = t - value / slope_at(t);
            double const next = newton > from && newton < to ? newton : 0.5 * (from + to);
            bool const done = std::abs(next - t) <= 2.3e-16 * std::abs(t) || next == from || next == to;
            t = next;
            if (done)
                return t;
        }
        return t;
    }

    /// Between two crossings the height may be no more than its own rounding, which a sum of large terms has:
    /// there is no crossing then. A start on the surface is one for certain.
    bool is_rounding(double from, double to) const {
        if (to - from > 1e-5 * (to_ - from_) || (on_ && from == 0.0))
            return false;
        double const t = 0.5 * (from + to);
        dvec3 const p = o_ + t * d_;
        double const s = p.x * p.x + p.y * p.y;
        double size = std::abs(p.z), power = s;
        for (double const term : terms_)
            size += std::abs(term) * (power *= s);
        return std::abs(height(t)) <= 4e-15 * size; // some twenty roundings
    }

    void add(double t, bool rises) {
        if (!roots_.empty() && is_rounding(roots_.back().t, t)) {
            roots_.erase(roots_.end() - 1);
            return;
        }
        if (roots_.full())
            return;
        double const along = std::abs(dot(sheet_.normal(o_ + t * d_), d_));
        roots_.push_back({t, along, rises});
    }

    RevolvedSheet const& sheet_;
    std::vector<double> const& terms_;
    double c_, epsilon_;
    dvec3 o_, d_;
    double a_, b_, s0_, limit_, scale_; // s(t) = s0 + 2 b t + a t²
    double z0_ = 0.0;
    bool on_ = false, stretch_ = false, side_from_ = true, side_to_ = true;
    double from_ = 0.0, to_ = 0.0;
    Roots roots_;
};

RevolvedSheet::Roots RevolvedSheet::roots(dvec3 const& origin, dvec3 const& direction, double rounding,
                                          bool extended) const {
    return Line(*this, origin, direction, rounding).roots(extended);
}

bool RevolvedSheet::from_above(dvec3 const& origin, dvec3 const& direction) const {
    return direction.z != 0.0 ? direction.z < 0.0 : origin.z >= rim_;
}

} // namespace sahl
