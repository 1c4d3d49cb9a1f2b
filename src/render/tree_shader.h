// In: the trees of camera rays, as they grow. Out: the light that each ray brings.
#pragma once

#include "render/camera_rays.h"
#include "render/channels.h"
#include "render/footprints.h"
#include "render/lamps.h"
#include "render/light_map.h"
#include "render/sky.h"
#include "scene/picture.h"
#include "scene/surface_textures.h"
#include "trace/straight.h"
#include "trace/tree_watch.h"

#include <vector>

namespace sahl {

/// All that a picture's rays need to know; nothing is changed.
struct PictureScene {
    Scene const& scene;
    WavelengthTable const& optics;
    Picture const& picture;
    Sky const& sky;
    std::vector<bool> const& dispersive; // media
    SurfaceTextures const& textures;
    std::vector<Affine> const& to_objects; // by body: from the world to its own frame
    CameraRays const& camera;
    double step = 1.0;                  // pixels between samples: what each of them stands for
    LightMap const* caustics = nullptr; // light that is added to paint
};

/// What one camera ray sees.
struct RayView {
    dvec3 light{0.0};
    double depth = INFINITY;  // m, to the first surface
    dvec3 normal{0.0};        // of that, facing the camera
    std::uint32_t pieces = 0; // of its tree: those that ended somewhere, and were not cut
    bool disperses = false;   // some of it came by way of a medium that does
    double cut = 0.0;         // of 1: what was not followed
};

/// Weighs each branch by colour and adds up what its tree sees: local illumination where it ends at paint or
/// crosses it (B. T. Phong, Commun. ACM 18 (1975) 311; T. Whitted, Commun. ACM 23 (1980) 343), the sky where
/// it leaves the scene. Rays start with a power of 1 W, and a branch's power is that of its brightest colour.
class TreeShader final : public TreeWatch {
  public:
    /// channels   of a tree for all colours; where `single`, each ray has its own wavelength, and trees that
    ///            grow together may have different ones
    TreeShader(PictureScene const& picture, Channels const& channels, bool single);

    void plant(std::span<Branch const> roots, std::span<Ray const> rays) override;
    double meet(std::size_t number, Branch const& branch, Interface const& interface,
                Branches& branches) override;
    void lose(std::size_t number, Branch const& branch, Event event) override;
    void cut(std::uint32_t ray, double power) override { views_[first_view_ + ray].cut += power; }
    void push(std::size_t number, Branch const& child, Outgoing const& outgoing) override;
    void next_generation() override;

    /// By ray, in the order in which they were planted since this was last cleared.
    std::vector<RayView>& views() { return views_; }

  private:
    Paint const* paint_of(Interface const& interface);
    dvec3 glow(Branch const& branch, double length) const;
    void weigh(Branch const& branch, Interface const& interface, dvec3 const& arrives, double power,
               Branches& branches);
    void light_up(RayView& view, Branch const& branch, Interface const& interface, dvec3 const& arrives,
                  Branches& branches);
    dvec3 local_light(Paint const& paint, Interface const& interface, Branch const& branch, bool& lit);
    dvec3 lamp_light(LampView const& lamp, Interface const& interface);

    PictureScene in_;
    bool single_;
    bool absorbs_, disperses_, glows_; // does any medium, or lamp?
    Paint matt_;                       // of a diffuse surface
    Channels channels_{};              // of the branch that is looked at
    std::span<Ray const> rays_;
    std::vector<RayView> views_;
    std::size_t first_view_ = 0;                // of the group that grows
    std::vector<dvec3> colours_, next_colours_; // of this generation's branches, at their start
    std::array<dvec3, 2> leaving_{};            // what comes back and what crosses, of a power of 1
    std::optional<Footprints> footprints_;      // where something has a pattern to be averaged over
    Interface toward_lamp_;                     // that is met on the way to a lamp
    Footprint seen_;                            // of the branch that is looked at, on the surface
};

} // namespace sahl
