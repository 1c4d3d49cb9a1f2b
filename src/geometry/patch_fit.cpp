#include "geometry/patch_fit.h"

#include "geometry/householder.h"
#include "geometry/least_squares.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sahl {

namespace {

/// Fans whose places and normals tell of the surface at this one: itself first, then ring by ring.
std::vector<std::uint32_t> neighbours_of(SmoothFans const& fans, std::uint32_t centre, int rings) {
    constexpr std::size_t enough = 64; // a pole may have a thousand
    std::vector<std::uint32_t> found{centre};
    std::size_t begin = 0;
    for (int ring = 0; ring < rings && found.size() < enough; ++ring) {
        std::size_t const end = found.size();
        for (std::size_t i = begin; i < end; ++i) {
            Fan const& fan = fans.fans[found[i]];
            for (std::uint32_t k = 0; k < fan.corners; ++k)
                for (std::uint32_t const other : fans.triangles[fans.corners[fan.first_corner + k]].fans)
                    if (std::find(found.begin(), found.end(), other) == found.end())
                        found.push_back(other);
        }
        begin = end;
    }
    return found;
}

constexpr std::size_t unknowns_of(int degree) {
    auto const d = static_cast<std::size_t>(degree);
    return (d + 1) * (d + 2) / 2;
}

constexpr std::size_t most_unknowns = HeightField::terms + 1; // a constant, and HeightField's
using LeastSquares = Householder<most_unknowns>;
using Row = LeastSquares::Row;

enum class Of : std::uint8_t { height, slope_x, slope_y };

/// The terms xⁱyʲ in the order of their degree, or their derivatives.
Row row_of(Of what, double x, double y) {
    std::array<double, HeightField::degree + 1> px{1.0}, py{1.0};
    for (std::size_t k = 1; k < px.size(); ++k) {
        px[k] = x * px[k - 1];
        py[k] = y * py[k - 1];
    }
    Row row{};
    std::size_t term = 0;
    for (std::size_t degree = 0; degree < px.size(); ++degree)
        for (std::size_t j = 0; j <= degree; ++j) {
            std::size_t const i = degree - j;
            double& entry = row[term++];
            if (what == Of::height)
                entry = px[i] * py[j];
            else if (what == Of::slope_x && i > 0)
                entry = static_cast<double>(i) * px[i - 1] * py[j];
            else if (what == Of::slope_y && j > 0)
                entry = static_cast<double>(j) * px[i] * py[j - 1];
        }
    return row;
}

/// A neighbour as the polynomial's frame sees it, lengths in the patch's radius.
struct Datum {
    double x, y, z, slope_x, slope_y, distance;
};

/// rad: a normal is off by a float's ulp of one; files carry no better ones.
constexpr double normal_noise = 0x1p-24;

/// How the surface departs from its tangent plane over the patch's radius.
struct Scale {
    double turn; // of the normal from the middle to the rim, rad
    double fall; // of the terms of one degree beside those of the degree below
    int degree;  // of the polynomial
    /// What a slope's terms of this degree come to at a distance.
    double slope(int of_degree, double r) const {
        double sum = turn * r;
        for (int k = 1; k < of_degree; ++k)
            sum *= fall * r;
        return sum;
    }
};

/// How far data may be off, in lengths of the patch's radius (heights) and rad (slopes): by their own
/// rounding, and by what the polynomial leaves out.
struct Doubt {
    double noise;        // of slopes
    double height_noise; // of heights
    Scale scale;
    double slope(double r) const { return noise + left_out(r); }
    double height(double r) const { return height_noise + left_out(r) * r / 6.0; }
    double left_out(double r) const { return 0.1 * scale.slope(scale.degree + 1, r); }
};

/// What the data's doubt would make of terms that hardly show in them is held down: a term is expected to be
/// no larger than the surface's scale makes it.
void add_expectations(LeastSquares& equations, Scale const& scale) {
    for (int degree = 3; degree <= scale.degree; ++degree) {
        double const weight = 1.0 / scale.slope(degree - 1, 1.0);
        for (std::size_t k = unknowns_of(degree - 1); k < unknowns_of(degree); ++k) {
            Row row{};
            row[k] = 1.0;
            equations.add(row, 0.0, weight);
        }
    }
}

/// From how far the normals are from a polynomial of degree 2 in the place, by least squares: that is what
/// the terms of degree 3 come to.
double fall_of(std::vector<Datum> const& data, double turn) {
    std::array<Equations<6>, 2> equations;
    auto const row_at = [](Datum const& d) {
        return Unknowns<6>{1.0, d.x, d.y, d.x * d.x, d.x * d.y, d.y * d.y};
    };
    for (Datum const& d : data) {
        equations[0].add(row_at(d), d.slope_x);
        equations[1].add(row_at(d), d.slope_y);
    }
    auto const of_x = equations[0].solved(), of_y = equations[1].solved();
    if (!of_x || !of_y || data.size() < 8)
        return turn;
    double squares = 0.0;
    for (Datum const& d : data) {
        Unknowns<6> const row = row_at(d);
        double x = d.slope_x, y = d.slope_y;
        for (std::size_t k = 0; k < 6; ++k) {
            x -= (*of_x)[k] * row[k];
            y -= (*of_y)[k] * row[k];
        }
        squares += x * x + y * y;
    }
    double const off = std::sqrt(squares / static_cast<double>(data.size()));
    constexpr double margin = 2.0, most = 0.5; // beyond it no series tells anything
    // what rounding may have made of the normals says nothing of the surface: then it bends as a sphere does
    double const fall = margin * std::cbrt(std::max(off - normal_noise, 0.0) / turn);
    return std::clamp(fall, std::min(turn, most), most);
}

/// What is known of the surface round a fan.
struct Surroundings {
    double size; // m, radius
    std::vector<Datum> data;
    Doubt doubt;
};

std::optional<Surroundings> patch_round(SmoothFans const& fans, std::uint32_t fan, HeightField const& frame,
                                        FitOptions const& options, int rings) {
    Fan const& centre = fans.fans[fan];
    std::vector<std::uint32_t> const near = neighbours_of(fans, fan, rings);
    double size = 0.0, turn = 1e-5;
    for (std::uint32_t const i : near) {
        size = std::max(size, length(fans.fans[i].place - centre.place));
        turn = std::max(turn, length(fans.fans[i].normal - centre.normal));
    }
    if (!(size > 0.0))
        return std::nullopt;
    constexpr double steepest = 0.3; // cosine; beyond it the patch is no height field here
    std::vector<Datum> data;
    data.reserve(near.size());
    for (std::uint32_t const i : near) {
        Fan const& at = fans.fans[i];
        dvec3 const from = (at.place - centre.place) / size;
        double const nz = dot(at.normal, frame.z_axis);
        if (nz >= steepest)
            data.push_back({dot(from, frame.x_axis), dot(from, frame.y_axis), dot(from, frame.z_axis),
                            -dot(at.normal, frame.x_axis) / nz, -dot(at.normal, frame.y_axis) / nz,
                            length(from)});
    }
    // a float height is off by an ulp of the coordinates
    double const fall = fall_of(data, turn);
    return Surroundings{size,
                        std::move(data),
                        {normal_noise,
                         (fans.float_positions ? 0x1p-24 : 0x1p-50) * fans.reach / size,
                         {turn, fall, options.degree}}};
}

} // namespace

