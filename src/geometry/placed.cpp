#include "geometry/placed.h"

#include "geometry/pilot_curving.h"
#include "geometry/recognise.h"
#include "geometry/region.h"
#include "math/overloaded.h"

namespace sahl {

namespace {

using Tree = std::shared_ptr<MeshTree const>;
using Sheet = std::shared_ptr<MeshSheet const>;
using Curved = std::shared_ptr<RevolvedSheet const>;
using Patches = std::shared_ptr<CurvedTree const>;
using OpenPatches = std::shared_ptr<CurvedSheet const>;

Bounds world_box(dvec3 const& low, dvec3 const& high, Affine const& to_world) {
    Bounds box{dvec3(INFINITY), dvec3(-INFINITY)};
    for (int corner = 0; corner < 8; ++corner) {
        dvec3 const p = to_world.point(
            {corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
        box = {glm::min(box.low, p), glm::max(box.high, p)};
    }
    return box;
}

std::pair<dvec3, dvec3> sheet_box(Shape const& sheet) {
    return std::visit(Overloaded{
                          [](Rectangle const& s) {
                              dvec3 const high(0.5 * s.size.x, 0.5 * s.size.y, 0.0);
                              return std::pair(-high, high);
                          },
                          [](Disk const& s) {
                              dvec3 const high(s.radius, s.radius, 0.0);
                              return std::pair(-high, high);
                          },
                          [](auto const&) {
                              return std::pair(dvec3(-INFINITY, -INFINITY, 0.0),
                                               dvec3(INFINITY, INFINITY, 0.0));
                          },
                      },
                      sheet);
}

} // namespace

Placed place(PlacedGeometry geometry, MeshMeeting by) {
    Affine const to_world = geometry.to_world;
    std::pair<dvec3, dvec3> box;
    auto met_by = [&]() -> decltype(Placed::met_by) {
        if (by.curved) {
            box = {by.curved->box().low, by.curved->box().high};
            return by.curved;
        }
        if (by.curved_sheet) {
            box = {by.curved_sheet->box().low, by.curved_sheet->box().high};
            return by.curved_sheet;
        }
        if (by.tree || by.sheet) {
            Mesh const& mesh = by.tree ? by.tree->mesh() : by.sheet->mesh();
            box = {mesh.low, mesh.high};
            if (by.tree)
                return by.tree;
            return by.sheet;
        }
        Shape const& shape = std::get<Shape>(geometry.geometry);
        if (auto const* const mirror = std::get_if<ConicMirror>(&shape)) {
            double const h = 0.5 * mirror->diameter;
            auto curved =
                std::make_shared<RevolvedSheet const>(form_of(*mirror), h, 0.5 * mirror->hole_diameter);
            auto const [low, high] = curved->heights();
            box = {{-h, -h, low}, {h, h, high}};
            return curved;
        }
        if (is_open(shape)) {
            box = sheet_box(shape);
            return shape;
        }
        Solid solid(shape);
        box = {solid.low(), solid.high()};
        return solid;
    }();
    Placed placed{std::move(geometry),
                  std::move(met_by),
                  {},
                  inverse(to_world),
                  !(to_world == Affine{}),
                  false,
                  0.0,
                  0.0,
                  {},
                  true};
    placed.turned = to_world.linear != dmat3(1.0);
    placed.bounded = std::isfinite(box.second.x);
    placed.extent = length(glm::max(glm::abs(box.first), glm::abs(box.second)));
    placed.rounding = start_ulps * ((placed.bounded ? placed.extent : 0.0) + length(placed.to_local.offset));
    if (placed.bounded)
        placed.box = world_box(box.first, box.second, to_world);
    return placed;
}

std::optional<Placed> recognised(Placed const& placed) {
    Patches const* const patches = std::get_if<Patches>(&placed.met_by);
    auto found =
        patches ? recognise((*patches)->fans(), vertices_for(placed.geometry.curving)) : std::nullopt;
    if (!found)
        return std::nullopt;
    Placed as_solid = placed;
    as_solid.met_by = std::move(found->solid);
    as_solid.face_of_region = std::move(found->face_of_region);
    return as_solid;
}

namespace {

/// Met straight on, a triangle has no extent along the line: what is left is rounding.
double least_blur(Placed::LocalRay const& ray) {
    return ray.rounding / length(ray.direction);
}

/// What is met of patches.
///   off   m: how far rounding may move it, along the normal
void set(Candidate& found, CurvedCrossing const& c, Mesh const& mesh, bool open, double off,
         Placed::LocalRay const& ray) {
    found.set(c.t, c.slope > 0.0 ? std::max(off / c.slope, least_blur(ray)) : INFINITY,
              mesh.face_of(c.triangle), open, c.enters, c.triangle, c.uv, c.normal);
    found.recovered = c.recovered;
    found.point = c.point;
    found.geometric = c.geometric;
}

} // namespace

Candidate Placed::candidate(MeshCrossing const& c, LocalRay const& ray) const {
    Candidate found;
    found.set(c.t, std::max(c.blur(ray.rounding), least_blur(ray)), mesh()->face_of(c.triangle), false,
              c.enters, c.triangle, c.uv, c.normal);
    found.recovered = c.recovered;
    found.well_within = c.well_within;
    return found;
}

double Placed::next_of_others(LocalRay const& ray, ShellSet const& inside, Reach reach,
                              std::optional<bool> above, Candidate& found) const {
    return std::visit(
        Overloaded{
            [&](Tree const& tree) {
                MeshAnswer const answer = tree->next(ray.origin, ray.direction,
                                                     {inside, geometry.first_shell}, reach, ray.rounding);
                if (answer.crossing)
                    found = candidate(*answer.crossing, ray);
                return answer.contradiction;
            },
            [&](Curved const& curved) {
                for (auto const& root : curved->roots(ray.origin, ray.direction, ray.rounding, false)) {
                    double const blur = std::min(ray.rounding / root.slope, curved->aperture());
                    if (root.t > reach.to)
                        break;
                    // where the ray starts on it, it goes away from the side that it is on
                    bool const left = std::abs(root.t) <= blur && above && *above == root.rises;
                    if (left || root.t < reach.from - blur ||
                        !curved->covers(ray.origin + root.t * ray.direction))
                        continue;
                    found.set(root.t, blur, 0, true, !root.rises);
                    break;
                }
                return INFINITY + 0.0;
            },
            [&](Patches const& patches) {
                CurvedAnswer const answer = patches->next(
                    ray.origin, ray.direction, {inside, geometry.first_shell}, reach, ray.rounding);
                if (answer.crossing)
                    set(found, *answer.crossing, patches->mesh(), false,
                        patches->blur(answer.crossing->triangle, ray.rounding), ray);
                return answer.contradiction;
            },
            [&](OpenPatches const& sheet) {
                if (auto const c = sheet->next(ray.origin, ray.direction, reach, ray.rounding, above))
                    set(found, *c, sheet->mesh(), true, sheet->blur(c->triangle, ray.rounding), ray);
                return INFINITY + 0.0;
            },
            [&](Sheet const& sheet) {
                if (auto const m = sheet->next(ray.origin, ray.direction, reach, ray.rounding, above))
                    found.set(m->t, std::max(m->blur(ray.rounding), least_blur(ray)),
                              sheet->mesh().face_of(m->triangle), true, m->against, m->triangle, m->uv,
                              sheet->normal(m->triangle));
                return INFINITY + 0.0;
            },
            [](auto const&) { return INFINITY + 0.0; },
        },
        met_by);
}

void Placed::next_exact(dvec3 const& origin, dvec3 const& direction, ShellSet const& inside, Reach reach,
                        Candidate& found) const {
    Tree const* const tree = std::get_if<Tree>(&met_by);
    if (!tree)
        return;
    LocalRay const ray = local(origin, direction);
    MeshAnswer const answer =
        (*tree)->next_exact(ray.origin, ray.direction, {inside, geometry.first_shell}, reach, ray.rounding);
    if (answer.crossing)
        found = candidate(*answer.crossing, ray);
}

ShellSet Placed::after(Candidate const& candidate, ShellSet const& inside) const {
    ShellId shell = geometry.first_shell;
    if (Mesh const* const of_mesh = mesh())
        shell.value += of_mesh->shell_of(static_cast<std::uint32_t>(candidate.primitive));
    ShellSet changed = inside;
    changed.erase(shell);
    if (candidate.enters)
        changed.insert(shell);
    return changed;
}

void Placed::start(dvec3 const& origin, dvec3 const& direction, std::uint32_t index, Bvh::Start& into) const {
    LocalRay const ray = local(origin, direction);
    auto const in = [&](std::uint32_t shell) {
        into.fits = into.inside.insert({geometry.first_shell.value + shell}) && into.fits;
    };
    auto const in_each = [&](std::vector<bool> const& states) {
        for (std::uint32_t shell = 0; shell < states.size(); ++shell)
            if (states[shell])
                in(shell);
    };
    auto const on = [&](bool above) {
        into.fits = into.fits && !into.on.full();
        if (!into.on.full())
            into.on.push_back({index, above});
    };
    std::visit(
        Overloaded{
            [&](Shape const& sheet) {
                if (std::abs(ray.origin.z) <= ray.rounding && covers(sheet, ray.origin.x, ray.origin.y))
                    on(ray.direction.z > 0.0);
            },
            [&](Curved const& curved) {
                if (std::abs(curved->distance(ray.origin)) <= ray.rounding && curved->covers(ray.origin))
                    on(dot(curved->normal(ray.origin), ray.direction) > 0.0);
            },
            [&](Sheet const& sheet) {
                if (auto const above = sheet->heads_above(ray.origin, ray.direction, ray.rounding))
                    on(*above);
            },
            [&](Solid const& solid) {
                if (solid.inside(ray.origin, ray.direction, 0.0, ray.rounding))
                    in(0);
            },
            [&](Tree const& tree) { in_each(tree->inside(ray.origin, ray.direction, ray.rounding)); },
            [&](Patches const& patches) {
                in_each(patches->inside(ray.origin, ray.direction, ray.rounding));
            },
            [&](OpenPatches const& sheet) {
                if (auto const above = sheet->heads_above(ray.origin, ray.direction, ray.rounding))
                    on(*above);
            },
        },
        met_by);
}

bool Placed::lies_at(dvec3 const& point) const {
    LocalRay const ray = local(point, dvec3(0.0));
    if (Sheet const* const sheet = std::get_if<Sheet>(&met_by))
        return (*sheet)->heads_above(ray.origin, ray.direction, ray.rounding).has_value();
    if (OpenPatches const* const sheet = std::get_if<OpenPatches>(&met_by))
        return (*sheet)->heads_above(ray.origin, ray.direction, ray.rounding).has_value();
    if (Curved const* const curved = std::get_if<Curved>(&met_by))
        return std::abs((*curved)->distance(ray.origin)) <= ray.rounding;
    return std::abs(ray.origin.z) <= ray.rounding;
}

namespace {

/// The vertices' normals, weighted, on the side of the triangle's own.
dvec3 smooth_normal(TriangleSoup const& soup, std::array<std::uint32_t, 3> const& vertices, dvec2 const& uv,
                    dvec3 const& facet) {
    if (soup.normals.empty())
        return facet;
    auto const& [a, b, c] = vertices;
    dvec3 const smooth =
        (1.0 - uv.x - uv.y) * soup.normals[a] + uv.x * soup.normals[b] + uv.y * soup.normals[c];
    // the file's normals point out of the glass as the triangles do, or the triangles were turned
    double const sense = dot(smooth, facet);
    return sense != 0.0 ? normalize(smooth * (sense < 0.0 ? -1.0 : 1.0)) : facet;
}

} // namespace

void Placed::finish(Candidate const& candidate, dvec3 const& origin, dvec3 const& direction, double from,
                    Crossing& crossing) const {
    LocalRay const ray = local(origin, direction);
    double const t = std::max(candidate.t, from);
    dvec3 point = ray.origin + t * ray.direction;
    dvec3 facet(0.0), normal(0.0);
    std::visit(
        Overloaded{
            [&](Shape const&) {
                point.z = 0.0;
                facet = normal = {0.0, 0.0, 1.0};
            },
            [&](Solid const& solid) { facet = normal = settle(solid.regions()[candidate.face], point); },
            [&](Curved const& curved) { facet = normal = curved->settle(point); },
            [&](Patches const&) {
                point = candidate.point;
                facet = candidate.geometric;
                normal = candidate.normal;
            },
            [&](OpenPatches const&) {
                point = candidate.point;
                facet = candidate.geometric;
                normal = candidate.normal;
            },
            [&](auto const& tree_or_sheet) {
                auto const triangle = static_cast<std::uint32_t>(candidate.primitive);
                facet = normal = candidate.normal;
                if constexpr (std::is_same_v<decltype(tree_or_sheet), Tree const&>)
                    point = candidate.well_within ? tree_or_sheet->onto(triangle, facet, point)
                                                  : tree_or_sheet->onto(triangle, point);
                else
                    point = tree_or_sheet->onto(triangle, point);
                if (geometry.interpolate)
                    normal = smooth_normal(tree_or_sheet->mesh().soup, tree_or_sheet->vertices(triangle),
                                           candidate.uv, facet);
            },
        },
        met_by);
    crossing.t = t;
    crossing.face = {geometry.first_face.value + local_face(candidate.face)};
    crossing.shell = geometry.first_shell;
    crossing.open = candidate.open;
    crossing.detector = geometry.detector;
    crossing.enters = candidate.enters;
    crossing.object = candidate.object;
    crossing.primitive = candidate.primitive;
    if (Mesh const* const of_mesh = mesh(); of_mesh && !candidate.open)
        crossing.shell.value += of_mesh->shell_of(static_cast<std::uint32_t>(candidate.primitive));
    crossing.point = point;
    crossing.normal = normal;
    crossing.facet_normal = facet;
    if (moved) {
        crossing.point = turned ? geometry.to_world.point(point) : point + geometry.to_world.offset;
        auto const to_world = [&](dvec3 const& local) {
            return normalize(turned ? local * to_local.linear : local); // by the transpose
        };
        crossing.facet_normal = to_world(facet);
        crossing.normal = normal == facet ? crossing.facet_normal : to_world(normal);
    }
}

namespace {

/// Of the point's foot on a triangle's plane.
dvec2 barycentric(TriangleSoup const& soup, std::uint32_t triangle, dvec3 const& point) {
    auto const& [a, b, c] = soup.triangles[triangle];
    dvec3 const u = soup.positions[b] - soup.positions[a], v = soup.positions[c] - soup.positions[a],
                p = point - soup.positions[a];
    double const uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), area = uu * vv - uv * uv;
    return {(dot(p, u) * vv - dot(p, v) * uv) / area, (dot(p, v) * uu - dot(p, u) * uv) / area};
}

bool is_flat(Placed const& placed, std::uint32_t face) {
    if (placed.mesh())
        return !placed.geometry.interpolate && placed.geometry.curving == Curving::none;
    if (Solid const* const solid = std::get_if<Solid>(&placed.met_by)) {
        Region::Kind const kind = solid->regions()[face].kind;
        return kind == Region::Kind::half_space || kind == Region::Kind::block;
    }
    bool const facets =
        std::holds_alternative<Tree>(placed.met_by) || std::holds_alternative<Sheet>(placed.met_by);
    return std::holds_alternative<Shape>(placed.met_by) || (facets && !placed.geometry.interpolate);
}

} // namespace

dmat3 Placed::turning(std::uint32_t face, std::int32_t primitive, dvec3 const& point,
                      dvec3 const& normal) const {
    if (is_flat(*this, face))
        return dmat3(0.0);
    // what a third power of the step leaves out, and what rounding over the step brings in, are both below
    // 1e-9
    double const step = 1e-5 * length(box.high - box.low);
    dvec3 const here = to_local.point(point);
    auto const normal_at = [&](dvec3 const& shift) {
        dvec3 at = here + to_local.vector(shift);
        dvec3 const local = std::visit(
            Overloaded{
                [&](Shape const&) { return dvec3(0.0, 0.0, 1.0); },
                [&](Solid const& solid) { return solid.settle(face, at); },
                [&](Curved const& curved) { return curved->settle(at); },
                [&](auto const& tree_or_sheet) {
                    TriangleSoup const& soup = tree_or_sheet->mesh().soup;
                    auto const triangle = static_cast<std::uint32_t>(primitive);
                    return smooth_normal(soup, soup.triangles[triangle], barycentric(soup, triangle, at),
                                         glm::transpose(geometry.to_world.linear) * normal);
                },
            },
            met_by);
        dvec3 const seen = normalize(glm::transpose(to_local.linear) * local);
        return dot(seen, normal) < 0.0 ? -seen : seen;
    };
    dmat3 turning(0.0);
    dvec3 const side = perpendicular_to(normal);
    for (dvec3 const& along : {side, cross(normal, side)}) {
        dvec3 const change = (normal_at(step * along) - normal_at(-step * along)) / (2.0 * step);
        turning += dmat3(along.x * change, along.y * change, along.z * change);
    }
    return turning;
}

Mesh const* Placed::mesh() const {
    if (Tree const* const tree = std::get_if<Tree>(&met_by))
        return &(*tree)->mesh();
    if (Sheet const* const sheet = std::get_if<Sheet>(&met_by))
        return &(*sheet)->mesh();
    if (Patches const* const patches = std::get_if<Patches>(&met_by))
        return &(*patches)->mesh();
    if (OpenPatches const* const sheet = std::get_if<OpenPatches>(&met_by))
        return &(*sheet)->mesh();
    return nullptr;
}

std::uint32_t Placed::face_count() const {
    if (Mesh const* const of_mesh = mesh())
        return static_cast<std::uint32_t>(of_mesh->soup.face_names.size());
    if (!face_of_region.empty())
        return static_cast<std::uint32_t>(face_of_region.size());
    return static_cast<std::uint32_t>(face_names(std::get<Shape>(geometry.geometry)).size());
}

Carriers Placed::carriers(std::uint32_t face) const {
    if (Solid const* const solid = std::get_if<Solid>(&met_by))
        return carriers_of(solid->regions()[face]);
    Curved const* const curved = std::get_if<Curved>(&met_by);
    Carriers one;
    one.push_back(curved ? carrier_of(**curved, dvec3(0.0)) : sheet_carrier());
    return one;
}

} // namespace sahl
