#include "geometry/recognise.h"

#include "geometry/mesh_shadow.h"
#include "geometry/recognise_pieces.h"
#include "geometry/region.h"
#include "math/random.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace sahl {

namespace {

/// Ulps of float coordinates, relative to the largest; a float ulp is 2⁻²³ of it at most.
constexpr double residual_ulps = 4.0 * 0x1p-23;
constexpr std::size_t most_regions = 6;

/// By a hash: every other vertex may be all of one rim. The same for places that are each other's images in
/// the planes and diagonals of the axes, since a regular mesh rounds all of them by the same.
std::uint64_t lot_of(dvec3 const& place) {
    std::array<double, 3> sizes{std::abs(place.x), std::abs(place.y), std::abs(place.z)};
    std::sort(sizes.begin(), sizes.end());
    std::uint64_t lot = 0;
    for (double const size : sizes)
        lot = mix64(lot ^ std::bit_cast<std::uint64_t>(size));
    return lot;
}

/// By vertex of a piece: is it in the first half?
std::vector<bool> first_half(Piece const& piece, unsigned way) {
    std::size_t const count = piece.places.size();
    std::vector<bool> first(count);
    if (way < ways_by_chance) {
        for (std::size_t i = 0; i < count; ++i)
            first[i] = (lot_of(piece.places[i]) >> way) % 2 == 0;
        return first;
    }
    constexpr std::array<std::size_t, ways_to_halve - ways_by_chance> bands{4, 6, 10};
    dvec3 middle(0.0);
    for (dvec3 const& p : piece.places)
        middle += p / static_cast<double>(count);
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < count; ++i)
        order.emplace_back(length(piece.places[i] - middle), i);
    std::sort(order.begin(), order.end());
    for (std::size_t rank = 0; rank < count; ++rank)
        first[order[rank].second] = rank * bands[way - ways_by_chance] / count % 2 == 0;
    return first;
}

/// Where there are few vertices, all but one are left.
void leave_out(Piece& piece, VertexShare share) {
    constexpr std::size_t few = 16;
    std::size_t const count = piece.places.size();
    if (!share.way || count < 4)
        return;
    std::vector<bool> left(count, true);
    if (count < few) {
        std::size_t const out = *share.way % (count / 2);
        left[share.rest ? count - 1 - out : out] = false;
    } else {
        left = first_half(piece, *share.way);
        if (share.rest)
            left.flip();
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (left[i]) {
            piece.places[kept] = piece.places[i];
            piece.normals[kept++] = piece.normals[i];
        }
    piece.places.resize(kept);
    piece.normals.resize(kept);
}

std::vector<Piece> pieces_of(SmoothFans const& fans, VertexShare share) {
    std::vector<Piece> pieces(fans.groups);
    std::vector<bool> seen(fans.fans.size(), false), has_face(fans.groups, false);
    for (std::uint32_t t = 0; t < fans.triangles.size(); ++t) {
        Piece& piece = pieces[fans.group[t]];
        std::uint32_t const face = fans.mesh->face_of(t);
        piece.one_face = piece.one_face && (!has_face[fans.group[t]] || piece.face == face);
        piece.face = face;
        has_face[fans.group[t]] = true;
        for (std::uint32_t const fan : fans.triangles[t].fans)
            if (!seen[fan]) {
                seen[fan] = true;
                piece.places.push_back(fans.fans[fan].place);
                piece.normals.push_back(fans.fans[fan].normal);
            }
    }
    for (Piece& piece : pieces) {
        leave_out(piece, share);
        for (dvec3 const& p : piece.places)
            piece.centre += p;
        piece.centre /= static_cast<double>(piece.places.size());
    }
    return pieces;
}

double height(Region const& region, dvec3 const& p) { // < 0 inside
    switch (region.kind) {
    case Region::Kind::half_space:
        return dot(region.a, p) - region.b;
    case Region::Kind::ball:
        return length(p - region.a) - region.b;
    default: {
        dvec3 const from = p - region.a;
        double const steep = length(region.quadric->gradient(from));
        return steep > 0.0 ? region.quadric->value(from) / steep : 0.0;
    }
    }
}

/// How far a triangle may lie off what it stands for: less than that is no difference.
double sag_of(SmoothFans const& fans) {
    double most = 0.0;
    for (SmoothTriangle const& t : fans.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            Fan const &a = fans.fans[t.fans[k]], &b = fans.fans[t.fans[(k + 1) % 3]];
            most = std::max(most, length(a.place - b.place) * length(a.normal - b.normal));
        }
    return most;
}

/// Is the mesh's inside that of all regions together? At places drawn over its box.
bool same_body(SmoothFans const& fans, Solid const& solid) {
    constexpr int draws = 2000;
    Mesh const& mesh = *fans.mesh;
    Shadow const shadow = make_shadow(mesh.soup.positions, mesh.soup.triangles);
    dvec3 const size = mesh.high - mesh.low;
    double const sag = sag_of(fans);
    for (int i = 0; i < draws; ++i) {
        auto const draw = [&](std::uint32_t number) {
            return uniform(1, static_cast<std::uint64_t>(i), 0, number);
        };
        dvec3 const p = mesh.low - 0.05 * size + 1.1 * dvec3(draw(0), draw(1), draw(2)) * size;
        double most = -INFINITY;
        for (Region const& region : solid.regions())
            most = std::max(most, height(region, p));
        if (std::abs(most) > sag && (most < 0.0) != (winding_number(shadow, p) > 0))
            return false;
    }
    return true;
}

} // namespace

std::optional<RecognisedSolid> recognise(SmoothFans const& fans, VertexShare share) {
    Mesh const& mesh = *fans.mesh;
    if (!mesh.closed() || mesh.shells.size() != 1 || mesh.shells.front().sign < 0 || fans.groups == 0 ||
        fans.groups > most_regions)
        return std::nullopt;
    PieceJudge judge{residual_ulps * fans.reach, fans.normals == NormalUse::files, fans.reach,
                     fans.float_positions};
    std::vector<Region> regions, behind;
    std::vector<std::uint32_t> faces;
    std::vector<std::shared_ptr<Quadric const>> quadrics;
    for (Piece const& piece : pieces_of(fans, share)) {
        if (!piece.one_face || piece.places.size() < 3)
            return std::nullopt;
        std::optional<FoundPiece> found = fit_piece(piece, judge);
        if (!found)
            return std::nullopt;
        if (found->quadric) {
            quadrics.push_back(std::make_shared<Quadric const>(*found->quadric));
            found->region.quadric = quadrics.back().get();
        }
        regions.push_back(found->region);
        faces.push_back(piece.face);
        if (found->behind)
            behind.push_back(*found->behind);
    }
    for (Region const& region : behind) {
        regions.push_back(region);
        faces.push_back(0);
    }
    if (regions.size() > most_regions)
        return std::nullopt;
    for (Fan const& fan : fans.fans)
        for (Region const& region : regions)
            if (!(height(region, fan.place) <= 4.0 * judge.tolerance))
                return std::nullopt;
    double const sag = sag_of(fans);
    RecognisedSolid made{Solid(regions, std::move(quadrics), mesh.low - sag, mesh.high + sag),
                         std::move(faces), judge.residual, judge.normals_off};
    if (!same_body(fans, made.solid))
        return std::nullopt;
    return made;
}

} // namespace sahl
