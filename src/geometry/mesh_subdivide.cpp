#include "geometry/mesh_subdivide.h"

#include "geometry/curved_tree.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace sahl {

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// A piece of one of the mesh's triangles.
struct Piece {
    Corners vertices;
    std::uint32_t triangle;    // of the mesh
    std::array<dvec2, 3> at;   // the corners' weights on its patch
    std::array<vec2, 3> image; // texture coordinates, if the mesh has any
};

std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

class Subdivision {
  public:
    Subdivision(Mesh const& mesh, CurvedTree const& surface, double tolerance)
        : mesh_(mesh), surface_(surface), tolerance_(tolerance), soup_(mesh.soup) {
        std::map<std::tuple<double, double, double>, std::uint32_t> places;
        for (dvec3 const& p : soup_.positions) {
            auto const known = places.emplace(std::tuple(p.x, p.y, p.z), places_.size());
            if (known.second)
                places_.push_back(p);
            place_of_.push_back(known.first->second);
        }
        for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t)
            pieces_.push_back({soup_.triangles[t], t, weights_of(t), image_of(t)});
    }

    /// Halves once what lies too far off; false where nothing does.
    bool halve() {
        bool any = false;
        for (Piece const& piece : pieces_) {
            std::array<std::uint32_t, 3> sides{};
            for (std::size_t k = 0; k < 3; ++k)
                sides[k] = side_of(piece, k);
            dvec2 const middle = (piece.at[0] + piece.at[1] + piece.at[2]) / 3.0;
            bool const inside_far = is_far(point_on(surface_.patch(piece.triangle), middle.x, middle.y).place,
                                           (place(piece, 0) + place(piece, 1) + place(piece, 2)) / 3.0);
            for (std::uint32_t const side : sides) {
                sides_[side].halved = sides_[side].halved || inside_far;
                any = any || sides_[side].halved;
            }
        }
        if (!any)
            return false;
        std::vector<Piece> whole;
        std::swap(whole, pieces_);
        for (Piece const& piece : whole)
            split(piece);
        return true;
    }

    std::size_t size() const { return pieces_.size(); }

    TriangleSoup soup() && {
        std::vector<std::uint32_t> const faces = std::move(soup_.triangle_face);
        bool const pictured = !soup_.texture_coordinates.empty();
        soup_.triangles.clear();
        soup_.triangle_face.clear();
        soup_.texture_coordinates.clear();
        for (Piece const& piece : pieces_) {
            soup_.triangles.push_back(piece.vertices);
            soup_.triangle_face.push_back(faces[piece.triangle]);
            if (pictured)
                soup_.texture_coordinates.push_back(piece.image);
        }
        return std::move(soup_);
    }

  private:
    /// Between two places, whichever triangles have it.
    struct Side {
        std::uint32_t middle; // in places_
        bool halved;
    };

    dvec3 const& place(Piece const& piece, std::size_t k) const {
        return places_[place_of_[piece.vertices[k]]];
    }
    bool is_far(dvec3 const& surface, dvec3 const& flat) const { return length(surface - flat) > tolerance_; }

    /// A patch may name its corners from another one on, or the other way round.
    std::array<dvec2, 3> weights_of(std::uint32_t t) const {
        constexpr std::array corner{dvec2(0.0, 0.0), dvec2(1.0, 0.0), dvec2(0.0, 1.0)};
        SmoothFans const& fans = surface_.fans();
        std::array<dvec2, 3> at{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t j = 0; j < 3; ++j)
                if (fans.fans[fans.triangles[t].fans[j]].place == soup_.positions[soup_.triangles[t][k]])
                    at[k] = corner[j];
        return at;
    }

    std::array<vec2, 3> image_of(std::uint32_t t) const {
        return soup_.texture_coordinates.empty() ? std::array<vec2, 3>{} : soup_.texture_coordinates[t];
    }

    /// The number of the side from the corner k to the next.
    std::uint32_t side_of(Piece const& piece, std::size_t k) {
        std::size_t const next = (k + 1) % 3;
        auto const [known, is_new] = side_numbers_.emplace(
            pair_key(place_of_[piece.vertices[k]], place_of_[piece.vertices[next]]), sides_.size());
        if (is_new) {
            dvec2 const at = 0.5 * (piece.at[k] + piece.at[next]);
            dvec3 const surface = point_on(surface_.patch(piece.triangle), at.x, at.y).place;
            bool const far = is_far(surface, 0.5 * (place(piece, k) + place(piece, next)));
            sides_.push_back({static_cast<std::uint32_t>(places_.size()), far});
            places_.push_back(surface);
        }
        return known->second;
    }

    /// The vertex in the middle of a side: one for each pair of normals that its ends have.
    std::uint32_t middle_of(Piece const& piece, std::size_t k, dvec2 const& at) {
        std::size_t const next = (k + 1) % 3;
        auto const [known, is_new] =
            middles_.emplace(pair_key(piece.vertices[k], piece.vertices[next]), soup_.positions.size());
        if (is_new) {
            std::uint32_t const place = sides_[side_of(piece, k)].middle;
            place_of_.push_back(place);
            soup_.positions.push_back(places_[place]);
            double const sign = mesh_.shells[mesh_.shell_of(piece.triangle)].sign;
            soup_.normals.push_back(sign *
                                    normalize(light_normal(surface_.patch(piece.triangle), at.x, at.y)));
        }
        return known->second;
    }

    void split(Piece const& piece) {
        std::array<bool, 3> halved{};
        for (std::size_t k = 0; k < 3; ++k)
            halved[k] = sides_[side_of(piece, k)].halved;
        auto const count = static_cast<std::size_t>(std::count(halved.begin(), halved.end(), true));
        if (count == 0) {
            pieces_.push_back(piece);
            return;
        }
        // corners 0 to 2, and 3 to 5 in the middles of the sides that begin there
        std::array<std::uint32_t, 6> vertex{piece.vertices[0], piece.vertices[1], piece.vertices[2]};
        std::array<dvec2, 6> at{piece.at[0], piece.at[1], piece.at[2]};
        std::array<vec2, 6> image{piece.image[0], piece.image[1], piece.image[2]};
        for (std::size_t k = 0; k < 3; ++k)
            if (halved[k]) {
                at[3 + k] = 0.5 * (at[k] + at[(k + 1) % 3]);
                image[3 + k] = 0.5f * (image[k] + image[(k + 1) % 3]);
                vertex[3 + k] = middle_of(piece, k, at[3 + k]);
            }
        auto const add = [&](std::size_t a, std::size_t b, std::size_t c) {
            pieces_.push_back({{vertex[a], vertex[b], vertex[c]},
                               piece.triangle,
                               {at[a], at[b], at[c]},
                               {image[a], image[b], image[c]}});
        };
        if (count == 3) {
            for (std::size_t k = 0; k < 3; ++k)
                add(k, 3 + k, 3 + (k + 2) % 3);
            return add(3, 4, 5);
        }
        // the first corner whose side is halved, where two are with the next one's
        std::size_t first = 0;
        while (!halved[first] || (count == 2 && !halved[(first + 1) % 3]))
            ++first;
        std::size_t const second = (first + 1) % 3, third = (first + 2) % 3;
        if (count == 1) {
            add(first, 3 + first, third);
            return add(3 + first, second, third);
        }
        add(3 + first, second, 3 + second);
        auto const far_apart = [&](std::size_t a, std::size_t b) {
            return length(places_[place_of_[vertex[a]]] - places_[place_of_[vertex[b]]]);
        };
        if (far_apart(first, 3 + second) < far_apart(third, 3 + first)) {
            add(first, 3 + first, 3 + second);
            return add(first, 3 + second, third);
        }
        add(first, 3 + first, third);
        add(3 + first, 3 + second, third);
    }

    Mesh const& mesh_;
    CurvedTree const& surface_;
    double tolerance_;
    TriangleSoup soup_; // its vertices; those of the mesh first
    std::vector<dvec3> places_;
    std::vector<std::uint32_t> place_of_; // by vertex
    std::vector<Side> sides_;
    std::unordered_map<std::uint64_t, std::uint32_t> side_numbers_, middles_;
    std::vector<Piece> pieces_;
};

} // namespace

std::optional<Mesh> subdivided(std::shared_ptr<Mesh const> const& mesh, double tolerance, std::size_t most) {
    if (mesh->soup.normals.empty() || mesh->non_manifold_edges != 0)
        return std::nullopt;
    CurvedTree const surface(mesh, PatchKind::fitted);
    Subdivision subdivision(*mesh, surface, tolerance);
    while (subdivision.halve())
        if (subdivision.size() > most)
            return std::nullopt;
    return make_mesh(std::move(subdivision).soup());
}

} // namespace sahl
