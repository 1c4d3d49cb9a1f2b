// Figures, never asserted: the first hits of a camera's rays, as the scene gives them (met again in double,
// with medium and normal), in packets and one by one, beside Embree's own packets of 16 with the coherent
// hint on the same rays and the same triangles. One thread; CPU seconds of the thread, in turn, medians.
//   camera_rays [FILE.obj]...
#include "float_scene.h"
#include "support/cpu_clock.h"
#include "support/lab.h"
#include "support/meshes.h"

#include "geometry/mesh_tree.h"
#include "render/camera_rays.h"
#include "scene/interface.h"
#include "scene/read_obj.h"

#include <cstdio>

using namespace sahl;
using namespace sahl::bench;

namespace {

constexpr int rounds = 7;
constexpr std::size_t together = Bvh::most_together;

/// Nothing but Embree: what it is that a ray hits, in float.
class RawPackets {
  public:
    explicit RawPackets(Mesh const& mesh) : scene_(mesh, RTC_SCENE_FLAG_NONE) {}

    /// How many of them hit something.
    std::size_t hits(std::span<CameraRay const> rays) const {
        alignas(64) RTCRayHit16 packet;
        alignas(64) int valid[together];
        for (std::size_t i = 0; i < together; ++i) {
            CameraRay const& ray = rays[std::min(i, rays.size() - 1)];
            valid[i] = i < rays.size() ? -1 : 0;
            packet.ray.org_x[i] = static_cast<float>(ray.origin.x);
            packet.ray.org_y[i] = static_cast<float>(ray.origin.y);
            packet.ray.org_z[i] = static_cast<float>(ray.origin.z);
            packet.ray.dir_x[i] = static_cast<float>(ray.direction.x);
            packet.ray.dir_y[i] = static_cast<float>(ray.direction.y);
            packet.ray.dir_z[i] = static_cast<float>(ray.direction.z);
            packet.ray.tnear[i] = packet.ray.time[i] = 0.0f;
            packet.ray.tfar[i] = INFINITY;
            packet.ray.mask[i] = 0xFFFFFFFFu;
            packet.ray.flags[i] = 0;
            packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        }
#if RTC_VERSION_MAJOR >= 4
        RTCIntersectArguments arguments;
        rtcInitIntersectArguments(&arguments);
        arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
        rtcIntersect16(valid, scene_, &packet, &arguments);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect16(valid, scene_, &context, &packet);
#endif
        std::size_t hits = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            hits += packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        return hits;
    }

  private:
    FloatScene scene_;
};

/// Of a picture of 640 × 480 that the mesh fills: squares of 4 × 4 pixels, or the samples of a pixel.
std::vector<CameraRay> rays_of(Mesh const& mesh, bool sixteen_a_pixel) {
    Camera camera;
    double const size = length(mesh.high - mesh.low);
    camera.at = 0.5 * (mesh.low + mesh.high) + dvec3(0.0, 0.0, 2.0 * size);
    camera.fov = 0.45;
    CameraRays const rays(camera);
    std::vector<CameraRay> all;
    for (std::uint32_t y = 0; y < camera.rows; y += 4)
        for (std::uint32_t x = 0; x < camera.columns; x += 4)
            for (std::uint32_t i = 0; i < 16; ++i)
                for (std::uint32_t k = 0; k < (sixteen_a_pixel ? 16 : 1); ++k) {
                    dvec2 const within = sixteen_a_pixel ? dvec2(k % 4 + 0.5, k / 4 + 0.5) / 4.0 : dvec2(0.5);
                    all.push_back(rays.ray(dvec2(x + i % 4, y + i / 4) + within, dvec2(0.0)));
                }
    return all;
}

/// Hits of a packet, as the scene gives them.
std::size_t scene_hits(Scene const& scene, std::span<CameraRay const> rays, bool as_packet) {
    static ShellSet const outside;
    std::array<SeenAhead, together> seen;
    if (as_packet) {
        InlineVector<Bvh::Line, together> lines;
        for (CameraRay const& ray : rays)
            lines.push_back({&ray.origin, &ray.direction, &outside});
        scene.bvh->look_ahead({lines.begin(), lines.size()}, seen);
    }
    std::size_t hits = 0;
    Interface found;
    for (std::size_t i = 0; i < rays.size(); ++i)
        hits += next_interface(scene, rays[i].origin, rays[i].direction, outside, {}, {}, found,
                               as_packet ? &seen[i] : nullptr) == Meeting::interface;
    return hits;
}

void measure(std::string const& name, TriangleSoup soup) {
    Lab lab;
    MediumId const glass = lab.medium(1.5);
    auto const mesh = std::make_shared<Mesh const>(make_mesh(std::move(soup)));
    Scene const scene = with_meshes(build_scene(lab.experiment), {{"mesh", mesh, glass, Affine{}, 0}});
    RawPackets const raw(*mesh);
    for (bool const sixteen : {false, true}) {
        std::vector<CameraRay> const rays = rays_of(*mesh, sixteen);
        std::vector<double> ns[3];
        std::size_t hits[3] = {0, 0, 0};
        for (int round = 0; round < rounds; ++round)
            for (int way = 0; way < 3; ++way) {
                hits[way] = 0;
                double const start = cpu_seconds();
                for (std::size_t first = 0; first < rays.size(); first += together) {
                    auto const packet =
                        std::span(rays).subspan(first, std::min(together, rays.size() - first));
                    hits[way] += way == 0 ? raw.hits(packet) : scene_hits(scene, packet, way == 1);
                }
                ns[way].push_back((cpu_seconds() - start) / static_cast<double>(rays.size()) * 1e9);
            }
        double const bare = median(ns[0]), packets = median(ns[1]), single = median(ns[2]);
        std::printf(
            "%-10s %7zu triangles, %2d samples a pixel, %4.1f %% hit: raw packets %.1f ns a ray, sahl "
            "%.1f ns (%.2f of raw speed), one by one %.1f ns; hits that differ from raw: %lld\n",
            name.c_str(), mesh->soup.triangles.size(), sixteen ? 16 : 1,
            100.0 * static_cast<double>(hits[1]) / static_cast<double>(rays.size()), bare, packets,
            bare / packets, single, static_cast<long long>(hits[1]) - static_cast<long long>(hits[0]));
        std::fflush(stdout);
    }
}

} // namespace

int main(int argc, char** argv) {
    measure("ball", geodesic_soup(5e-3, 71));
    for (int i = 1; i < argc; ++i)
        for (ModelMesh& mesh : read_obj(argv[i]).meshes)
            measure(std::filesystem::path(argv[i]).stem().string(), std::move(mesh.soup));
    return 0;
}