std::optional<HeightField> fit_at(SmoothFans const& fans, std::uint32_t fan, FitOptions const& options) {
    Fan const& centre = fans.fans[fan];
    HeightField field;
    field.origin = centre.place;
    field.z_axis = centre.normal;
    field.x_axis = perpendicular_to(field.z_axis);
    field.y_axis = cross(field.z_axis, field.x_axis);
    auto patch = patch_round(fans, fan, field, options, 2);
    // a third ring lessens the noise, where the polynomial reaches so far
    constexpr double third_ring = 1.5, little = 16.0;
    if (patch && patch->doubt.left_out(third_ring) < little * patch->doubt.noise)
        patch = patch_round(fans, fan, field, options, 3);
    if (!patch)
        return std::nullopt;
    auto const& [size, data, doubt] = *patch;
    std::size_t const unknowns = unknowns_of(options.degree);
    LeastSquares equations(data.size() * (options.slopes ? 3 : 1) + unknowns, unknowns);
    for (Datum const& d : data) {
        equations.add(row_of(Of::height, d.x, d.y), d.z, 1.0 / doubt.height(d.distance));
        if (options.slopes) {
            double const weight = 1.0 / doubt.slope(d.distance);
            equations.add(row_of(Of::slope_x, d.x, d.y), d.slope_x, weight);
            equations.add(row_of(Of::slope_y, d.x, d.y), d.slope_y, weight);
        }
    }
    add_expectations(equations, doubt.scale);
    std::size_t const independent = equations.reflect();
    int degree = options.degree;
    while (degree > 0 && unknowns_of(degree) > independent)
        --degree;
    if (degree == 0)
        return std::nullopt;
    Row const solved = equations.solution(unknowns_of(degree));
    // the constant says how far the place lies off what all data tell: where rounding may have put it there,
    // the surface follows the data, otherwise it keeps to the place
    double const constant = solved[0] * size;
    field.constant = std::abs(constant) <= height_noise(fans) ? constant : 0.0;
    double unit = 1.0;
    for (int sum = 1; sum <= degree; ++sum, unit /= size)
        for (std::size_t k = unknowns_of(sum - 1); k < unknowns_of(sum); ++k)
            field.c[k - 1] = solved[k] * unit;
    return field;
}

} // namespace sahl
