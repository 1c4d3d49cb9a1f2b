#include "render/picture.h"

#include <algorithm>
#include <cmath>

namespace sahl {

namespace {

// A tree for all colours: its directions are those of the helium d line, by which glasses are named; its
// colours are those of a wavelength in the middle of each band of materials/colour.h.
constexpr std::array<double, 4> one_tree_wavelengths{587.5618e-9, 610e-9, 540e-9, 460e-9};
constexpr Channels one_tree_channels{WavelengthId{1}, WavelengthId{2}, WavelengthId{3}};

constexpr std::uint32_t spectral_lines = 60;   // that the visible range is cut into: 5 nm each
constexpr std::uint32_t lines_of_a_sample = 6; // two in each band

/// Below this share of n the index counts as one number: less turns no ray by as much as a pixel.
constexpr double least_dispersion = 1e-6;

SourceSpec source_of(std::vector<double> const& wavelengths) {
    SourceSpec source;
    source.name = "camera";
    source.emitter = ExplicitRays{{{dvec3(0.0), dvec3(0.0, 0.0, 1.0), 1.0}}};
    for (double const wavelength : wavelengths)
        source.wavelengths.emplace_back(wavelength, 1.0);
    return source;
}

/// Every second bit: x or y of place `index` < 2¹⁶ along Morton's curve, which keeps neighbours together.
std::uint32_t every_second_bit(std::uint32_t index) {
    std::uint32_t bits = index & 0x5555U;
    bits = (bits | bits >> 1U) & 0x3333U;
    bits = (bits | bits >> 2U) & 0x0F0FU;
    return (bits | bits >> 4U) & 0xFFU;
}

double difference(dvec3 const& a, dvec3 const& b) {
    dvec3 const d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

} // namespace

bool disperses(Medium const& medium) {
    double const blue = refractive_index(medium.index, one_tree_wavelengths[3]);
    double const red = refractive_index(medium.index, one_tree_wavelengths[1]);
    return std::abs(blue - red) > least_dispersion * red;
}

bool disperses(Scene const& scene) {
    return std::any_of(scene.media.begin(), scene.media.end(),
                       [](Medium const& medium) { return disperses(medium); });
}

namespace {

bool many_wavelengths(Scene const& scene, PictureOptions const& options) {
    return options.wavelengths > 1 || (options.wavelengths == 0 && disperses(scene));
}

} // namespace

struct PictureMaker::Tile {
    struct Sample {
        std::uint32_t x, y;
        PixelSample in_pixel;
        CameraRay ray;
    };
    std::uint64_t first_ray = 0; // a number that no other tile's rays have
    std::vector<Sample> samples;
    std::vector<RayView> views; // by sample
};

PictureMaker::PictureMaker(Scene& scene, Picture const& picture, TraceOptions const& trace,
                           LightMap const* caustics)
    : picture_(picture), camera_(*picture.camera),
      samples_(picture.options, trace.seed, picture.camera->lens_radius > 0.0,
               many_wavelengths(scene, picture.options)),
      sky_(picture.background), textures_(scene), trace_(trace), scene_(scene), caustics_(caustics),
      tiles_across_((picture.camera->columns + tile_side - 1) / tile_side),
      tiles_down_((picture.camera->rows + tile_side - 1) / tile_side) {
    std::uint32_t const asked = picture.options.wavelengths;
    std::vector<double> wavelengths(one_tree_wavelengths.begin(), one_tree_wavelengths.end());
    if (many_wavelengths(scene, picture.options)) {
        lines_ = std::max(asked == 0 ? lines_of_a_sample : asked, 3U); // one in each band, at least
        all_by_lines_ = asked > 1;
        spectrum_.emplace(spectral_lines);
        wavelengths.insert(wavelengths.end(), spectrum_->wavelengths().begin(),
                           spectrum_->wavelengths().end());
    }
    for (Body const& body : scene.bodies)
        to_objects_.push_back(inverse(body.to_world));
    for (Medium const& medium : scene.media)
        dispersive_.push_back(sahl::disperses(medium));
    scene.sources = {source_of(wavelengths)};
    optics_ = std::make_unique<WavelengthTable const>(scene);
    nothing_ = std::make_unique<Emission const>(scene.sources, *optics_, trace.seed);
    trace_.digits_lost = false;
    if (camera_.from_one_point())
        start_ = scene.bvh->start_at(camera_.camera().at, camera_.camera().forward);
}

Film PictureMaker::empty_film() const {
    return {camera_.camera().columns, camera_.camera().rows, samples_.mean_weight()};
}

void PictureMaker::render_tile(Film& film, std::uint64_t number, std::uint32_t first, std::uint32_t end,
                               std::vector<bool> const& only, EventCounts& ended) const {
    std::uint32_t const left = static_cast<std::uint32_t>(number % tiles_across_) * tile_side;
    std::uint32_t const top = static_cast<std::uint32_t>(number / tiles_across_) * tile_side;
    Tile tile;
    tile.first_ray = number << 32U | std::uint64_t{first} << 24U;
    tile.samples.reserve(std::size_t{tile_side} * tile_side * (end - first));
    for (std::uint32_t place = 0; place < tile_side * tile_side; ++place) {
        std::uint32_t const x = left + every_second_bit(place), y = top + every_second_bit(place >> 1);
        std::uint64_t const pixel = std::uint64_t{y} * film.columns + x;
        if (x >= film.columns || y >= film.rows || (!only.empty() && !only[pixel]))
            continue;
        for (std::uint32_t index = first; index < end; ++index) {
            PixelSample const sample = samples_.at(pixel, index);
            tile.samples.push_back(
                {x, y, sample, camera_.ray(dvec2(x + 0.5, y + 0.5) + sample.offset, sample.lens)});
        }
    }
    std::vector<Ray> rays;
    rays.reserve(tile.samples.size());
    for (Tile::Sample const& sample : tile.samples)
        rays.push_back({sample.ray.origin, sample.ray.direction, 1.0, {0}, {0}});
    tile.views = look(rays, tile.first_ray, false, ended);
    if (spectrum_)
        look_by_lines(tile, ended);
    collect(tile, film);
}

std::vector<RayView> PictureMaker::look(std::span<Ray const> rays, std::uint64_t first, bool by_lines,
                                        EventCounts& ended) const {
    TraceContext const context{scene_, *optics_, *nothing_, trace_, SumUnit::for_total(1.0)};
    double const step = 1.0 / std::sqrt(static_cast<double>(picture_.options.samples));
    TreeShader shader(
        {scene_, *optics_, picture_, sky_, dispersive_, textures_, to_objects_, camera_, step, caustics_},
        one_tree_channels, by_lines);
    EventCounts const counts = trace_rays(context, first, rays, shader, start_ ? &*start_ : nullptr);
    for (std::size_t i = 0; i < counts.size(); ++i)
        ended[i] += counts[i];
    return std::move(shader.views());
}

/// What came by way of a medium that disperses is looked at again, wavelength by wavelength.
void PictureMaker::look_by_lines(Tile& tile, EventCounts& ended) const {
    std::vector<std::size_t> again;
    std::vector<Spectrum::Line> lines;
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < tile.samples.size(); ++i) {
        if (!all_by_lines_ && !tile.views[i].disperses)
            continue;
        again.push_back(i);
        Tile::Sample const& sample = tile.samples[i];
        for (Spectrum::Line const& line : spectrum_->sample(lines_, sample.in_pixel.turn)) {
            lines.push_back(line);
            auto const wavelength = static_cast<std::uint32_t>(one_tree_wavelengths.size()) + line.line;
            rays.push_back({sample.ray.origin, sample.ray.direction, 1.0, {wavelength}, {0}});
        }
    }
    std::vector<RayView> const views = look(rays, tile.first_ray | std::uint64_t{1} << 63U, true, ended);
    for (std::size_t i = 0; i < again.size(); ++i) {
        RayView& view = tile.views[again[i]];
        view.light = dvec3(0.0);
        for (std::size_t k = i * lines_; k < (i + 1) * lines_; ++k)
            view.light += lines[k].colour * views[k].light;
    }
}

void PictureMaker::collect(Tile const& tile, Film& film) const {
    for (std::size_t i = 0; i < tile.samples.size(); ++i) {
        Tile::Sample const& sample = tile.samples[i];
        RayView const& view = tile.views[i];
        FilmPixel& pixel = film.at(sample.x, sample.y);
        ++pixel.samples;
        pixel.weight += sample.in_pixel.weight;
        pixel.plain += view.light;
        pixel.light += sample.in_pixel.weight * view.light;
        pixel.depth += view.depth;
        pixel.normal += view.normal;
        pixel.pieces += view.pieces;
        pixel.cut += view.cut;
    }
}

std::vector<bool> PictureMaker::that_differ(Film const& film) const {
    std::vector<dvec3> shown;
    shown.reserve(film.pixels.size());
    for (FilmPixel const& pixel : film.pixels)
        shown.push_back(encoded_srgb(std::exp2(picture_.options.exposure) * film.mean(pixel)));
    std::vector<bool> differ(film.pixels.size());
    auto const compare = [&](std::size_t a, std::size_t b) {
        if (difference(shown[a], shown[b]) > picture_.options.adaptive)
            differ[a] = differ[b] = true;
    };
    for (std::size_t y = 0; y < film.rows; ++y)
        for (std::size_t x = 0; x < film.columns; ++x) {
            std::size_t const at = y * film.columns + x;
            if (x + 1 < film.columns)
                compare(at, at + 1);
            if (y + 1 < film.rows)
                compare(at, at + film.columns);
        }
    return differ;
}

} // namespace sahl
