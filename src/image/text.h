// In: a line of text. Out: the same, drawn into a picture with strokes of its own small alphabet: no font
// file is needed.
#pragma once

#include "image/image.h"

#include <string_view>

namespace sahl {

/// One letter takes this width, and one line this height, at scale 1.
constexpr int letter_width = 6, line_height = 11;

/// Number of letters of a UTF-8 text.
int letter_count(std::string_view text);

/// Draws `text` (UTF-8) into an RGB image, its first letter's top left at (x, y), in grey `ink` (0 … 1); what
/// would fall outside the image is left away, and letters that the alphabet lacks become a box. scale ≥ 1:
/// pixels per dot.
void draw_text(Image& image, double x, double y, std::string_view text, double scale, float ink,
               bool bold = false);

} // namespace sahl
