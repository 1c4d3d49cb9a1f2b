// In: rays and the scene. Out: their trees, each branch traced to where it ends.
#include "trace/grove.h"

#include "math/random.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

bool finite(dvec3 const& v) {
    return std::isfinite(v.x + v.y + v.z);
}

double largest_coordinate(dvec3 const& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// The largest coordinate of what is bounded; a metre where nothing is.
double extent_of(Bvh const& bvh) {
    auto const [low, high] = bvh.bounds();
    double const extent = std::max(largest_coordinate(low), largest_coordinate(high));
    return std::isfinite(extent) ? extent : 1.0;
}

} // namespace

Grove::Grove(TraceContext const& context, BatchResult& result, SegmentSink& log)
    : context_(context), result_(result), log_(log),
      seed_(context.again ? seed_again(context.options.seed) : context.options.seed), ahead_(context.scene) {
    if (context.options.digits_lost)
        extent_ = extent_of(*context.scene.bvh);
}

void Grove::begin(std::uint64_t first, std::size_t count) {
    first_ = first;
    rays_.clear();
    next_index_.assign(count, 0);
    generation_.clear();
    generation_.reserve(count);
    next_generation_.reserve(2 * count);
    spreads_.clear();
    lights_.clear();
}

void Grove::grow(std::uint64_t first, std::span<Ray const> rays) {
    begin(first, rays.size());
    for (Ray const& ray : rays)
        plant(ray);
    watch_->plant(generation_, rays);
    grow_generations();
}

void Grove::grow(std::uint64_t first, std::uint32_t count) {
    begin(first, count);
    for (std::uint32_t i = 0; i < count; ++i)
        plant(context_.emission.ray(first + i, context_.again));
    std::size_t const hits_before = result_.hits.size();
    grow_generations();
    if (!segments_.empty())
        order_by_ray();
    if (context_.filters)
        apply_filters(hits_before);
    else if (!segments_.empty())
        log_.take(std::span(by_ray_).first(segments_.size()));
    segments_.clear();
    // generations lie one after another: put each ray's hits together, their order kept
    std::stable_sort(result_.hits.begin() + static_cast<std::ptrdiff_t>(hits_before), result_.hits.end(),
                     [](DetectorHit const& a, DetectorHit const& b) { return a.ray < b.ray; });
}

void Grove::grow_generations() {
    for (bool first = true; !generation_.empty(); first = false) {
        look_ahead(first);
        for (Branch const& branch : generation_)
            trace(branch);
        std::swap(generation_, next_generation_);
        next_generation_.clear();
        std::swap(spreads_, next_spreads_);
        next_spreads_.clear();
        std::swap(lights_, next_lights_);
        next_lights_.clear();
        if (watch_)
            watch_->next_generation();
    }
}

/// All are asked about before any is traced. Where rays split, later generations go no one way: packets of
/// what is left of them cost more than they save (measured in a ball of 100 000 triangles).
void Grove::look_ahead(bool first) {
    bool const may_go_alike = first || one_path_a_ray(context_.options);
    ahead_.begin(generation_.size(), first, may_go_alike);
    if (!ahead_.wants())
        return;
    for (std::size_t i = 0; i < generation_.size(); ++i)
        if (cut_or_none(generation_[i]) == Event::none)
            ahead_.add(i, generation_[i]);
    ahead_.end();
}

void Grove::plant(Ray const& ray) {
    if (!finite(ray.origin) || !finite(ray.direction) || ray.direction == dvec3(0.0))
        plant(ray, {{}, {}, false});
    else if (start_)
        plant(ray, *start_);
    else
        plant(ray, context_.scene.bvh->start_at(ray.origin, ray.direction));
}

void Grove::plant(Ray const& ray, Bvh::Start const& start) {
    add(result_.tally.emitted, ray.power);
    std::optional<ObjectId> const body = body_at(context_.scene, start.inside);
    generation_.push_back({.origin = ray.origin,
                           .direction = ray.direction,
                           .power = ray.power,
                           .ray = static_cast<std::uint32_t>(rays_.size()),
                           .body = body,
                           .medium = medium_of(context_.scene, body),
                           .fate = start.fits ? Event::none : Event::invalid,
                           .inside = start.inside,
                           .left = start.on});
    rays_.push_back(ray);
    if (context_.options.digits_lost)
        spreads_.emplace_back(std::max(extent_, largest_coordinate(ray.origin)));
    if (context_.polarised)
        lights_.push_back(emitted_light(context_.scene, ray));
}

inline Event Grove::cut_or_none(Branch const& branch) const {
    if (branch.fate != Event::none)
        return branch.fate;
    if (!finite(branch.origin + branch.direction + branch.power))
        return Event::invalid;
    if (branch.depth > context_.options.max_depth)
        return Event::cut_depth;
    return branch.power < context_.options.min_power * rays_[branch.ray].power ? Event::cut_power
                                                                               : Event::none;
}

