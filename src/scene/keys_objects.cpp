// In: nothing. Out: the keys of objects and shapes.
#include "scene/keys.h"

namespace sahl {

namespace {

constexpr Range above_zero{0.0, std::numeric_limits<double>::infinity(), true};
constexpr Range not_negative{0.0};

constexpr Key object_keys[] = {
    {"name", Kind::text, Required{}, "unique among objects, sources and detectors; without dots"},
    {"group", Kind::text, {}, "the group that moves it"},
    {"shape", Kind::table, {}, "an exact shape, shape = {sphere = {radius_mm = 10}}"},
    {"model", Kind::text, {}, "or a model's file, .gltf, .glb or .obj, relative to the experiment's file"},
    {"length_unit",
     Kind::text,
     {},
     "of a model: um, mm, cm, m, in, ft; OBJ needs one, glTF is in m unless said otherwise"},
    {"parts",
     Kind::texts,
     {},
     "of a model: only these nodes or groups; * stands for any characters, ? for one"},
    {"medium", Kind::text, {}, "what the body is made of"},
    {"surface",
     Kind::text,
     {},
     "surface of all faces that `faces` does not name; none: a clean boundary of two media"},
    {"faces", Kind::table, {}, "surfaces of single faces, {base = \"wall\"}"},
    {"materials", Kind::table, {}, "of a model: what its materials are, {Glass = {medium = \"N-BK7\"}}"},
    {"decimate_mm",
     Kind::number,
     {},
     "of a model: `trace` has it in fewer triangles, no vertex that is left out farther off them than "
     "this; pictures and charts have all",
     above_zero},
    {"smooth", Kind::truth, false,
     "of a model: a mesh that has no normals gets those of its triangles, smooth up to folds of 30°; method "
     "\"interpolated\" then has something to interpolate"},
    {"open_walls", Kind::truth, false,
     "of a model with a `medium`: meshes that are not closed are walls of it without thickness, and no "
     "bodies "
     "that light leaks into"},
    {"scale", Kind::any, 1.0, "a number, or one for each axis; not 0"},
    {"turn_deg", Kind::three, Repeated{3, 0.0}, "then about x, then about y, then about z"},
    {"move_mm", Kind::three, Repeated{3, 0.0}, "then moved; then the group's motion"},
    {"matrix", Kind::sixteen, {}, "instead of the three: column by column, lengths in mm"},
    {"priority",
     Kind::integer,
     0.0,
     "where bodies overlap the higher one is there, of equals the later",
     {-1e6, 1e6}},
};

constexpr Key material_keys[] = {
    {"medium", Kind::text, {}, "what is made of it"},
    {"surface", Kind::text, {}, "what is finished with it"},
};

constexpr Key shape_keys[] = {
    {"sphere", Kind::table, {}, "face: surface"},
    {"box", Kind::table, {}, "faces: left (−x), right, bottom (−y), top, back (−z), front"},
    {"cylinder", Kind::table, {}, "faces: side, back (−z), front"},
    {"lens", Kind::table, {}, "faces: front, back, edge"},
    {"prism", Kind::table, {}, "faces: left (−x), right, base, near (−z), far"},
    {"plane", Kind::table, {}, "open; z = 0 without end; face: surface"},
    {"rectangle", Kind::table, {}, "open; z = 0; face: surface"},
    {"disk", Kind::table, {}, "open; z = 0; face: surface"},
    {"cone", Kind::table, {}, "or a part of one; faces: side, back (−z), front"},
    {"corner_cube", Kind::table, {}, "faces: x, y, z (where that coordinate is 0), front"},
    {"quadric", Kind::table, {}, "faces: surface, caps (where the box cuts it off)"},
    {"conic_mirror", Kind::table, {}, "open; face: surface"},
};

constexpr Key sphere_keys[] = {{"radius_mm", Kind::number, Required{}, "", above_zero}};
constexpr Key box_keys[] = {{"size_mm", Kind::three, Required{}, "along x, y, z", above_zero}};
constexpr Key cylinder_keys[] = {
    {"radius_mm", Kind::number, Required{}, "", above_zero},
    {"length_mm", Kind::number, Required{}, "along z", above_zero},
};
constexpr Key lens_keys[] = {
    {"r1_mm", Kind::number, 0.0,
     "radius of the front, signed as in optics: positive has its centre at +z; 0 is a plane"},
    {"r2_mm", Kind::number, 0.0, "radius of the back"},
    {"thickness_mm", Kind::number, Required{}, "from vertex to vertex", above_zero},
    {"diameter_mm", Kind::number, Required{}, "of the rim", above_zero},
    {"conic1", Kind::number, 0.0, "conic constant of the front: −1 a paraboloid, below it a hyperboloid"},
    {"conic2", Kind::number, 0.0, "conic constant of the back"},
    {"aspheric1", Kind::numbers, {}, "of the front: coefficients of r⁴ in mm⁻³, r⁶ in mm⁻⁵, …; at most 15"},
    {"aspheric2", Kind::numbers, {}, "the same of the back"},
};
constexpr Key prism_keys[] = {
    {"apex_deg", Kind::number, Required{}, "between 0 and 180", above_zero},
    {"side_mm", Kind::number, Required{}, "of the two faces that meet at the apex edge", above_zero},
    {"length_mm", Kind::number, Required{}, "along z", above_zero},
};
constexpr Key cone_keys[] = {
    {"radius_mm", Kind::number, Required{}, "at −z", not_negative},
    {"top_radius_mm", Kind::number, 0.0, "at +z", not_negative},
    {"length_mm", Kind::number, Required{}, "along z", above_zero},
};
constexpr Key corner_cube_keys[] = {{"side_mm", Kind::number, Required{}, "of its edges", above_zero}};
constexpr Key quadric_keys[] = {
    {"coefficients", Kind::numbers, Required{}, "ten, of xx, yy, zz, xy, xz, yz, x, y, z, 1, lengths in mm"},
    {"clip_mm", Kind::three, Required{}, "sizes of the box, along x, y, z", above_zero},
};
constexpr Key conic_mirror_keys[] = {
    {"radius_mm", Kind::number, Required{}, "at the vertex; positive has its centre at +z; 0 is a plane"},
    {"conic", Kind::number, 0.0, "0 a sphere, −1 a paraboloid, below it a hyperboloid"},
    {"diameter_mm", Kind::number, Required{}, "of the rim", above_zero},
    {"hole_diameter_mm", Kind::number, 0.0, "below diameter_mm", not_negative},
};
constexpr Key rectangle_keys[] = {{"size_mm", Kind::two, Required{}, "along x, y", above_zero}};
constexpr Key disk_keys[] = {
    {"radius_mm", Kind::number, Required{}, "", above_zero},
    {"hole_radius_mm", Kind::number, 0.0, "below radius_mm", not_negative},
};

} // namespace

KeyTable const keys::object{"[[object]]",
                            "A shape or a model. A closed shape needs a medium, unless all its faces have a "
                            "surface; an open shape needs a "
                            "surface and has no medium.",
                            object_keys};
KeyTable const keys::material{
    "materials", "What a material of a model's file is: a medium, a surface or both.", material_keys};
KeyTable const keys::shape{"shape", "Exactly one.", shape_keys};
KeyTable const keys::sphere{"shape sphere", "Its centre is the origin.", sphere_keys};
KeyTable const keys::box{"shape box", "Its centre is the origin.", box_keys};
KeyTable const keys::cylinder{"shape cylinder", "Its centre is the origin, its axis z.", cylinder_keys};
KeyTable const keys::lens{"shape lens", "The front vertex is the origin; light runs along +z.", lens_keys};
KeyTable const keys::prism{
    "shape prism", "Isosceles; the apex edge runs along z at the top (+y); centred by its bounding box.",
    prism_keys};
KeyTable const keys::cone{"shape cone", "Its centre is the origin, its axis z.", cone_keys};
KeyTable const keys::corner_cube{
    "shape corner_cube",
    "A cube's corner at the origin, its edges along +x, +y, +z, closed by the triangle through their ends.",
    corner_cube_keys};
KeyTable const keys::quadric{
    "shape quadric",
    "What lies in a box about the origin where xᵀAx + bᵀx + c ≤ 0; the origin is that of both.",
    quadric_keys};
KeyTable const keys::conic_mirror{"shape conic_mirror", "Its vertex is the origin, its axis z.",
                                  conic_mirror_keys};
KeyTable const keys::plane{"shape plane", "It has no keys: plane = {}.", {}};
KeyTable const keys::rectangle{"shape rectangle", "Its centre is the origin.", rectangle_keys};
KeyTable const keys::disk{"shape disk", "Its centre is the origin.", disk_keys};

} // namespace sahl
