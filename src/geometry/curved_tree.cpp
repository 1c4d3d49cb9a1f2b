#include "geometry/curved_tree.h"

#include "geometry/curved_query.h"
#include "geometry/patch_cell.h"
#include "geometry/patch_roots.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace sahl {

namespace {

/// Weights: cells overlap by so much, so that rounding leaves nothing between them. What is met twice is so
/// at one place and in one sense, and counts once.
constexpr double overlap_of_cells = 1e-10;
/// Where a ray that is inside finds no way out: rounding at a crease or a silhouette that a smaller overlap
/// missed.
constexpr double overlap_in_doubt = 1e-3;

} // namespace

CurvedTree::CurvedTree(std::shared_ptr<Mesh const> mesh, PatchKind kind)
    : fans_(std::make_shared<SmoothFans const>(smooth_fans(std::move(mesh)))), kind_(kind),
      patches_(bare_patches(*fans_)), reliefs_(reliefs_of(*fans_, patches())) {
    if (kind_ != PatchKind::quadratic)
        fields_.emplace(fans_);
    // two meshes with the same vertices in frames of their own weigh them differently: their fits lie apart
    // by what float data leave open; of vertices in double by what least squares rounds
    fit_blur_ = std::max(height_noise(*fans_), 1e-11 * length(fans_->mesh->high - fans_->mesh->low));
    std::vector<Bounds> boxes;
    boxes.reserve(reliefs_.size());
    for (std::size_t t = 0; t < reliefs_.size(); ++t)
        boxes.push_back(box_of(patches_[t], reliefs_[t]));
    box_ = boxes.empty() ? Bounds{} : boxes.front();
    for (Bounds const& box : boxes)
        box_ = {glm::min(box_.low, box.low), glm::max(box_.high, box.high)};
    boxes_.emplace(boxes);
    PatchCage cage = cage_of(*fans_, patches(), reliefs_);
    cage_.emplace(cage.triangles, cage.steep);
    owner_ = std::move(cage.owner);
    thickness_ = cage.thickness;
    behind_ = thickness_ / cage.steep;
}

void CurvedTree::make(std::uint32_t triangle) const {
    std::scoped_lock const lock(making_[triangle % making_.size()]);
    Patch& patch = patches_[triangle];
    if (patch.made.load(std::memory_order_relaxed) != Patch::bare)
        return;
    CornerFields fields{};
    if (fields_)
        for (std::size_t k = 0; k < 3; ++k)
            fields[k] = fields_->at(fans_->triangles[triangle].fans[k], reliefs_);
    Patch::Made const made = fill(patch, *fans_, triangle, reliefs_[triangle], fields, kind_);
    patch.made.store(made, std::memory_order_release);
}

double CurvedTree::bytes_per_triangle() const {
    double const fans = static_cast<double>(fans_->fans.size()),
                 triangles = static_cast<double>(reliefs_.size());
    double const bytes = triangles * (sizeof(Patch) + sizeof(Relief) + sizeof(SmoothTriangle) +
                                      sizeof(Bounds) + 4 * sizeof(std::uint32_t)) +
                         static_cast<double>(owner_.size()) * sizeof(std::uint32_t) + fans * sizeof(Fan) +
                         (fields_ ? fans * (sizeof(HeightField) + sizeof(void*)) : 0.0);
    return reliefs_.empty() ? 0.0 : bytes / triangles;
}

double CurvedTree::share_stood_in() const {
    constexpr std::size_t sample = 4096;
    std::size_t const stride = std::max<std::size_t>(1, reliefs_.size() / sample);
    std::size_t looked_at = 0, stood_in = 0;
    for (std::size_t t = 0; t < reliefs_.size(); t += stride, ++looked_at)
        stood_in += patch(static_cast<std::uint32_t>(t)).stood_in;
    return looked_at == 0 ? 0.0 : static_cast<double>(stood_in) / static_cast<double>(looked_at);
}

