// In: the parts of a scene. Out: the words that a check has for them.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <string>

namespace sahl {

/// "clear", "mirror (metal)", "absorber", "reflects 50 %, transmits 50 %", …
std::string surface_words(Surface const& surface);

/// "body of N-BK7"; of an open one or one that is opaque all round, what its surface does.
std::string body_words(Scene const& scene, ObjectId body, bool opaque);

/// "sphere of 10 mm", "lens", …
std::string shape_words(Shape const& shape);

/// As printf does, of up to 600 bytes.
[[gnu::format(printf, 1, 2)]] std::string words(char const* format, ...);

/// "1 hole", "2 holes".
std::string plural(std::uint64_t count, char const* one, char const* many);

} // namespace sahl