/// Where digits lost are asked for, carries the branch's rounding to the end of its segment.
void Grove::follow_rounding(Branch const& branch, Interface const& interface) {
    std::uint32_t const object = context_.scene.faces[interface.face.value].body.value;
    spread_.go(interface.t, branch.direction, interface.facet_normal);
    WavelengthId const wavelength = rays_[branch.ray].wavelength;
    bend_ = {interface.normal,
             context_.scene.bvh->turning(object, interface.face, interface.primitive, interface.point,
                                         interface.normal),
             context_.optics.index(branch.medium, wavelength),
             context_.optics.index(interface.medium_after, wavelength)};
}

inline void Grove::end(Branch const& branch, Event ended, double power, double length, double optical_path,
                       Interface const* interface) {
    ++result_.tally.ended[static_cast<std::size_t>(ended)];
    if (!watch_)
        keep_segment(branch, ended, power, length, optical_path, interface);
    else if (!interface)
        watch_->lose(number_of(branch), branch, ended);
}

inline void Grove::trace(Branch const& branch) {
    std::size_t const number = number_of(branch);
    bool const follows = context_.options.digits_lost;
    if (follows)
        spread_ = spreads_[number];
    if (Event const fate = cut_or_none(branch); fate != Event::none) {
        if (fate == Event::invalid)
            return lose(branch, fate, branch.power, 0.0);
        add(result_.tally.cut, branch.power);
        return end(branch, fate, branch.power, 0.0, branch.optical_path, nullptr);
    }
    Interface& interface = interface_;
    Meeting const meeting = next_interface(context_.scene, branch.origin, branch.direction, branch.inside,
                                           branch.body, branch.left, interface, ahead_.at(number));
    for (Arrival const& arrival : interface.arrivals)
        detect_arrival(branch, arrival);
    if (meeting == Meeting::leak || meeting == Meeting::too_deep)
        return lose(branch, meeting == Meeting::leak ? Event::leak : Event::invalid, branch.power,
                    interface.t);
    result_.tally.recovered += interface.recovered;
    WavelengthId const wavelength = rays_[branch.ray].wavelength;
    if (meeting == Meeting::nothing) {
        if (!watch_)
            result_.tally.escape(branch.power, branch.direction, wavelength);
        for (DetectorId const sphere : context_.scene.sphere_detectors)
            detect_escape(branch, sphere);
        return end(branch, Event::escaped, branch.power, INFINITY, INFINITY, nullptr);
    }
    if (follows)
        follow_rounding(branch, interface);
    double const optical_path =
        branch.optical_path + context_.optics.index(branch.medium, wavelength) * interface.t;
    double power = watch_ ? branch.power : attenuate(branch, interface);
    if (interface.detector) {
        DetectorSpec const& detector = context_.scene.detectors[interface.detector->value];
        bool const counts = interface.against_facing || detector.back;
        if (counts)
            detect(branch, interface, power, optical_path);
        if (!detector.absorbs) {
            pass_on(branch, interface, power, optical_path);
            return end(branch, Event::passed, power, interface.t, optical_path, &interface);
        }
        (counts ? result_.tally.detected : result_.tally.absorbed).add(power, context_.unit);
        if (!counts) // the back of an absorbing detector is black
            result_.tally.absorbed_at_face[interface.face.value].add(power, context_.unit);
        return end(branch, counts ? Event::detected : Event::absorbed, power, interface.t, optical_path,
                   &interface);
    }
    Draw const draw{seed_, first_ + branch.ray, branch.place};
    Branches branches = interact(context_.scene, context_.optics, interface, branch.direction, branch.medium,
                                 wavelength, draw);
    if (context_.polarised)
        sorted_ = sort_light(context_.scene, context_.optics, interface, branch.direction, branch.medium,
                             wavelength, lights_[number], branches);
    if (watch_) {
        power = watch_->meet(number, branch, interface, branches);
    } else if (branches.absorbed > 0.0) {
        result_.tally.absorbed.add(power * branches.absorbed, context_.unit);
        result_.tally.absorbed_at_face[interface.face.value].add(power * branches.absorbed, context_.unit);
    }
    choose(branches, context_.options, power, rays_[branch.ray].power, branch.depth, draw);
    push_children(branch, interface, branches, optical_path);
    end(branch, branches.ended, power, interface.t, optical_path, &interface);
}

/// Beer–Lambert on the way; counts what is lost and returns what arrives.
double Grove::attenuate(Branch const& branch, Interface const& interface) {
    double const coefficient = context_.optics.absorption(branch.medium, rays_[branch.ray].wavelength);
    if (coefficient == 0.0)
        return branch.power;
    double power = branch.power;
    auto const pass = [&](double end, std::optional<ObjectId> body) {
        double const arrives = branch.power * std::exp(-coefficient * end);
        double const lost = power - arrives;
        result_.tally.absorbed.add(lost, context_.unit);
        auto& in_body = result_.tally.absorbed_in_body;
        (body ? in_body[body->value] : in_body.back()).add(lost, context_.unit);
        power = arrives;
    };
    for (Stretch const& stretch : interface.on_the_way)
        pass(stretch.end, stretch.body);
    pass(interface.t, interface.body_before);
    return power;
}

