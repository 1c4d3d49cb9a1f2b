// In: trees that grow, or are grown. Out: what reached the detectors, and the segments as the log has them.
#include "trace/grove.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sahl {

/// Which hits count, and which paths are logged.
void Grove::apply_filters(std::size_t hits_before) {
    PathFilters const& filters = *context_.filters;
    auto const ray_at = [&](std::uint32_t ray) {
        std::size_t const begin = ray == 0 ? 0 : place_[ray - 1];
        return std::span<Segment const>(by_ray_).subspan(begin, place_[ray] - begin);
    };
    auto& hits = result_.hits;
    std::size_t kept = hits_before;
    for (std::size_t i = hits_before; i < hits.size(); ++i) {
        auto const& filter = filters.detectors[hits[i].detector.value];
        if (filter) {
            SelectedPaths paths(*filter);
            paths.take(ray_at(static_cast<std::uint32_t>(hits[i].ray - first_)));
            if (!paths.path_to(hit_segments_[i - hits_before]))
                continue;
        }
        hits[kept++] = hits[i];
    }
    hits.resize(kept);
    hit_segments_.clear();
    for (std::uint32_t ray = 0; ray < rays_.size() && !segments_.empty(); ++ray)
        if (context_.log_every != 0 && (first_ + ray) % context_.log_every == 0)
            log_selected(ray_at(ray));
}

void Grove::log_selected(std::span<Segment const> ray) {
    std::vector<char> const* kept = nullptr;
    std::optional<SelectedPaths> paths;
    if (context_.filters->log) {
        paths.emplace(*context_.filters->log);
        paths->take(ray);
        kept = &paths->kept();
    }
    selected_.clear();
    for (std::size_t i = 0; i < ray.size(); ++i)
        if ((!kept || (*kept)[i]) && ray[i].power_start >= context_.log_min_power * ray.front().power_start)
            selected_.push_back(ray[i]);
    if (!selected_.empty())
        log_.take(selected_);
}

void Grove::order_by_ray() {
    place_.assign(rays_.size() + 1, 0);
    for (Segment const& segment : segments_)
        ++place_[segment.ray - first_ + 1];
    std::partial_sum(place_.begin(), place_.end(), place_.begin());
    by_ray_.resize(std::max(by_ray_.size(), segments_.size()));
    for (Segment const& segment : segments_)
        by_ray_[place_[segment.ray - first_]++] = segment;
}

/// The segment that brought it is about to end, and gets the next number.
void Grove::keep(Branch const& branch, DetectorHit const& hit) {
    result_.hits.push_back(hit);
    if (context_.filters)
        hit_segments_.push_back(next_index_[branch.ray]);
}

void Grove::detect(Branch const& branch, Interface const& interface, double power, double optical_path) {
    DetectorSpec const& detector = context_.scene.detectors[interface.detector->value];
    dvec3 const from_centre = interface.point - detector.to_world.offset;
    Ray const& ray = rays_[branch.ray];
    keep(branch,
         {*interface.detector,
          ray.wavelength,
          ray.source,
          first_ + branch.ray,
          {dot(from_centre, detector.to_world.linear[0]), dot(from_centre, detector.to_world.linear[1])},
          branch.direction,
          power,
          optical_path});
}

/// At infinity a direction is all there is; its optical path is that to the last surface.
void Grove::detect_escape(Branch const& branch, DetectorId id) {
    DetectorSpec const& sphere = context_.scene.detectors[id.value];
    Ray const& ray = rays_[branch.ray];
    DetectorHit hit{id,         ray.wavelength,   ray.source,   first_ + branch.ray,
                    dvec2(0.0), branch.direction, branch.power, branch.optical_path};
    if (sphere.radius > 0.0) {
        dvec3 const from_centre = branch.origin - sphere.to_world.offset;
        double const half = dot(from_centre, branch.direction);
        double const outside = dot(from_centre, from_centre) - sphere.radius * sphere.radius;
        if (outside >= 0.0) // it starts beyond the sphere
            return;
        double const t = std::sqrt(half * half - outside) - half;
        hit.direction = normalize(from_centre + t * branch.direction);
        hit.optical_path += context_.optics.index(branch.medium, ray.wavelength) * t;
    }
    keep(branch, hit);
}

void Grove::detect_arrival(Branch const& branch, Arrival const& arrival) {
    Scene const& scene = context_.scene;
    Body const& body = scene.bodies[scene.faces[arrival.face.value].body.value];
    dvec3 const from_origin = arrival.point - body.to_world.offset;
    Ray const& ray = rays_[branch.ray];
    double const power =
        branch.power * std::exp(-context_.optics.absorption(branch.medium, ray.wavelength) * arrival.t);
    for (auto const& [face, id] : scene.surface_detectors) {
        ArrivesFrom const from = scene.detectors[id.value].from;
        if (face.value != arrival.face.value || (from == ArrivesFrom::inside && !arrival.inside) ||
            (from == ArrivesFrom::outside && arrival.inside))
            continue;
        keep(branch,
             {id,
              ray.wavelength,
              ray.source,
              first_ + branch.ray,
              {dot(from_origin, normalize(body.to_world.linear[0])),
               dot(from_origin, normalize(body.to_world.linear[1]))},
              branch.direction,
              power,
              branch.optical_path + context_.optics.index(branch.medium, ray.wavelength) * arrival.t});
    }
}

} // namespace sahl
