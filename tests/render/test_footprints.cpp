// What a sample stands for on the surfaces that its tree meets, against where the trees of its neighbours
// meet them; and what patterns look like through it.
#include "math/random.h"
#include "render/camera_rays.h"
#include "render/footprints.h"
#include "run/render_scene.h"
#include "scene/read_text.h"
#include "support/catch.h"
#include "trace/tracer.h"

#include <cmath>
#include <map>

using namespace sahl;

namespace {

struct Seen {
    dvec3 point;
    Footprint footprint;
    dvec3 normal;
};

/// Where a tree meets paint, by the choices on the way there.
class Recorder final : public TreeWatch {
  public:
    Recorder(Scene const& scene, WavelengthTable const& optics, CameraRays const& camera)
        : scene_(scene), camera_(camera), footprints_(scene, optics) {}

    void plant(std::span<Branch const>, std::span<Ray const> rays) override {
        footprints_.plant({camera_.footprint(rays[0].direction, 1.0)});
    }
    double meet(std::size_t number, Branch const& branch, Interface const& interface, Branches&) override {
        Footprint const& here = footprints_.meet(number, branch, interface, {0});
        if (interface.surface &&
            std::holds_alternative<Paint>(scene_.surfaces[interface.surface->value].kind))
            seen[branch.place] = {interface.point, here, interface.facet_normal};
        return branch.power;
    }
    void lose(std::size_t, Branch const&, Event) override {}
    void cut(std::uint32_t, double) override {}
    void push(std::size_t, Branch const&, Outgoing const& outgoing) override { footprints_.push(outgoing); }
    void next_generation() override { footprints_.next_generation(); }

    std::map<std::uint64_t, Seen> seen;

  private:
    Scene const& scene_;
    CameraRays const& camera_;
    Footprints footprints_;
};

std::string const page_and_camera =
    "[surface.page]\npaint = {diffuse = [1, 1, 1]}\n[[object]]\nname = \"page\"\n"
    "shape = {rectangle = {size_mm = [4000, 4000]}}\nsurface = \"page\"\n"
    "[[object]]\nname = \"wall\"\nshape = {sphere = {radius_mm = 3000}}\nsurface = \"page\"\n"
    "[surface.silver]\nreflect = 0.9\n[medium.m]\nn = 1.5\n[trace]\nmin_power = 1e-3\nmax_depth = 6\n"
    "[camera]\nat_mm = [30, -20, 300]\nlook_at_mm = [0, 0, 40]\nup = [0, 1, 0]\nfov_deg = 20\n"
    "resolution = [200, 150]\nsamples = 1\n[[object]]\nname = \"body\"\nmove_mm = [0, 0, 40]\n";

RenderOutcome render(std::string const& toml) {
    Experiment experiment = read_text(toml);
    Scene scene = build_scene(experiment);
    PictureMaker const maker(scene, *experiment.picture, experiment.trace);
    std::atomic<bool> const never{false};
    return render_scene(maker, experiment.picture->options, 2, {}, never);
}

} // namespace

TEST_CASE("what a sample stands for, through lenses and off mirrors, is where its neighbours go",
          "[render]") {
    for (char const* body :
         {"shape = {lens = {r1_mm = 75, r2_mm = -60, thickness_mm = 10, diameter_mm = 50}}\nmedium = \"m\"\n",
          "shape = {lens = {r1_mm = -50, r2_mm = 40, thickness_mm = 4, diameter_mm = 40}}\nmedium = \"m\"\n",
          "shape = {sphere = {radius_mm = 25}}\nmedium = \"m\"\n",
          "shape = {sphere = {radius_mm = 25}}\nsurface = \"silver\"\n",
          "shape = {box = {size_mm = [40, 40, 40]}}\nmedium = \"m\"\nturn_deg = [10, 20, 30]\n"}) {
        INFO(body);
        Experiment experiment = read_text(page_and_camera + body);
        Scene scene = build_scene(experiment);
        SourceSpec source;
        source.emitter = ExplicitRays{{{dvec3(0.0), dvec3(0.0, 0.0, 1.0), 1.0}}};
        source.wavelengths = {{587.5618e-9, 1.0}};
        scene.sources = {source};
        WavelengthTable const optics(scene);
        Emission const nothing(scene.sources, optics, 1);
        TraceContext const context{scene, optics, nothing, experiment.trace, SumUnit::for_total(1.0)};
        CameraRays const camera(*experiment.picture->camera);
        auto const look = [&](dvec2 const& film) {
            Recorder recorder(scene, optics, camera);
            CameraRay const ray = camera.ray(film, dvec2(0.0));
            std::vector<Ray> const rays{{ray.origin, ray.direction, 1.0, {0}, {0}}};
            trace_rays(context, 0, rays, recorder);
            return recorder.seen;
        };
        double const step = 1e-4; // pixels: the second derivative leaves 1e-4 of what changes over a pixel
        std::size_t compared = 0, narrow = 0, wide = 0;
        for (dvec2 const film :
             {dvec2(100.3, 74.8), dvec2(88.2, 66.1), dvec2(113.4, 80.2), dvec2(99.1, 95.3)}) {
            auto const here = look(film), right = look(film + dvec2(step, 0.0)),
                       below = look(film + dvec2(0.0, step));
            REQUIRE(!here.empty());
            for (auto const& [place, seen] : here) {
                if (!right.contains(place) || !below.contains(place))
                    continue;
                dvec3 const across = (right.at(place).point - seen.point) / step;
                dvec3 const down = (below.at(place).point - seen.point) / step;
                double const size = length(across) + length(down);
                CHECK(length(seen.footprint.across.place - across) < 1e-3 * size);
                CHECK(length(seen.footprint.down.place - down) < 1e-3 * size);
                ++compared;
                double const straight = 2.0 * 0.176 / 150 * 0.3; // m, what a pixel sees on the page
                narrow += size < 0.8 * 2.0 * straight;
                wide += size > 3.0 * 2.0 * straight;
            }
        }
        CHECK(compared >= 4);
        CHECK(narrow + wide >= 1); // neither is what a cone from the camera would say
    }
}

TEST_CASE("a chess board is seen as its mean over each pixel", "[render]") {
    // a floor that goes far, a sample a pixel, against a thousand points a pixel
    auto const board = [](std::string const& how, int samples) {
        return render("[surface.p]\npaint = {ambient = [1, 1, 1], checker = {size_mm = 20}}\n[[object]]\n"
                      "name = \"floor\"\nshape = {plane = {}}\nsurface = \"p\"\nturn_deg = [-90, 27, 0]\n"
                      "[camera]\nat_mm = [0, 60, 0]\nlook_at_mm = [0, 20, -100]\nfov_deg = 30\n"
                      "resolution = [64, 48]\nsamples = " +
                      std::to_string(samples) + "\n[picture]\nfilter = \"box\"\n" + how)
            .film;
    };
    Film const mean = board("filter_textures = false\n", 1024);
    auto const farthest = [&](Film const& film) {
        double most = 0.0;
        for (std::size_t i = 0; i < film.pixels.size(); ++i)
            most = std::max(most, std::abs(film.mean(film.pixels[i]).x - mean.mean(mean.pixels[i]).x));
        return most;
    };
    CHECK(farthest(board("filter_textures = false\n", 1)) > 0.45);
    // parts of the parallelogram are seen as boxes, a quarter wider: where an edge runs askew, this blurs
    CHECK(farthest(board("", 1)) < 0.15);
    CHECK(farthest(board("", 16)) < 0.1); // what samples of low discrepancy stand for overlaps a little
}
