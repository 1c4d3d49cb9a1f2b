// In: the outline of half a section. Out: the closed mesh that it makes when it goes round the z axis.
#pragma once

#include "support/meshes.h"

#include <vector>

namespace sahl::bench {

/// `outline` runs from the axis to the axis, (r, z), counter-clockwise seen with r to the right and z up.
inline TriangleSoup lathe_soup(std::vector<dvec2> const& outline, std::uint32_t sectors) {
    TriangleSoup soup;
    soup.face_names = {"surface"};
    std::vector<std::uint32_t> first; // of each point's ring
    for (dvec2 const& p : outline) {
        first.push_back(static_cast<std::uint32_t>(soup.positions.size()));
        for (std::uint32_t k = 0; k < (p.x == 0.0 ? 1 : sectors); ++k) {
            double const angle = 2.0 * std::numbers::pi * k / sectors;
            soup.positions.push_back({p.x * std::cos(angle), p.x * std::sin(angle), p.y});
        }
    }
    for (std::size_t i = 0; i + 1 < outline.size(); ++i)
        for (std::uint32_t k = 0; k < sectors; ++k) {
            std::uint32_t const next = (k + 1) % sectors;
            bool const low_tip = outline[i].x == 0.0, high_tip = outline[i + 1].x == 0.0;
            std::uint32_t const a = first[i] + (low_tip ? 0 : k), b = first[i] + (low_tip ? 0 : next),
                                c = first[i + 1] + (high_tip ? 0 : k),
                                d = first[i + 1] + (high_tip ? 0 : next);
            if (!low_tip)
                add_triangle(soup, a, b, c);
            if (!high_tip)
                add_triangle(soup, b, d, c);
        }
    return soup;
}

inline double sag_at(double radius, double r) {
    return radius == 0.0 ? 0.0 : r * r / (radius + std::copysign(std::sqrt(radius * radius - r * r), radius));
}

/// A lens with its first vertex at the origin, light along +z, radii signed as in optics, 0 a plane.
inline TriangleSoup lens_soup(double r1, double r2, double thickness, double rim, std::uint32_t rings,
                              std::uint32_t sectors) {
    std::vector<dvec2> outline;
    for (std::uint32_t i = 0; i <= rings; ++i) {
        double const r = rim * i / rings;
        outline.push_back({r, sag_at(r1, r)});
    }
    for (std::uint32_t i = 0; i <= rings; ++i) {
        double const r = rim * (rings - i) / rings;
        outline.push_back({r, thickness + sag_at(r2, r)});
    }
    return lathe_soup(outline, sectors);
}

} // namespace sahl::bench
