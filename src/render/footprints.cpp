#include "render/footprints.h"

#include <cmath>
#include <optional>

namespace sahl {

namespace {

/// Snell's law keeps n · (direction × normal): a branch that breaks it by more than rounding was bent by
/// another normal.
constexpr double same_normal = 1e-9;

bool bends(dvec3 const& normal, dvec3 const& direction, dvec3 const& leaves, double n_incident,
           double n_leaves) {
    return length(n_incident * cross(direction, normal) - n_leaves * cross(leaves, normal)) <
           same_normal * n_incident;
}

/// Of a ball that is no ellipsoid in the world: its normal turns by dx / radius, which the search for the
/// normals of neighbouring points finds too, for many times the price.
std::optional<dmat3> turning_of_ball(Body const& body, Interface const& interface) {
    auto const* const ball = body.shape ? std::get_if<Sphere>(&*body.shape) : nullptr;
    dmat3 const& axes = body.to_world.linear;
    double const square = dot(axes[0], axes[0]), rounding = 1e-12 * square;
    if (!ball || std::abs(dot(axes[1], axes[1]) - square) > rounding ||
        std::abs(dot(axes[2], axes[2]) - square) > rounding || std::abs(dot(axes[0], axes[1])) > rounding ||
        std::abs(dot(axes[1], axes[2])) > rounding || std::abs(dot(axes[2], axes[0])) > rounding)
        return std::nullopt;
    double const radius = ball->radius * std::sqrt(square);
    bool const outward = dot(interface.normal, interface.point - body.to_world.offset) > 0.0;
    return dmat3((outward ? 1.0 : -1.0) / radius); // times what lies along the surface
}

} // namespace

void Footprints::plant(std::vector<Footprint> roots) {
    now_ = std::move(roots);
    next_.clear();
}

void Footprints::next_generation() {
    std::swap(now_, next_);
    next_.clear();
}

Footprint const& Footprints::meet(std::size_t number, Branch const& branch, Interface const& interface,
                                  WavelengthId wavelength) {
    here_ = now_[number];
    here_.across.go(interface.t, branch.direction, interface.facet_normal);
    here_.down.go(interface.t, branch.direction, interface.facet_normal);
    interface_ = &interface;
    direction_ = branch.direction;
    n_incident_ = optics_.index(branch.medium, wavelength);
    wavelength_ = wavelength;
    return here_;
}

/// The normal that the branch was bent by, and how that turns from place to place: the surface's, or, where
/// an interpolated one would have sent light to the wrong side, the flat triangle's.
Footprints::Bend Footprints::bend_of(Outgoing const& outgoing, double n_leaves) const {
    dvec3 const& normal = interface_->normal;
    if (!bends(normal, direction_, outgoing.direction, n_incident_, n_leaves))
        return {interface_->facet_normal, dmat3(0.0)};
    ObjectId const body = scene_.faces[interface_->face.value].body;
    if (auto const turning = turning_of_ball(scene_.bodies[body.value], *interface_))
        return {normal, *turning};
    return {normal, scene_.bvh->turning(body.value, interface_->face, interface_->primitive,
                                        interface_->point, normal)};
}

void Footprints::push(Outgoing const& outgoing) {
    double const n_leaves =
        outgoing.crosses ? optics_.index(interface_->medium_after, wavelength_) : n_incident_;
    Bend const bend = bend_of(outgoing, n_leaves);
    Footprint& child = next_.emplace_back(here_);
    for (RayDifferential* const one : {&child.across, &child.down}) {
        dvec3 const turn = bend.turning * one->place;
        if (outgoing.crosses)
            one->refract(direction_, outgoing.direction, bend.normal, turn, n_incident_, n_leaves);
        else
            one->reflect(direction_, bend.normal, turn);
    }
}

} // namespace sahl
