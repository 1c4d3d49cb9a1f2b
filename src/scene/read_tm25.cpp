// In: a ray file after IES TM-25-13 (.tm25ray), binary, little-endian, mm. Out: its rays in the world, in
// metres. The numbers of sections below are the standard's, as the public-domain TM25RaySetTools of J.
// Muschaweck cite them.
#include "scene/read_sources.h"

#include "math/input_error.h"
#include "scene/read_file.h"

#include <array>
#include <cmath>
#include <cstring>

namespace sahl {

namespace {

constexpr std::size_t reserved = 168;          // 4.7.1.16, bytes
constexpr std::size_t descriptions = 9 * 4000; // 4.7.3: nine texts of 1000 characters of four bytes
constexpr std::size_t padding = 32;            // 4.7.4: the spectral tables together fill a multiple of it
constexpr std::size_t column_label = 512;      // 4.7.5, bytes
constexpr std::int32_t version = 2013;

class Bytes {
  public:
    Bytes(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {}

    template <class T>
    T take() {
        static_assert(std::is_trivially_copyable_v<T>);
        need(sizeof(T));
        T value;
        std::memcpy(&value, text_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return value;
    }
    void skip(std::uint64_t bytes) {
        need(bytes);
        at_ += bytes;
    }
    std::uint64_t left() const { return text_.size() - at_; }
    [[noreturn]] void refuse(std::string const& problem, std::string const& remedy) const {
        throw InputError(file_ + ": byte " + std::to_string(at_), problem, remedy);
    }

  private:
    void need(std::uint64_t bytes) const {
        if (bytes > left())
            refuse("the file ends too early", "give a whole IES TM-25 file");
    }
    std::string text_, file_;
    std::size_t at_ = 0;
};

struct Header {
    double radiant_flux = 0.0; // W; 0 or NaN: unknown
    std::uint64_t rays = 0;
    std::int32_t spectrum = 0, spectra = 0, more_columns = 0, more_text = 0;
    double wavelength_nm = 0.0;
    bool radiant = false, wavelength = false, luminous = false, stokes = false, tristimulus = false,
         spectrum_index = false;

    /// Of a ray: place, direction, and what the flags say.
    std::uint64_t columns() const {
        return 6U + radiant + wavelength + luminous + (stokes ? 3U : 0U) + (tristimulus ? 2U : 0U) +
               spectrum_index + static_cast<std::uint64_t>(more_columns);
    }
};

bool take_flag(Bytes& bytes) {
    auto const flag = bytes.take<std::int32_t>();
    if (flag != 0 && flag != 1)
        bytes.refuse("a flag is " + std::to_string(flag), "give 0 or 1 as IES TM-25, 4.7.2, has it");
    return flag == 1;
}

Header read_header(Bytes& bytes) {
    auto const magic = bytes.take<std::array<char, 4>>();
    if (std::memcmp(magic.data(), "TM25", 4) != 0)
        bytes.refuse("this is no IES TM-25 file: it does not begin with TM25",
                     "give one, or a ray file as CSV with the end .csv");
    if (auto const found = bytes.take<std::int32_t>(); found != version)
        bytes.refuse("this is version " + std::to_string(found) + " of IES TM-25",
                     "give one of version 2013");
    Header header;
    bytes.skip(4 + 4); // how it was made; luminous flux
    header.radiant_flux = bytes.take<float>();
    header.rays = bytes.take<std::uint64_t>();
    bytes.skip(28 + 4); // date; what the rays start on
    header.spectrum = bytes.take<std::int32_t>();
    header.wavelength_nm = bytes.take<float>();
    bytes.skip(4 + 4); // range of wavelengths
    header.spectra = bytes.take<std::int32_t>();
    header.more_columns = bytes.take<std::int32_t>();
    header.more_text = bytes.take<std::int32_t>();
    if (header.rays == 0 || header.spectra < 0 || header.more_columns < 0 || header.more_text < 0)
        bytes.refuse("the header has no rays, or a negative number of something", "write the file anew");
    bytes.skip(reserved);
    if (!take_flag(bytes) || !take_flag(bytes))
        bytes.refuse("its rays have no place or no direction", "give a file with both");
    for (bool* flag : {&header.radiant, &header.wavelength, &header.luminous, &header.stokes,
                       &header.tristimulus, &header.spectrum_index})
        *flag = take_flag(bytes);
    if (!header.radiant && !header.luminous)
        bytes.refuse("its rays have neither radiant nor luminous flux", "give a file with one of them");
    return header;
}

void skip_to_rays(Bytes& bytes, Header const& header) {
    bytes.skip(descriptions);
    std::uint64_t size = 0;
    for (std::int32_t i = 0; i < header.spectra; ++i) {
        auto const pairs = bytes.take<std::int32_t>();
        if (pairs < 0)
            bytes.refuse("a spectral table has a negative number of points", "write the file anew");
        bytes.skip(std::uint64_t{8} * static_cast<std::uint64_t>(pairs));
        size += 4 + std::uint64_t{8} * static_cast<std::uint64_t>(pairs);
    }
    bytes.skip((padding - size % padding) % padding);
    bytes.skip(column_label * static_cast<std::uint64_t>(header.more_columns));
    bytes.skip(static_cast<std::uint64_t>(header.more_text));
}

RaySpec read_ray(Bytes& bytes, std::vector<float>& row, std::size_t flux, Affine const& to_world) {
    for (float& number : row) {
        number = bytes.take<float>();
        if (!std::isfinite(number) && static_cast<std::size_t>(&number - row.data()) <= flux)
            bytes.refuse("a ray has a number that is not finite", "leave that ray out");
    }
    dvec3 const direction(row[3], row[4], row[5]);
    if (direction == dvec3(0.0))
        bytes.refuse("a ray has a direction of length 0", "leave that ray out");
    if (!(row[flux] >= 0.0F))
        bytes.refuse("a ray has a negative power", "leave that ray out");
    dvec3 const turned = to_world.vector(normalize(direction));
    return {to_world.point(dvec3(row[0], row[1], row[2]) / 1000.0), normalize(turned), row[flux]};
}

} // namespace

RayList read_tm25(std::filesystem::path const& path, Affine const& to_world) {
    Bytes bytes(file_text(path), path.string());
    Header const header = read_header(bytes);
    skip_to_rays(bytes, header);
    std::uint64_t const columns = header.columns();
    if (bytes.left() / 4 / columns != header.rays || bytes.left() % (4 * columns) != 0)
        bytes.refuse("the header promises " + std::to_string(header.rays) + " rays of " +
                         std::to_string(columns) + " numbers, but " + std::to_string(bytes.left()) +
                         " bytes are left",
                     "give a whole IES TM-25 file");
    std::size_t const flux = header.radiant ? 6 : 6 + header.wavelength;
    RayList list;
    std::vector<float> row(columns);
    for (std::uint64_t i = 0; i < header.rays; ++i) {
        list.rays.push_back(read_ray(bytes, row, flux, to_world));
        list.power += header.radiant ? list.rays.back().weight : 0.0;
    }
    std::erase_if(list.rays, [](RaySpec const& ray) { return ray.weight == 0.0; });
    if (list.rays.empty())
        bytes.refuse("no ray has any power", "give a file with light in it");
    if (!header.radiant && header.radiant_flux > 0.0 && std::isfinite(header.radiant_flux))
        list.power = header.radiant_flux;
    if (header.spectrum == 1 && header.wavelength_nm >= 10.0 && header.wavelength_nm <= 1e7)
        list.wavelength = header.wavelength_nm * 1e-9;
    list.mixed = header.spectrum == 2;
    return list;
}

} // namespace sahl
