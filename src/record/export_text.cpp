#include "record/export_text.h"

#include "record/log_columns.h"
#include "record/pending_file.h"
#include "record/read_rays.h"

#include <charconv>
#include <cmath>
#include <type_traits>

namespace sahl {

namespace {

constexpr std::size_t portion_bytes = std::size_t{1} << 20;

template <class Row>
void write_rows(RayLogReader const& log, std::filesystem::path const& out, PathFilter const* where,
                std::string text, Row row) {
    PendingFile file(out);
    read_rays(log, where, [&](std::span<Segment const> ray) {
        for (Segment const& segment : ray)
            row(text, segment);
        if (text.size() >= portion_bytes) {
            file.write(text);
            text.clear();
        }
        return true;
    });
    file.write(text);
    file.finish();
}

template <class Number>
void put(std::string& text, Number number) {
    if constexpr (std::is_floating_point_v<Number>)
        if (!std::isfinite(number)) {
            text += "null";
            return;
        }
    char digits[32];
    text.append(digits, std::to_chars(digits, std::end(digits), number).ptr);
}

/// In quotes, as JSON has it; names are UTF-8, which it takes as it is.
std::string in_quotes(std::string_view name) {
    constexpr char hex[] = "0123456789abcdef";
    std::string text = "\"";
    for (char const c : name) {
        auto const code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            text += '\\';
        if (code < 0x20)
            (text += "\\u00") += {hex[code >> 4], hex[code & 15]};
        else
            text += c;
    }
    return text + '"';
}

std::vector<std::string> all_in_quotes(std::vector<std::string> names) {
    for (std::string& name : names)
        name = in_quotes(name);
    return names;
}

bool ends_for_good(Event event) {
    return event != Event::refracted && event != Event::reflected && event != Event::total_internal &&
           event != Event::passed && event != Event::scattered;
}

} // namespace

void export_json_lines(RayLogReader const& log, std::filesystem::path const& out, PathFilter const* where) {
    auto const surfaces = all_in_quotes(log.header().surfaces), media = all_in_quotes(log.header().media);
    WavelengthInNm nm;
    write_rows(log, out, where, {}, [&](std::string& text, Segment const& segment) {
        char next = '{';
        visit_columns(nm, log.header().digits_lost, [&](ColumnInfo info, auto get, auto) {
            ((((text += next) += '"') += info.name) += "\":");
            next = ',';
            auto const value = get(segment);
            using Kind = std::remove_const_t<decltype(value)>;
            if constexpr (std::is_same_v<Kind, Event>)
                text += in_quotes(name_of(value));
            else if constexpr (std::is_same_v<Kind, MediumNumber>)
                text += media[static_cast<std::size_t>(value)];
            else if constexpr (std::is_same_v<Kind, SurfaceNumber>)
                text += segment.surface >= 0 ? surfaces[static_cast<std::size_t>(segment.surface)] : "null";
            else
                put(text, value);
        });
        text += ",\"end_mm\":";
        if (!std::isfinite(segment.length)) {
            text += "null}\n";
            return;
        }
        dvec3 const end = segment.origin + segment.length * segment.direction;
        for (int axis = 0; axis < 3; ++axis) {
            text += axis == 0 ? '[' : ',';
            put(text, in_mm(end[axis]));
        }
        text += "]}\n";
    });
}

void export_soltrace(RayLogReader const& log, std::filesystem::path const& out, PathFilter const* where) {
    write_rows(log, out, where, "Pos X,Pos Y,Pos Z,Cos X,Cos Y,Cos Z,Element,Stage,Ray Number\n",
               [](std::string& text, Segment const& segment) {
                   if (!std::isfinite(segment.length) || segment.surface < 0)
                       return;
                   dvec3 const end = segment.origin + segment.length * segment.direction;
                   for (dvec3 const& v : {end, segment.direction})
                       for (int axis = 0; axis < 3; ++axis) {
                           put(text, v[axis]);
                           text += ',';
                       }
                   put(text, ends_for_good(segment.ended) ? -(segment.surface + 1) : segment.surface + 1);
                   text += ",1,";
                   put(text, segment.ray + 1);
                   text += '\n';
               });
}

} // namespace sahl
