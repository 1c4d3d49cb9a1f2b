// In: the bank. Out: that no kind of case is forgotten: each is traced by a test, or here stands why not.
#include "support/bank.h"
#include "support/catch.h"

#include <array>
#include <set>

using namespace sahl;
using namespace sahl::bench;

namespace {

// Of those traced, what needs s and p apart is compared as far as unpolarised light is exact; the test of
// each says how far: prism_general and ball_lens (transmittances of two surfaces), drop_order_intensities and
// ball_flux_orders (orders from 1 on), pile_of_plates and beer_lambert_slab at an angle, fresnel_dielectric
// beyond the critical angle and fresnel_metal (phases).
constexpr std::array<std::string_view, 26> traced{
    "prism_min_deviation", "prism_general",      "sellmeier",
    "dispersing_prism",    "dove_prism",         "pellin_broca",
    "ball_lens",           "rainbow_angle",      "drop_order_intensities",
    "aplanatic_sphere",    "ball_flux_orders",   "singlet_real_ray",
    "multi_surface",       "pile_of_plates",     "beer_lambert_slab",
    "plate_displacement",  "fresnel_dielectric", "special_angles",
    "fresnel_metal",       "mirror_pipe",        "two_mirror_wedge",
    "corner_cube",         "spherical_mirror",   "diffuse_fresnel",
    "conic_mirror",        "cartesian_refractor"};

struct Out {
    std::string_view kind, reason;
};
constexpr std::array<Out, 1> not_traced{{
    {"fresnel_rhomb", "all its values are phases between s and p: it needs polarised tracing"},
}};

} // namespace

TEST_CASE("every kind of case in the bank is traced, or there is a reason why not") {
    std::set<std::string_view> known(traced.begin(), traced.end());
    for (Out const& out : not_traced) {
        INFO(out.kind << ": " << out.reason);
        CHECK(known.insert(out.kind).second);
    }
    for (BankCase const& c : bank()) {
        INFO(c.id);
        CHECK(known.count(c.kind) == 1);
    }
}
