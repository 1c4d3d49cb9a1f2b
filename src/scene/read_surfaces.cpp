// In: the tables [surface.NAME]. Out: surfaces, one kind each.
#include "scene/read_surfaces.h"

#include "materials/catalogue.h"
#include "math/input_error.h"
#include "scene/read_file.h"
#include "scene/read_table.h"

#include <algorithm>

namespace sahl {

namespace {

constexpr double any_wavelength = 587.5618e-9; // one point holds at all wavelengths

Metal read_metal(Fields const& fields) {
    std::string const name = fields.text("metal");
    if (auto metal = find_metal(name))
        return *metal;
    throw InputError(fields.place("metal").text(), "there is no metal \"" + name + "\" in the catalogue",
                     did_you_mean(name, metal_names()) + " Or give n and k");
}

Metal read_complex_index(Fields const& fields) {
    for (auto const& [one, other] : {std::pair{"n", "k"}, std::pair{"k", "n"}})
        if (!fields.has(other))
            throw InputError(fields.place(one).text(), fields.called(one) + " stands without " + other,
                             "give both");
    if (fields.number("n") == 0.0 && fields.number("k") == 0.0)
        throw InputError(fields.place("n").text(), "n and k are both 0", "give the metal's complex index");
    return {{{any_wavelength, fields.number("n"), fields.number("k")}}};
}

Shares read_shares(Fields const& fields) {
    Shares shares{fields.has("reflect") ? fields.number("reflect") : 0.0,
                  fields.has("transmit") ? fields.number("transmit") : 0.0};
    // Two decimal shares that make 1 on paper may make 1 + 2⁻⁵² in binary.
    if (shares.reflect + shares.transmit > 1.0 + 1e-15)
        throw InputError(fields.place(fields.has("transmit") ? "transmit" : "reflect").text(),
                         "reflect and transmit are more than 1 together", "make their sum at most 1");
    shares.transmit = std::min(shares.transmit, 1.0 - shares.reflect);
    return shares;
}

Paint read_paint(Value const& table, std::filesystem::path const& folder) {
    Fields const fields(table, keys::paint);
    auto const colour = [&](std::string_view key) {
        auto const rgb = fields.numbers(key);
        return Colour{rgb[0], rgb[1], rgb[2]};
    };
    Paint paint{colour("ambient"),
                colour("diffuse"),
                colour("specular"),
                fields.number("shininess"),
                fields.number("reflect"),
                {},
                {},
                fields.number("covers")};
    if (fields.has("checker")) {
        Fields const checker(fields.at("checker"), keys::checker);
        auto const other = checker.numbers("other");
        paint.checker = Checker{checker.number("size_mm") / 1000.0, {other[0], other[1], other[2]}};
        if (fields.has("texture"))
            fields.only_one_of({"texture", "checker"});
    }
    if (fields.has("texture"))
        paint.texture = existing_file(folder, fields.text("texture"), fields.place("texture")).string();
    return paint;
}

Surface read_surface(std::string const& name, Value const& table, std::filesystem::path const& folder) {
    Fields const fields(table, keys::surface);
    bool const index = fields.has("n") || !fields.has("k");
    bool const shares = fields.has("reflect") || !fields.has("transmit");
    std::string const kind = fields.only_one_of(
        {"metal", index ? "n" : "k", shares ? "reflect" : "transmit", "absorb", "diffuse", "paint"});
    if (kind == "metal")
        return {name, read_metal(fields)};
    if (kind == "n" || kind == "k")
        return {name, read_complex_index(fields)};
    if (kind == "reflect" || kind == "transmit")
        return {name, read_shares(fields)};
    if (kind == "diffuse")
        return {name, Diffuse{fields.number("diffuse")}};
    if (kind == "paint")
        return {name, read_paint(fields.at("paint"), folder)};
    if (!fields.truth("absorb"))
        throw InputError(fields.place("absorb").text(),
                         fields.called("absorb") + " is false, which says nothing",
                         "give absorb = true, or what the surface does");
    return {name, Absorber{}};
}

} // namespace

std::vector<Surface> read_surfaces(Value const* definitions, std::filesystem::path const& folder) {
    std::vector<Surface> surfaces;
    if (!definitions)
        return surfaces;
    for (auto const& [name, table] : std::get<Table>(definitions->data)) {
        check_name(name, table.place);
        surfaces.push_back(read_surface(name, table, folder));
    }
    return surfaces;
}

SurfaceId find_surface(std::vector<Surface> const& surfaces, std::string_view name, Place const& place) {
    auto const found =
        std::find_if(surfaces.begin(), surfaces.end(), [&](Surface const& s) { return s.name == name; });
    if (found != surfaces.end())
        return {static_cast<std::uint32_t>(found - surfaces.begin())};
    std::vector<std::string> names;
    for (Surface const& surface : surfaces)
        names.push_back(surface.name);
    std::string const quoted = "\"" + std::string(name) + "\"";
    if (find_metal(name))
        throw InputError(place.text(), "there is no surface " + quoted + " in this file",
                         "add surface." + std::string(name) + " = {metal = " + quoted + "}");
    throw InputError(place.text(), "there is no surface " + quoted + " in this file",
                     names.empty()
                         ? "define it, for instance surface." + std::string(name) + " = {absorb = true}"
                         : did_you_mean(name, names));
}

} // namespace sahl
