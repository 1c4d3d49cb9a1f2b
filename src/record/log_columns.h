// In: a segment in SI units. Out: its values as the log's columns have them, and the way back; one table that
// the HDF5 writer, the reader and the CSV export share. The units of the log (mm, nm) begin and end here.
#pragma once

#include "trace/segment.h"

#include <cmath>
#include <optional>
#include <type_traits>

namespace sahl {

inline constexpr std::int32_t log_schema_version = 2;

struct ColumnInfo {
    char const* name;
    char const* unit;
    char const* meaning;
};

enum class SurfaceNumber : std::int32_t {}; // columns that are numbers in HDF5 and names in CSV
enum class MediumNumber : std::uint16_t {};

/// The type of a value in the file: an enumeration's integer, anything else itself.
template <class T>
using Stored =
    typename std::conditional_t<std::is_enum_v<T>, std::underlying_type<T>, std::type_identity<T>>::type;

inline double in_mm(double metres) {
    return metres * 1e3;
}

/// The metres that in_mm turns into exactly this number, so that rows read and written again (a merge) keep
/// their bytes. Two roundings stand between the quotient and that value, at most two ulp.
inline double from_mm(double mm) {
    double const metres = mm / 1e3;
    if (in_mm(metres) == mm)
        return metres;
    double above = metres, below = metres;
    for (int step = 0; step < 2; ++step) {
        above = std::nextafter(above, INFINITY);
        below = std::nextafter(below, -INFINITY);
        if (in_mm(above) == mm)
            return above;
        if (in_mm(below) == mm)
            return below;
    }
    return metres;
}

inline double from_nm(double nm) {
    return nm * 1e-9;
}

/// A number of nm that from_nm turns into this wavelength: if possible the decimal of ten places that an
/// experiment says (587.5618, not 587.56180000000006), even if that was divided by 1e9. None for a wavelength
/// that from_nm never gives.
inline std::optional<double> exact_nm(double metres) {
    double const decimal =
        std::round(metres * 1e9 * 1e10) / 1e10; // both exact: rounds as reading the decimal does
    if (from_nm(decimal) == metres || decimal / 1e9 == metres)
        return decimal;
    double above = metres * 1e9, below = above;
    for (int step = 0; step <= 3; ++step) { // three roundings stand between the product and the answer
        if (from_nm(above) == metres)
            return above;
        if (from_nm(below) == metres)
            return below;
        above = std::nextafter(above, INFINITY);
        below = std::nextafter(below, -INFINITY);
    }
    return std::nullopt;
}

/// The wavelength in nm as the log has it. One that from_nm never gives is moved by an ulp or two to one that
/// it does, so that what is read and written again stays as it is.
inline double in_nm(double metres) {
    if (auto const nm = exact_nm(metres))
        return *nm;
    return exact_nm(from_nm(metres * 1e9)).value_or(metres * 1e9);
}

/// in_nm, remembering the last answer: neighbouring rows nearly always share their wavelength.
struct WavelengthInNm {
    double metres = 0.0, nm = 0.0;
    double operator()(double wavelength) {
        if (wavelength != metres) {
            metres = wavelength;
            nm = in_nm(wavelength);
        }
        return nm;
    }
};

/// Calls column(info, get, set) for each column in the order of the contract.
///   digits_lost                      with the column of that name, which a log has where it was asked for
///   get(Segment const&)                 the value of the column; Stored<…> of its type is the type in the
///   file set(Segment&, Stored<…> value)      puts it back
template <class Visitor>
void visit_columns(WavelengthInNm& nm, bool digits_lost, Visitor&& column) {
    using S = Segment;
    column(
        ColumnInfo{"ray", "", "number of the ray, counted from 0 through all sources"},
        [](S const& s) { return s.ray; }, [](S& s, std::uint64_t v) { s.ray = v; });
    column(
        ColumnInfo{"segment", "", "index in the tree of its ray, breadth first, refracted before reflected"},
        [](S const& s) { return s.index; }, [](S& s, std::uint32_t v) { s.index = v; });
    column(
        ColumnInfo{"parent", "", "index of the segment it was born from, -1 for the root"},
        [](S const& s) { return s.parent; }, [](S& s, std::int32_t v) { s.parent = v; });
    column(
        ColumnInfo{"depth", "", "interactions so far"}, //
        [](S const& s) { return s.depth; }, [](S& s, std::uint16_t v) { s.depth = v; });
    column(
        ColumnInfo{"born", "", "event that began it"}, //
        [](S const& s) { return s.born; }, [](S& s, std::uint8_t v) { s.born = Event{v}; });
    column(
        ColumnInfo{"ended", "", "event that ended it"}, //
        [](S const& s) { return s.ended; }, [](S& s, std::uint8_t v) { s.ended = Event{v}; });
    column(
        ColumnInfo{"surface", "", "what it ends on, a row of /surfaces; -1: nothing"},
        [](S const& s) { return SurfaceNumber{s.surface}; }, [](S& s, std::int32_t v) { s.surface = v; });
    column(
        ColumnInfo{"primitive", "", "triangle it ends on; -1: none"}, //
        [](S const& s) { return s.primitive; }, [](S& s, std::int32_t v) { s.primitive = v; });
    column(
        ColumnInfo{"medium", "", "what it runs through, a row of /media"},
        [](S const& s) { return MediumNumber{s.medium}; }, [](S& s, std::uint16_t v) { s.medium = v; });
    column(
        ColumnInfo{"wavelength_nm", "nm", "wavelength in standard air"},
        [&nm](S const& s) { return nm(s.wavelength); }, [](S& s, double v) { s.wavelength = from_nm(v); });
    column(
        ColumnInfo{"x_mm", "mm", "start"}, //
        [](S const& s) { return in_mm(s.origin.x); }, [](S& s, double v) { s.origin.x = from_mm(v); });
    column(
        ColumnInfo{"y_mm", "mm", "start"}, //
        [](S const& s) { return in_mm(s.origin.y); }, [](S& s, double v) { s.origin.y = from_mm(v); });
    column(
        ColumnInfo{"z_mm", "mm", "start"}, //
        [](S const& s) { return in_mm(s.origin.z); }, [](S& s, double v) { s.origin.z = from_mm(v); });
    column(
        ColumnInfo{"dx", "1", "unit direction along travel"}, //
        [](S const& s) { return s.direction.x; }, [](S& s, double v) { s.direction.x = v; });
    column(
        ColumnInfo{"dy", "1", "unit direction along travel"}, //
        [](S const& s) { return s.direction.y; }, [](S& s, double v) { s.direction.y = v; });
    column(
        ColumnInfo{"dz", "1", "unit direction along travel"}, //
        [](S const& s) { return s.direction.z; }, [](S& s, double v) { s.direction.z = v; });
    column(
        ColumnInfo{"length_mm", "mm", "length of this piece; inf if it escapes"},
        [](S const& s) { return in_mm(s.length); }, [](S& s, double v) { s.length = from_mm(v); });
    column(
        ColumnInfo{"optical_path_mm", "mm", "optical path from the source to its end, relative to air"},
        [](S const& s) { return in_mm(s.optical_path); },
        [](S& s, double v) { s.optical_path = from_mm(v); });
    column(
        ColumnInfo{"power_start_W", "W", "power at its start"}, //
        [](S const& s) { return s.power_start; }, [](S& s, double v) { s.power_start = v; });
    column(
        ColumnInfo{"power_end_W", "W", "power at its end, after absorption on the way"},
        [](S const& s) { return s.power_end; }, [](S& s, double v) { s.power_end = v; });
    if (digits_lost)
        column(
            ColumnInfo{
                "digits_lost", "1",
                "decimal digits of sixteen that rounding has taken from place or direction by its end"},
            [](S const& s) { return s.digits_lost; }, [](S& s, double v) { s.digits_lost = v; });
}

} // namespace sahl
