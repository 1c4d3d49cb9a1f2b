// In: a ray log. Out: the same rows as text, one line a segment; see export_csv.h.
#include "record/export_csv.h"

#include "record/log_columns.h"
#include "record/pending_file.h"
#include "record/read_rays.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace sahl {

namespace {

constexpr std::size_t portion_bytes = 4 << 20; // of text, held in memory

std::string as_field(std::string const& name) {
    if (name.find_first_of(",\"\r\n") == std::string::npos)
        return name;
    std::string text = "\"";
    for (char const c : name)
        text.append(c == '"' ? 2 : 1, c);
    return text + '"';
}

std::vector<std::string> as_fields(std::vector<std::string> names) {
    for (std::string& name : names)
        name = as_field(name);
    return names;
}

/// Appends fields to a text; each overload knows one kind of column.
struct Fields {
    std::vector<std::string> surfaces, media;
    std::string text;

    void put(double value) {
        char digits[32];
        text.append(digits,
                    std::to_chars(digits, std::end(digits), value, std::chars_format::general, 17).ptr);
    }
    template <class Integer>
    void put(Integer value) {
        char digits[24];
        text.append(digits, std::to_chars(digits, std::end(digits), value).ptr);
    }
    void put(Event event) { text += name_of(event); }
    void put(MediumNumber medium) { text += media[static_cast<std::size_t>(medium)]; }
    void put(SurfaceNumber surface) {
        if (auto const number = static_cast<std::int32_t>(surface); number >= 0)
            text += surfaces[static_cast<std::size_t>(number)];
    }
};

void put_row(Fields& fields, WavelengthInNm& nm, bool digits_lost, Segment const& segment) {
    visit_columns(nm, digits_lost, [&](ColumnInfo, auto get, auto) {
        fields.put(get(segment));
        fields.text += ',';
    });
    dvec3 const end = segment.origin + segment.length * segment.direction;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::isfinite(segment.length))
            fields.put(in_mm(end[axis]));
        fields.text += axis < 2 ? ',' : '\n';
    }
}

} // namespace

void export_csv(RayLogReader const& log, std::filesystem::path const& out, PathFilter const* where) {
    Fields fields{as_fields(log.header().surfaces), as_fields(log.header().media), {}};
    WavelengthInNm nm;
    bool const digits_lost = log.header().digits_lost;
    visit_columns(nm, digits_lost, [&](ColumnInfo info, auto, auto) { (fields.text += info.name) += ','; });
    fields.text += "end_x_mm,end_y_mm,end_z_mm\n";
    PendingFile file(out);
    read_rays(log, where, [&](std::span<Segment const> ray) {
        for (Segment const& segment : ray)
            put_row(fields, nm, digits_lost, segment);
        if (fields.text.size() >= portion_bytes) {
            file.write(fields.text);
            fields.text.clear();
        }
        return true;
    });
    file.write(fields.text);
    file.finish();
}

} // namespace sahl