std::optional<CurvedCrossing> CurvedTree::meet(std::uint32_t triangle, dvec3 const& origin,
                                               dvec3 const& direction, bool rises, double from,
                                               Care const& care) const {
    Patch const& here = patch(triangle);
    bool const thorough = care.thorough || here.made.load(std::memory_order_relaxed) == Patch::uneven;
    CurvedCrossing crossing;
    dvec3 outward;
    if (thorough) {
        PatchRoot const* first = nullptr;
        PatchRoots const roots = roots_of(here, origin, direction, care.overlap);
        for (PatchRoot const& root : roots)
            if ((dot(root.outward, direction) > 0.0) == rises && root.t >= from &&
                (!first || root.t < first->t))
                first = &root;
        if (!first)
            return std::nullopt;
        crossing.t = first->t;
        crossing.uv = {first->v, first->w};
        outward = first->outward;
    } else {
        auto const root = PatchCell(here, reliefs_[triangle]).root(origin, direction, rises, care.overlap);
        if (!root)
            return std::nullopt;
        crossing.t = root->t;
        crossing.uv = {root->at.v, root->at.w};
        outward = root->at.gradient;
    }
    crossing.point = origin + crossing.t * direction;
    crossing.geometric = normalize(outward);
    crossing.normal = normalize(light_normal(here, crossing.uv.x, crossing.uv.y));
    crossing.slope = std::abs(dot(crossing.geometric, direction));
    crossing.triangle = triangle;
    crossing.enters = !rises;
    if (care.overlap <= overlap_of_cells && lies_beside(crossing, length(direction), care.rounding))
        return std::nullopt;
    return crossing;
}

bool CurvedTree::lies_beside(CurvedCrossing const& crossing, double unit, double rounding) const {
    std::array<double, 3> const weights{1.0 - crossing.uv.x - crossing.uv.y, crossing.uv.x, crossing.uv.y};
    if (weights[0] >= 0.0 && weights[1] >= 0.0 && weights[2] >= 0.0)
        return false;
    Patch const& here = patch(crossing.triangle);
    std::array<double, 3> const sides{length(here.to_third - here.to_second), length(here.to_third),
                                      length(here.to_second)};
    double const area = length(cross(here.to_second, here.to_third));
    for (std::size_t k = 0; k < 3; ++k)
        if (-weights[k] * (area / sides[k]) * crossing.slope > rounding * unit)
            return true;
    return false;
}

std::optional<CurvedCrossing> CurvedTree::foot(std::uint32_t triangle, dvec3 const& place) const {
    Patch const& here = patch(triangle);
    dvec3 const normal = normalize(cross(here.to_second, here.to_third));
    return meet(triangle, place, normal, true, -INFINITY, {false, overlap_of_cells, 0.0});
}

std::optional<CurvedCrossing> CurvedTree::nearest(dvec3 const& origin, dvec3 const& direction,
                                                  InsideShells inside, Reach reach, Care const& care) const {
    std::optional<CurvedCrossing> best;
    double const rounding = care.rounding, start = reach.from - rounding / length(direction);
    boxes_->visit(origin, direction, {start, reach.to}, [&](std::uint32_t triangle, double to) {
        bool const in = inside[mesh().shell_of(triangle)];
        auto const c = meet(triangle, origin, direction, in, start, care);
        if (!c || c->t > to || (c->t - reach.from) * c->slope < -rounding)
            return to;
        if (!best || std::pair(c->t, triangle) < std::pair(best->t, best->triangle))
            best = c;
        return std::min(to, best->t + 2.0 * rounding / std::max(best->slope, 1e-9));
    });
    return best;
}

