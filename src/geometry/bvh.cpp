#include "geometry/bvh.h"

#include "geometry/embree/box_tree.h"
#include "geometry/mesh_cluster.h"
#include "geometry/mesh_store.h"
#include "geometry/pilot_curving.h"
#include "geometry/placed.h"
#include "geometry/survey.h"
#include "geometry/touching.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <tuple>

namespace sahl {

struct Bvh::State {
    std::vector<Placed> objects;
    std::vector<std::uint32_t> unbounded;
    std::vector<std::uint32_t> bounded; // by index in the tree
    std::optional<BoxTree> tree;        // where there are many bounded objects
    std::optional<MeshCluster> cluster; // where there are few
    std::uint32_t in_cluster = 0;       // a bit for each of `bounded`
    Touching touch;                     // two candidates at one place
    std::vector<MadeFlush> made_flush;
    bool lone = false;                       // one object, no shell of which touches another
    std::optional<std::uint32_t> seen_ahead; // the mesh that packets are asked about

    void choose_mesh_for_packets();
    NextHit next_of_lone(dvec3 const& origin, dvec3 const& direction, ShellSet const& inside, double from,
                         SeenAhead const* ahead) const;
};

namespace {

MeshTree const* tree_of(Placed const& object) {
    auto const* const tree = std::get_if<std::shared_ptr<MeshTree const>>(&object.met_by);
    return tree ? tree->get() : nullptr;
}

/// What was seen ahead of an object's next crossing, as Placed::next gives it.
double recall(Placed const& object, SeenAhead const& ahead, dvec3 const& origin, dvec3 const& direction,
              double to, Candidate& found) {
    if (ahead.crossing && ahead.crossing->t <= to)
        found = object.candidate(*ahead.crossing, object.local(origin, direction));
    return INFINITY;
}

/// Below this many objects asking each is quicker than a hierarchy of boxes (measured: six spheres against
/// Embree).
constexpr std::size_t few = 6;

/// Four numbers in one register.
using Lanes [[gnu::vector_size(32)]] = double;

/// A line made ready for boxes: all axes at once; the fourth lane is no axis.
struct Slabs {
    Lanes origin, per_metre; // 1/direction
    double margin;           // far above rounding

    Slabs(dvec3 const& from, dvec3 const& direction)
        : origin{from.x, from.y, from.z, 0.0}, per_metre{1.0 / direction.x, 1.0 / direction.y,
                                                         1.0 / direction.z, 1.0},
          margin(1e-12 * length(from)) {}

