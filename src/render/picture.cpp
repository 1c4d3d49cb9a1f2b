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

/// Every second bit: x or y of place `index` along Morton's curve, which keeps neighbours together.
std::uint32_t every_second_bit(std::uint32_t index) {
    std::uint32_t bits = 0;
    for (std::uint32_t bit = 0; bit < 16; ++bit)
        bits |= (index >> (2 * bit) & 1U) << bit;
    return bits;
}

double difference(dvec3 const& a, dvec3 const& b) {
    dvec3 const d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z});
}

} // namespace

bool disperses(Scene const& scene) {
    return std::any_of(scene.media.begin(), scene.media.end(), [](Medium const& medium) {
        double const blue = refractive_index(medium.index, one_tree_wavelengths[3]);
        double const red = refractive_index(medium.index, one_tree_wavelengths[1]);
        return std::abs(blue - red) > least_dispersion * red;
    });
}

struct PictureMaker::Tile {
    struct Sample {
        std::uint32_t x, y;
        double weight;
    };
    std::vector<Sample> samples;
    std::vector<Spectrum::Line> lines; // of all samples, each lines_ of them; empty in one tree
    std::vector<Ray> rays;
    std::vector<RayView> views;
};

PictureMaker::PictureMaker(Scene& scene, Picture const& picture, TraceOptions const& trace,
                           LightMap const* caustics)
    : picture_(picture), camera_(*picture.camera), samples_(picture.options, trace.seed),
      sky_(picture.background), trace_(trace), scene_(scene), caustics_(caustics),
      tiles_across_((picture.camera->columns + tile_side - 1) / tile_side),
      tiles_down_((picture.camera->rows + tile_side - 1) / tile_side) {
    std::uint32_t const asked = picture.options.wavelengths;
    if (asked > 1 || (asked == 0 && sahl::disperses(scene))) {
        lines_ = std::max(asked == 0 ? lines_of_a_sample : asked, 3U); // one in each band, at least
        spectrum_.emplace(spectral_lines);
    }
    scene.sources = {source_of(spectrum_
                                   ? spectrum_->wavelengths()
                                   : std::vector(one_tree_wavelengths.begin(), one_tree_wavelengths.end()))};
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
    std::vector<Tile> by_line(1);
    Tile& tile = by_line[0];
    for (std::uint32_t place = 0; place < tile_side * tile_side; ++place) {
        std::uint32_t const x = left + every_second_bit(place), y = top + every_second_bit(place >> 1);
        std::uint64_t const pixel = std::uint64_t{y} * film.columns + x;
        if (x >= film.columns || y >= film.rows || (!only.empty() && !only[pixel]))
            continue;
        for (std::uint32_t index = first; index < end; ++index) {
            PixelSample const sample = samples_.at(pixel, index);
            CameraRay const ray = camera_.ray(dvec2(x + 0.5, y + 0.5) + sample.offset, sample.lens);
            tile.samples.push_back({x, y, sample.weight});
            if (!spectrum_) {
                tile.rays.push_back({ray.origin, ray.direction, 1.0, {0}, {0}});
                continue;
            }
            for (Spectrum::Line const& line : spectrum_->sample(lines_, sample.turn)) {
                tile.lines.push_back(line);
                tile.rays.push_back({ray.origin, ray.direction, 1.0, {line.line}, {0}});
            }
        }
    }
    TraceContext const context{scene_, *optics_, *nothing_, trace_, SumUnit::for_total(1.0)};
    TreeShader shader({scene_, *optics_, picture_, sky_, caustics_}, one_tree_channels,
                      spectrum_.has_value());
    EventCounts const counts = trace_rays(context, number << 32U | std::uint64_t{first} << 24U, tile.rays,
                                          shader, start_ ? &*start_ : nullptr);
    for (std::size_t i = 0; i < counts.size(); ++i)
        ended[i] += counts[i];
    tile.views = std::move(shader.views());
    collect(tile, film);
}

void PictureMaker::collect(Tile& tile, Film& film) const {
    std::size_t next = 0;
    double const share = 1.0 / lines_;
    for (Tile::Sample const& sample : tile.samples) {
        FilmPixel& pixel = film.at(sample.x, sample.y);
        ++pixel.samples;
        pixel.weight += sample.weight;
        for (std::uint32_t line = 0; line < lines_; ++line, ++next) {
            RayView const& view = tile.views[next];
            dvec3 const light = spectrum_ ? tile.lines[next].colour * view.light : view.light;
            pixel.plain += light;
            pixel.light += sample.weight * light;
            pixel.depth += share * view.depth;
            pixel.normal += share * view.normal;
            pixel.pieces += share * view.pieces;
            pixel.cut += share * view.cut;
        }
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
