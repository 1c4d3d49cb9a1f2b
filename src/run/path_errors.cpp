#include "run/path_errors.h"

#include "run/trace_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace sahl {

namespace {

constexpr double least_power = 1e-2; // share of the ray's: what carries less moves no result by what it errs

double angle(dvec3 const& a, dvec3 const& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

bool is_cut(Event event) {
    return event == Event::cut_power || event == Event::cut_depth;
}

} // namespace

std::vector<std::uint64_t> spread_rays(Emission const& emission, std::uint64_t count, double shift) {
    std::vector<std::uint64_t> rays;
    auto const& first = emission.first_rays();
    for (std::size_t source = 0; source + 1 < first.size(); ++source) {
        std::uint64_t const all = first[source + 1] - first[source], wanted = std::min(count, all);
        for (std::uint64_t i = 0; i < wanted; ++i) {
            double const at =
                (static_cast<double>(i) + shift) * static_cast<double>(all) / static_cast<double>(wanted);
            rays.push_back(first[source] + std::min(all - 1, static_cast<std::uint64_t>(at)));
        }
    }
    return rays;
}

Trees trees_of(Scene const& scene, WavelengthTable const& optics, Emission const& emission,
               TraceOptions const& options, std::span<std::uint64_t const> rays) {
    TraceOptions split = options;
    split.branch = BranchPolicy::split;
    split.min_power = std::max(options.min_power, least_power);
    TraceContext const context{scene, optics, emission, split, power_unit(emission), 1};
    Trees trees;
    trees.reserve(rays.size());
    for (std::uint64_t const ray : rays)
        trees.push_back(trace_batch(context, ray, 1).log.segments);
    return trees;
}

double PathErrors::tail() const {
    constexpr std::size_t back =
        8; // the greatest over the eighth tells how the tail grows, eight times rarer
    std::vector<double> sorted = by_ray;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    double const eighth = sorted.size() > back ? sorted[back - 1] : 0.0;
    return eighth > 0.0 ? greatest * std::min(greatest / eighth, 4.0) : greatest;
}

PathErrors compare_paths(Trees const& one, Trees const& other, bool same_faces) {
    PathErrors errors;
    double squares = 0.0, leaving_squares = 0.0;
    std::uint64_t leaving = 0;
    for (std::size_t r = 0; r < one.size(); ++r) {
        std::vector<Segment> const &a = one[r], &b = other[r];
        bool changed = a.empty() || b.empty();
        double worst = 0.0, sum = 0.0, sum_leaving = 0.0;
        std::uint64_t count = 0, count_leaving = 0;
        std::vector<std::pair<std::size_t, std::size_t>>
            matched; // indices; children come after their parents
        if (!changed)
            matched.emplace_back(0, 0);
        for (std::size_t m = 0; m < matched.size(); ++m) {
            auto const [i, j] = matched[m];
            if (i != 0) {
                double const off = angle(a[i].direction, b[j].direction);
                worst = std::max(worst, off);
                sum += off * off;
                ++count;
                bool const leaves = a[i].ended == Event::escaped || a[i].ended == Event::detected;
                sum_leaving += leaves ? off * off : 0.0;
                count_leaving += leaves;
            }
            bool const same = a[i].ended == b[j].ended && (!same_faces || a[i].surface == b[j].surface);
            if (!same) {
                changed = changed || !(is_cut(a[i].ended) || is_cut(b[j].ended));
                continue;
            }
            for (std::size_t k = i + 1; k < a.size(); ++k) {
                if (a[k].parent != static_cast<std::int32_t>(a[i].index))
                    continue;
                for (std::size_t l = j + 1; l < b.size(); ++l)
                    if (b[l].parent == static_cast<std::int32_t>(b[j].index) && b[l].born == a[k].born)
                        matched.emplace_back(k, l);
            }
        }
        ++errors.rays;
        errors.changed += changed;
        errors.by_ray.push_back(changed ? -1.0 : worst);
        if (changed) // where the events are others, so are the directions
            continue;
        squares += sum;
        errors.segments += count;
        leaving_squares += sum_leaving;
        leaving += count_leaving;
        errors.greatest = std::max(errors.greatest, worst);
    }
    errors.rms = errors.segments ? std::sqrt(squares / static_cast<double>(errors.segments)) : 0.0;
    errors.leaving = leaving ? std::sqrt(leaving_squares / static_cast<double>(leaving)) : 0.0;
    return errors;
}

} // namespace sahl
