#include "geometry/bvh.h"

#include "geometry/bvh_state.h"
#include "geometry/mesh_store.h"
#include "geometry/pilot_curving.h"
#include "geometry/survey.h"

#include <algorithm>
#include <map>

namespace sahl {

namespace {

MeshTree const* tree_of(Placed const& object) {
    auto const* const tree = std::get_if<std::shared_ptr<MeshTree const>>(&object.met_by);
    return tree ? tree->get() : nullptr;
}

PatchKind patch_kind(Curving curving) {
    return curving == Curving::quadratic ? PatchKind::quadratic
           : curving == fitted_apart     ? PatchKind::apart
                                         : PatchKind::fitted;
}

} // namespace

Bvh::Bvh(std::vector<PlacedGeometry> geometries, MeshStore* store) : state_(std::make_unique<State>()) {
    MeshStore own; // instances share what is made of a mesh
    MeshStore& made = store ? *store : own;
    std::map<std::pair<Mesh const*, Curving>, std::shared_ptr<CurvedSheet const>> curved_sheets;
    auto const meeting = [&](PlacedGeometry const& geometry) {
        MeshMeeting by;
        auto const* const mesh = std::get_if<std::shared_ptr<Mesh const>>(&geometry.geometry);
        if (mesh && geometry.open)
            by.sheet = made.sheet(*mesh);
        else if (mesh && geometry.curving == Curving::none)
            by.tree = made.tree(*mesh);
        else if (mesh)
            by.curved = made.curved(*mesh, patch_kind(geometry.curving));
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
    if (state_->bounded.size() > State::few) {
        std::vector<Bounds> boxes;
        for (std::uint32_t object : state_->bounded)
            boxes.push_back(state_->objects[object].box);
        state_->tree.emplace(boxes);
    } else {
        for (std::size_t i = 0; i < state_->bounded.size(); ++i) {
            Placed const& object = state_->objects[state_->bounded[i]];
            state_->boxes[i / boxes_at_once].set(static_cast<int>(i % boxes_at_once), object.box);
            state_->first_shell[i] = object.geometry.first_shell;
        }
        state_->cluster = MeshCluster::of(state_->objects);
        for (std::size_t i = 0; state_->cluster && i < state_->bounded.size(); ++i)
            state_->in_cluster |= std::uint32_t(state_->cluster->holds(state_->bounded[i])) << i;
    }
    state_->apart = state_->touch.none() && !state_->cluster;
    state_->lone = state_->objects.size() == 1 && !state_->touch.objects(0, 0);
    state_->choose_mesh_seen_ahead();
}

Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;
Bvh::~Bvh() = default;

/// The largest, unless it shares a tree with others.
void Bvh::State::choose_mesh_seen_ahead() {
    std::size_t most = 0;
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        MeshTree const* const mesh = tree_of(objects[i]);
        if (!mesh || (cluster && cluster->holds(i)) || mesh->mesh().soup.triangles.size() <= most)
            continue;
        most = mesh->mesh().soup.triangles.size();
        seen_ahead = i;
    }
}

double Bvh::size_seen_ahead() const {
    if (!state_->seen_ahead || !tree_of(state_->objects[*state_->seen_ahead])->looks_ahead())
        return 0.0;
    Bounds const& box = state_->objects[*state_->seen_ahead].box;
    return length(box.high - box.low);
}

void Bvh::look_ahead(std::span<Line const> lines, std::span<SeenAhead> seen) const {
    Placed const& object = state_->objects[*state_->seen_ahead];
    MeshTree::Lines asked;
    asked.first = object.geometry.first_shell;
    for (Line const& line : lines) {
        Placed::LocalRay const ray = object.local(*line.origin, *line.direction);
        asked.add(ray.origin, ray.direction, ray.rounding, *line.inside);
    }
    tree_of(object)->next_together(asked, seen);
}

bool Bvh::looks_ahead_in_turn() const {
    return state_->seen_ahead.has_value();
}

bool Bvh::State::asks_ahead(Line const& line) const {
    Placed const& object = objects[*seen_ahead];
    if (!line.inside->empty())
        return InsideShells{*line.inside, object.geometry.first_shell}.any_of(
            tree_of(object)->mesh().shells.size());
    if (bounded.size() == 1)
        return true;
    if (tree)
        return false;
    Slabs const slabs(*line.origin, *line.direction);
    std::array<double, boxes_at_once * rows> entry;
    double first = INFINITY, of_mesh = INFINITY;
    for (std::size_t row = 0; boxes_at_once * row < bounded.size(); ++row)
        slabs.entries(boxes[row], 0.0, INFINITY, &entry[boxes_at_once * row]);
    for (std::size_t i = 0; i < bounded.size(); ++i) {
        double& nearest = bounded[i] == *seen_ahead ? of_mesh : first;
        nearest = std::min(nearest, entry[i]);
    }
    return of_mesh < INFINITY && of_mesh <= first;
}

void Bvh::look_ahead_in_turn(std::span<Line const> lines, std::span<SeenAhead* const> seen) const {
    Placed const& object = state_->objects[*state_->seen_ahead];
    MeshTree::Lines asked;
    asked.first = object.geometry.first_shell;
    std::array<SeenAhead*, most_together> of;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!state_->asks_ahead(lines[i]))
            continue;
        of[asked.lines.count] = seen[i];
        Placed::LocalRay const ray = object.local(*lines[i].origin, *lines[i].direction);
        asked.add(ray.origin, ray.direction, ray.rounding, *lines[i].inside);
    }
    tree_of(object)->next_in_turn(asked, of);
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
    Slabs const slabs(point, direction);
    std::vector<std::uint32_t> near;
    if (state_->tree)
        state_->tree->visit(point, direction, {-margin, margin}, [&](std::uint32_t box, double to) {
            near.push_back(state_->bounded[box]);
            return to;
        });
    else
        for (std::size_t i = 0; i < state_->bounded.size(); ++i) {
            std::array<double, boxes_at_once> entry;
            std::uint32_t const met =
                slabs.entries(state_->boxes[i / boxes_at_once], -margin, margin, entry.data());
            if (met >> i % boxes_at_once & 1U)
                near.push_back(state_->bounded[i]);
        }
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
