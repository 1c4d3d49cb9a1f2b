// In: the text of an experiment, or its file. Out: what `sahl trace` makes of it: summary, log, failed
// checks; and small functions that find one's way in them. Nothing stays on disk.
#pragma once

#include "record/ray_log.h"
#include "run/run.h"

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace sahl::bench {

/// A new folder under the system's temporary one, removed with all that is in it at the end of its life.
class Folder {
  public:
    Folder();
    ~Folder();
    Folder(Folder const&) = delete;
    Folder& operator=(Folder const&) = delete;
    std::filesystem::path const& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

struct Run {
    Value summary;
    LogHeader names;
    std::vector<Segment> segments;
};

/// Writes the text to a file, loads it, runs it with trace.log on and reads the log back. That no check of
/// physics fails is required here. Each of `set` is KEY=VALUE.
Run run(std::string const& text, std::vector<std::string> const& set = {});

/// The same without a log and without files: the summary alone.
Value summarise(std::string const& text, std::vector<std::string> const& set = {});

template <class Piece>
void put(std::ostream& out, Piece const& piece) {
    out << piece;
}
inline void put(std::ostream& out, dvec3 const& v) {
    out << '[' << v.x << ", " << v.y << ", " << v.z << ']';
}

/// Pieces of text and numbers, these with 17 digits, one after another; a vector is [x, y, z].
template <class... Pieces>
std::string text(Pieces const&... pieces) {
    std::ostringstream out;
    out.precision(17);
    (put(out, pieces), ...);
    return out.str();
}

using Rows = std::vector<Segment>; // of one ray, in the order of the log

Rows rows_of(Run const& run, std::uint64_t ray);

/// The segment that is reached from the root by children born of these events, one after another. Required to
/// exist.
Segment branch(Rows const& rows, std::vector<Event> const& births);

/// The root, its first child, that one's first child, to the end: refracted wherever light is refracted.
Rows direct_path(Rows const& rows);

dvec3 end_of(Segment const& segment);

/// "lens.front", or nothing.
std::string surface_at_end(Run const& run, Segment const& segment);

/// The number found by going down these keys (0, 1, … in an array). Required to be there.
double number_at(Value const& value, std::initializer_list<std::string_view> path);

/// Of a medium by its name, at the log's only wavelength or the one given in nm.
double index_of(Run const& run, std::string_view medium, double wavelength_nm = 0.0);

} // namespace sahl::bench
