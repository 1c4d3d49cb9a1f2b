#include "geometry/patch_relief.h"

#include "geometry/embree/triangle_tree.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

/// A surface that is fitted may differ from the quadratic one by this share of the greatest bulge near by.
constexpr double share_of_bulge = 0.1;

/// Heights of a patch stay one-to-one with places as long as every layer's area keeps this share.
constexpr double least_area = 0.25;

std::array<dvec3, 3> directions_of(Patch const& patch) {
    return {patch.direction(0), patch.direction(1), patch.direction(2)};
}

/// The least share that an area over the triangle has left at this height, seen along `up`.
double area_left(Patch const& patch, double height) {
    auto const up = directions_of(patch);
    dvec3 const flat = cross(patch.to_second, patch.to_third);
    dvec3 const layer =
        cross(patch.to_second + height * (up[1] - up[0]), patch.to_third + height * (up[2] - up[0]));
    return std::min({dot(layer, up[0]), dot(layer, up[1]), dot(layer, up[2])}) / length(flat);
}

/// Over a triangle: the range of heights that bulges and room make.
std::pair<double, double> range_of(Relief const& relief, double noise) {
    double const a = relief.bulge_over(0), b = relief.bulge_over(1), c = relief.bulge_over(2);
    auto const room = static_cast<double>(std::max({relief.room[0], relief.room[1], relief.room[2]}));
    // the quadratic patch's coefficients, written as those of degree 4, are at most 5/12 of the bulge
    return {0.42 * std::min({a, b, c, 0.0}) - room - noise, 0.42 * std::max({a, b, c, 0.0}) + room + noise};
}

struct ReliefMaker {
    SmoothFans const& fans;
    std::span<Patch const> patches;
    double noise = height_noise(fans);
    std::vector<Relief> reliefs = std::vector<Relief>(fans.triangles.size());

    void bulge() {
        std::vector<double> most(fans.fans.size(), 0.0);
        for (std::size_t t = 0; t < reliefs.size(); ++t) {
            auto const& of = fans.triangles[t].fans;
            for (std::size_t k = 0; k < 3; ++k) {
                Fan const &i = fans.fans[of[(k + 1) % 3]], &j = fans.fans[of[(k + 2) % 3]];
                double const bulge =
                    reliefs[t].has_chord(k) ? 0.0 : 0.5 * dot(j.place - i.place, j.normal - i.normal);
                reliefs[t].bulge[k] = static_cast<float>(bulge);
                for (std::uint32_t const fan : {of[(k + 1) % 3], of[(k + 2) % 3]})
                    most[fan] = std::max(most[fan], std::abs(bulge));
            }
        }
        for (std::size_t t = 0; t < reliefs.size(); ++t) {
            auto const& of = fans.triangles[t].fans;
            for (std::size_t k = 0; k < 3; ++k)
                if (!reliefs[t].has_chord(k))
                    reliefs[t].room[k] = static_cast<float>(
                        share_of_bulge * std::max(most[of[(k + 1) % 3]], most[of[(k + 2) % 3]]));
            auto const [low, high] = range_of(reliefs[t], noise);
            reliefs[t].low = static_cast<float>(low);
            reliefs[t].high = static_cast<float>(high);
        }
    }

    /// Chords on both sides of each side of this triangle.
    void flatten(std::uint32_t t) {
        reliefs[t].chords = 7;
        reliefs[t].room = {};
        for (std::uint32_t const other : fans.triangles[t].beside)
            if (other != SmoothTriangle::none)
                for (std::size_t k = 0; k < 3; ++k)
                    if (fans.triangles[other].beside[k] == t) {
                        reliefs[other].chords |= static_cast<std::uint8_t>(1u << k);
                        reliefs[other].room[k] = 0.0f;
                    }
    }
};

} // namespace

