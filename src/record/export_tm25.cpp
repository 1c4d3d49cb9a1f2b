// The numbers of sections are those of IES TM-25-13, as in scene/read_tm25.cpp.
#include "record/export_tm25.h"

#include "math/nearest_name.h"
#include "record/log_columns.h"
#include "record/pending_file.h"
#include "record/read_rays.h"

#include <algorithm>
#include <limits>
#include <set>

namespace sahl {

namespace {

constexpr std::size_t description_size = 4000; // 4.7.3, bytes: 1000 characters of four

bool counted(Segment const& segment) {
    return segment.ended == Event::detected || segment.ended == Event::passed;
}

template <class Visit>
void for_all(RayLogReader const& log, PathFilter const* paths, Visit visit) {
    read_rays(log, paths, [&](std::span<Segment const> ray) {
        for (Segment const& segment : ray)
            visit(segment);
        return true;
    });
}

/// What arrives, before it is written: the header has it.
struct Census {
    std::uint64_t rays = 0;
    double power = 0.0;             // W
    std::set<double> wavelengths{}; // m
};

struct Place {
    std::int32_t surface = -1;
    bool detector = false;

    bool has(Segment const& segment) const {
        return segment.surface == surface && (!detector || counted(segment)) && segment.power_end > 0.0;
    }
};

[[noreturn]] void refuse(RayLogReader const& log, std::string const& problem, std::string const& remedy) {
    throw InputError("log of " + log.header().title, problem, remedy);
}

std::string quoted_names(std::vector<std::string> const& names) {
    std::string text;
    for (std::string const& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

Place place_called(RayLogReader const& log, std::string const& where) {
    std::vector<std::string> const& surfaces = log.header().surfaces;
    std::set<std::int32_t> detectors;
    for_all(log, nullptr, [&](Segment const& segment) {
        if (counted(segment) && segment.surface >= 0)
            detectors.insert(segment.surface);
    });
    std::vector<std::string> names;
    for (std::int32_t const detector : detectors)
        names.push_back(surfaces[static_cast<std::size_t>(detector)]);
    if (where.empty()) {
        if (detectors.size() != 1)
            refuse(log, names.empty() ? "no light came to a detector" : "light came to several detectors",
                   names.empty() ? "name a face whose light is wanted with --detector"
                                 : "name one of them with --detector: " + quoted_names(names));
        return {*detectors.begin(), true};
    }
    auto const found = std::find(surfaces.begin(), surfaces.end(), where);
    if (found == surfaces.end()) {
        refuse(log, "there is no detector or face " + where,
               "did you mean " + nearest_name(where, surfaces) + "?");
    }
    auto const number = static_cast<std::int32_t>(found - surfaces.begin());
    return {number, detectors.count(number) > 0};
}

/// UTF-8 as characters of four bytes, as many as fit with a 0 behind them.
std::string description(std::string const& text) {
    std::string bytes;
    for (std::size_t i = 0; i < text.size() && bytes.size() + 8 <= description_size;) {
        auto const first = static_cast<unsigned char>(text[i++]);
        std::size_t const more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
        std::uint32_t character = more == 0 ? first : first & (0x3FU >> more);
        for (std::size_t k = 0; k < more && i < text.size(); ++k)
            character = character << 6 | (static_cast<unsigned char>(text[i++]) & 0x3FU);
        bytes.append(reinterpret_cast<char const*>(&character), 4);
    }
    bytes.resize(description_size, '\0');
    return bytes;
}

struct Bytes {
    std::string bytes{};
    template <class T>
    void put(T value) {
        bytes.append(reinterpret_cast<char const*>(&value), sizeof value);
    }
};

std::string header_of(LogHeader const& header, Census const& census, std::string const& where) {
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    bool const one = census.wavelengths.size() == 1;
    Bytes out{"TM25"};
    out.put<std::int32_t>(2013);
    out.put<std::int32_t>(0); // 4.7.1.3: simulated
    out.put(unknown);         // luminous flux
    out.put(static_cast<float>(census.power));
    out.put<std::uint64_t>(census.rays);
    out.bytes.append(28, '\0');         // no date: the same rays give the same bytes
    out.put<std::int32_t>(0);           // 4.7.1.8: on what the rays start is not said
    out.put<std::int32_t>(one ? 1 : 2); // 4.7.1.9: one wavelength, or one a ray
    out.put(one ? static_cast<float>(in_nm(*census.wavelengths.begin())) : unknown);
    out.put(static_cast<float>(in_nm(*census.wavelengths.begin())));
    out.put(static_cast<float>(in_nm(*census.wavelengths.rbegin())));
    out.put<std::int32_t>(0); // spectral tables
    out.put<std::int32_t>(0); // further columns
    out.put<std::int32_t>(0); // further text
    out.bytes.append(168, '\0');
    for (bool const flag : {true, true, true, !one, false, false, false, false}) // 4.7.2
        out.put<std::int32_t>(flag);
    // 4.7.3: name, maker and model of the light source, maker of the file, equipment, camera, light source,
    // more, reference
    for (std::string const& text :
         {header.title, std::string("unknown"), header.program, header.program, std::string("none"),
          std::string("none"), quoted_names(header.sources),
          "rays as they arrive at " + where + "; SHA-256 of the experiment: " + header.experiment_sha256,
          std::string("none")})
        out.bytes += description(text);
    return std::move(out.bytes);
}

} // namespace

void export_tm25(RayLogReader const& log, std::string const& where, std::filesystem::path const& out,
                 PathFilter const* paths) {
    LogHeader const& header = log.header();
    if (header.every != 1 || header.min_power > 0.0)
        refuse(log, "it holds only some of the rays, so that their powers would not add up to the light",
               "trace again with log.every = 1 and log.min_power = 0");
    Place const place = place_called(log, where);
    std::string const& name = header.surfaces[static_cast<std::size_t>(place.surface)];
    Census census;
    for_all(log, paths, [&](Segment const& segment) {
        if (!place.has(segment))
            return;
        ++census.rays;
        census.power += segment.power_end;
        census.wavelengths.insert(segment.wavelength);
    });
    if (census.rays == 0)
        refuse(log, "no light came to " + name, "name another detector or face with --detector");
    PendingFile file(out);
    file.write(header_of(header, census, name));
    Bytes rows;
    for_all(log, paths, [&](Segment const& segment) {
        if (!place.has(segment))
            return;
        dvec3 const end = segment.origin + segment.length * segment.direction;
        for (dvec3 const& v : {1e3 * end, segment.direction})
            for (int axis = 0; axis < 3; ++axis)
                rows.put(static_cast<float>(v[axis]));
        rows.put(static_cast<float>(segment.power_end));
        if (census.wavelengths.size() > 1)
            rows.put(static_cast<float>(in_nm(segment.wavelength)));
        if (rows.bytes.size() >= (std::size_t{1} << 20)) {
            file.write(rows.bytes);
            rows.bytes.clear();
        }
    });
    file.write(rows.bytes);
    file.finish();
}

} // namespace sahl
