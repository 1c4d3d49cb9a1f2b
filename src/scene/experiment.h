// In: nothing. Out: an experiment as its file describes it, in SI units, with every name resolved to an id.
// The scene that is traced is built from it (scene/scene.h); how it is read is scene/read_experiment.h.
#pragma once

#include "geometry/shape.h"
#include "materials/medium.h"
#include "materials/surface.h"
#include "math/ids.h"
#include "math/vec.h"
#include "scene/value.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sahl {

/// What a model file's material is mapped to: a medium, or a surface, or both.
struct MaterialMapping {
    std::string material;
    std::optional<MediumId> medium;
    std::optional<SurfaceId> surface;
    Place place;
};

struct ModelReference {
    std::filesystem::path path; // as found on disk
    double metres_per_unit = 1.0;
    std::vector<std::string> parts; // empty or "*": all
    std::vector<MaterialMapping> materials;
    Place place;
    double decimate = 0.0;   // m in the world: it is traced in fewer triangles, no vertex farther off them
    bool smooth = false;     // a mesh without normals gets some
    bool open_walls = false; // of a medium: what is not closed is a wall of it without thickness
};

struct ObjectSpec {
    std::string name;
    std::variant<Shape, ModelReference> what;
    Affine to_world;
    std::optional<MediumId>
        medium; // a closed shape needs one unless all its faces have a surface (then it is opaque)
    std::optional<SurfaceId> surface; // for all faces that `faces` does not name
    std::vector<std::pair<std::string, SurfaceId>> faces;
    int priority = 0;
    Place place;
};

enum class Pattern { grid, hexagonal, random, sobol, fan, ring, edge };

struct Beam {
    dvec3 from, toward, up; // toward, up: unit, orthogonal; `up` is the second axis of a size, and of a fan
    double radius = 0.0;    // m; 0: a rectangle of `size`
    dvec2 size{0.0};        // m
    std::optional<double> gaussian_radius; // m, where the irradiance has fallen to 1/e²
    Pattern pattern = Pattern::grid;
    std::uint64_t rays = 1; // at least this many per wavelength
};

struct PointEmitter { // uniform in solid angle within the cone
    dvec3 at, toward, up;
    double half_angle = 0.0; // rad, (0, π]
    std::uint64_t rays = 1;
};

struct LambertianEmitter { // a flat rectangle, cosine law about `toward`
    dvec3 at, toward, up;
    dvec2 size{0.0};
    std::uint64_t rays = 1;
};

struct RaySpec {
    dvec3 origin, direction; // direction: unit
    double weight = 1.0;     // share of the source's power is weight / sum of weights
};

struct ExplicitRays {
    std::vector<RaySpec> rays;
};

struct Polarisation {
    dvec3 stokes{0.0}; // S1, S2, S3 over S0, of length ≤ 1; S3 > 0 is right-handed seen by the receiver
    dvec3 axis{0.0};   // unit: S1 is positive along its part across a ray
};

struct SourceSpec {
    std::string name;
    std::variant<Beam, PointEmitter, LambertianEmitter, ExplicitRays> emitter;
    std::vector<std::pair<double, double>> wavelengths; // m in standard air, weight > 0
    double power = 1.0;                                 // W, of the whole source
    std::optional<Polarisation> polarisation{};         // none: unpolarised
    Place place;
};

/// Bins of direction: rings of equal angle about an axis, each in sectors of equal azimuth.
struct FarField {
    dvec3 axis{0.0}, up{0.0}; // unit, orthogonal, world; light that travels along `axis` is at angle 0
    std::uint32_t rings = 90, sectors = 1;
    double largest = 0.0; // rad, (0, π]: the angle that the last ring ends at
};

enum class DetectorKind { rectangle, sphere, surface };
enum class ArrivesFrom { both, outside, inside }; // of a surface: the body it belongs to

/// A path filter (docs/filters.md) as it was written; empty: every path.
struct WrittenFilter {
    std::string text;
    Place place;
};

