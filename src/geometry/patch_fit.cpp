#include "geometry/patch_fit.h"

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

constexpr int unknowns_of(int degree) {
    return degree == 4 ? 15 : degree == 3 ? 10 : degree == 2 ? 6 : 3;
}

constexpr int most_unknowns = 15;                  // a constant, and HeightField's
using Row = std::array<double, most_unknowns + 1>; // and the right hand side

/// Least squares by Householder's reflections; nothing where a column is all but a sum of those before it.
std::optional<std::array<double, most_unknowns>> solve(std::vector<Row> rows, int unknowns) {
    constexpr double independent = 1e-4; // of columns of about the same length: far above rounding
    auto const n = static_cast<std::size_t>(unknowns), m = rows.size();
    if (m < n)
        return std::nullopt;
    for (std::size_t k = 0; k < n; ++k) {
        double whole = 0.0, rest = 0.0;
        for (std::size_t i = 0; i < m; ++i)
            (i < k ? whole : rest) += rows[i][k] * rows[i][k];
        whole += rest;
        if (!(rest > independent * independent * whole))
            return std::nullopt;
        double const norm = std::copysign(std::sqrt(rest), -rows[k][k]);
        double const head = rows[k][k] - norm; // of Householder's vector; below it the column itself
        double const scale = -1.0 / (norm * head);
        for (std::size_t j = k + 1; j <= n; ++j) {
            std::size_t const column = j == n ? most_unknowns : j;
            double sum = head * rows[k][column];
            for (std::size_t i = k + 1; i < m; ++i)
                sum += rows[i][k] * rows[i][column];
            sum *= scale;
            rows[k][column] -= sum * head;
            for (std::size_t i = k + 1; i < m; ++i)
                rows[i][column] -= sum * rows[i][k];
        }
        rows[k][k] = norm;
    }
    std::array<double, most_unknowns> x{};
    for (std::size_t k = n; k-- > 0;) {
        double sum = rows[k][most_unknowns];
        for (std::size_t j = k + 1; j < n; ++j)
            sum -= rows[k][j] * x[j];
        x[k] = sum / rows[k][k];
    }
    return x;
}

enum class Of : std::uint8_t { height, slope_x, slope_y };

/// One equation: the terms xⁱyʲ in the order of their degree, or their derivatives, and what they add up to.
Row row_of(Of what, double x, double y, double value, double weight) {
    std::array<double, 5> const px{1.0, x, x * x, x * x * x, x * x * x * x};
    std::array<double, 5> const py{1.0, y, y * y, y * y * y, y * y * y * y};
    Row row{};
    std::size_t term = 0;
    for (std::size_t degree = 0; degree < px.size(); ++degree)
        for (std::size_t j = 0; j <= degree; ++j) {
            std::size_t const i = degree - j;
            double& entry = row[term++];
            if (what == Of::height)
                entry = weight * px[i] * py[j];
            else if (what == Of::slope_x && i > 0)
                entry = weight * static_cast<double>(i) * px[i - 1] * py[j];
            else if (what == Of::slope_y && j > 0)
                entry = weight * static_cast<double>(j) * px[i] * py[j - 1];
        }
    row[term] = weight * value;
    return row;
}

/// How far data may be off, in lengths of the patch's radius (heights) and rad (slopes): by their own
/// rounding, and by what a polynomial of degree 4 leaves out, which grows with the fifth power of the
/// distance.
struct Doubt {
    double noise;        // of slopes
    double height_noise; // of heights
    double turn;         // of the normal from the middle to the rim, rad
    double slope(double r) const { return noise + left_out(r); }
    double height(double r) const { return height_noise + left_out(r) * r / 6.0; }

  private:
    double left_out(double r) const { // of a sphere 3/8; of other surfaces about as much
        double const t = turn * r;
        return 0.4 * t * t * t * t * t;
    }
};

/// What the data's doubt would make of terms that hardly show in them is held down: a term is expected to be
/// no larger than the turn of the normals over the patch makes it.
void add_expectations(std::vector<Row>& rows, double turn) {
    auto const hold = [&](std::size_t first, std::size_t last, double expected) {
        for (std::size_t k = first; k < last; ++k) {
            Row row{};
            row[k] = 1.0 / expected;
            rows.push_back(row);
        }
    };
    hold(6, 10, turn * turn);
    hold(10, 15, turn * turn * turn);
}

} // namespace

std::optional<HeightField> fit_at(SmoothFans const& fans, std::uint32_t fan, FitOptions const& options) {
    Fan const& centre = fans.fans[fan];
    HeightField field;
    field.origin = centre.place;
    field.z_axis = centre.normal;
    field.x_axis = perpendicular_to(field.z_axis);
    field.y_axis = cross(field.z_axis, field.x_axis);
    std::vector<std::uint32_t> const data = neighbours_of(fans, fan, 2);
    double scale = 0.0, turn = 1e-5;
    for (std::uint32_t const i : data) {
        scale = std::max(scale, length(fans.fans[i].place - centre.place));
        turn = std::max(turn, length(fans.fans[i].normal - centre.normal));
    }
    if (!(scale > 0.0))
        return std::nullopt;
    // a float height is off by an ulp of the coordinates, a normal by an ulp of one: files carry no better
    // ones
    Doubt const doubt{0x1p-24, (fans.float_positions ? 0x1p-24 : 0x1p-50) * fans.reach / scale, turn};
    constexpr double steepest = 0.3; // cosine; beyond it the patch is no height field here
    std::vector<Row> rows;
    for (std::uint32_t const i : data) {
        Fan const& at = fans.fans[i];
        dvec3 const from = at.place - centre.place;
        double const x = dot(from, field.x_axis) / scale, y = dot(from, field.y_axis) / scale;
        double const r = length(from) / scale, nz = dot(at.normal, field.z_axis);
        if (nz < steepest)
            continue;
        rows.push_back(row_of(Of::height, x, y, dot(from, field.z_axis) / scale, 1.0 / doubt.height(r)));
        if (options.slopes) {
            double const weight = 1.0 / doubt.slope(r);
            rows.push_back(row_of(Of::slope_x, x, y, -dot(at.normal, field.x_axis) / nz, weight));
            rows.push_back(row_of(Of::slope_y, x, y, -dot(at.normal, field.y_axis) / nz, weight));
        }
    }
    add_expectations(rows, turn);
    for (int degree = options.degree; degree > 0; --degree) {
        auto const solved = solve(rows, unknowns_of(degree));
        if (!solved)
            continue;
        // the constant says how far the place lies off what all data tell: where rounding may have put it
        // there, the surface follows the data, otherwise it keeps to the place
        double const constant = (*solved)[0] * scale;
        field.constant = std::abs(constant) <= height_noise(fans) ? constant : 0.0;
        double const by = 1.0 / scale;
        std::array<double, 4> const unit{1.0, by, by * by, by * by * by};
        for (std::size_t k = 0; k < field.c.size(); ++k)
            field.c[k] = (*solved)[k + 1] * unit[k < 2 ? 0 : k < 5 ? 1 : k < 9 ? 2 : 3];
        return field;
    }
    return std::nullopt;
}

} // namespace sahl