CurvedAnswer CurvedTree::next(dvec3 const& origin, dvec3 const& direction, InsideShells inside, Reach reach,
                              double rounding) const {
    double const unit = length(direction), behind = behind_ / unit;
    CurvedQuery query(*this, origin, direction, inside, reach.from, rounding, behind, cage_->blur() / unit);
    double const end = query.in_some() ? INFINITY : reach.to;
    cage_->visit(origin, direction, unit, {reach.from - behind, end + behind},
                 [&](Proposal const& proposal) { return query.take(proposal); });
    CurvedAnswer answer;
    if (query.settle(end, answer))
        return answer;
    return next_by_boxes(origin, direction, inside, {reach.from, end}, rounding);
}

CurvedAnswer CurvedTree::next_by_boxes(dvec3 const& origin, dvec3 const& direction, InsideShells inside,
                                       Reach reach, double rounding) const {
    CurvedAnswer answer{nearest(origin, direction, inside, reach, {false, overlap_of_cells, rounding}),
                        INFINITY};
    bool in_some = false;
    for (std::uint32_t shell = 0; shell < mesh().shells.size(); ++shell)
        in_some = in_some || inside[shell];
    if (answer.crossing || !in_some)
        return answer;
    // what the ray is in must be left somewhere
    answer.crossing = nearest(origin, direction, inside, reach, {true, overlap_of_cells, rounding});
    if (answer.crossing)
        return answer;
    answer.crossing = nearest(origin, direction, inside, reach, {true, overlap_in_doubt, 1e3 * rounding});
    if (!answer.crossing)
        answer = through_triangles(origin, direction, inside, reach, rounding);
    if (!answer
             .crossing) { // between chord and arc: it has gone out behind its start, by no more than a layer
        answer.crossing = nearest(origin, direction, inside, reach, {true, overlap_in_doubt, thickness_});
        if (!answer.crossing)
            return answer;
        answer.contradiction = INFINITY;
        answer.crossing->t = std::max(answer.crossing->t, reach.from);
        answer.crossing->point = origin + answer.crossing->t * direction;
    }
    answer.crossing->recovered = true;
    return answer;
}

CurvedAnswer CurvedTree::through_triangles(dvec3 const& origin, dvec3 const& direction, InsideShells inside,
                                           Reach reach, double rounding) const {
    // in a thread of its own: one that traces would, while Embree builds, take up other rays and come here
    // again
    std::call_once(triangles_built_, [this] {
        std::thread([this] { triangles_ = std::make_unique<MeshTree const>(fans_->mesh); }).join();
    });
    MeshAnswer const met = triangles_->next(origin, direction, inside, reach, rounding);
    CurvedAnswer answer{std::nullopt, met.contradiction};
    if (auto const& c = met.crossing) {
        answer.crossing.emplace();
        answer.crossing->t = std::max(c->t, reach.from);
        answer.crossing->slope = c->slope;
        answer.crossing->point = origin + answer.crossing->t * direction;
        answer.crossing->normal = answer.crossing->geometric = c->normal;
        answer.crossing->uv = c->uv;
        answer.crossing->triangle = c->triangle;
        answer.crossing->enters = c->enters;
        answer.crossing->recovered = true;
    }
    return answer;
}

std::vector<bool> CurvedTree::inside(dvec3 const& origin, dvec3 const& direction, double rounding) const {
    std::size_t const shells = mesh().shells.size();
    std::vector<double> nearest_t(shells, INFINITY);
    std::vector<bool> states(shells, false);
    double const start = -rounding / length(direction);
    boxes_->visit(origin, direction, {start, INFINITY}, [&](std::uint32_t triangle, double to) {
        std::uint32_t const shell = mesh().shell_of(triangle);
        for (bool const rises : {true, false}) {
            auto const c =
                meet(triangle, origin, direction, rises, start, {false, overlap_of_cells, rounding});
            if (!c || c->t * c->slope <= rounding || c->t >= nearest_t[shell])
                continue;
            nearest_t[shell] = c->t;
            states[shell] = rises;
        }
        return to;
    });
    return states;
}

} // namespace sahl
