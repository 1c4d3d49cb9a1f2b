#include "geometry/patch_fill.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sahl {

namespace {

/// Weights of the corners.
using Weights = std::array<double, 3>;

/// Where a corner's weights' exponents stand in a net: rows by the third, in each the second.
template <std::size_t Degree>
constexpr std::size_t slot(std::array<std::size_t, 3> const& exponents) {
    std::size_t at = exponents[1];
    for (std::size_t k = 0; k < exponents[2]; ++k)
        at += Degree + 1 - k;
    return at;
}

/// A place on the side from corner i to corner j, `step` of `Degree` towards j.
template <std::size_t Degree>
constexpr std::size_t on_side(std::size_t i, std::size_t j, std::size_t step) {
    std::array<std::size_t, 3> exponents{};
    exponents[i] = Degree - step;
    exponents[j] = step;
    return slot<Degree>(exponents);
}

/// A polynomial's part in a height; none: the model's.
struct Share {
    double weight = 0.0;
    HeightField const* field = nullptr;
};

/// From a place of the triangle along `up`: where the weighted polynomials vanish, by Newton's method from
/// the model's height. NaN where they tell of none.
template <std::size_t Size>
double height_of(std::array<Share, Size> const& shares, dvec3 const& from, dvec3 const& up, double model) {
    constexpr double least_slope = 0.2; // below it the surface is none over the triangle
    double height = model;
    for (int pass = 0; pass < 4; ++pass) {
        double value = 0.0, slope = 0.0;
        for (Share const& share : shares) {
            dvec3 gradient;
            value += share.weight *
                     (share.field ? share.field->above(from + height * up, gradient) : height - model);
            slope += share.weight * (share.field ? dot(gradient, up) : 1.0);
        }
        if (!(slope > least_slope))
            return NAN;
        height -= value / slope;
    }
    return height;
}

struct Filler {
    Patch& patch;
    SmoothFans const& fans;
    SmoothTriangle const& triangle;
    Relief const& relief;
    CornerFields const& fields;
    PatchKind kind;
    double strays = 0.0;   // m: coefficients from those of the quadratic surface
    bool stood_in = false; // the quadratic surface, for a polynomial that strays too far, or is none

    dvec3 flat(Weights const& w) const {
        return w[0] * patch.place(0) + w[1] * patch.place(1) + w[2] * patch.place(2);
    }
    dvec3 up(Weights const& w) const {
        return w[0] * patch.direction(0) + w[1] * patch.direction(1) + w[2] * patch.direction(2);
    }

    double free_height(Weights const& w) const {
        return height_of(std::array{Share{w[0], fields[0]}, Share{w[1], fields[1]}, Share{w[2], fields[2]}},
                         flat(w), up(w), relief.model(w[1], w[2]));
    }

    double corner_height(std::size_t k) const { return fields[k] ? fields[k]->constant : 0.0; }

    /// On the side opposite corner k, `along` of the way from the corner after it: what its ends' polynomials
    /// make of it. Its two triangles count from the same end, and so compute the same to the bit.
    double free_on_side(std::size_t k, double along) const {
        std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        if (triangle.fans[j] < triangle.fans[i]) {
            std::swap(i, j);
            along = 1.0 - along;
        }
        double const rest = 1.0 - along;
        Fan const &first = fans.fans[triangle.fans[i]], &second = fans.fans[triangle.fans[j]];
        return height_of(std::array{Share{rest, fields[i]}, Share{along, fields[j]}},
                         rest * first.place + along * second.place,
                         rest * patch.direction(i) + along * patch.direction(j),
                         along * rest * relief.bulge_over(k));
    }