    /// t where the line enters the box, or `from`, if it starts inside; ∞: it misses it.
    double entry(Bounds const& box, double from, double to) const {
        dvec3 const size = box.high - box.low;
        double const room = margin + 1e-12 * (size.x + size.y + size.z);
        Lanes const low{box.low.x, box.low.y, box.low.z, 0.0}, high{box.high.x, box.high.y, box.high.z, 0.0};
        Lanes const one = (low - room - origin) * per_metre, other = (high + room - origin) * per_metre;
        // comparisons with 0/0 are false: it constrains nothing
        Lanes const near = one < other ? one : other, far = one < other ? other : one;
        for (int axis = 0; axis < 3; ++axis) {
            from = near[axis] > from ? near[axis] : from;
            to = far[axis] < to ? far[axis] : to;
        }
        return from <= to ? from : INFINITY;
    }
    bool misses(Bounds const& box, double from, double to) const { return entry(box, from, to) == INFINITY; }
};

PatchKind patch_kind(Curving curving) {
    return curving == Curving::quadratic ? PatchKind::quadratic
           : curving == fitted_apart     ? PatchKind::apart
                                         : PatchKind::fitted;
}

} // namespace

Bvh::Bvh(std::vector<PlacedGeometry> geometries, MeshStore* store) : state_(std::make_unique<State>()) {
    MeshStore own; // instances share what is made of a mesh
    MeshStore& made = store ? *store : own;
    std::map<std::pair<Mesh const*, Curving>, std::shared_ptr<CurvedTree const>> curved;
    std::map<std::pair<Mesh const*, Curving>, std::shared_ptr<CurvedSheet const>> curved_sheets;
    auto const meeting = [&](PlacedGeometry const& geometry) {
        MeshMeeting by;
        auto const* const mesh = std::get_if<std::shared_ptr<Mesh const>>(&geometry.geometry);
        if (mesh && geometry.open)
            by.sheet = made.sheet(*mesh);
        else if (mesh && geometry.curving == Curving::none)
            by.tree = made.tree(*mesh);
        else if (mesh) {
            auto& one = curved[{mesh->get(), geometry.curving}];
            if (!one)
                one = std::make_shared<CurvedTree const>(*mesh, patch_kind(geometry.curving));
            by.curved = one;
        }
        return by;
    };
    for (PlacedGeometry& geometry : geometries) {
        MeshMeeting by = meeting(geometry);
        state_->objects.push_back(place(std::move(geometry), std::move(by)));
        Placed const& placed = state_->objects.back();
        auto& list = placed.bounded ? state_->bounded : state_->unbounded;
        list.push_back(static_cast<std::uint32_t>(state_->objects.size() - 1));
    }
    state_->touch = Touching(state_->objects);
    if (!state_->touch.to_make_flush().empty()) {
        for (FlushMesh& flush : sahl::made_flush(state_->objects, state_->touch.to_make_flush())) {
            Placed& object = state_->objects[flush.object];
            PlacedGeometry geometry = object.geometry;
            geometry.geometry = flush.mesh;
            MeshMeeting by = meeting(geometry);
            object = place(std::move(geometry), std::move(by));
            state_->made_flush.push_back({flush.object, flush.farthest});
        }
        state_->touch = Touching(state_->objects);
    }
    // a mesh that touches nothing may be met as the exact solid that it stands for; one that does is cemented
    // to what has the same vertices
    bool some_recognised = false;
    for (std::uint32_t i = 0; i < state_->objects.size(); ++i) {
        Placed& object = state_->objects[i];
        bool touches = !is_recognition(object.geometry.curving);
        for (std::uint32_t other = 0; !touches && other < state_->objects.size(); ++other)
            touches = state_->touch.objects(i, other);
        if (touches)
            continue;
        if (auto exact = recognised(object)) {
            object = std::move(*exact);
            some_recognised = true;
        }
    }
    if (some_recognised)
        state_->touch = Touching(state_->objects);
    // an open mesh that touches nothing too, as the surface that it stands for
    for (std::uint32_t i = 0; i < state_->objects.size(); ++i) {
        PlacedGeometry const& geometry = state_->objects[i].geometry;
        auto const* const mesh = std::get_if<std::shared_ptr<Mesh const>>(&geometry.geometry);
        bool flat = !mesh || !geometry.open || geometry.curving == Curving::none;
        for (std::uint32_t other = 0; !flat && other < state_->objects.size(); ++other)
            flat = state_->touch.objects(i, other);
        if (flat)
            continue;
        auto& sheet = curved_sheets[{mesh->get(), geometry.curving}];
        if (!sheet)
            sheet = std::make_shared<CurvedSheet const>(*mesh, patch_kind(geometry.curving));
        MeshMeeting by;
        by.curved_sheet = sheet;
        PlacedGeometry kept = geometry;
        state_->objects[i] = place(std::move(kept), std::move(by));
    }
    if (state_->bounded.size() > few) {
        std::vector<Bounds> boxes;
        for (std::uint32_t object : state_->bounded)
            boxes.push_back(state_->objects[object].box);
        state_->tree.emplace(boxes);
    } else {
        state_->cluster = MeshCluster::of(state_->objects);
        for (std::size_t i = 0; state_->cluster && i < state_->bounded.size(); ++i)
            state_->in_cluster |= std::uint32_t(state_->cluster->holds(state_->bounded[i])) << i;
    }
    state_->lone = state_->objects.size() == 1 && !state_->touch.objects(0, 0);
    state_->choose_mesh_for_packets();
}

Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;
Bvh::~Bvh() = default;

/// The largest, unless it shares a tree with others.
void Bvh::State::choose_mesh_for_packets() {
    std::size_t most = 0;
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        MeshTree const* const mesh = tree_of(objects[i]);
        if (!mesh || !mesh->looks_ahead() || (cluster && cluster->holds(i)) ||
            mesh->mesh().soup.triangles.size() <= most)
            continue;
        most = mesh->mesh().soup.triangles.size();
        seen_ahead = i;
    }
}

