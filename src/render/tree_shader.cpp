#include "render/tree_shader.h"

#include "math/overloaded.h"
#include "optics/snell.h"
#include "render/surface_colour.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sahl {

namespace {

constexpr double least_shadow_light = 1e-4; // below half a step of the 8 bits of a PNG

double brightest(dvec3 const& colour) {
    return std::max({colour.x, colour.y, colour.z});
}

dvec3 vector(Colour const& colour) {
    return {colour[0], colour[1], colour[2]};
}

} // namespace

TreeShader::TreeShader(PictureScene const& picture, Channels const& channels, bool single)
    : in_(picture), single_(single), absorbs_(single),
      disperses_(std::find(picture.dispersive.begin(), picture.dispersive.end(), true) !=
                 picture.dispersive.end()),
      glows_(std::any_of(picture.picture.lights.begin(), picture.picture.lights.end(),
                         [](Light const& lamp) { return lamp.radius > 0.0; })),
      channels_(channels) {
    for (std::uint32_t medium = 0; medium < picture.scene.media.size(); ++medium)
        for (WavelengthId const channel : channels)
            absorbs_ = absorbs_ || picture.optics.absorption({medium}, channel) != 0.0;
    if (picture.picture.options.filter_textures &&
        (!picture.textures.empty() || picture.sky.has_image() || has_checker(picture.scene)))
        footprints_.emplace(picture.scene, picture.optics);
}

/// What a surface is painted with, if a lamp lights it.
Paint const* TreeShader::paint_of(Interface const& interface) {
    if (!interface.surface)
        return nullptr;
    auto const& kind = in_.scene.surfaces[interface.surface->value].kind;
    if (auto const* const matt = std::get_if<Diffuse>(&kind)) {
        matt_.diffuse = {matt->reflectance, matt->reflectance, matt->reflectance};
        return &matt_;
    }
    return std::get_if<Paint>(&kind);
}

void TreeShader::plant(std::span<Branch const> roots, std::span<Ray const> rays) {
    rays_ = rays;
    first_view_ = views_.size();
    views_.resize(views_.size() + roots.size());
    colours_.assign(roots.size(), dvec3(1.0));
    next_colours_.clear();
    if (footprints_) {
        std::vector<Footprint> seen;
        seen.reserve(rays.size());
        for (Ray const& ray : rays)
            seen.push_back(in_.camera.footprint(ray.direction, in_.step));
        footprints_->plant(std::move(seen));
    }
}

void TreeShader::next_generation() {
    if (footprints_)
        footprints_->next_generation();
    std::swap(colours_, next_colours_);
    next_colours_.clear();
}

void TreeShader::push(std::size_t, Branch const& child, Outgoing const& outgoing) {
    if (footprints_)
        footprints_->push(outgoing);
    next_colours_.push_back(child.power * leaving_[outgoing.crosses ? 1 : 0]);
}

void TreeShader::lose(std::size_t number, Branch const& branch, Event event) {
    RayView& view = views_[first_view_ + branch.ray];
    if (event == Event::cut_power || event == Event::cut_depth) {
        view.cut += branch.power;
        return;
    }
    ++view.pieces;
    if (event != Event::escaped)
        return;
    Footprint const seen = footprints_ ? footprints_->of(number) : Footprint{};
    dvec3 light = in_.sky.toward(branch.direction, seen.across.heading, seen.down.heading);
    if (glows_)
        light += glow(branch, std::numeric_limits<double>::infinity());
    view.light += colours_[number] * light;
}

dvec3 TreeShader::glow(Branch const& branch, double length) const {
    dvec3 light(0.0);
    for (Light const& lamp : in_.picture.lights)
        light += glow_of(lamp, branch.origin, branch.direction, length);
    return light;
}

double TreeShader::meet(std::size_t number, Branch const& branch, Interface const& interface,
                        Branches& branches) {
    if (single_)
        channels_.fill(rays_[branch.ray].wavelength);
    RayView& view = views_[first_view_ + branch.ray];
    ++view.pieces;
    if (branch.depth == 0) {
        view.depth = interface.t;
        view.normal = interface.normal;
    }
    if (disperses_)
        view.disperses = view.disperses || in_.dispersive[branch.medium.value] ||
                         in_.dispersive[interface.medium_after.value];
    if (footprints_)
        seen_ = footprints_->meet(number, branch, interface, rays_[branch.ray].wavelength);
    dvec3 arrives = colours_[number];
    if (glows_)
        view.light += arrives * glow(branch, interface.t);
    if (absorbs_)
        arrives *= absorbed_on_way(in_.optics, branch.medium, channels_, interface.t);
    light_up(view, branch, interface, arrives, branches);
    double const power = brightest(arrives);
    if (power > 0.0)
        weigh(branch, interface, arrives, power, branches);
    return power;
}

