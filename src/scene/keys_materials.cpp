// In: nothing. Out: the keys of media and surfaces.
#include "scene/keys.h"

namespace sahl {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range above_zero{0.0, infinity, true};
constexpr Range not_negative{0.0};
constexpr Range share{0.0, 1.0};

constexpr Key medium_keys[] = {
    {"glass",
     Kind::text,
     {},
     "a name of the catalogue, \"N-BK7\" or \"SCHOTT:N-BK7\", with its absorption; `sahl glass` lists them"},
    {"n", Kind::number, {}, "the same refractive index at all wavelengths", above_zero},
    {"nd", Kind::number, {}, "index at the d line, with vd: as in KHR_materials_dispersion", {1.0, infinity}},
    {"vd", Kind::number, {}, "Abbe number", above_zero},
    {"sellmeier", Kind::table, {}, "n² = 1 + Σ B λ²/(λ² − C)"},
    {"cauchy", Kind::table, {}, "n = A + B/λ² + C/λ⁴"},
    {"table", Kind::pairs, {}, "[[nm, n], …], ascending; linear in between"},
    {"absorption",
     Kind::any,
     {},
     "[[nm, 1/mm], …], ascending, linear in between; false: none, whatever the catalogue has"},
    {"absorption_per_mm", Kind::number, {}, "the same absorption at all wavelengths", not_negative},
};

constexpr Key sellmeier_keys[] = {
    {"B", Kind::numbers, Required{}, "as makers print them"},
    {"C_um2", Kind::numbers, Required{}, "as many as B"},
};

constexpr Key cauchy_keys[] = {
    {"A", Kind::number, Required{}, "what the index tends to at long wavelengths", above_zero},
    {"B_um2", Kind::number, 0.0, "of 1/λ²"},
    {"C_um4", Kind::number, 0.0, "of 1/λ⁴"},
};

constexpr Key surface_keys[] = {
    {"metal", Kind::text, {}, "a metal of the catalogue: \"silver\", \"aluminium\", \"gold\", \"copper\""},
    {"n", Kind::number, {}, "with k: a metal of the complex index n + ik at all wavelengths", not_negative},
    {"k", Kind::number, {}, "with n", not_negative},
    {"reflect",
     Kind::number,
     {},
     "constant share that is reflected; what is neither reflected nor transmitted is absorbed",
     share},
    {"transmit",
     Kind::number,
     {},
     "constant share that goes through; where refraction is impossible it reflects",
     share},
    {"absorb", Kind::truth, {}, "true: black"},
    {"diffuse", Kind::number, {}, "a Lambertian reflector of this reflectance", share},
    {"paint", Kind::table, {}, "for pictures; in tracing all but its `reflect` is absorbed"},
};

constexpr Key paint_keys[] = {
    {"ambient", Kind::three, Repeated{3, 0.0}, "red, green, blue", not_negative},
    {"diffuse", Kind::three, Repeated{3, 0.0}, "red, green, blue", not_negative},
    {"specular", Kind::three, Repeated{3, 0.0}, "red, green, blue", not_negative},
    {"shininess", Kind::number, 1.0, "exponent of the highlight", not_negative},
    {"reflect", Kind::number, 0.0, "share that is reflected as by a mirror", share},
    {"covers", Kind::number, 1.0, "share of the surface that is there; the rest of the light goes on", share},
    {"texture",
     Kind::text,
     {},
     "a picture, relative to the experiment's file, whose colours multiply `ambient` and `diffuse`"},
    {"checker", Kind::table, {}, "or two colours in turn"},
};

constexpr Key checker_keys[] = {
    {"size_mm", Kind::number, Required{}, "side of the cubes, from the object's origin on, in its own frame",
     above_zero},
    {"other", Kind::three, Repeated{3, 0.0},
     "red, green, blue: what `ambient` and `diffuse` are multiplied by in every second cube", not_negative},
};

} // namespace

KeyTable const keys::medium{
    "medium",
    "Exactly one of glass, n, nd with vd, sellmeier, cauchy and table. Indices are "
    "relative to air. Wherever a medium "
    "is asked for, a name defined here, in one of your `catalogues`, or in the "
    "built-in catalogue will do, in this order; \"air\" and \"vacuum\" are in the last.",
    medium_keys};
KeyTable const keys::sellmeier{"sellmeier", "λ in µm.", sellmeier_keys};
KeyTable const keys::cauchy{"cauchy", "λ in µm.", cauchy_keys};
KeyTable const keys::surface{
    "surface", "Exactly one of metal, n with k, reflect and transmit, absorb, diffuse and paint.",
    surface_keys};
KeyTable const keys::paint{"paint", "Colours are linear, as light adds up; 1 is white.", paint_keys};
KeyTable const keys::checker{"checker", "A chess board in space, cut by the surface.", checker_keys};

} // namespace sahl