double Bvh::size_seen_ahead() const {
    if (!state_->seen_ahead)
        return 0.0;
    Bounds const& box = state_->objects[*state_->seen_ahead].box;
    return length(box.high - box.low);
}

void Bvh::look_ahead(std::span<Line const> lines, std::span<SeenAhead> seen) const {
    Placed const& object = state_->objects[*state_->seen_ahead];
    InlineVector<MeshTree::Line, most_together> asked;
    for (Line const& line : lines) {
        Placed::LocalRay const ray = object.local(*line.origin, *line.direction);
        asked.push_back({ray.origin,
                         ray.direction,
                         length(ray.direction),
                         {*line.inside, object.geometry.first_shell},
                         ray.rounding});
    }
    tree_of(object)->next_together({asked.begin(), asked.size()}, seen);
}

/// A lone object is met directly: nothing lies before it, and nothing touches it.
NextHit Bvh::State::next_of_lone(dvec3 const& origin, dvec3 const& direction, ShellSet const& inside,
                                 double from, SeenAhead const* ahead) const {
    NextHit hit;
    Candidate found;
    double const contradiction =
        ahead && ahead->known ? recall(objects.front(), *ahead, origin, direction, INFINITY, found)
                              : objects.front().next(origin, direction, inside, {from, INFINITY}, {}, found);
    if (found.t == INFINITY || contradiction < found.t) {
        hit.proof = contradiction < INFINITY || !inside.empty() ? Proof::leak : Proof::clean;
        hit.t = contradiction;
        return hit;
    }
    hit.at_one_place.push_back(objects.front().finished(found, origin, direction, from));
    hit.t = std::max(found.t, from);
    hit.blur = found.blur;
    hit.proof = found.recovered ? Proof::recovered : Proof::clean;
    return hit;
}

namespace {

/// The nearest crossings so far.
struct Nearest {
    InlineVector<Candidate, 16> candidates;
    double horizon = INFINITY; // nothing beyond it can be at the nearest place
    double dropped = INFINITY; // the nearest t that one for which there was no room may have

    void take(Candidate const& found) {
        if (candidates.full()) { // keep the nearer ones
            auto* const farthest = std::max_element(candidates.begin(), candidates.end(),
                                                    [](auto const& a, auto const& b) { return a.t < b.t; });
            Candidate const& out = found.t >= farthest->t ? found : *farthest;
            dropped = std::min(dropped, out.t - out.blur);
            if (&out == &found)
                return;
            candidates.erase(farthest);
        }
        candidates.push_back(found);
        horizon = std::min(horizon, found.t + 2.0 * std::min(found.blur, std::abs(found.t) + 1.0));
    }
};

} // namespace

