// In: triangles and rays. Out: the segments of their trees, traced by the shortest loop that a program of
// this kind can have: Embree with ROBUST, the hit met again in double, Snell, Fresnel, a stack. It is what
// the tracer is measured against, and is not to be made faster or slower with it. It protects itself from
// nothing but by an epsilon.
#pragma once

#include "float_scene.h"
#include "optics/fresnel.h"
#include "optics/snell.h"

#include <optional>
#include <vector>

namespace sahl::bench {

class BareLoop {
  public:
    explicit BareLoop(Mesh const& mesh)
        : mesh_(mesh), scene_(mesh, RTC_SCENE_FLAG_ROBUST),
          epsilon_(static_cast<float>(1e-5 * length(mesh.high - mesh.low))) {}

    struct Hit {
        double t;
        dvec3 normal; // unit, of the triangle
    };
    /// The nearest triangle, met again in double.
    std::optional<Hit> next(dvec3 const& origin, dvec3 const& direction) const {
        RTCRayHit ray;
        ray.ray = {static_cast<float>(origin.x),
                   static_cast<float>(origin.y),
                   static_cast<float>(origin.z),
                   epsilon_,
                   static_cast<float>(direction.x),
                   static_cast<float>(direction.y),
                   static_cast<float>(direction.z),
                   0.0f,
                   INFINITY,
                   0xFFFFFFFFu,
                   0,
                   0};
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect1(scene_, &ray);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_, &context, &ray);
#endif
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            return std::nullopt;
        auto const& corners = mesh_.soup.triangles[ray.hit.primID];
        dvec3 const &a = mesh_.soup.positions[corners[0]], &b = mesh_.soup.positions[corners[1]],
                    &c = mesh_.soup.positions[corners[2]];
        dvec3 const normal = normalize(cross(b - a, c - a));
        return Hit{dot(normal, a - origin) / dot(normal, direction), normal};
    }

    /// Segments of one ray's tree in glass of index n: split at each hit, cut below `least` of the power and
    /// beyond `deepest` hits along one path, where facets hold light for ever.
    std::uint64_t trace(dvec3 const& origin, dvec3 const& direction, double n, double least, unsigned deepest,
                        double& escaped) {
        std::uint64_t segments = 0;
        stack_.push_back({origin, direction, 1.0, 0, false});
        while (!stack_.empty()) {
            Branch const branch = stack_.back();
            stack_.pop_back();
            ++segments;
            if (branch.power < least || branch.depth > deepest)
                continue;
            auto const hit = next(branch.origin, branch.direction);
            if (!hit) {
                escaped += branch.power;
                continue;
            }
            dvec3 const point = branch.origin + hit->t * branch.direction;
            dvec3 const normal = branch.inside ? -hit->normal : hit->normal;
            double const n1 = branch.inside ? n : 1.0, n2 = branch.inside ? 1.0 : n;
            Approach const approach(branch.direction, normal);
            double const squared = transmitted_normal_squared(approach.incidence, n1, n2);
            if (squared <= 0.0) {
                stack_.push_back({point, reflect(branch.direction, normal), branch.power, branch.depth + 1,
                                  branch.inside});
                continue;
            }
            double const along = std::sqrt(squared);
            FresnelShares const shares = fresnel_shares(approach.incidence, n1, n2, along);
            stack_.push_back({point, refracted(approach, normal, n1, n2, along),
                              branch.power * shares.transmittance(), branch.depth + 1, !branch.inside});
            stack_.push_back({point, reflect(branch.direction, normal), branch.power * shares.reflectance(),
                              branch.depth + 1, branch.inside});
        }
        return segments;
    }

  private:
    struct Branch {
        dvec3 origin, direction;
        double power;
        unsigned depth;
        bool inside;
    };
    Mesh const& mesh_;
    FloatScene scene_;
    float epsilon_;
    std::vector<Branch> stack_;
};

} // namespace sahl::bench
