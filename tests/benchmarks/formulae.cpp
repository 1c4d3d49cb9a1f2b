// Figures, never asserted: the worst errors of Fresnel's and Snell's formulae, regime by regime, on random
// and adversarial inputs, against arithmetic of 113 bits.
//   formulae [INPUTS A REGIME] [FILE.csv]
#include "optics/regimes.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>

using namespace sahl::bench;

namespace {

void row(std::ofstream& csv, std::string const& name, Shares4 const& w) {
    std::printf("%-52s ulp %5.1f %5.1f %5.1f %5.1f  abs %.1e %.1e %.1e %.1e  balance %.1e  wrong %llu\n",
                name.c_str(), w.r_s.ulps, w.r_p.ulps, w.t_s.ulps, w.t_p.ulps, w.r_s.absolute, w.r_p.absolute,
                w.t_s.absolute, w.t_p.absolute, w.balance, static_cast<unsigned long long>(w.wrong_total));
    std::fflush(stdout);
    if (csv)
        csv << '"' << name << "\"," << w.inputs << ',' << w.r_s.ulps << ',' << w.r_p.ulps << ',' << w.t_s.ulps
            << ',' << w.t_p.ulps << ',' << w.r_s.absolute << ',' << w.r_p.absolute << ',' << w.t_s.absolute
            << ',' << w.t_p.absolute << ',' << w.balance << ',' << w.wrong_total << '\n';
}

} // namespace

int main(int argc, char** argv) {
    std::uint64_t const inputs = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100'000;
    std::ofstream csv, directions;
    if (argc > 2) {
        csv.open(argv[2]);
        csv << "regime,inputs,ulp_R_s,ulp_R_p,ulp_T_s,ulp_T_p,abs_R_s,abs_R_p,abs_T_s,abs_T_p,balance,wrong_"
               "total\n";
    }
    std::printf("worst errors of R_s, R_p, T_s, T_p (ulp: of values that err by more than 1e-16), %llu "
                "inputs a regime\n",
                static_cast<unsigned long long>(inputs));
    for (Regime const& regime : dielectric_regimes())
        row(csv, regime.name, judge_dielectric(regime, 1, inputs));
    for (MetalRegime const& regime : metal_regimes())
        row(csv, regime.name, judge_metal(regime, 2, inputs));
    std::printf("directions: worst error in rad\n");
    if (csv)
        csv << "\nregime,inputs,refracted_rad,reflected_rad,length,wrong_total_within\n";
    for (Regime const& regime : dielectric_regimes()) {
        Directions const w = judge_directions(regime, 3, inputs);
        std::printf(
            "%-52s refracted %.1e reflected %.1e length %.1e  wrong on total reflection within %.1e\n",
            regime.name.c_str(), w.refracted, w.reflected, w.length, w.undecided);
        std::fflush(stdout);
        if (csv)
            csv << '"' << regime.name << "\"," << w.inputs << ',' << w.refracted << ',' << w.reflected << ','
                << w.length << ',' << w.undecided << '\n';
    }
    return 0;
}