struct DetectorSpec {
    std::string name;
    Affine to_world;           // of the rectangle z = 0, x along its width, y along `up`, z = `facing`
    dvec2 size{0.0};           // m
    std::uint32_t columns = 1; // pixels along x
    std::uint32_t rows = 1;    // pixels along y
    bool absorbs = true;
    bool back = false; // counts light that comes from behind too
    Place place;
    DetectorKind kind = DetectorKind::rectangle; // a sphere: what escapes; to_world holds its centre
    double radius = 0.0;                         // m, of a sphere; 0: at infinity
    std::string surface{};                       // face.name of what counts what arrives at it
    ArrivesFrom from = ArrivesFrom::both;
    // what is recorded beyond sums and pixels
    bool spot = false, spectrum = false;
    std::optional<FarField> far_field{};
    std::uint32_t path_bins = 0; // of the optical path's histogram; 0: none
    WrittenFilter where{};       // which paths to it count
};

enum class BranchPolicy { split, roulette, dominant };
enum class Method { automatic, facet, interpolated, quadratic, fitted, recognised };
enum class Polarised { automatic, yes, no };

struct TraceOptions {
    std::uint32_t max_depth = 64; // [0, 65534] interactions; a branch that is cut has one more, in 16 bits
    double min_power = 1e-6;      // share of the source ray's power
    BranchPolicy branch = BranchPolicy::split;
    double split_until = 0.1;      // with roulette: a share of the source ray's power
    std::uint32_t split_depth = 2; // with roulette: [0, 65534] interactions that split in any case
    Method method = Method::automatic;
    double tolerance = 1e-6;       // rad
    double tolerance_power = 1e-3; // share
    Polarised polarised = Polarised::automatic;
    std::uint64_t seed = 1;
    bool decimate = false;    // with automatic: meshes are traced in as few triangles as the tolerance needs
    bool digits_lost = false; // each path's loss of digits is followed
};

struct LogOptions {
    bool on = false;
    std::uint64_t every = 1;
    double min_power = 0.0; // share of the ray's power
    WrittenFilter where{};  // which paths, whole; min_power thins what is left
    bool compress = false;
    std::uint64_t shard_rows = 4194304;
};

struct Limits {
    double leak = 1e-6;
    double ledger = 1e-12;
};

struct SweepAxis {
    std::string key;           // "object.prism.turn_deg[2]"
    std::vector<Value> values; // whatever may stand under the key: numbers, names of glasses, lists
    Place place;
};

/// Several runs of one experiment.
struct SweepSpec {
    std::vector<SweepAxis> axes;
    bool zip = false; // the axes go together; false: every value of each with all of the others

    bool empty() const { return axes.empty(); }
    std::size_t runs() const;
    /// What the axes have in run `run` of runs(): in a grid the last axis changes first.
    std::vector<Value> point(std::size_t run) const;
};

enum class Aim { minimise, maximise, reach };

/// One number of the experiment, varied until a figure of the summary is least, greatest or a given one.
struct GoalSpec {
    Aim aim = Aim::minimise;
    std::string figure; // as in the head of sweep.csv: "detectors.screen.rms_radius_mm"
    double value = 0.0; // to be reached
    std::string key;
    double from = 0.0, to = 0.0;
    double tolerance = 0.0;      // of the key's number, as a share of to − from
    std::uint64_t looks = 2;     // runs, evenly spread, that find where to search
    std::uint64_t most_runs = 0; // looks included
    Place place;
};

struct Picture; // scene/picture.h

struct Experiment {
    std::string title;
    std::filesystem::path file;
    std::vector<Medium> media; // by MediumId; only those that something refers to
    MediumId surroundings;
    std::vector<Surface> surfaces; // by SurfaceId
    std::vector<ObjectSpec> objects;
    std::vector<SourceSpec> sources;
    std::vector<DetectorSpec> detectors;
    TraceOptions trace;
    LogOptions log;
    Limits limits;
    SweepSpec sweep;
    std::optional<GoalSpec> goal;
    std::shared_ptr<Picture> picture;  // of [camera] and its like, never null where a file was read
    std::vector<std::string> warnings; // what a user should know, e.g. a formula used outside its range
};

} // namespace sahl
