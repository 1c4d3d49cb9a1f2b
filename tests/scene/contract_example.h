// In: nothing. Out: the example of an experiment file that shows every part of the format, as its description
// has it.
#pragma once

namespace sahl {

inline constexpr char const contract_example[] = R"toml(title = "A 60° prism at minimum deviation"
surroundings = "air"        # the medium outside all bodies

# media: by catalogue name anywhere a medium is asked for ("N-SF11", "SCHOTT:N-SF11"), or named here
medium.flint = {glass = "N-SF11"}                            # catalogue absorption is used; absorption = false turns it off
medium.syrup = {n = 1.45, absorption_per_mm = 0.01}          # or absorption = [[400, 0.02], [700, 0.001]]   (nm, 1/mm)
medium.mine  = {nd = 1.62, vd = 36.4}                        # n(λ) as in KHR_materials_dispersion
medium.other = {sellmeier = {B = [1.0396, 0.2318, 1.0105], C_um2 = [0.0060, 0.0200, 103.56]}}   # or cauchy = {A, B_um2, C_um4}, table = [[nm, n], …]

surface.silver = {metal = "silver"}                          # complex index from the catalogue, or n = .., k = ..
surface.half   = {reflect = 0.5, transmit = 0.5}             # constant shares; the rest is absorbed. Directions by Snell; where refraction is impossible the transmitted share reflects
surface.wall   = {absorb = true}
surface.white  = {diffuse = 0.97}                            # Lambertian reflector, event 13
surface.plain  = {paint = {ambient = [0.1, 0.1, 0.1], diffuse = [0.8, 0.2, 0.2], specular = [1, 1, 1], shininess = 40, reflect = 0.2, texture = "floor.png"}}   # for pictures

[trace]
max_depth    = 64           # interactions along one path; a guard, not the main cut-off
min_power    = 1e-6         # a branch below this share of its source ray's power is cut, and counted
branch       = "split"      # "split" | "roulette" (unbiased) | "dominant" (strongest branch only)
split_until  = 0.1          # with roulette: split while the branch's share is above this, or depth < 2
method       = "auto"       # "auto" | "facet" | "interpolated" | "quadratic" | "fitted" | "recognised"
tolerance_rad   = 1e-6      # with auto: the direction error a user can bear
tolerance_power = 1e-3      # with auto: the share of a detector's power
polarised    = "auto"       # "auto" | true | false
seed         = 1
log          = false        # true writes rays.h5

[log]                       # optional: thinner, or in fewer bytes
every    = 1                # each N-th ray
where    = ""               # a filter, e.g. "hits(prism.left) and total_internal >= 1"
compress = false

[limits]
leak   = 1e-6               # share of the events; above it exit status is 4
ledger = 1e-12              # remainder as a share of what was emitted; above it exit status is 4

[[group]]                   # moves its objects, sources and detectors as one; groups may nest
name = "head"
turn_deg = [0, 0, 0]
move_mm  = [0, 0, 0]

[[object]]
name   = "prism"
group  = "head"
shape  = {prism = {apex_deg = 60, side_mm = 25, length_mm = 25}}
medium = "flint"            # what the body is made of
faces  = {base = "wall"}    # surfaces of single faces; surface = "…" for all. None: a clean boundary between two media
turn_deg = [0, 0, 0]        # scale (number or 3) first, then about x, then y, then z, then move; or matrix = [16, column by column, lengths in mm]
move_mm  = [0, 0, 0]
priority = 0                # where bodies overlap the higher one is there

[[object]]
name  = "bunny"
model = "../../models/bunny.obj"   # path relative to this file; .gltf, .glb, .obj
length_unit = "mm"                 # required for OBJ; glTF is in metres unless said otherwise
parts  = ["*"]                     # optional: only these nodes or groups
medium = "N-BK7"                   # for all of it; or material by material:
materials = {Glass = {medium = "N-BK7"}, Mirror = {surface = "silver"}}
move_mm = [0, 0, 500]

[[source]]
name = "laser"
beam = {from_mm = [-50, 0, 0], toward = [1, 0, 0], radius_mm = 2, pattern = "hexagonal", rays = 1000}
# radius_mm or size_mm with up; pattern: grid, hexagonal, random, sobol, fan, ring; profile = {gaussian_radius_mm = 1}
# or point = {at_mm, toward, half_angle_deg, rays}; lambertian = {at_mm, toward, size_mm, rays};
# or rays  = [[x, y, z, dx, dy, dz], …] (mm; a seventh number is power); or file = "rays.csv" with these columns
wavelengths_nm = [486.1327, 587.5618, 656.2725]   # weights = […]; or lines = ["F", "d", "C"], spectrum = "D65" …
power_W = 1.0               # of the whole source, shared over its wavelengths by weight and over its rays
polarisation = {stokes = [1, 1, 0, 0], axis = [0, 1, 0]}     # absent: unpolarised

[[detector]]
name = "screen"
at_mm = [40, -60, 0]
facing = [-0.4, 0.92, 0]    # counts light that comes against this; back = true counts both sides
up = [0, 0, 1]
size_mm = [80, 80]
pixels = [256, 256]
absorbs = true              # the default; false: rays are counted and go on

[sweep]
"object.prism.turn_deg[2]" = {from = -45, to = -20, steps = 26}   # a run for each; one row each in sweep.csv

[camera]
at_mm = [0, 30, 120]
look_at_mm = [0, 0, 0]
up = [0, 1, 0]
fov_deg = 35
resolution = [640, 480]
samples = 16

[[light]]
point = {at_mm = [50, 80, 60]}
intensity = [1, 1, 1]

[background]
color = [0.1, 0.2, 0.5]     # or image = "sky.hdr"
)toml";

} // namespace sahl
