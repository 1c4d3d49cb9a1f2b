#include "geometry/curved_tree.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace sahl {

namespace {

/// Weights: cells overlap by so much, so that rounding leaves nothing between them. What is met twice is so
/// at one place and in one sense, and counts once.
constexpr double overlap_of_cells = 1e-10;
/// Where a ray that is inside finds no way out: rounding at a crease or a silhouette that a smaller overlap
/// missed.
constexpr double overlap_in_doubt = 1e-3;

std::array<dvec3, 3> places_of(SmoothFans const& fans, std::uint32_t triangle) {
    auto const& [a, b, c] = fans.triangles[triangle].fans;
    return {fans.fans[a].place, fans.fans[b].place, fans.fans[c].place};
}

std::array<dvec3, 3> normals_of(SmoothFans const& fans, std::uint32_t triangle) {
    auto const& [a, b, c] = fans.triangles[triangle].fans;
    return {fans.fans[a].normal, fans.fans[b].normal, fans.fans[c].normal};
}

/// m: what float positions leave open of heights; in double a share of rounding.
double height_noise(SmoothFans const& fans) {
    return fans.reach * (fans.float_positions ? 0x1p-22 : 0x1p-46);
}

std::vector<PatchCell> cells_of(SmoothFans const& fans) {
    std::vector<PatchCell> cells;
    cells.reserve(fans.triangles.size());
    double const noise = height_noise(fans);
    for (std::uint32_t t = 0; t < fans.triangles.size(); ++t)
        cells.emplace_back(places_of(fans, t), normals_of(fans, t), fans.triangles[t].creases, noise);
    return cells;
}

std::vector<Bounds> boxes_of(SmoothFans const& fans, std::vector<PatchCell> const& cells) {
    std::vector<Bounds> boxes;
    boxes.reserve(cells.size());
    for (std::uint32_t t = 0; t < cells.size(); ++t) {
        auto const places = places_of(fans, t), normals = normals_of(fans, t);
        Bounds box{dvec3(INFINITY), dvec3(-INFINITY)};
        for (std::size_t k = 0; k < 3; ++k)
            for (double const height : {cells[t].low, cells[t].high}) {
                dvec3 const p = places[k] + height * normals[k];
                box = {glm::min(box.low, p), glm::max(box.high, p)};
            }
        boxes.push_back(box);
    }
    return boxes;
}

/// Does the polynomial stay within the heights that the cells round its fan have room for?
bool fits_in(HeightField const& field, SmoothFans const& fans, std::vector<PatchCell> const& cells,
             std::uint32_t fan) {
    constexpr double room = 0.95;
    Fan const& centre = fans.fans[fan];
    for (std::uint32_t i = 0; i < centre.corners; ++i) {
        std::uint32_t const t = fans.corners[centre.first_corner + i];
        SmoothTriangle const& triangle = fans.triangles[t];
        auto const places = places_of(fans, t), normals = normals_of(fans, t);
        PatchCell const& cell = cells[t];
        auto const mine = static_cast<std::size_t>(
            std::find(triangle.fans.begin(), triangle.fans.end(), fan) - triangle.fans.begin());
        std::size_t const next = (mine + 1) % 3, last = (mine + 2) % 3;
        constexpr std::array<dvec3, 6> samples{dvec3{1.0, 0.0, 0.0}, {0.5, 0.5, 0.0}, {0.5, 0.0, 0.5},
                                               {0.34, 0.33, 0.33},   {0.7, 0.3, 0.0}, {0.7, 0.0, 0.3}};
        for (dvec3 const& s : samples) {
            dvec3 const at = s.x * places[mine] + s.y * places[next] + s.z * places[last];
            dvec3 const up = s.x * normals[mine] + s.y * normals[next] + s.z * normals[last];
            dvec3 gradient;
            double const above = field.above(at, gradient), steep = dot(gradient, up);
            if (!(steep > 0.2))
                return false;
            double const height = -above / steep; // where the surface lies over the plane, to first order
            // near a crease, where the surface is bent onto the chord, both heights count
            if (!(height <= room * cell.high && height >= room * cell.low) &&
                !(triangle.creases && std::abs(height) < 0.25 * length(places[next] - places[last])))
                return false;
        }
    }
    return true;
}

} // namespace

LazyFields::LazyFields(std::shared_ptr<SmoothFans const> fans)
    : fans_(std::move(fans)), slots_(fans_->fans.size()) {}

LazyFields::~LazyFields() {
    for (auto& slot : slots_)
        if (HeightField const* const field = slot.load(); field != &none_)
            delete field;
}

std::size_t LazyFields::fitted() const {
    return static_cast<std::size_t>(
        std::count_if(slots_.begin(), slots_.end(), [](auto const& slot) { return slot.load() != nullptr; }));
}