NextHit Bvh::next(dvec3 const& origin, dvec3 const& direction, ShellSet const& inside, LeftSheets const& left,
                  double from, SeenAhead const* ahead) const {
    State const& state = *state_;
    if (state.lone && left.empty())
        return state.next_of_lone(origin, direction, inside, from, ahead);
    Nearest nearest_ones;
    auto& candidates = nearest_ones.candidates;
    double& horizon = nearest_ones.horizon;
    double contradiction = INFINITY;

    auto const take = [&](Candidate const& found) {
        nearest_ones.take(found);
        if (found.primitive < 0 || found.open || !state.touch(found, found))
            return;
        // another shell of the mesh lies on this one
        Placed const& object = state.objects[found.object];
        Candidate second;
        object.next(origin, direction, object.after(found, inside), {found.t, horizon}, {}, second);
        second.object = found.object;
        if (second.t <= found.t + found.blur + second.blur && state.touch(second, second))
            nearest_ones.take(second);
    };
    auto const ask = [&](std::uint32_t index) {
        Placed const& object = state.objects[index];
        std::optional<bool> above;
        for (LeftSheet const& sheet : left)
            if (sheet.object == index)
                above = bool(sheet.above);
        Candidate found;
        bool const known = ahead && ahead->known && index == state.seen_ahead;
        contradiction = std::min(
            contradiction, known ? recall(object, *ahead, origin, direction, horizon, found)
                                 : object.next(origin, direction, inside, {from, horizon}, above, found));
        if (found.t == INFINITY)
            return;
        found.object = index;
        take(found);
    };

    for (std::uint32_t const index : state.unbounded)
        ask(index);
    if (state.tree) {
        state.tree->visit(origin, direction, {from, horizon}, [&](std::uint32_t box, double) {
            ask(state.bounded[box]);
            return horizon;
        });
    } else {
        // what the ray is in must be left: asked first, that bounds the way to anything else
        std::uint32_t asked = 0; // a bit each
        static_assert(few <= 32);
        std::size_t const count = state.bounded.size();
        InlineVector<Candidate, MeshCluster::most> found;
        InlineVector<std::uint32_t, MeshCluster::most> alone;
        if (state.cluster &&
            state.cluster->next(state.objects, origin, direction, inside, from, found, alone)) {
            for (Candidate const& each : found)
                take(each);
            asked = state.in_cluster;
            for (std::size_t i = 0; !alone.empty() && i < count; ++i)
                if (std::find(alone.begin(), alone.end(), state.bounded[i]) != alone.end())
                    asked &= ~(1u << i);
        }
        if (!inside.empty() || count == 1)
            for (std::size_t i = 0; i < count; ++i)
                if (!(asked >> i & 1u) &&
                    (count == 1 || inside.contains(state.objects[state.bounded[i]].geometry.first_shell))) {
                    ask(state.bounded[i]);
                    asked |= 1u << i;
                }
        Slabs const slabs(origin, direction);
        for (std::size_t i = 0; i < count; ++i)
            if (!(asked >> i & 1u) && !slabs.misses(state.objects[state.bounded[i]].box, from, horizon))
                ask(state.bounded[i]);
    }

    // a ray that starts closer to a face than float tells, and comes to it at a slope that float does not
    // tell either: what touches there may not have been proposed
    for (std::size_t i = 0, count = candidates.size(); i < count; ++i) {
        std::span<std::uint32_t const> const touching = state.touch.at(candidates[i]);
        Candidate const& found = candidates[i];
        if (touching.empty() || !state.objects[found.object].grazes(found, origin, direction))
            continue;
        for (std::uint32_t const other : touching) {
            bool const known = std::any_of(candidates.begin(), candidates.end(),
                                           [&](Candidate const& c) { return c.object == other; });
            Candidate second;
            if (!known)
                state.objects[other].next_exact(origin, direction, inside, {from, horizon}, second);
            second.object = other;
            if (second.t < INFINITY)
                take(second);
        }
    }

    NextHit hit;
    if (candidates.empty()) {
        hit.proof = contradiction < INFINITY || !inside.empty() ? Proof::leak : Proof::clean;
        hit.t = contradiction;
        return hit;
    }
    if (candidates.size() == 1 && contradiction == INFINITY) { // as nearly always
        Candidate const& only = candidates.front();
        hit.at_one_place.push_back(state.objects[only.object].finished(only, origin, direction, from));
        hit.t = std::max(only.t, from);
        hit.blur = only.blur;
        hit.proof = only.recovered ? Proof::recovered : Proof::clean;
        return hit;
    }
    auto const rank = [&](Candidate const& c) {
        // bodies are left before others are entered: what only seems to overlap by rounding does not
        return std::tuple(!state.objects[c.object].geometry.detector, !c.open, !c.open && c.enters, c.object);
    };
    Candidate const nearest =
        *std::min_element(candidates.begin(), candidates.end(), [&](auto const& a, auto const& b) {
            return std::pair(a.t, rank(a)) < std::pair(b.t, rank(b));
        });
    // at the same place as well: what a torn mesh lies on does not hide that it was entered through a hole
    if (contradiction < INFINITY && contradiction <= nearest.t + nearest.blur) {
        hit.proof = Proof::leak;
        hit.t = contradiction;
        return hit;
    }
    hit.fits = nearest_ones.dropped > nearest.t + nearest.blur;
    // in the order in which they count
    std::sort(candidates.begin(), candidates.end(),
              [&](auto const& a, auto const& b) { return rank(a) < rank(b); });
    InlineVector<Candidate, 8> together;
    for (Candidate const& c : candidates) {
        if (c.object != nearest.object && c.t > nearest.t + nearest.blur + c.blur)
            continue;
        if (c.object != nearest.object && !state.touch(c, nearest)) {
            hit.fits = hit.fits && !(c.open && hit.beside.full());
            if (c.open && hit.fits)
                hit.beside.push_back({c.object, c.enters});
        } else if (!together.full()) {
            together.push_back(c);
        } else {
            hit.fits = false;
        }
    }
    for (Candidate const& c : together)
        hit.at_one_place.push_back(state.objects[c.object].finished(c, origin, direction, from));
    hit.t = std::max(nearest.t, from);
    hit.blur = nearest.blur;
    hit.proof = nearest.recovered ? Proof::recovered : Proof::clean;
    return hit;
}