std::unique_ptr<Patch[]> bare_patches(SmoothFans const& fans) {
    auto patches = std::make_unique<Patch[]>(fans.triangles.size());
    for (std::size_t t = 0; t < fans.triangles.size(); ++t) {
        auto const& of = fans.triangles[t].fans;
        Patch& patch = patches[t];
        patch.corner = fans.fans[of[0]].place;
        patch.to_second = fans.fans[of[1]].place - patch.corner;
        patch.to_third = fans.fans[of[2]].place - patch.corner;
        for (std::size_t k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
                patch.up[k][static_cast<std::size_t>(axis)] =
                    static_cast<float>(fans.fans[of[k]].normal[axis]);
    }
    return patches;
}

std::vector<Relief> reliefs_of(SmoothFans const& fans, std::span<Patch const> patches) {
    ReliefMaker maker{fans, patches};
    for (std::size_t t = 0; t < patches.size(); ++t)
        maker.reliefs[t].chords = fans.triangles[t].creases;
    maker.bulge();
    std::vector<std::uint32_t> folded;
    for (std::uint32_t t = 0; t < patches.size(); ++t) {
        auto const low = static_cast<double>(maker.reliefs[t].low),
                   high = static_cast<double>(maker.reliefs[t].high);
        bool const sound = area_left(patches[t], 0.0) > least_area &&
                           area_left(patches[t], low) > least_area &&
                           area_left(patches[t], high) > least_area;
        if (!sound)
            folded.push_back(t);
    }
    for (std::uint32_t const t : folded)
        maker.flatten(t);
    if (!folded.empty())
        maker.bulge();
    return std::move(maker.reliefs);
}

Bounds box_of(Patch const& patch, Relief const& relief) {
    Bounds box{dvec3(INFINITY), dvec3(-INFINITY)};
    for (std::size_t k = 0; k < 3; ++k)
        for (float const height : {relief.low, relief.high}) {
            dvec3 const p = patch.place(k) + static_cast<double>(height) * patch.direction(k);
            box = {glm::min(box.low, p), glm::max(box.high, p)};
        }
    return box;
}

namespace {

/// On which side of the surface a cage stands: one is enough where the surface bends one way, and a line that
/// leaves it cannot come back before it is through the cage.
enum class Stands : std::uint8_t { outside, inside, both };

std::vector<Stands> sides_by_group(SmoothFans const& fans, std::span<Relief const> reliefs) {
    constexpr double about_flat = 1e-3; // of the greatest bulge: what float normals leave open
    std::vector<double> up(fans.groups, 0.0), down(fans.groups, 0.0);
    for (std::size_t t = 0; t < reliefs.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            double const bulge = reliefs[t].bulge_over(k);
            double& most = (bulge > 0.0 ? up : down)[fans.group[t]];
            most = std::max(most, std::abs(bulge));
        }
    std::vector<Stands> sides;
    for (std::uint32_t g = 0; g < fans.groups; ++g)
        sides.push_back(down[g] <= about_flat * up[g]   ? Stands::outside
                        : up[g] <= about_flat * down[g] ? Stands::inside
                                                        : Stands::both);
    return sides;
}

/// rad, from a triangle's plane to its normals; those of its surface and its neighbours are of that size too.
double turn_of(Patch const& patch) {
    dvec3 const flat = normalize(cross(patch.to_second, patch.to_third));
    double turn = 0.0;
    for (dvec3 const& up : directions_of(patch))
        turn = std::max(turn, std::atan2(length(cross(up, flat)), dot(up, flat)));
    return turn;
}

/// The slope from which on a line goes through the surface once where it goes through the cage, and the turn
/// from which on a triangle is too bent for it.
std::pair<double, double> steepness(std::vector<double> turns) {
    constexpr double by_turn = 4.0, least_by_turn = 2.5, most = 0.3;
    if (turns.empty())
        return {most, INFINITY};
    auto const nearly_all = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() * 19 / 20);
    std::nth_element(turns.begin(), nearly_all, turns.end());
    double const steep = std::clamp(by_turn * *nearly_all, TriangleTree::sure_slope, most);
    return {steep, steep / least_by_turn};
}

struct CageMaker {
    SmoothFans const& fans;
    std::span<Patch const> patches;
    std::span<Relief const> reliefs;
    PatchCage cage{};
    std::vector<std::array<double, 2>> heights = std::vector<std::array<double, 2>>(fans.fans.size()); // m

    void measure() {
        constexpr double margin = 1.1;
        for (std::size_t t = 0; t < reliefs.size(); ++t)
            for (std::uint32_t const fan : fans.triangles[t].fans) {
                auto& [low, high] = heights[fan];
                low = std::min(low, margin * static_cast<double>(reliefs[t].low));
                high = std::max(high, margin * static_cast<double>(reliefs[t].high));
            }
        for (auto const& [low, high] : heights)
            cage.thickness = std::max(cage.thickness, high - low);
    }
    dvec3 lifted(std::size_t t, std::size_t k, std::size_t side) const {
        return patches[t].place(k) + heights[fans.triangles[t].fans[k]][side] * patches[t].direction(k);
    }
    void layer(std::uint32_t t, std::size_t side, std::uint32_t owner) {
        cage.triangles.push_back({lifted(t, 0, side), lifted(t, 1, side), lifted(t, 2, side)});
        cage.owner.push_back(owner);
    }
    /// Over a crease, where the cage of the other group is another one.
    void skirt(std::uint32_t t, std::size_t k) {
        std::size_t const i = (k + 1) % 3, j = (k + 2) % 3;
        dvec3 const low_i = lifted(t, i, 0), high_i = lifted(t, i, 1), low_j = lifted(t, j, 0),
                    high_j = lifted(t, j, 1);
        cage.triangles.push_back({low_i, low_j, high_j});
        cage.triangles.push_back({low_i, high_j, high_i});
        cage.owner.insert(cage.owner.end(), 2, t | PatchCage::doubtful);
    }
};

} // namespace

PatchCage cage_of(SmoothFans const& fans, std::span<Patch const> patches, std::span<Relief const> reliefs) {
    CageMaker maker{fans, patches, reliefs};
    maker.measure();
    std::vector<Stands> const sides = sides_by_group(fans, reliefs);
    std::vector<double> turns;
    turns.reserve(patches.size());
    for (std::size_t t = 0; t < patches.size(); ++t)
        turns.push_back(turn_of(patches[t]));
    auto const [steep, most_turn] = steepness(turns);
    maker.cage.steep = steep;
    for (std::uint32_t t = 0; t < patches.size(); ++t) {
        Stands const stands = sides[fans.group[t]];
        std::uint32_t const owner = turns[t] <= most_turn ? t : t | PatchCage::doubtful;
        if (stands != Stands::inside)
            maker.layer(t, 1, owner);
        if (stands != Stands::outside)
            maker.layer(t, 0, owner);
        for (std::size_t k = 0; k < 3; ++k)
            if ((fans.triangles[t].creases >> k & 1) != 0)
                maker.skirt(t, k);
    }
    return std::move(maker.cage);
}

} // namespace sahl
