// In: the header of a log. Out: attributes and tables of its HDF5 file, and the header again; see
// log_header.h.
#include "record/log_header.h"

#include "record/log_columns.h"

#include <algorithm>
#include <cassert>

namespace sahl {

using namespace hdf5;

namespace {

/// Each is an attribute, of variable length as people expect, and a table of one text, which is what is read
/// here: the library trusts the lengths in its heap of attributes, and crashes where a broken file has
/// others.
struct Text {
    char const* name;
    std::string LogHeader::*value;
};

constexpr Text texts[] = {{"program", &LogHeader::program},
                          {"title", &LogHeader::title},
                          {"experiment", &LogHeader::experiment_text},
                          {"experiment_sha256", &LogHeader::experiment_sha256},
                          {"options", &LogHeader::options_json},
                          {"where", &LogHeader::where}};

} // namespace

void write_header(Must const& must, hid_t file, LogHeader const& header) {
    std::size_t const sources = header.sources.size();
    assert(header.source_power_W.size() == sources);
    assert(header.source_first_ray.size() == sources + 1 ||
           (sources == 0 && header.source_first_ray.empty()));
    assert(header.refractive_index.size() == header.media.size() * header.wavelengths_m.size());

    std::uint64_t const rays = header.source_first_ray.empty() ? 0 : header.source_first_ray.back();
    write_attribute(must, file, "schema_version", H5T_STD_I32LE, &log_schema_version);
    make_group(must, file, "texts");
    for (Text const& text : texts) {
        write_text(must, file, text.name, header.*text.value);
        write_names(must, file, (std::string("texts/") + text.name).c_str(), {header.*text.value});
    }
    write_attribute(must, file, "seed", H5T_STD_U64LE, &header.seed);
    write_attribute(must, file, "rays", H5T_STD_U64LE, &rays);
    write_attribute(must, file, "every", H5T_STD_U64LE, &header.every);
    write_attribute(must, file, "min_power", H5T_IEEE_F64LE, &header.min_power);

    for (char const* group : {"sources", "surfaces", "media", "models"})
        make_group(must, file, group);
    write_names(must, file, "sources/name", header.sources);
    write_table(must, file, "sources/power_W", H5T_IEEE_F64LE, {sources}, header.source_power_W.data(), "W");
    write_table(must, file, "sources/first_ray", H5T_STD_U64LE, {sources}, header.source_first_ray.data(),
                "");
    write_names(must, file, "surfaces/name", header.surfaces);
    write_names(must, file, "media/name", header.media);
    write_names(must, file, "models/path", header.models);
    std::vector<double> nm(header.wavelengths_m.size());
    std::transform(header.wavelengths_m.begin(), header.wavelengths_m.end(), nm.begin(), in_nm);
    write_table(must, file, "wavelengths_nm", H5T_IEEE_F64LE, {nm.size()}, nm.data(), "nm");
    write_table(must, file, "media/refractive_index", H5T_IEEE_F64LE, {header.media.size(), nm.size()},
                header.refractive_index.data(), "1");
}

LogHeader read_header(Must const& must, hid_t file) {
    std::int32_t version = 0;
    read_attribute(must, file, "schema_version", type_of<std::int32_t>(), &version);
    if (version != log_schema_version)
        must.fail("its schema_version is " + std::to_string(version) + ", this program reads " +
                  std::to_string(log_schema_version));
    LogHeader header;
    for (Text const& text : texts) {
        std::string const place = std::string("texts/") + text.name;
        bool const newer = text.value == &LogHeader::where; // logs of before have none
        if (newer && must(H5Lexists(file, place.c_str(), H5P_DEFAULT), "look for /" + place) == 0)
            continue;
        std::vector<std::string> found = read_names(must, file, place);
        if (found.size() != 1)
            must.fail("/" + place + " is not one text");
        header.*text.value = std::move(found.front());
    }
    read_attribute(must, file, "seed", type_of<std::uint64_t>(), &header.seed);
    read_attribute(must, file, "every", type_of<std::uint64_t>(), &header.every);
    read_attribute(must, file, "min_power", type_of<double>(), &header.min_power);
    header.sources = read_names(must, file, "sources/name");
    std::size_t const sources = header.sources.size();
    header.source_power_W = read_numbers<double>(must, file, "sources/power_W", sources);
    header.source_first_ray = read_numbers<std::uint64_t>(must, file, "sources/first_ray", sources);
    std::uint64_t& rays = header.source_first_ray.emplace_back();
    read_attribute(must, file, "rays", type_of<std::uint64_t>(), &rays);
    if (!std::is_sorted(header.source_first_ray.begin(), header.source_first_ray.end()))
        must.fail("/sources/first_ray does not increase up to the number of rays");
    header.surfaces = read_names(must, file, "surfaces/name");
    header.media = read_names(must, file, "media/name");
    header.models = read_names(must, file, "models/path");
    std::size_t const wavelengths = open_table(must, file, "wavelengths_nm").values;
    header.wavelengths_m = read_numbers<double>(must, file, "wavelengths_nm", wavelengths);
    for (double& wavelength : header.wavelengths_m)
        wavelength = from_nm(wavelength);
    header.refractive_index =
        read_numbers<double>(must, file, "media/refractive_index", header.media.size() * wavelengths);
    return header;
}

} // namespace sahl