HeightField const* LazyFields::fit(std::uint32_t fan, std::vector<PatchCell> const& cells) const {
    std::unique_ptr<HeightField const> made;
    bool const slopes = fans_->normals == NormalUse::files;
    for (int degree : {4, 3, 2}) {
        auto const field = fit_at(*fans_, fan, {degree, slopes});
        if (field && fits_in(*field, *fans_, cells, fan)) {
            made = std::make_unique<HeightField const>(*field);
            break;
        }
    }
    HeightField const* const mine = made ? made.get() : &none_;
    HeightField const* other = nullptr;
    if (slots_[fan].compare_exchange_strong(other, mine, std::memory_order_acq_rel)) {
        made.release();
        return mine == &none_ ? nullptr : mine;
    }
    return other == &none_ ? nullptr : other; // another thread was faster, with the same polynomial
}

CurvedTree::CurvedTree(std::shared_ptr<Mesh const> mesh, PatchKind kind)
    : fans_(std::make_shared<SmoothFans const>(smooth_fans(std::move(mesh)))), kind_(kind),
      cells_(cells_of(*fans_)) {
    if (kind_ != PatchKind::quadratic)
        fields_.emplace(fans_);
    // two meshes with the same vertices in frames of their own weigh them differently: their fits lie apart
    // by what float data leave open; of vertices in double by what least squares rounds
    fit_blur_ = std::max(height_noise(*fans_), 1e-11 * length(fans_->mesh->high - fans_->mesh->low));
    std::vector<Bounds> const boxes = boxes_of(*fans_, cells_);
    box_ = boxes.empty() ? Bounds{} : boxes.front();
    for (Bounds const& box : boxes)
        box_ = {glm::min(box_.low, box.low), glm::max(box_.high, box.high)};
    boxes_.emplace(boxes);
}

double CurvedTree::bytes_per_triangle() const {
    double const fans = static_cast<double>(fans_->fans.size());
    double const bytes = static_cast<double>(cells_.size() * (sizeof(PatchCell) + sizeof(SmoothTriangle) +
                                                              sizeof(Bounds) + 3 * sizeof(std::uint32_t))) +
                         fans * sizeof(Fan) + (fields_ ? fans * (sizeof(HeightField) + sizeof(void*)) : 0.0);
    return cells_.empty() ? 0.0 : bytes / static_cast<double>(cells_.size());
}

std::optional<CurvedCrossing> CurvedTree::meet(std::uint32_t triangle, dvec3 const& origin,
                                               dvec3 const& direction, bool rises, double slack) const {
    PatchCell const& cell = cells_[triangle];
    auto const start = model_root(cell, origin, direction, rises);
    if (!start)
        return std::nullopt;
    SmoothTriangle const& corners = fans_->triangles[triangle];
    CellFields fields{};
    if (fields_)
        for (std::size_t k = 0; k < 3; ++k)
            fields[k] = fields_->at(corners.fans[k], cells_);
    PatchSurface const surface{cell,
                               places_of(*fans_, triangle),
                               normals_of(*fans_, triangle),
                               fields,
                               corners.creases,
                               kind_ == PatchKind::apart};
    auto const root = root_from(*start, surface, origin, direction, rises, slack);
    if (!root)
        return std::nullopt;
    CurvedCrossing crossing;
    crossing.t = root->t;
    crossing.point = root->point;
    crossing.geometric = normalize(root->surface.gradient);
    crossing.normal = normalize(root->surface.normal);
    crossing.slope = std::abs(dot(crossing.geometric, direction));
    crossing.uv = {root->surface.at.v, root->surface.at.w};
    crossing.triangle = triangle;
    crossing.enters = !rises;
    return crossing;
}

std::optional<CurvedCrossing> CurvedTree::nearest(dvec3 const& origin, dvec3 const& direction,
                                                  InsideShells inside, Reach reach, double rounding,
                                                  double slack) const {
    std::optional<CurvedCrossing> best;
    double const unit = length(direction);
    boxes_->visit(origin, direction, {reach.from - rounding / unit, reach.to},
                  [&](std::uint32_t triangle, double to) {
                      bool const in = inside[mesh().shell_of(triangle)];
                      auto const c = meet(triangle, origin, direction, in, slack);
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
    bool in_some = false;
    for (std::uint32_t shell = 0; shell < mesh().shells.size(); ++shell)
        in_some = in_some || inside[shell];
    double const end = in_some ? INFINITY : reach.to; // what the ray is in must be left somewhere
    CurvedAnswer answer{nearest(origin, direction, inside, {reach.from, end}, rounding, overlap_of_cells),
                        INFINITY};
    if (!answer.crossing && in_some) {
        answer.crossing =
            nearest(origin, direction, inside, {reach.from, end}, 1e3 * rounding, overlap_in_doubt);
        if (!answer.crossing)
            return through_triangles(origin, direction, inside, {reach.from, end}, rounding);
        answer.crossing->recovered = true;
    }
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
    double const unit = length(direction);
    boxes_->visit(origin, direction, {-rounding / unit, INFINITY}, [&](std::uint32_t triangle, double to) {
        std::uint32_t const shell = mesh().shell_of(triangle);
        for (bool const rises : {true, false}) {
            auto const c = meet(triangle, origin, direction, rises, overlap_of_cells);
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
