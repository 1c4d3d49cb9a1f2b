// In: the rows of one ray, as logged. Out: who begot whom, and what lies at the boundaries; see ray_tree.h.
#include "record/ray_tree.h"

#include <algorithm>
#include <cmath>

namespace sahl {

RayTree grow_tree(LogHeader const& header, std::vector<Segment> const& rows) {
    RayTree tree{header, rows};
    tree.whole = header.min_power == 0.0 && header.where.empty();
    tree.children.resize(rows.size());
    tree.parents.resize(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        tree.whole = tree.whole && rows[i].index == i;
        auto const self = rows.begin() + static_cast<std::ptrdiff_t>(i); // a parent comes before its children
        auto const parent =
            std::lower_bound(rows.begin(), self, rows[i].parent,
                             [](Segment const& s, std::int64_t index) { return s.index < index; });
        if (parent != self && parent->index == std::int64_t{rows[i].parent}) {
            tree.parents[i] = static_cast<std::size_t>(parent - rows.begin());
            tree.children[*tree.parents[i]].push_back(i);
        }
    }
    return tree;
}

Segment const* child_born(RayTree const& tree, std::size_t row, std::initializer_list<Event> events) {
    for (std::size_t const child : tree.children[row])
        if (std::find(events.begin(), events.end(), tree.rows[child].born) != events.end())
            return &tree.rows[child];
    return nullptr;
}

/// Index of a medium at the ray's wavelength; none if the log's list has no such wavelength.
std::optional<double> index_of(LogHeader const& header, std::size_t medium, double wavelength) {
    auto const& list = header.wavelengths_m;
    // A log keeps a wavelength to an ulp or two, see in_nm; two that a user tells apart differ by far more.
    auto const found = std::find_if(list.begin(), list.end(), [&](double listed) {
        return std::abs(listed - wavelength) <= 1e-14 * wavelength;
    });
    std::size_t const at = medium * list.size() + static_cast<std::size_t>(found - list.begin());
    if (found == list.end() || at >= header.refractive_index.size())
        return std::nullopt;
    return header.refractive_index[at];
}

std::optional<dvec3> normal_at_end(RayTree const& tree, std::size_t row) {
    Segment const& in = tree.rows[row];
    dvec3 normal(0.0);
    if (auto const* mirrored = child_born(tree, row, {Event::reflected, Event::total_internal}))
        normal = in.direction - mirrored->direction;
    if (auto const* bent = child_born(tree, row, {Event::refracted})) {
        auto const n_before = index_of(tree.header, in.medium, in.wavelength);
        auto const n_after = index_of(tree.header, bent->medium, in.wavelength);
        if (n_before && n_after) {
            dvec3 const step = *n_before * in.direction - *n_after * bent->direction;
            if (dot(step, step) > dot(normal, normal))
                normal = step;
        }
    }
    // Directions are rounded to about 1e-16: a difference of 1e-8 still gives the normal to 1e-8.
    return dot(normal, normal) > 1e-16 ? std::optional(normalize(normal)) : std::nullopt;
}

std::optional<Behind> beyond(RayTree const& tree, std::size_t row, double incidence) {
    Segment const& in = tree.rows[row];
    std::optional<std::size_t> medium;
    for (std::size_t i = 0; i < tree.rows.size() && !medium; ++i) {
        Segment const& near = tree.rows[i];
        auto const* far = near.surface == in.surface ? child_born(tree, i, {Event::refracted}) : nullptr;
        if (far != nullptr && near.medium == in.medium)
            medium = far->medium;
        else if (far != nullptr && far->medium == in.medium)
            medium = near.medium;
    }
    bool const seen = medium.has_value();
    for (auto up = tree.parents[row]; up && !medium; up = tree.parents[*up])
        if (tree.rows[*up].medium != in.medium)
            medium = tree.rows[*up].medium;
    if (!medium)
        return std::nullopt;
    auto const n_here = index_of(tree.header, in.medium, in.wavelength);
    auto const n_there = index_of(tree.header, *medium, in.wavelength);
    if (!n_here || !n_there || !(*n_there <= *n_here * std::sin(incidence)))
        return std::nullopt;
    return Behind{*medium, std::asin(*n_there / *n_here), seen};
}

double angle_to(dvec3 const& direction, dvec3 const& normal) {
    return std::atan2(length(cross(direction, normal)), std::abs(dot(direction, normal)));
}

} // namespace sahl
