#include "geometry/recognise_pieces.h"
#include "geometry/least_squares.h"

namespace sahl {

namespace {

dvec3 least_direction(dmat3 const& a) {
    std::array<std::array<double, 3>, 3> rows{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            rows[i][j] = a[static_cast<int>(j)][static_cast<int>(i)];
    auto const v = least_eigenvector(rows);
    return normalize(dvec3(v[0], v[1], v[2]));
}

std::optional<FoundPiece> as_plane(Piece const& piece, PieceJudge& judge) {
    dmat3 scatter(0.0);
    for (dvec3 const& p : piece.places)
        scatter += glm::outerProduct(p - piece.centre, p - piece.centre);
    dvec3 normal = least_direction(scatter);
    if (dot(normal, piece.normals.front()) < 0.0)
        normal = -normal;
    double const offset = dot(normal, piece.centre);
    if (!accepts(
            judge, piece, [&](dvec3 const& p) { return dot(normal, p) - offset; },
            [&](dvec3 const&) { return normal; }))
        return std::nullopt;
    return FoundPiece{{Region::Kind::half_space, normal, offset, 0.0}, {}, {}};
}

Quadric outside_of_ball(double radius) {
    return {dmat3(-1.0), dvec3(0.0), radius * radius, dvec3(0.0)};
}

std::optional<FoundPiece> as_sphere(Piece const& piece, PieceJudge& judge) {
    if (piece.places.size() < 5)
        return std::nullopt;
    double size = 0.0;
    for (dvec3 const& p : piece.places)
        size = std::max(size, length(p - piece.centre));
    Equations<4> algebraic; // |x|² = 2 c·x + k
    for (dvec3 const& p : piece.places) {
        dvec3 const x = (p - piece.centre) / size;
        algebraic.add({2.0 * x.x, 2.0 * x.y, 2.0 * x.z, 1.0}, dot(x, x));
    }
    auto const first = algebraic.solved();
    if (!first)
        return std::nullopt;
    dvec3 c((*first)[0], (*first)[1], (*first)[2]);
    double radius = std::sqrt(std::max((*first)[3] + dot(c, c), 0.0));
    if (!(radius > 0.0) || !std::isfinite(radius) || radius > 1e4)
        return std::nullopt;
    bool const normals = judge.normals;
    double const outwards =
        dot(piece.normals.front(), (piece.places.front() - piece.centre) / size - c) < 0.0 ? -1.0 : 1.0;
    for (int pass = 0; pass < 4; ++pass) { // Gauss and Newton on distances
        Equations<4> step;
        for (dvec3 const& p : piece.places) {
            dvec3 const from = (p - piece.centre) / size - c;
            double const r = length(from), w = 1.0 / length(from / r * judge.steps(p));
            step.add({-w * from.x / r, -w * from.y / r, -w * from.z / r, -w}, w * (radius - r));
        }
        // place − centre = radius · normal, each coordinate by the ulps of both
        for (std::size_t i = 0; normals && i < piece.places.size(); ++i) {
            dvec3 const n = outwards * piece.normals[i], steps = judge.steps(piece.places[i]);
            dvec3 const off = (piece.places[i] - piece.centre) / size - c - radius * n;
            for (int k = 0; k < 3; ++k) {
                double const w =
                    1.0 / std::hypot(steps[k], radius * size / judge.reach * ulp_share(n[k], 1.0));
                Unknowns<4> row{0.0, 0.0, 0.0, w * n[k]};
                row[static_cast<std::size_t>(k)] = w;
                step.add(row, w * off[k]);
            }
        }
        auto const by = step.solved();
        if (!by)
            return std::nullopt;
        c += dvec3((*by)[0], (*by)[1], (*by)[2]);
        radius += (*by)[3];
    }
    dvec3 const centre = piece.centre + size * c;
    radius *= size;
    if (!accepts(
            judge, piece, [&](dvec3 const& p) { return length(p - centre) - radius; },
            [&](dvec3 const& p) { return normalize(p - centre); }))
        return std::nullopt;
    if (dot(piece.normals.front(), piece.places.front() - centre) > 0.0)
        return FoundPiece{{Region::Kind::ball, centre, radius, 0.0}, {}, {}};
    dvec3 middle(0.0); // towards the centre, on the whole
    for (dvec3 const& n : piece.normals)
        middle += n;
    dvec3 const m = normalize(middle);
    return FoundPiece{{Region::Kind::quadric, centre, 0.0, 0.0},
                      outside_of_ball(radius),
                      Region{Region::Kind::half_space, m, dot(m, centre), 0.0}};
}

std::optional<FoundPiece> as_cylinder(Piece const& piece, PieceJudge& judge) {
    if (piece.places.size() < 6)
        return std::nullopt;
    dmat3 scatter(0.0);
    for (dvec3 const& n : piece.normals)
        scatter += glm::outerProduct(n, n);
    dvec3 axis = least_direction(scatter);
    double size = 0.0;
    for (dvec3 const& p : piece.places)
        size = std::max(size, length(p - piece.centre));
    dvec3 x = perpendicular_to(axis), y = cross(axis, x), point(0.0); // lengths in `size`, from the centre
    double radius = 0.0;
    Equations<3> circle;
    for (dvec3 const& p : piece.places) {
        dvec3 const from = (p - piece.centre) / size;
        double const u = dot(from, x), v = dot(from, y);
        circle.add({2.0 * u, 2.0 * v, 1.0}, u * u + v * v);
    }
    if (auto const c = circle.solved()) {
        point = (*c)[0] * x + (*c)[1] * y;
        radius = std::sqrt(std::max((*c)[2] + dot(point, point), 0.0));
    }
    if (!(radius > 0.0) || !std::isfinite(radius) || radius > 1e3)
        return std::nullopt;
    for (int pass = 0; pass < 6; ++pass) { // shift and tilt of the axis, and the radius
        x = perpendicular_to(axis);
        y = cross(axis, x);
        Equations<5> step;
        for (dvec3 const& p : piece.places) {
            dvec3 const from = (p - piece.centre) / size - point;
            double const along = dot(from, axis);
            dvec3 const out = from - along * axis;
            double const r = length(out), nx = dot(out, x) / r, ny = dot(out, y) / r;
            step.add({-nx, -ny, -along * nx, -along * ny, -1.0}, radius - r);
        }
        auto const by = step.solved();
        if (!by)
            return std::nullopt;
        point += (*by)[0] * x + (*by)[1] * y;
        axis = normalize(axis + (*by)[2] * x + (*by)[3] * y);
        radius += (*by)[4];
    }
    dvec3 const on_axis = piece.centre + size * point;
    radius *= size;
    auto const out = [&](dvec3 const& p) { return (p - on_axis) - dot(p - on_axis, axis) * axis; };
    if (!accepts(
            judge, piece, [&](dvec3 const& p) { return length(out(p)) - radius; },
            [&](dvec3 const& p) { return normalize(out(p)); }))
        return std::nullopt;
    double const sign = dot(piece.normals.front(), out(piece.places.front())) > 0.0 ? 1.0 : -1.0;
    Quadric quadric;
    quadric.a = sign * (dmat3(1.0) - glm::outerProduct(axis, axis));
    quadric.c = -sign * radius * radius;
    return FoundPiece{{Region::Kind::quadric, on_axis, 0.0, 0.0}, quadric, {}};
}

} // namespace

std::optional<FoundPiece> fit_piece(Piece const& piece, PieceJudge& judge) {
    std::optional<FoundPiece> found = as_plane(piece, judge);
    if (!found)
        found = as_sphere(piece, judge);
    if (!found)
        found = as_cylinder(piece, judge);
    if (!found)
        found = as_revolved(piece, judge);
    return found;
}

} // namespace sahl
