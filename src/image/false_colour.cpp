// In: a scalar field. Out: a picture of it with axes, a colour bar and a title, in sRGB from 0 to 1.
#include "image/image.h"

#include "image/colour_map.h"
#include "image/text.h"
#include "image/ticks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

namespace sahl {
namespace {

constexpr Colour ground{0.98F, 0.98F, 0.97F}, ink{0.15F, 0.15F, 0.17F};
constexpr double text_scale = 1.8, title_scale = 2.2;
constexpr int line = static_cast<int>(line_height * text_scale);
constexpr int title_line = static_cast<int>(line_height * title_scale) + 2;
constexpr int margin = 18, tick_length = 6, tick_gap = 5, bar_gap = 30, bar_width = 22, minimum_width = 480;
constexpr std::string_view x_title = "x / mm", y_title = "y / mm";

struct Scale {
    double peak, decades; // decades 0: linear from 0

    bool logarithmic() const { return decades > 0.0; }
    double bottom() const { return logarithmic() ? peak * std::pow(10.0, -decades) : 0.0; }
    double share(double value) const {
        if (!logarithmic())
            return value / peak;
        return value > 0.0 ? 1.0 + std::log10(value / peak) / decades : value <= 0.0 ? 0.0 : value;
    }
};

/// Where the parts of the picture lie, in pixels.
struct Layout {
    int across, down;             // pixels of the picture for one of the field
    int left, top, width, height; // the field
    int bar_left, bar_height;     // its top is that of the field
    int picture_width, picture_height;
};

void fill(Image& picture, int left, int top, int width, int height, Colour const& colour) {
    for (int y = top; y < top + height; ++y)
        for (int x = left; x < left + width; ++x)
            std::copy(colour.begin(), colour.end(),
                      &picture.pixels[3 * (static_cast<std::size_t>(y) * picture.width +
                                           static_cast<std::size_t>(x))]);
}

void frame(Image& picture, int left, int top, int width, int height) {
    fill(picture, left - 1, top - 1, width + 2, 1, ink);
    fill(picture, left - 1, top + height, width + 2, 1, ink);
    fill(picture, left - 1, top, 1, height, ink);
    fill(picture, left + width, top, 1, height, ink);
}

int text_width(std::string_view text, double scale = text_scale) {
    return static_cast<int>(std::ceil(letter_count(text) * letter_width * scale));
}

/// Horizontal position of the text: its left, middle or right at x for align 0, ½, 1; y is the middle of its
/// letters.
void write(Image& picture, double x, double y, double align, std::string_view text) {
    double const half_letter = 3.5 * text_scale; // capitals are 7 dots high
    draw_text(picture, x - align * text_width(text), y - half_letter, text, text_scale, ink[0]);
}

/// Whole factors that make the longer side at least 512 pixels, the shorter one visible, and the picture's
/// aspect that of the field to within 5 % where that takes no more than 2048 pixels.
std::array<int, 2> enlargement(Image const& field, double width_mm, double height_mm) {
    double const aspect = height_mm * field.width / (width_mm * field.height); // of one pixel of the field
    double const tall = std::isfinite(aspect) && aspect > 0.0 ? aspect : 1.0;
    bool const wide = tall * field.height <= field.width;
    int const side = static_cast<int>(wide ? field.width : field.height);
    int const other = static_cast<int>(wide ? field.height : field.width);
    double const stretch = wide ? tall : 1.0 / tall;
    int const least = (512 + side - 1) / side;
    std::array<int, 2> best{least, 1};
    double best_error = 1e9;
    for (int factor = least; best_error > 0.05 && (factor == least || factor * side <= 2048); ++factor) {
        int const matching = std::max(1, static_cast<int>(std::lround(factor * stretch)));
        double const error = std::abs(std::log(matching / (factor * stretch)));
        if (error < best_error)
            best = {factor, matching};
        best_error = std::min(error, best_error);
    }
    best[1] = std::max(best[1], 32 / other);
    return wide ? best : std::array<int, 2>{best[1], best[0]};
}

/// The words of a title in lines of no more than `most` letters each, as far as single words allow.
std::vector<std::string> wrapped(std::string const& title, int most) {
    std::vector<std::string> lines;
    std::istringstream words(title);
    for (std::string word; words >> word;) {
        if (lines.empty() || letter_count(lines.back()) + 1 + letter_count(word) > most)
            lines.push_back(word);
        else
            lines.back() += " " + word;
    }
    return lines;
}

/// Row 0 of the field at the top, each of its values a block of equal pixels.
void draw_field(Image& picture, Image const& field, Scale const& scale, Layout const& at) {
    for (std::uint32_t y = 0; y < field.height; ++y)
        for (std::uint32_t x = 0; x < field.width; ++x) {
            double const value = field.pixels[(std::size_t{y} * field.width + x) * field.channels];
            fill(picture, at.left + static_cast<int>(x) * at.across, at.top + static_cast<int>(y) * at.down,
                 at.across, at.down, colour_of(scale.share(value)));
        }
    frame(picture, at.left, at.top, at.width, at.height);
}

void draw_axes(Image& picture, std::vector<double> const& x_ticks, std::vector<double> const& y_ticks,
               double width_mm, double height_mm, Layout const& at) {
    int const bottom = at.top + at.height;
    for (double const tick : x_ticks) {
        double const x = at.left + (0.5 + tick / width_mm) * at.width;
        fill(picture, static_cast<int>(x), bottom, 1, tick_length, ink);
        write(picture, x, bottom + tick_length + line * 0.55, 0.5, tick_label(tick));
    }
    for (double const tick : y_ticks) {
        double const y = at.top + (0.5 - tick / height_mm) * at.height;
        fill(picture, at.left - tick_length, std::min(static_cast<int>(y), bottom), tick_length, 1, ink);
        write(picture, at.left - tick_length - tick_gap, y, 1.0, tick_label(tick));
    }
    write(picture, at.left + at.width / 2.0, bottom + tick_length + line * 1.6, 0.5, x_title);
    write(picture, at.left, at.top - line, 0.0, y_title);
}

struct Mark {
    double value;
    std::string label; // empty: a tick alone
};

/// The ends of the scale, and the round values between them that have room.
std::vector<Mark> bar_marks(Scale const& scale, int height) {
    double const room = 1.1 * line / height;
    std::vector<Mark> marks{{scale.bottom(), tick_label(scale.bottom(), 3)},
                            {scale.peak, tick_label(scale.peak, 3)}};
    auto const add = [&](double value, bool labelled) {
        bool const free = std::none_of(marks.begin(), marks.end(), [&](Mark const& m) {
            return !m.label.empty() && std::abs(scale.share(m.value) - scale.share(value)) < room;
        });
        marks.push_back({value, labelled && free ? tick_label(value, 3) : ""});
    };
    if (!scale.logarithmic()) {
        for (double const value : round_ticks(0.0, scale.peak, std::clamp(height / 60, 1, 10)))
            add(value, true);
        return marks;
    }
    for (double const value : decade_ticks(scale.bottom(), scale.peak, false))
        add(value, true);
    if (scale.decades * 9 * 4 < height) // ticks within decades want four pixels each
        for (double const value : decade_ticks(scale.bottom(), scale.peak, true))
            add(value, scale.decades < 2.0);
    return marks;
}

void draw_bar(Image& picture, Scale const& scale, std::vector<Mark> const& marks, std::string const& unit,
              Layout const& at) {
    for (int y = 0; y < at.bar_height; ++y)
        fill(picture, at.bar_left, at.top + y, bar_width, 1, colour_of(1.0 - (y + 0.5) / at.bar_height));
    frame(picture, at.bar_left, at.top, bar_width, at.bar_height);
    int const right = at.bar_left + bar_width;
    for (Mark const& mark : marks) {
        double const y = at.top + (1.0 - scale.share(mark.value)) * at.bar_height;
        int const row = std::clamp(static_cast<int>(y), at.top - 1, at.top + at.bar_height);
        fill(picture, right, row, mark.label.empty() ? tick_length / 2 + 1 : tick_length, 1, ink);
        write(picture, right + tick_length + tick_gap, y, 0.0, mark.label);
    }
    write(picture, at.bar_left, at.top - line, 0.0, unit);
}

template <class List, class Width>
int widest(List const& list, Width width) {
    int most = 0;
    for (auto const& item : list)
        most = std::max(most, width(item));
    return most;
}

} // namespace

Image false_colour(Image const& field, double peak, double decades, std::string const& title,
                   std::string const& unit, double width_mm, double height_mm) {
    Scale const scale{peak > 0.0 ? peak : 1.0, decades}; // an empty field is dark on a scale from 0 to 1
    auto const [across, down] = enlargement(field, width_mm, height_mm);
    Layout at{};
    at.across = across;
    at.down = down;
    at.width = across * static_cast<int>(field.width);
    at.height = down * static_cast<int>(field.height);
    at.bar_height = std::max(at.height, 8 * line);

    std::vector<double> const y_ticks =
        round_ticks(-height_mm / 2, height_mm / 2, std::clamp(at.height / 50, 1, 10));
    auto const x_label_width = [](double tick) { return text_width(tick_label(tick)); };
    std::vector<double> x_ticks;
    for (int most = std::clamp(at.width / 40, 1, 10); most >= 1;
         --most) { // as many as leave two letters between labels
        x_ticks = round_ticks(-width_mm / 2, width_mm / 2, most);
        if (static_cast<int>(x_ticks.size()) * (widest(x_ticks, x_label_width) + text_width("  ")) <=
            at.width)
            break;
    }
    std::vector<Mark> const marks = bar_marks(scale, at.bar_height);
    int const bar_labels = widest(marks, [](Mark const& m) { return text_width(m.label); });

    at.left = margin + tick_length + tick_gap + widest(y_ticks, x_label_width);
    at.bar_left = at.left + std::max(at.width, text_width(y_title)) + bar_gap;
    int const right_part = std::max(bar_width + tick_length + tick_gap + bar_labels, text_width(unit));
    at.picture_width = std::max(minimum_width, at.bar_left + right_part + margin);
    std::vector<std::string> const lines =
        wrapped(title, static_cast<int>((at.picture_width - 2 * margin) / (letter_width * title_scale)));
    at.picture_width = std::max(at.picture_width, 2 * margin + widest(lines, [](std::string const& words) {
                                                      return text_width(words, title_scale);
                                                  }));
    at.top = margin + static_cast<int>(lines.size()) * title_line + 3 * line / 2;
    at.picture_height =
        at.top + std::max(at.height + tick_length + 2 * line, at.bar_height + line / 2) + margin;

    Image picture{
        static_cast<std::uint32_t>(at.picture_width), static_cast<std::uint32_t>(at.picture_height), 3, {}};
    picture.pixels.resize(std::size_t{3} * picture.width * picture.height);
    fill(picture, 0, 0, at.picture_width, at.picture_height, ground);
    for (std::size_t i = 0; i < lines.size(); ++i)
        draw_text(picture, margin, margin + static_cast<int>(i) * title_line, lines[i], title_scale, ink[0],
                  true);
    draw_field(picture, field, scale, at);
    draw_axes(picture, x_ticks, y_ticks, width_mm, height_mm, at);
    draw_bar(picture, scale, marks, unit, at);
    return picture;
}

} // namespace sahl