/// Gives each outgoing branch the share of its brightest colour.
void TreeShader::weigh(Branch const& branch, Interface const& interface, dvec3 const& arrives, double power,
                       Branches& branches) {
    leaving_.fill(arrives / power);
    if (!is_coloured(in_.scene, interface))
        return;
    bool const pictured = in_.textures.has(in_.scene, interface);
    if (single_ && !pictured)
        return;
    ColouredBranches coloured =
        coloured_branches(in_.scene, in_.optics, interface, branch.direction, branch.medium, channels_);
    if (pictured)
        tint(coloured, in_.scene, in_.optics, interface, channels_,
             in_.textures.at(in_.scene, interface, seen_.across.place, seen_.down.place));
    branches.outgoing = coloured.outgoing;
    double sum = 0.0;
    for (Outgoing& outgoing : branches.outgoing) {
        dvec3 const leaves = arrives * (outgoing.crosses ? coloured.across : coloured.back);
        double const most = brightest(leaves);
        leaving_[outgoing.crosses ? 1 : 0] = most > 0.0 ? leaves / most : dvec3(0.0);
        outgoing.share = most / power;
        sum += outgoing.share;
    }
    branches.absorbed = 1.0 - sum;
}

void TreeShader::light_up(RayView& view, Branch const& branch, Interface const& interface,
                          dvec3 const& arrives, Branches& branches) {
    Paint const* const paint = paint_of(interface);
    if (!paint)
        return;
    bool lit = false;
    view.light += arrives * paint->covers * local_light(*paint, interface, branch, lit);
    bool const scatters = !branches.outgoing.empty() && branches.outgoing[0].event == Event::scattered;
    if (scatters || (in_.picture.options.shadows == Shadows::ambient_only && !lit && paint->covers == 1.0))
        branches.outgoing.clear();
}

/// Phong's ambient, diffuse and specular terms, over all lamps.
dvec3 TreeShader::local_light(Paint const& paint, Interface const& interface, Branch const& branch,
                              bool& lit) {
    ObjectId const body = in_.scene.faces[interface.face.value].body;
    dvec3 const across = seen_.across.place, down = seen_.down.place;
    dvec3 const colour = pigment(in_.to_objects[body.value], interface, paint, across, down) *
                         in_.textures.at(in_.scene, interface, across, down);
    dvec3 const& direction = branch.direction;
    dvec3 light = in_.picture.options.ambient * vector(paint.ambient) * colour;
    if (in_.caustics)
        light += in_.caustics->at(interface.point) * vector(paint.diffuse) * colour;
    dvec3 const specular = vector(paint.specular);
    bool const glossy = brightest(specular) > 0.0;
    dvec3 const mirrored = direction - 2.0 * dot(direction, interface.normal) * interface.normal;
    for (Light const& source : in_.picture.lights) {
        LampView const lamp = view_of(source, interface.point);
        double const facing = dot(lamp.toward, interface.normal);
        if (facing <= 0.0 || dot(lamp.toward, interface.facet_normal) <= 0.0)
            continue;
        dvec3 const comes = lamp_light(lamp, interface);
        if (brightest(comes) <= 0.0)
            continue;
        lit = true;
        dvec3 sent = facing * vector(paint.diffuse) * colour;
        if (glossy)
            sent += std::pow(std::max(0.0, dot(mirrored, lamp.toward)), paint.shininess) * specular;
        light += comes * sent;
    }
    return light;
}

/// What of a lamp's light comes straight to a surface.
dvec3 TreeShader::lamp_light(LampView const& lamp, Interface const& interface) {
    if (brightest(lamp.light) <= 0.0)
        return dvec3(0.0);
    dvec3 passes(1.0);
    bool const glass = in_.picture.options.shadows == Shadows::glass;
    auto const visit = [&](Interface const& met, MediumId medium) {
        if (!glass)
            return false;
        ColouredBranches boundary =
            coloured_branches(in_.scene, in_.optics, met, lamp.toward, medium, channels_);
        if (in_.textures.has(in_.scene, met) && is_coloured(in_.scene, met))
            tint(boundary, in_.scene, in_.optics, met, channels_, in_.textures.at(in_.scene, met));
        passes *= absorbed_on_way(in_.optics, medium, channels_, met.t) * boundary.across;
        return brightest(passes) > least_shadow_light;
    };
    auto const last = [&](MediumId medium, double length) {
        if (std::isfinite(length))
            passes *= absorbed_on_way(in_.optics, medium, channels_, length);
    };
    bool const reached = straight_on(in_.scene, StraightStart(interface), lamp.toward, lamp.distance,
                                     toward_lamp_, visit, last);
    return reached ? passes * lamp.light : dvec3(0.0);
}

} // namespace sahl