    void fill_side(std::size_t k) {
        std::size_t const i = (k + 1) % 3, j = (k + 2) % 3;
        bool const turned = triangle.fans[j] < triangle.fans[i];
        std::array<double, 5> f{corner_height(i), 0.0, 0.0, 0.0, corner_height(j)};
        if (turned)
            std::swap(f[0], f[4]);
        double const b = relief.bulge_over(k);
        std::array<double, 3> const model{b / 4.0, b / 3.0, b / 4.0};
        std::array<double, 3> c = model;
        if (!relief.has_chord(k) && (fields[i] || fields[j])) {
            for (std::size_t step = 1; step < 4; ++step)
                f[step] = free_on_side(k, 0.25 * static_cast<double>(turned ? 4 - step : step));
            c = {(-13.0 * f[0] + 48.0 * f[1] - 36.0 * f[2] + 16.0 * f[3] - 3.0 * f[4]) / 12.0,
                 (13.0 * f[0] - 64.0 * f[1] + 120.0 * f[2] - 64.0 * f[3] + 13.0 * f[4]) / 18.0,
                 (-3.0 * f[0] + 16.0 * f[1] - 36.0 * f[2] + 48.0 * f[3] - 13.0 * f[4]) / 12.0};
            double const room = static_cast<double>(relief.room[k]) + height_noise(fans);
            for (std::size_t m = 0; m < 3; ++m)
                if (!(std::abs(c[m] - model[m]) <= room)) {
                    c = model;
                    stood_in = true;
                    break;
                }
        }
        for (std::size_t m = 0; m < 3; ++m)
            strays = std::max(strays, std::abs(c[m] - model[m]));
        if (turned) {
            std::swap(f[0], f[4]);
            std::swap(c[0], c[2]);
        }
        patch.height[on_side<4>(i, j, 0)] = static_cast<float>(f[0]);
        patch.height[on_side<4>(i, j, 4)] = static_cast<float>(f[4]);
        for (std::size_t step = 1; step < 4; ++step)
            patch.height[on_side<4>(i, j, step)] = static_cast<float>(c[step - 1]);
    }

    /// By how much the side opposite corner k was bent away from what its polynomials make of it.
    double bent(std::size_t k, Weights const& w) const {
        std::size_t const i = (k + 1) % 3, j = (k + 2) % 3;
        double const along = w[j] + 0.5 * w[k], rest = 1.0 - along;
        Weights on{};
        on[i] = rest;
        on[j] = along;
        double const adopted = value_of(patch.height, on[1], on[2]).value;
        return w[i] * w[j] / (along * rest) * (free_on_side(k, along) - adopted);
    }

    void fill_inside() {
        constexpr std::array<Weights, 3> nodes{
            Weights{0.5, 0.25, 0.25}, {0.25, 0.5, 0.25}, {0.25, 0.25, 0.5}};
        double const a = relief.bulge_over(0), b = relief.bulge_over(1), c = relief.bulge_over(2);
        // the quadratic surface's own coefficients
        std::array<double, 3> const model{(a + 2.0 * b + 2.0 * c) / 12.0, (2.0 * a + b + 2.0 * c) / 12.0,
                                          (2.0 * a + 2.0 * b + c) / 12.0};
        std::array<double, 3> inner = model;
        if (relief.chords != 7 && (fields[0] || fields[1] || fields[2])) {
            std::array<double, 3> rest{};
            double sum = 0.0;
            for (std::size_t n = 0; n < 3; ++n) {
                double height = free_height(nodes[n]);
                for (std::size_t k = 0; k < 3; ++k)
                    height -= bent(k, nodes[n]);
                rest[n] = height - value_of(patch.height, nodes[n][1], nodes[n][2]).value;
                sum += rest[n];
            }
            bool usable = true;
            for (std::size_t n = 0; n < 3; ++n) {
                inner[n] = (rest[n] - 0.25 * sum) * (32.0 / 3.0); // 1 over Bernstein's 3/32 at a node
                usable = usable && inner[n] >= static_cast<double>(relief.low) &&
                         inner[n] <= static_cast<double>(relief.high);
            }
            if (!usable) {
                inner = model;
                stood_in = true;
            }
            for (std::size_t n = 0; n < 3; ++n)
                strays = std::max(strays, std::abs(inner[n] - model[n]));
        }
        patch.height[slot<4>({2, 1, 1})] = static_cast<float>(inner[0]);
        patch.height[slot<4>({1, 2, 1})] = static_cast<float>(inner[1]);
        patch.height[slot<4>({1, 1, 2})] = static_cast<float>(inner[2]);
    }

    dvec3 normal_at(Weights const& w) const {
        dvec3 const point = flat(w) + value_of(patch.height, w[1], w[2]).value * up(w);
        dvec3 sum(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            double const weight = kind == PatchKind::apart ? 0.5 * (1.0 - w[k]) : w[k];
            dvec3 gradient = fans.fans[triangle.fans[k]].normal;
            if (fields[k])
                fields[k]->above(point, gradient);
            sum += weight * gradient;
        }
        return sum;
    }

