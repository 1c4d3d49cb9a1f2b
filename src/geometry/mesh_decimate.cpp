// With geometry/mesh_manifold.cpp the door to OpenMesh: its decimater.
#include "geometry/mesh_decimate.h"

#include "geometry/mesh_health_parts.h"
#include "geometry/triangle.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModHausdorffT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <algorithm>
#include <numeric>

namespace sahl {

namespace {

constexpr float most_turned = 30.0F; // deg, of a triangle by one collapse: creases begin there

struct InDouble : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
    FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
};
using Working = OpenMesh::TriMesh_ArrayKernelT<InDouble>;

/// Triangles by the soup's vertices; the place of each vertex is the working mesh's.
struct CornerBook {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> place; // of each of the soup's vertices

    std::uint32_t at(int triangle, int vertex) const {
        for (std::uint32_t const corner : triangles[static_cast<std::size_t>(triangle)])
            if (place[corner] == static_cast<std::uint32_t>(vertex))
                return corner;
        return 0xFFFFFFFFu;
    }
};

/// Lets a vertex go only into one that has the same normal on both sides of the edge, and writes down which.
template <class MeshT>
class KeepsCorners : public OpenMesh::Decimater::ModBaseT<MeshT> {
  public:
    DECIMATING_MODULE(KeepsCorners, MeshT, KeepsCorners);
    explicit KeepsCorners(MeshT& mesh) : Base(mesh, true) {}
    void keep(CornerBook& book) { book_ = &book; }

    float collapse_priority(CollapseInfo const& info) override {
        if (!info.fl.is_valid() || !info.fr.is_valid())
            return float(Base::ILLEGAL_COLLAPSE);
        bool const same = book_->at(info.fl.idx(), info.v1.idx()) == book_->at(info.fr.idx(), info.v1.idx());
        return float(same ? Base::LEGAL_COLLAPSE : Base::ILLEGAL_COLLAPSE);
    }
    void preprocess_collapse(CollapseInfo const& info) override {
        std::uint32_t const becomes = book_->at(info.fl.idx(), info.v1.idx());
        for (auto face = this->mesh().cvf_iter(info.v0); face.is_valid(); ++face)
            for (std::uint32_t& corner : book_->triangles[static_cast<std::size_t>(face->idx())])
                if (book_->place[corner] == static_cast<std::uint32_t>(info.v0.idx()))
                    corner = becomes;
    }

  private:
    CornerBook* book_ = nullptr;
};

/// By place: what may not go.
std::vector<bool> held(HealthView const& view) {
    MeshHealth ignored;
    std::vector<std::uint32_t> const across = find_creases(view, ignored);
    std::vector<bool> hold(view.places.size(), false);
    auto const& corners = view.mesh.soup.triangles;
    for (std::uint32_t side = 0; side < 3 * view.corners.size(); ++side) {
        std::uint32_t const triangle = side / 3,
                            other = across[side] >= Sides::crowded ? triangle : across[side] / 3;
        bool keep = across[side] >= Sides::crowded || triangle >= view.real() || other >= view.real();
        if (!keep) {
            std::uint32_t const back = across[side]; // runs the other way: its first corner is our second
            keep = view.mesh.face_of(triangle) != view.mesh.face_of(other) ||
                   corners[triangle][side % 3] != corners[other][next_side(back) % 3] ||
                   corners[triangle][next_side(side) % 3] != corners[other][back % 3];
        }
        if (keep)
            for (std::uint32_t const end : {side, next_side(side)})
                hold[view.corners[end / 3][end % 3]] = true;
    }
    return hold;
}

/// In units of the mesh's size, since OpenMesh takes for flat what is small in metres.
bool fill(Working& working, HealthView const& view, double size) {
    std::vector<double> valence(view.places.size(), 0.0);
    double steps = 0.0; // as in mesh_manifold.cpp
    for (std::size_t t = 0; t < view.real(); ++t)
        for (std::uint32_t const corner : view.corners[t])
            steps += 2.0 * valence[corner]++ + 1.0;
    if (steps > 100.0 * static_cast<double>(view.real()) + 1e6)
        return false;
    for (dvec3 const& p : view.places) {
        dvec3 const q = (p - view.mesh.low) / size;
        working.add_vertex({q.x, q.y, q.z});
    }
    auto const vertex = [](std::uint32_t place) { return Working::VertexHandle(static_cast<int>(place)); };
    for (std::size_t t = 0; t < view.real(); ++t) {
        Corners const& c = view.corners[t];
        if (!working.add_face(vertex(c[0]), vertex(c[1]), vertex(c[2])).is_valid())
            return false;
    }
    return true;
}

void measure_shells(Mesh& mesh) {
    for (MeshShell& shell : mesh.shells)
        shell.volume = 0.0;
    for (std::size_t t = 0; t < mesh.soup.triangles.size(); ++t) {
        auto const& [a, b, c] = mesh.soup.triangles[t];
        dvec3 const o = mesh.low;
        MeshShell& shell = mesh.shells[mesh.triangle_shell[t]];
        shell.volume +=
            dot(mesh.soup.positions[a] - o, cross(mesh.soup.positions[b] - o, mesh.soup.positions[c] - o)) /
            6.0;
    }
    for (MeshShell& shell : mesh.shells)
        shell.volume = std::abs(shell.volume);
}

} // namespace