/// Of what would end where it begins, for want of power or room, a watch is told at once: it takes no place
/// in the next generation.
inline bool Grove::cut_unseen(Branch const& branch, Interface const& interface, Outgoing const& outgoing) {
    if (outgoing.fate != Event::none || !finite(interface.point + outgoing.direction + outgoing.power))
        return false;
    Event const fate = branch.depth >= context_.options.max_depth ? Event::cut_depth
                       : outgoing.power < context_.options.min_power * rays_[branch.ray].power
                           ? Event::cut_power
                           : Event::none;
    if (fate == Event::none)
        return false;
    ++result_.tally.ended[static_cast<std::size_t>(fate)];
    watch_->cut(branch.ray, outgoing.power);
    return true;
}

inline void Grove::push_children(Branch const& branch, Interface const& interface, Branches const& branches,
                                 double optical_path) {
    for (Outgoing const& outgoing : branches.outgoing) {
        if (watch_ && cut_unseen(branch, interface, outgoing))
            continue;
        bool const crosses = outgoing.crosses;
        next_generation_.push_back({.origin = interface.point,
                                    .direction = outgoing.direction,
                                    .power = outgoing.power,
                                    .optical_path = optical_path,
                                    .place = child_place(branch.place, crosses ? 0 : 1),
                                    .ray = branch.ray,
                                    .parent = static_cast<std::int32_t>(next_index_[branch.ray]),
                                    .body = crosses ? interface.body_after : interface.body_before,
                                    .medium = crosses ? interface.medium_after : branch.medium,
                                    .depth = static_cast<std::uint16_t>(branch.depth + 1),
                                    .born = outgoing.event,
                                    .fate = outgoing.fate,
                                    .inside = crosses ? interface.inside_after : interface.inside_before,
                                    .left = interface.left_by(crosses)});
        if (watch_)
            watch_->push(number_of(branch), next_generation_.back(), outgoing);
        if (context_.options.digits_lost)
            next_spreads_.emplace_back(spread_).turn(branch.direction, bend_, outgoing.event);
        if (context_.polarised)
            next_lights_.push_back(crosses ? sorted_.through : sorted_.back);
    }
}

/// Behind a detector that lets light pass, the branch goes on as it was.
void Grove::pass_on(Branch const& branch, Interface const& interface, double power, double optical_path) {
    Branch& child = next_generation_.emplace_back(branch);
    child.origin = interface.point;
    child.power = power;
    child.optical_path = optical_path;
    child.place = child_place(branch.place, 0);
    child.parent = static_cast<std::int32_t>(next_index_[branch.ray]);
    child.depth = static_cast<std::uint16_t>(branch.depth + 1);
    child.born = Event::passed;
    child.body = interface.body_after;
    child.inside = interface.inside_after;
    child.left = interface.left_by(true);
    if (context_.options.digits_lost)
        next_spreads_.emplace_back(spread_).turn(branch.direction, bend_, Event::passed);
    if (context_.polarised)
        next_lights_.push_back(lights_[number_of(branch)]);
}

void Grove::lose(Branch const& branch, Event event, double power, double t) {
    add(result_.tally.error, std::isfinite(power) ? power : 0.0);
    dvec3 const at = t > 0.0 && std::isfinite(t) ? branch.origin + t * branch.direction : branch.origin;
    result_.lost.push_back({first_ + branch.ray, event, at, power, branch.origin, branch.direction});
    end(branch, event, power, t, branch.optical_path, nullptr);
}

void Grove::keep_segment(Branch const& branch, Event ended, double power, double length, double optical_path,
                         Interface const* interface) {
    std::uint32_t const index = next_index_[branch.ray]++;
    std::uint64_t const number = first_ + branch.ray;
    double const digits_lost = context_.options.digits_lost ? spread_.digits_lost() : 0.0;
    if (context_.options.digits_lost)
        result_.digits.count(digits_lost, number, branch.depth, branch.origin);
    Ray const& ray = rays_[branch.ray];
    PathFilters const* const filters = context_.filters;
    bool const logged = context_.log_every != 0 && number % context_.log_every == 0 &&
                        (branch.power >= context_.log_min_power * ray.power || (filters && filters->log));
    if (!logged && !(filters && filters->at_detectors))
        return;
    Segment& segment = segments_.emplace_back();
    segment.ray = number;
    segment.index = index;
    segment.parent = branch.parent;
    segment.depth = branch.depth;
    segment.born = branch.born;
    segment.ended = ended;
    segment.surface = interface ? static_cast<std::int32_t>(interface->face.value) : -1;
    segment.primitive = interface ? interface->primitive : -1;
    segment.medium = static_cast<std::uint16_t>(branch.medium.value);
    segment.source = static_cast<std::uint16_t>(ray.source.value);
    segment.wavelength = context_.optics.wavelengths()[ray.wavelength.value];
    segment.origin = branch.origin;
    segment.direction = branch.direction;
    segment.length = length;
    segment.optical_path = optical_path;
    segment.power_start = branch.power;
    segment.power_end = power;
    segment.digits_lost = digits_lost;
}

} // namespace sahl