    void fill_tilts() {
        dvec3 const across = cross(patch.to_second, patch.to_third);
        double const squared = dot(across, across);
        dvec3 const to_v = cross(patch.to_third, across) / squared,
                    to_w = cross(across, patch.to_second) / squared;
        std::array<dvec2, 10> at{};
        auto const measure = [&](std::size_t i, std::size_t j, std::size_t k) {
            dvec3 const normal = normal_at(
                {static_cast<double>(i) / 3.0, static_cast<double>(j) / 3.0, static_cast<double>(k) / 3.0});
            double const rise = dot(normal, across) / squared;
            constexpr double least = 0.1; // cosine; beyond it light takes the triangle's own normal
            if (rise * std::sqrt(squared) > least * length(normal))
                at[slot<3>({i, j, k})] = dvec2(dot(normal, to_v), dot(normal, to_w)) / rise;
        };
        for (std::size_t k = 0; k <= 3; ++k)
            for (std::size_t j = 0; j + k <= 3; ++j)
                measure(3 - j - k, j, k);
        auto net = at;
        dvec2 sides(0.0);
        for (std::size_t k = 0; k < 3; ++k) {
            std::size_t const i = (k + 1) % 3, j = (k + 2) % 3;
            std::array<dvec2, 4> f{};
            for (std::size_t step = 0; step < 4; ++step)
                f[step] = at[on_side<3>(i, j, step)];
            net[on_side<3>(i, j, 1)] = (-5.0 * f[0] + 18.0 * f[1] - 9.0 * f[2] + 2.0 * f[3]) / 6.0;
            net[on_side<3>(i, j, 2)] = (2.0 * f[0] - 9.0 * f[1] + 18.0 * f[2] - 5.0 * f[3]) / 6.0;
            sides += 3.0 * (net[on_side<3>(i, j, 1)] + net[on_side<3>(i, j, 2)]) + f[0];
        }
        constexpr std::size_t middle = slot<3>({1, 1, 1});
        net[middle] = (27.0 * at[middle] - sides) / 6.0;
        for (std::size_t n = 0; n < net.size(); ++n) {
            patch.tilt_second[n] = static_cast<float>(net[n].x);
            patch.tilt_third[n] = static_cast<float>(net[n].y);
        }
    }
};

/// Do the walls of a patch's cell stray so far from those that are upright that what the quadratic surface
/// tells of a line does not hold?
bool leans(Patch const& patch, Relief const& relief) {
    dvec3 const flat = cross(patch.to_second, patch.to_third);
    double const area = length(flat);
    double longest = 0.0, sine = 0.0;
    for (dvec3 const& side : {patch.to_second, patch.to_third, patch.to_third - patch.to_second})
        longest = std::max(longest, length(side));
    for (std::size_t k = 0; k < 3; ++k)
        sine = std::max(sine, length(cross(patch.direction(k), flat)) / area);
    double const height = std::max(-static_cast<double>(relief.low), static_cast<double>(relief.high));
    constexpr double much = 0.05; // weight: a third of the margin that model_root has
    return sine * height * longest > much * area;
}

} // namespace

Patch::Made fill(Patch& patch, SmoothFans const& fans, std::uint32_t triangle, Relief const& relief,
                 CornerFields const& fields, PatchKind kind) {
    Filler filler{patch, fans, fans.triangles[triangle], relief, fields, kind};
    for (std::size_t k = 0; k < 3; ++k)
        filler.fill_side(k);
    filler.fill_inside();
    filler.fill_tilts();
    for (std::size_t k = 0; k < 3; ++k)
        filler.stood_in = filler.stood_in || !fields[k] ||
                          (relief.has_chord(k) && (fans.triangles[triangle].creases >> k & 1) == 0);
    patch.stood_in = kind != PatchKind::quadratic && filler.stood_in;
    patch.flat = std::all_of(patch.height.begin(), patch.height.end(), [&](float h) {
        return std::abs(static_cast<double>(h)) <= 0x1p-50 * fans.reach; // four ulps of the coordinates
    });
    constexpr double little = 0.02; // of the layer that the surface may lie in
    bool const near_quadratic =
        filler.strays <= little * (static_cast<double>(relief.high) - static_cast<double>(relief.low));
    return near_quadratic && !leans(patch, relief) ? Patch::even : Patch::uneven;
}

} // namespace sahl
