// As recognise_pieces.h: a conic about an axis. The axis is found first by the normals, whose lines all meet
// it (H. Pottmann, J. Wallner, Computational Line Geometry, 2001, section 4.1: the linear complex nearest to
// them), then places alone decide.
#include "geometry/least_squares.h"
#include "geometry/recognise_pieces.h"

namespace sahl {

namespace {

/// Lengths in the piece's size, from its centre.
struct Revolved {
    dvec3 point{0.0}, axis{0.0};
    double c0 = 0.0, c1 = 0.0, c2 = 0.0;

    double height(dvec3 const& p) const { return dot(p - point, axis); }
    double value(dvec3 const& p) const {
        double const z = height(p);
        dvec3 const out = p - point - z * axis;
        return dot(out, out) - (c0 + z * (c1 + z * c2));
    }
    dvec3 gradient(dvec3 const& p) const {
        double const z = height(p);
        return 2.0 * (p - point - z * axis) - (c1 + 2.0 * c2 * z) * axis;
    }
};

/// Lines that meet an axis of direction a through q: m·a + n·(q×a) = 0, m = p×n.
std::optional<Revolved> by_normals(Piece const& piece, double size) {
    std::array<std::array<double, 6>, 6> sums{};
    for (std::size_t i = 0; i < piece.places.size(); ++i) {
        dvec3 const n = piece.normals[i], m = cross((piece.places[i] - piece.centre) / size, n);
        std::array<double, 6> const line{m.x, m.y, m.z, n.x, n.y, n.z};
        for (std::size_t j = 0; j < 6; ++j)
            for (std::size_t k = 0; k < 6; ++k)
                sums[j][k] += line[j] * line[k];
    }
    auto const v = least_eigenvector(sums);
    dvec3 const direction(v[0], v[1], v[2]), moment(v[3], v[4], v[5]);
    double const squared = dot(direction, direction);
    if (!(squared > 1e-6)) // the axis lies beyond any distance that counts
        return std::nullopt;
    return Revolved{cross(direction, moment) / squared, normalize(direction)};
}

/// The coefficients for an axis that is known.
bool fit_profile(Revolved& shape, Piece const& piece, double size) {
    Equations<3> profile;
    for (dvec3 const& place : piece.places) {
        dvec3 const p = (place - piece.centre) / size;
        double const z = shape.height(p);
        dvec3 const out = p - shape.point - z * shape.axis;
        profile.add({1.0, z, z * z}, dot(out, out));
    }
    auto const c = profile.solved();
    if (c) {
        shape.c0 = (*c)[0];
        shape.c1 = (*c)[1];
        shape.c2 = (*c)[2];
    }
    return c.has_value();
}

/// A step of Gauss and Newton on distances, value over gradient.
bool improve(Revolved& shape, Piece const& piece, double size) {
    dvec3 const x = perpendicular_to(shape.axis), y = cross(shape.axis, x);
    Equations<7> step;
    for (dvec3 const& place : piece.places) {
        dvec3 const p = (place - piece.centre) / size, from = p - shape.point;
        double const z = shape.height(p), steep = 2.0 * z + shape.c1 + 2.0 * shape.c2 * z,
                     by = 1.0 / length(shape.gradient(p));
        if (!std::isfinite(by)) // an apex
            continue;
        double const u = dot(from, x), v = dot(from, y);
        step.add({-2.0 * u * by, -2.0 * v * by, -steep * u * by, -steep * v * by, -by, -z * by, -z * z * by},
                 -shape.value(p) * by);
    }
    auto const by = step.solved();
    if (!by)
        return false;
    shape.point += (*by)[0] * x + (*by)[1] * y;
    shape.axis = normalize(shape.axis + (*by)[2] * x + (*by)[3] * y);
    shape.c0 += (*by)[4];
    shape.c1 += (*by)[5];
    shape.c2 += (*by)[6];
    return true;
}

/// Of two sheets the one that the piece is on, and of a hollow closed one the side of its centre that the
/// body is on.
std::optional<Region> other_sheet(Revolved const& shape, Piece const& piece, double size, bool hollow) {
    double const apart = shape.c1 * shape.c1 - 4.0 * shape.c0 * shape.c2;
    bool const two_sheets = shape.c2 > 0.0 && apart > -1e-9;
    if (!(hollow ? shape.c2 < 0.0 : two_sheets))
        return std::nullopt;
    dvec3 const middle = shape.point - 0.5 * shape.c1 / shape.c2 * shape.axis,
                centre = piece.centre + size * middle;
    dvec3 sum(0.0);
    for (dvec3 const& n : piece.normals)
        sum += n;
    double const side = hollow ? dot(sum, shape.axis) : -dot(piece.centre - centre, shape.axis);
    dvec3 const out = side < 0.0 ? -shape.axis : shape.axis;
    return Region{Region::Kind::half_space, out, dot(out, centre), 0.0};
}

} // namespace

std::optional<FoundPiece> as_revolved(Piece const& piece, PieceJudge& judge) {
    if (piece.places.size() < 9)
        return std::nullopt;
    double size = 0.0;
    for (dvec3 const& p : piece.places)
        size = std::max(size, length(p - piece.centre));
    std::optional<Revolved> shape = by_normals(piece, size);
    if (!shape || !fit_profile(*shape, piece, size))
        return std::nullopt;
    for (int pass = 0; pass < 8; ++pass)
        if (!improve(*shape, piece, size))
            return std::nullopt;
    // once its place is settled, so that what is far along the axis loses no digits
    double const along = shape->height(dvec3(0.0));
    shape->c0 += along * (shape->c1 + along * shape->c2);
    shape->c1 += 2.0 * along * shape->c2;
    shape->point += along * shape->axis;
    auto const scaled = [&](dvec3 const& p) { return (p - piece.centre) / size; };
    if (!accepts(
            judge, piece,
            [&](dvec3 const& p) {
                double const steep = length(shape->gradient(scaled(p)));
                return steep > 1e-9 ? size * shape->value(scaled(p)) / steep : 0.0;
            },
            [&](dvec3 const& p) {
                dvec3 const gradient = shape->gradient(scaled(p));
                return length(gradient) > 1e-5 ? normalize(gradient) : dvec3(0.0);
            }))
        return std::nullopt;
    bool const hollow = dot(piece.normals.front(), shape->gradient(scaled(piece.places.front()))) < 0.0;
    double const sign = hollow ? -1.0 : 1.0;
    Quadric quadric;
    quadric.a = sign * (dmat3(1.0) - (1.0 + shape->c2) * glm::outerProduct(shape->axis, shape->axis));
    quadric.b = -sign * shape->c1 * size * shape->axis;
    quadric.c = -sign * shape->c0 * size * size;
    return FoundPiece{{Region::Kind::quadric, piece.centre + size * shape->point, 0.0, 0.0},
                      quadric,
                      other_sheet(*shape, piece, size, hollow)};
}

} // namespace sahl
