// In: nothing. Out: the keys of sources and detectors.
#include "scene/keys.h"

namespace sahl {

namespace {

constexpr Range above_zero{0.0, std::numeric_limits<double>::infinity(), true};
constexpr Range not_negative{0.0};
constexpr Range ray_count{1.0, 1e12}; // a year of tracing at some 10⁵ rays a second

constexpr Key source_keys[] = {
    {"name", Kind::text, Required{}, "unique among objects, sources and detectors; without dots"},
    {"group", Kind::text, {}, "the group that moves it; it may turn and move, not scale"},
    {"beam", Kind::table, {}, "parallel light"},
    {"point", Kind::table, {}, "light from a point into a cone, uniform in solid angle"},
    {"lambertian", Kind::table, {}, "light from a flat rectangle by the cosine law"},
    {"rays", Kind::any, {}, "single rays, [[x, y, z, dx, dy, dz], …] in mm; a seventh number is power"},
    {"file",
     Kind::text,
     {},
     "a CSV file with the columns x, y, z, dx, dy, dz and perhaps power, or an IES TM-25 ray file "
     "(.tm25ray), "
     "relative to the experiment's file"},
    {"wavelengths_nm", Kind::numbers, {}, "in standard air; neither these nor lines: 587.5618"},
    {"lines", Kind::texts, {}, "or spectral lines: i, h, g, F', F, e, d, D, C', C, r, s, t"},
    {"weights", Kind::numbers, {}, "of the wavelengths or lines; absent: all the same", above_zero},
    {"spectrum",
     Kind::any,
     {},
     "or a spectrum: \"D65\", a CSV file \"lamp.csv\", or a table, see spectrum; with wavelengths_nm or "
     "lines: "
     "their weights"},
    {"power_W",
     Kind::number,
     {},
     "of the whole source, shared over wavelengths by weight and over rays; absent: the sum of the rays' "
     "powers where they have some, else 1",
     above_zero},
    {"polarisation",
     Kind::table,
     {},
     "absent: unpolarised; what pilots are told, for a warning by how much it would matter"},
};

constexpr Key beam_keys[] = {
    {"from_mm", Kind::three, Required{}, "the middle of where it begins"},
    {"toward", Kind::three, Required{}, "its direction, of any length"},
    {"up", Kind::three, {}, "the second axis of size_mm, and that of a fan"},
    {"radius_mm", Kind::number, {}, "a round beam; neither this nor size_mm: a single ray", not_negative},
    {"size_mm", Kind::two, {}, "or a rectangular one: across `up`, along `up`", not_negative},
    {"pattern", Kind::text, "grid",
     "\"grid\", \"hexagonal\", \"random\", \"sobol\", \"fan\" \"ring\" or \"edge\""},
    {"rays", Kind::integer, 1.0, "at least this many for each wavelength", ray_count},
    {"profile", Kind::table, {}, "absent: the same irradiance everywhere"},
};

constexpr Key profile_keys[] = {
    {"gaussian_radius_mm", Kind::number, Required{}, "where the irradiance has fallen to 1/e²", above_zero},
};

constexpr Key point_keys[] = {
    {"at_mm", Kind::three, Required{}, "where it is"},
    {"toward", Kind::three, {}, "the axis of the cone, of any length; needed unless light goes everywhere"},
    {"up", Kind::three, {}, "a direction across"},
    {"half_angle_deg", Kind::number, 180.0, "of the cone; 180: everywhere", {0.0, 180.0, true}},
    {"rays", Kind::integer, Required{}, "at least this many for each wavelength", ray_count},
};

constexpr Key lambertian_keys[] = {
    {"at_mm", Kind::three, Required{}, "its middle"},
    {"toward", Kind::three, Required{}, "the side it shines to, of any length"},
    {"up", Kind::three, {}, "the second axis of size_mm"},
    {"size_mm", Kind::two, Required{}, "across `up`, along `up`", above_zero},
    {"rays", Kind::integer, Required{}, "at least this many for each wavelength", ray_count},
};

constexpr Key spectrum_keys[] = {
    {"illuminant", Kind::text, {}, "\"D65\", daylight after CIE 15; 300 to 830 nm"},
    {"black_body_K", Kind::number, {}, "Planck's law at this temperature", {1.0, 1e6}},
    {"file", Kind::text, {}, "a CSV file with the columns nm and power per nm, relative to the experiment's"},
    {"table", Kind::pairs, {}, "[[nm, power per nm], …], ascending; linear in between, 0 beyond"},
    {"from_nm", Kind::number, {}, "where it is cut; absent: 380, or where the table begins", {10.0, 1e7}},
    {"to_nm", Kind::number, {}, "and where above; absent: 780, or where the table ends", {10.0, 1e7}},
    {"bins",
     Kind::integer,
     40.0,
     "it is traced at the middles of this many equal bins, each with the power of its bin",
     {1.0, 10000.0}},
};

constexpr Key polarisation_keys[] = {
    {"stokes", Kind::four, Required{},
     "S0 > 0 and √(S1² + S2² + S3²) ≤ S0; S3 > 0 is right-handed seen by the receiver"},
    {"axis", Kind::three, Required{}, "where S1 is positive"},
};

constexpr Key detector_keys[] = {
    {"name", Kind::text, Required{}, "unique among objects, sources and detectors; without dots"},
    {"group", Kind::text, {}, "the group that moves it; it may turn and move, not scale"},
    {"at_mm", Kind::three, {}, "its middle"},
    {"facing", Kind::three, {}, "it counts light that comes against this; of any length"},
    {"up", Kind::three, {}, "the direction of its second axis; the first is up × facing"},
    {"size_mm", Kind::two, {}, "a rectangle: along both axes; it needs at_mm and facing", above_zero},
    {"sphere",
     Kind::truth,
     {},
     "true: or a sphere around everything, which counts what leaves the scene; it stops nothing"},
    {"radius_mm", Kind::number, {}, "of the sphere about at_mm; absent: at infinity", above_zero},
    {"surface", Kind::text, {}, "or a named surface, \"lens.front\": it counts what arrives there"},
    {"from", Kind::text, "both",
     "light that arrives at the surface from \"outside\" its body, from \"inside\", or from \"both\" sides"},
    {"pixels", Kind::two, Repeated{2, 1.0}, "whole numbers, along both axes", {1.0, 65536.0}},
    {"absorbs", Kind::truth, true, "false: rays are counted and go on"},
    {"back", Kind::truth, false, "true counts light from behind too"},
    {"spot", Kind::truth, false,
     "true: the geometric encircled energy about the centroid; keeps 24 bytes of memory a hit"},
    {"spectrum", Kind::truth, false, "true: the spectrum as a file, and the colour (CIE 1931)"},
    {"far_field", Kind::table, {}, "the distribution over directions"},
    {"optical_path",
     Kind::integer,
     {},
     "the histogram of the optical path in this many bins; keeps 16 bytes of memory a hit",
     {1.0, 100000.0}},
    {"where", Kind::text, "",
     "a filter: it counts only light that came by paths that it selects; see filters.md"},
};

constexpr Key far_field_keys[] = {
    {"axis",
     Kind::three,
     {},
     "light that travels along this is at 0°; of any length; absent: against `facing`, +z without"},
    {"up", Kind::three, {}, "the direction of azimuth 90°; azimuth 0 is up × axis"},
    {"to_deg",
     Kind::number,
     {},
     "the angle at which the last ring ends; absent: 90, of a sphere 180",
     {0.0, 180.0, true}},
    {"rings", Kind::integer, 90.0, "of equal angle", {1.0, 18000.0}},
    {"sectors", Kind::integer, 1.0, "of equal azimuth in each ring", {1.0, 36000.0}},
};

} // namespace

KeyTable const keys::source{"[[source]]", "Exactly one of beam, point, lambertian, rays and file.",
                            source_keys};
KeyTable const keys::beam{"beam", "Parallel light.", beam_keys};
KeyTable const keys::profile{"profile", "How a beam's irradiance falls off.", profile_keys};
KeyTable const keys::point{"point", "Uniform in solid angle within a cone.", point_keys};
KeyTable const keys::lambertian{"lambertian", "A flat rectangle that shines by the cosine law.",
                                lambertian_keys};
KeyTable const keys::spectrum{"spectrum",
                              "Exactly one of illuminant, black_body_K, file and table. With wavelengths_nm "
                              "or lines it gives their weights, and has no bins.",
                              spectrum_keys};
KeyTable const keys::polarisation{"polarisation", "A Stokes vector and the axis it refers to.",
                                  polarisation_keys};
KeyTable const keys::detector{
    "[[detector]]",
    "A flat rectangle that counts light, a sphere around everything, or a surface of an object.",
    detector_keys};
KeyTable const keys::far_field{"far_field", "How much light goes where, in bins of direction.",
                               far_field_keys};

} // namespace sahl
