// In: a scene of the torture suite. Out: what other tools do with it: triangles in float in Embree, hits in
// float, and some way of not meeting again the surface that a ray has just left. The ways are a file each;
// this is all else.
#pragma once

#include "torture/finder.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <glm/vec3.hpp>

namespace sahl::bench {

using fvec3 = glm::vec3;

/// Triangles of all parts, geometry number = part, where they stand in the world.
class FloatScene {
  public:
    explicit FloatScene(TortureCase const& torture);
    FloatScene(FloatScene const&) = delete;
    FloatScene& operator=(FloatScene const&) = delete;
    ~FloatScene();

    struct Hit {
        bool any = false;
        float t = 0.0f, u = 0.0f, v = 0.0f;
        std::uint32_t part = 0, triangle = 0;
        fvec3 normal{0.0f}; // unit, by the winding
        fvec3 point{0.0f};  // from the weights
        fvec3 error{0.0f};  // a bound on the point's rounding (pbrt-v4, 6.8.4, equation 6.28)
    };
    struct Last { // a triangle that is not to be met
        std::uint32_t part = RTC_INVALID_GEOMETRY_ID, triangle = RTC_INVALID_GEOMETRY_ID;
    };
    Hit meet(fvec3 const& origin, fvec3 const& direction, float from, Last const& but) const;

    double size() const { return size_; } // m, of the box round all
    std::array<dvec3, 3> corners(std::uint32_t part, std::uint32_t triangle) const;

  private:
    TortureCase const& torture_;
    RTCDevice device_;
    RTCScene scene_;
    std::vector<std::vector<fvec3>> positions_; // by part
    double size_ = 0.0;
};

/// Follows rays; where they start anew is what the ways differ in.
class FloatFinder : public Finder {
  public:
    explicit FloatFinder(TortureCase const& torture) : scene_(torture), torture_(torture) {}

    void begin(TortureRay const& ray, std::vector<std::uint32_t> const& inside) override;
    Answer next() override;
    void go_on(dvec3 const& direction, bool crosses) override;
    std::uint32_t medium() const override { return medium_in(turns_); }
    dvec3 origin() const override { return told_; }
    dvec3 direction() const override { return dvec3(direction_); }
    double ulp() const override { return 0x1p-23; }

  protected:
    /// The least distance at which a hit counts.
    virtual float from() const { return 0.0f; }
    /// Where a ray along `direction` starts that leaves a hit.
    virtual fvec3 start(FloatScene::Hit const& hit, fvec3 const& direction) const {
        (void)direction;
        return hit.point;
    }
    virtual bool excludes_last() const { return false; }

    FloatScene scene_;
    fvec3 origin_{0.0f}, direction_{0.0f};
    FloatScene::Last last_;

  private:
    std::uint32_t medium_in(std::vector<int> const& turns) const;

    TortureCase const& torture_;
    dvec3 told_{0.0};
    std::vector<int> turns_, before_, after_;
    FloatScene::Hit hit_;
};

std::unique_ptr<Finder> plain_loop(TortureCase const& torture);
std::unique_ptr<Finder> fixed_epsilon(TortureCase const& torture);
std::unique_ptr<Finder> relative_epsilon(TortureCase const& torture);
std::unique_ptr<Finder> integer_offset(TortureCase const& torture);
std::unique_ptr<Finder> error_bound_offset(TortureCase const& torture);
std::unique_ptr<Finder> exclude_last(TortureCase const& torture);

} // namespace sahl::bench
