// In: a scene and a picture's options. Out: tiles of the picture, each a pure function of its number.
#pragma once

#include "render/camera_rays.h"
#include "render/film.h"
#include "render/pixel_samples.h"
#include "render/spectral.h"
#include "render/tree_shader.h"
#include "trace/tracer.h"

#include <atomic>
#include <memory>
#include <optional>

namespace sahl {

inline constexpr std::uint32_t tile_side = 16; // pixels

/// Segments by the event that ended them.
using EventCounts = std::array<std::uint64_t, event_names.size()>;

class PictureMaker {
  public:
    /// The scene's sources become those of the picture: they say at which wavelengths it is traced. It has no
    /// detectors. All references must outlive this. Throws InputError where an image cannot be read.
    ///   caustics   light that is added to paint, or none
    PictureMaker(Scene& scene, Picture const& picture, TraceOptions const& trace,
                 LightMap const* caustics = nullptr);

    std::uint64_t tiles() const { return std::uint64_t{tiles_across_} * tiles_down_; }
    Film empty_film() const;
    /// Adds samples [first, end) of the pixels of a tile. Tiles may be done at the same time.
    ///   only   by pixel: which of them; empty: all
    void render_tile(Film& film, std::uint64_t tile, std::uint32_t first, std::uint32_t end,
                     std::vector<bool> const& only, EventCounts& ended) const;
    /// Pixels that differ from a neighbour by more than options.adaptive.
    std::vector<bool> that_differ(Film const& film) const;

    bool disperses() const { return spectrum_.has_value(); }
    std::uint32_t wavelengths_a_sample() const { return lines_; }
    /// Of pictures that a model names and that cannot be read.
    std::vector<std::string> const& warnings() const { return textures_.warnings(); }

  private:
    struct Tile;
    std::vector<RayView> look(std::span<Ray const> rays, std::uint64_t first, bool by_lines,
                              EventCounts& ended) const;
    void look_by_lines(Tile& tile, EventCounts& ended) const;
    void collect(Tile const& tile, Film& film) const;

    Picture const& picture_;
    CameraRays camera_;
    PixelSamples samples_;
    Sky sky_;
    SurfaceTextures textures_;
    std::optional<Spectrum> spectrum_; // absent: one tree for all colours
    std::uint32_t lines_ = 1;          // trees of a sample that met a medium that disperses
    bool all_by_lines_ = false;        // and of any other
    std::vector<bool> dispersive_;     // media
    std::vector<Affine> to_objects_;   // by body
    std::unique_ptr<WavelengthTable const> optics_;
    std::unique_ptr<Emission const> nothing_; // of a picture's context, which has no source
    TraceOptions trace_;
    Scene const& scene_;
    LightMap const* caustics_;
    std::optional<Bvh::Start> start_; // of all rays, where they begin at one point
    std::uint32_t tiles_across_, tiles_down_;
};

/// Does the index change over the visible range?
bool disperses(Medium const& medium);
bool disperses(Scene const& scene); // of any of its media

} // namespace sahl