LeftSheets Bvh::still_there(LeftSheets const& left, dvec3 const& point) const {
    LeftSheets there;
    for (LeftSheet const& sheet : left)
        if (state_->objects[sheet.object].lies_at(point))
            there.push_back(sheet);
    return there;
}

Bvh::Start Bvh::start_at(dvec3 const& point, dvec3 const& direction) const {
    Start start;
    double const margin = 1e-12 * length(point); // far above rounding
    auto const ask = [&](std::uint32_t index) {
        state_->objects[index].start(point, direction, index, start);
    };
    for (std::uint32_t const index : state_->unbounded)
        ask(index);
    std::vector<std::uint32_t> near;
    if (state_->tree)
        state_->tree->visit(point, direction, {-margin, margin}, [&](std::uint32_t box, double to) {
            near.push_back(state_->bounded[box]);
            return to;
        });
    else
        for (Slabs const slabs(point, direction); std::uint32_t const index : state_->bounded)
            if (!slabs.misses(state_->objects[index].box, -margin, margin))
                near.push_back(index);
    std::sort(near.begin(), near.end()); // the order must not depend on how boxes are found
    for (std::uint32_t const index : near)
        ask(index);
    return start;
}

dmat3 Bvh::turning(std::uint32_t object, FaceId face, std::int32_t primitive, dvec3 const& point,
                   dvec3 const& normal) const {
    Placed const& placed = state_->objects[object];
    return placed.turning(face.value - placed.geometry.first_face.value, primitive, point, normal);
}

std::vector<std::pair<FaceId, FaceId>> const& Bvh::contacts() const {
    return state_->touch.faces();
}

std::vector<Bvh::Tangency> const& Bvh::tangencies() const {
    return state_->touch.tangencies();
}

Curving Bvh::curving(std::uint32_t object) const {
    Placed const& placed = state_->objects[object];
    Curving const asked = placed.geometry.curving;
    if (placed.geometry.open && !std::holds_alternative<std::shared_ptr<CurvedSheet const>>(placed.met_by))
        return Curving::none;
    return is_recognition(asked) && placed.face_of_region.empty() ? Curving::fitted : asked;
}

std::vector<Bvh::MadeFlush> const& Bvh::made_flush() const {
    return state_->made_flush;
}

std::vector<Bvh::Closeness> Bvh::closeness(double near) const {
    return survey(state_->objects, state_->touch, near);
}

std::pair<dvec3, dvec3> Bvh::bounds() const {
    Bounds all{dvec3(INFINITY), dvec3(-INFINITY)};
    for (std::uint32_t const index : state_->bounded)
        all = {glm::min(all.low, state_->objects[index].box.low),
               glm::max(all.high, state_->objects[index].box.high)};
    return {all.low, all.high};
}

} // namespace sahl
