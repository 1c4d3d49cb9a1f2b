#include "report/labels.h"

#include "report/html.h"

#include <algorithm>
#include <array>

namespace sahl::report {

namespace {

constexpr double character = 6.6, line_height = 15.0, gap = 4.0; // pixels, at the drawings' 12 px
constexpr std::size_t most_characters = 28;

bool overlap(PixelBox const& a, PixelBox const& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}
bool contains(PixelBox const& outer, PixelBox const& inner) {
    return inner.low.x >= outer.low.x && inner.low.y >= outer.low.y && inner.high.x <= outer.high.x &&
           inner.high.y <= outer.high.y;
}

} // namespace

std::string labels_svg(std::vector<Label> const& labels, PixelBox const& frame) {
    std::vector<PixelBox> taken;
    std::string out;
    for (Label const& label : labels) {
        std::string const text = shortened(label.text, most_characters);
        auto const characters =
            std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
        dvec2 const size(character * static_cast<double>(characters), line_height);
        dvec2 const middle = 0.5 * (label.of.low + label.of.high);
        std::array<dvec2, 5> const places{{{middle.x, label.of.low.y - gap - 0.5 * size.y},
                                           {middle.x, label.of.high.y + gap + 0.5 * size.y},
                                           {label.of.high.x + gap + 0.5 * size.x, middle.y},
                                           {label.of.low.x - gap - 0.5 * size.x, middle.y},
                                           middle}};
        for (dvec2 at : places) {
            double const room = 0.5 * size.x + gap; // moved sideways where the frame's edge is near
            if (at.x == middle.x && frame.high.x - frame.low.x > 2.0 * room)
                at.x = std::clamp(at.x, frame.low.x + room, frame.high.x - room);
            PixelBox const box{at - 0.5 * size, at + 0.5 * size};
            if (!contains(frame, box) ||
                std::any_of(taken.begin(), taken.end(), [&](auto const& t) { return overlap(t, box); }))
                continue;
            taken.push_back(box);
            out += "<text class=\"middle halo " + std::string(label.kind) + "\" x=\"" + coordinate(at.x) +
                   "\" y=\"" + coordinate(at.y + 4.0) + "\">" + escaped(text) + "</text>\n";
            break;
        }
    }
    return out;
}

} // namespace sahl::report
