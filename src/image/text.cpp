// In: a line of text. Out: smooth strokes in a picture: the dots of a letter become round pen strokes between
// neighbours.
#include "image/text.h"

#include "image/alphabet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sahl {
namespace {

constexpr int columns = 5, rows = 9;
constexpr std::string_view unknown = "#####/#...#/#...#/#...#/#...#/#...#/#####";

/// The next letter of a UTF-8 text, which is shortened by it; U+FFFD where the bytes make no sense.
char32_t take_letter(std::string_view& text) {
    auto const first = static_cast<unsigned char>(text.front());
    std::size_t const length = first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    bool valid = first < 0x80 || (first >= 0xC2 && first < 0xF5 && length <= text.size());
    char32_t code = length == 1 ? first : first & (0x7FU >> length);
    for (std::size_t i = 1; valid && i < length; ++i) {
        auto const next = static_cast<unsigned char>(text[i]);
        valid = (next & 0xC0U) == 0x80;
        code = code << 6 | (next & 0x3FU);
    }
    text.remove_prefix(valid ? length : 1);
    return valid ? code : U'\uFFFD';
}

std::string_view dots_of(char32_t code) {
    for (Letter const& letter : alphabet())
        if (letter.code == code)
            return letter.dots;
    return unknown;
}

struct Dots {
    std::array<std::array<bool, columns + 2>, rows + 2> on{}; // with a rim, so that every dot has neighbours

    explicit Dots(std::string_view text) {
        int column = 1, row = 1;
        for (char c : text) {
            if (c == '/') {
                column = 1;
                ++row;
            } else {
                on[row][column++] = c == '#';
            }
        }
    }
    /// Whether a stroke joins the dot at (column, row) to the one at a step: itself and straight neighbours
    /// always, diagonal ones where no way round the corner joins them.
    bool joined(int column, int row, int right, int down) const {
        return on[row][column] && on[row + down][column + right] &&
               (right == 0 || down == 0 || (!on[row][column + right] && !on[row + down][column]));
    }
};

/// Distance of (x, y) from the segment from (ax, ay) by (dx, dy); a dot where that is (0, 0).
double distance(double x, double y, double ax, double ay, double dx, double dy) {
    double const square = dx * dx + dy * dy;
    double const along = square > 0 ? std::clamp(((x - ax) * dx + (y - ay) * dy) / square, 0.0, 1.0) : 0.0;
    return std::hypot(x - ax - along * dx, y - ay - along * dy);
}

/// Distance of a place from the nearest stroke; dot (column, row) lies at (column − ½, row − ½).
double distance_to_strokes(Dots const& dots, double x, double y) {
    constexpr std::array<std::array<int, 2>, 5> steps{{{0, 0}, {1, 0}, {0, 1}, {1, 1}, {-1, 1}}};
    double nearest = 1e9;
    for (int row = 1; row <= rows; ++row)
        for (int column = 1; column <= columns; ++column)
            for (auto const& [right, down] : steps)
                if (dots.joined(column, row, right, down))
                    nearest = std::min(nearest, distance(x, y, column - 0.5, row - 0.5, right, down));
    return nearest;
}

void draw_letter(Image& image, double left, double top, Dots const& dots, double scale, double half_pen,
                 float ink) {
    int const x_end =
        std::min(static_cast<int>(left + scale * letter_width) + 1, static_cast<int>(image.width));
    int const y_end = std::min(static_cast<int>(top + scale * rows) + 1, static_cast<int>(image.height));
    for (int y = std::max(0, static_cast<int>(top) - 1); y < y_end; ++y) {
        for (int x = std::max(0, static_cast<int>(left) - 1); x < x_end; ++x) {
            double const gap =
                distance_to_strokes(dots, (x + 0.5 - left) / scale, (y + 0.5 - top) / scale) - half_pen;
            auto const cover = static_cast<float>(std::clamp(0.5 - gap * scale, 0.0, 1.0));
            float* const pixel =
                &image.pixels[(static_cast<std::size_t>(y) * image.width + x) * image.channels];
            for (std::uint32_t c = 0; c < image.channels; ++c)
                pixel[c] += cover * (ink - pixel[c]);
        }
    }
}

} // namespace

int letter_count(std::string_view text) {
    int count = 0;
    for (; !text.empty(); ++count)
        take_letter(text);
    return count;
}

void draw_text(Image& image, double x, double y, std::string_view text, double scale, float ink, bool bold) {
    for (double left = x; !text.empty(); left += scale * letter_width)
        draw_letter(image, left, y, Dots(dots_of(take_letter(text))), scale, bold ? 0.55 : 0.38, ink);
}

} // namespace sahl
