#include "geometry/mesh_cluster.h"

#include "geometry/mesh_query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <new>
#include <type_traits>

namespace sahl {

namespace {

/// A tree's triangles are grown in proportion to its size, which must not be large for the triangles of any
/// member.
constexpr double largest_ratio = 8.0;

MeshTree const* tree_of(Placed const& object) {
    auto const* const tree = std::get_if<std::shared_ptr<MeshTree const>>(&object.met_by);
    return tree ? tree->get() : nullptr;
}

/// Slopes are then the same in the mesh's frame and in the world.
bool keeps_angles(dmat3 const& linear) {
    dmat3 const product = glm::transpose(linear) * linear;
    double const scale = product[0][0];
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (std::abs(product[column][row] - (row == column ? scale : 0.0)) > 1e-9 * scale)
                return false;
    return true;
}

/// A member's question, made only when it is asked: most rays come near one or two.
struct Slot {
    union {
        Placed::LocalRay ray;
    };
    union {
        MeshQuery query;
    };
    bool used = false;

    Slot() {}
    Slot(Slot const&) = delete;
    ~Slot() {}
    void ask(Placed::LocalRay const& of_member, MeshQuery const& question) {
        ::new (&ray) Placed::LocalRay(of_member);
        ::new (&query) MeshQuery(question);
        used = true;
    }
};
static_assert(std::is_trivially_destructible_v<Placed::LocalRay> &&
              std::is_trivially_destructible_v<MeshQuery>);

double size_of(Bounds const& box) {
    return length(box.high - box.low);
}

} // namespace

std::optional<MeshCluster> MeshCluster::of(std::span<Placed const> objects) {
    std::map<MeshTree const*, int> uses; // an instance's tree serves many
    for (Placed const& object : objects)
        ++uses[tree_of(object)];
    std::vector<std::uint32_t> fit;
    double largest = 0.0;
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        MeshTree const* const tree = tree_of(objects[i]);
        if (!tree || uses[tree] > 1 || !keeps_angles(objects[i].geometry.to_world.linear))
            continue;
        fit.push_back(i);
        largest = std::max(largest, size_of(objects[i].box));
    }
    std::erase_if(fit, [&](std::uint32_t i) { return size_of(objects[i].box) * largest_ratio < largest; });
    Bounds all{dvec3(INFINITY), dvec3(-INFINITY)};
    for (std::uint32_t const i : fit)
        all = {glm::min(all.low, objects[i].box.low), glm::max(all.high, objects[i].box.high)};
    if (fit.size() < 2 || fit.size() > most || size_of(all) > largest_ratio * largest)
        return std::nullopt;

    std::vector<Member> members;
    std::vector<std::array<dvec3, 3>> triangles;
    for (std::uint32_t const i : fit) {
        members.push_back({i, static_cast<std::uint32_t>(triangles.size())});
        MeshTree const& tree = *tree_of(objects[i]);
        Affine const& to_world = objects[i].geometry.to_world;
        bool const mirrored = glm::determinant(to_world.linear) < 0.0;
        for (std::uint32_t t = 0; t < tree.mesh().soup.triangles.size(); ++t) {
            auto corners = tree.corners(t);
            if (mirrored)
                std::swap(corners[1], corners[2]);
            for (dvec3& corner : corners)
                corner = to_world.point(corner);
            triangles.push_back(corners);
        }
    }
    return MeshCluster(std::move(members), TriangleTree(triangles));
}

bool MeshCluster::holds(std::uint32_t object) const {
    return std::any_of(members_.begin(), members_.end(), [&](Member const& m) { return m.object == object; });
}

bool MeshCluster::may_be_crossed(Placed const& object, dvec3 const& origin, dvec3 const& direction,
                                 ShellSet const& inside, Reach reach) const {
    if (reach.to == INFINITY)
        return false;
    // in the world first: few rays start in the box of a body that they do not meet
    double const lift = triangles_.lift();
    dvec3 const start = origin + reach.from * direction;
    dvec3 const out = glm::max(object.box.low - start, start - object.box.high);
    if (std::max({out.x, out.y, out.z}) > lift)
        return false;
    MeshTree const& tree = *tree_of(object);
    for (std::uint32_t shell = 0; shell < tree.mesh().shells.size(); ++shell)
        if (InsideShells{inside, object.geometry.first_shell}[shell])
            return true;
    Placed::LocalRay const ray = object.local(origin, direction);
    return tree.may_hide(ray.origin, ray.direction, reach, lift * length(object.to_local.linear[0]));
}

bool MeshCluster::next(std::span<Placed const> objects, dvec3 const& origin, dvec3 const& direction,
                       ShellSet const& inside, double from, InlineVector<Candidate, most>& found,
                       InlineVector<std::uint32_t, most>& alone) const {
    double const unit = length(direction), blur = triangles_.blur() / unit;
    std::array<Slot, most> asked; // once something is proposed
    double looked_to = INFINITY;
    triangles_.visit(origin, direction, unit, {from, INFINITY}, [&](Proposal const& proposal) {
        std::size_t m = members_.size() - 1;
        while (proposal.triangle < members_[m].first_triangle)
            --m;
        Slot& slot = asked[m];
        if (!slot.used) {
            Placed const& object = objects[members_[m].object];
            Placed::LocalRay const ray = object.local(origin, direction);
            slot.ask(ray, MeshQuery(*tree_of(object), ray.origin, ray.direction,
                                    object.moved ? length(ray.direction) : unit,
                                    {inside, object.geometry.first_shell}, from, ray.rounding, blur));
        }
        double const to =
            slot.query.take(proposal.triangle - members_[m].first_triangle, proposal.t, proposal.sense);
        looked_to = std::min(looked_to, to);
        return to;
    });
    for (std::size_t m = 0; m < members_.size(); ++m) {
        MeshAnswer answer;
        if (asked[m].used && !asked[m].query.settle(looked_to, answer.crossing)) {
            found.clear();
            alone.clear();
            return false;
        }
        if (!answer.crossing &&
            may_be_crossed(objects[members_[m].object], origin, direction, inside, {from, looked_to}))
            alone.push_back(members_[m].object);
        if (answer.crossing) {
            found.push_back(objects[members_[m].object].candidate(*answer.crossing, asked[m].ray));
            found.back().object = members_[m].object;
        }
    }
    // what was not proposed lies beyond what was; where nothing was met, what the ray is in is never left
    return !found.empty() || (inside.empty() && looked_to == INFINITY);
}

} // namespace sahl
