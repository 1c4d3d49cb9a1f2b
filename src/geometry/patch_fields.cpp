#include "geometry/patch_fields.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// Does the polynomial stay within the heights that the patches round its fan have room for?
bool fits_in(HeightField const& field, SmoothFans const& fans, std::span<Relief const> reliefs,
             std::uint32_t fan) {
    constexpr double least_slope = 0.2; // below it a step to first order tells no height
    Fan const& centre = fans.fans[fan];
    for (std::uint32_t i = 0; i < centre.corners; ++i) {
        std::uint32_t const t = fans.corners[centre.first_corner + i];
        SmoothTriangle const& triangle = fans.triangles[t];
        Relief const& relief = reliefs[t];
        auto const mine = static_cast<std::size_t>(
            std::find(triangle.fans.begin(), triangle.fans.end(), fan) - triangle.fans.begin());
        std::size_t const next = (mine + 1) % 3, last = (mine + 2) % 3;
        constexpr std::array<dvec3, 6> samples{dvec3{1.0, 0.0, 0.0}, {0.5, 0.5, 0.0}, {0.5, 0.0, 0.5},
                                               {0.34, 0.33, 0.33},   {0.7, 0.3, 0.0}, {0.7, 0.0, 0.3}};
        for (dvec3 const& s : samples) {
            Fan const &a = fans.fans[fan], &b = fans.fans[triangle.fans[next]],
                      &c = fans.fans[triangle.fans[last]];
            dvec3 const at = s.x * a.place + s.y * b.place + s.z * c.place;
            dvec3 const up = s.x * a.normal + s.y * b.normal + s.z * c.normal;
            dvec3 gradient;
            double const above = field.above(at, gradient), steep = dot(gradient, up);
            if (!(steep > least_slope))
                return false;
            double const height = -above / steep; // where the surface lies over the plane, to first order
            // near a chord, where the surface is bent onto it, both heights count
            bool const within =
                height <= static_cast<double>(relief.high) && height >= static_cast<double>(relief.low);
            if (!within && !(relief.chords != 0 && std::abs(height) < 0.25 * length(b.place - c.place)))
                return false;
        }
    }
    return true;
}

bool touches_chord(SmoothFans const& fans, std::span<Relief const> reliefs, std::uint32_t fan) {
    Fan const& centre = fans.fans[fan];
    for (std::uint32_t i = 0; i < centre.corners; ++i) {
        std::uint32_t const t = fans.corners[centre.first_corner + i];
        for (std::size_t k = 0; k < 3; ++k)
            if (reliefs[t].has_chord(k) && fans.triangles[t].fans[k] != fan)
                return true;
    }
    return false;
}

} // namespace

LazyFields::LazyFields(std::shared_ptr<SmoothFans const> fans)
    : fans_(std::move(fans)), slots_(fans_->fans.size()) {}

LazyFields::~LazyFields() {
    for (auto& slot : slots_)
        if (HeightField const* const field = slot.load(); field != &none_)
            delete field;
}

HeightField const* LazyFields::fit(std::uint32_t fan, std::span<Relief const> reliefs) const {
    std::unique_ptr<HeightField const> made;
    bool const slopes = fans_->normals == NormalUse::files;
    for (int degree : {slopes ? HeightField::degree : 4, 3, 2}) { // places alone carry no more
        auto const field = fit_at(*fans_, fan, {degree, slopes});
        if (field && fits_in(*field, *fans_, reliefs, fan)) {
            HeightField kept = *field;
            if (touches_chord(*fans_, reliefs, fan)) // both sides of a crease keep to its vertices
                kept.constant = 0.0;
            made = std::make_unique<HeightField const>(kept);
            break;
        }
    }
    HeightField const* const mine = made ? made.get() : &none_;
    HeightField const* other = nullptr;
    if (slots_[fan].compare_exchange_strong(other, mine, std::memory_order_acq_rel)) {
        made.release();
        return mine == &none_ ? nullptr : mine;
    }
    return other == &none_ ? nullptr : other; // another thread was faster, with the same polynomial
}

} // namespace sahl