double stretch_of(Affine const& to_world) {
    dmat3 const squared = glm::transpose(to_world.linear) * to_world.linear;
    double most = 0.0; // no eigenvalue is above a row's sum
    for (int row = 0; row < 3; ++row)
        most =
            std::max(most, std::abs(squared[0][row]) + std::abs(squared[1][row]) + std::abs(squared[2][row]));
    return std::sqrt(most);
}

std::optional<Mesh> decimated(Mesh const& mesh, double tolerance) {
    double const size = length(mesh.high - mesh.low);
    if (!(size > 0.0))
        return std::nullopt;
    HealthView view = view_of(mesh);
    for (std::uint32_t t = 0; t < view.real(); ++t)
        view.normals.push_back(normal_of({view.at(3 * t), view.at(3 * t + 1), view.at(3 * t + 2)}));
    Working working;
    if (!fill(working, view, size))
        return std::nullopt;
    std::vector<bool> const hold = held(view);
    for (std::size_t i = 0; i < hold.size(); ++i)
        working.status(Working::VertexHandle(static_cast<int>(i))).set_locked(hold[i]);
    CornerBook book{mesh.soup.triangles, std::vector<std::uint32_t>(mesh.soup.positions.size())};
    for (std::size_t t = 0; t < view.real(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            book.place[mesh.soup.triangles[t][k]] = view.corners[t][k];
    working.update_face_normals();

    OpenMesh::Decimater::DecimaterT<Working> decimater(working);
    OpenMesh::Decimater::ModHausdorffT<Working>::Handle within;
    OpenMesh::Decimater::ModNormalFlippingT<Working>::Handle turns;
    OpenMesh::Decimater::ModQuadricT<Working>::Handle order;
    KeepsCorners<Working>::Handle corners;
    bool const added =
        decimater.add(within) && decimater.add(turns) && decimater.add(order) && decimater.add(corners);
    decimater.module(within).set_tolerance(tolerance / size);
    decimater.module(turns).set_max_normal_deviation(most_turned);
    decimater.module(order).unset_max_err();
    decimater.module(corners).keep(book);
    if (!added || !decimater.initialize())
        return std::nullopt;
    decimater.decimate();

    Mesh left = mesh;
    std::size_t kept = 0;
    for (std::size_t t = 0; t < view.real(); ++t) {
        if (working.status(Working::FaceHandle(static_cast<int>(t))).deleted())
            continue;
        left.soup.triangles[kept] = book.triangles[t];
        left.soup.triangle_face[kept] = mesh.soup.triangle_face[t];
        left.triangle_shell[kept++] = mesh.triangle_shell[t];
    }
    left.soup.triangles.resize(kept);
    left.soup.triangle_face.resize(kept);
    left.triangle_shell.resize(kept);
    std::vector<std::uint32_t> all(mesh.shells.size());
    std::iota(all.begin(), all.end(), 0U);
    Mesh made = part_of(left, all); // without the vertices that have no triangle
    made.boundary_edges = mesh.boundary_edges;
    made.degenerate_triangles = mesh.degenerate_triangles;
    made.flipped_triangles = mesh.flipped_triangles;
    measure_shells(made);
    return made;
}

} // namespace sahl
