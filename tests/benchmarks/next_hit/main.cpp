// Figures, never asserted: the torture suite with every method. For each case and method: events, wrong ones,
// ambiguous ones (judged case by case against arithmetic of 64 and 113 bits), and CPU nanoseconds an event.
//   next_hit [--rays N] [--variant V] [--case TEXT] [--method TEXT] [--csv FILE] [--no-time] [--stories]
#include "float_finder.h"
#include "torture/cases.h"
#include "torture/follow.h"
#include "torture/ours.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string_view>

using namespace sahl::bench;

namespace {

/// Closed meshes and nothing else: what the methods in float know.
bool all_meshes(TortureCase const& torture) {
    return std::all_of(torture.parts.begin(), torture.parts.end(), [](TorturePart const& part) {
        return std::holds_alternative<MeshRef>(part.geometry) && !part.mirror && !part.torn;
    });
}

/// Closed bodies, which is all that is known without contact.
bool all_closed(TortureCase const& torture) {
    return std::none_of(torture.parts.begin(), torture.parts.end(),
                        [](TorturePart const& part) { return part.mirror || part.torn; });
}

bool any(TortureCase const&) {
    return true;
}

struct Way {
    char const* name;
    std::unique_ptr<Finder> (*make)(TortureCase const&);
    bool (*knows)(TortureCase const&);
};

constexpr Way ways[] = {
    {"plain loop", plain_loop, all_meshes},
    {"fixed epsilon", fixed_epsilon, all_meshes},
    {"relative epsilon", relative_epsilon, all_meshes},
    {"integer offset", integer_offset, all_meshes},
    {"error-bound offset", error_bound_offset, all_meshes},
    {"exclude last triangle", exclude_last, all_meshes},
    {"sahl without contact", ours_without_contact, all_closed},
    {"sahl", ours, any},
    {"sahl quadratic",
     [](TortureCase const& torture) { return ours_curved(torture, sahl::Curving::quadratic); },
     is_flat_faced},
    {"sahl fitted", [](TortureCase const& torture) { return ours_curved(torture, sahl::Curving::fitted); },
     is_flat_faced},
    {"sahl in packets", ours_in_packets, any}, // these where they are asked for
    {"sahl in turn", ours_in_turn, any},
};

struct Options {
    std::uint64_t rays = 100'000, variant = 0;
    std::string_view torture, method;
    char const* csv = nullptr;
    bool time = true, stories = false;
};

Options read(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; ++i) {
        std::string_view const key = argv[i];
        auto const value = [&] { return i + 1 < argc ? argv[++i] : ""; };
        if (key == "--rays")
            options.rays = std::strtoull(value(), nullptr, 10);
        else if (key == "--variant")
            options.variant = std::strtoull(value(), nullptr, 10);
        else if (key == "--case")
            options.torture = value();
        else if (key == "--method")
            options.method = value();
        else if (key == "--csv")
            options.csv = value();
        else if (key == "--no-time")
            options.time = false;
        else if (key == "--stories")
            options.stories = true;
        else {
            std::fprintf(stderr,
                         "usage: next_hit [--rays N] [--variant N] [--case PART_OF_A_NAME] [--method NAME] "
                         "[--csv FILE] [--no-time] [--stories]\n");
            std::exit(2);
        }
    }
    return options;
}

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
}

/// Nanoseconds an event, without what beginning a ray takes; the ways take turns, the median of seven rounds
/// counts.
std::vector<double> times_of(TortureCase const& torture, std::vector<std::unique_ptr<Finder>> const& methods,
                             std::uint64_t seed, std::uint64_t rays) {
    auto const drawn = rays_of(torture, seed, rays);
    auto const inside = insides_of(torture, drawn);
    std::vector<std::vector<double>> rounds(methods.size());
    for (int round = 0; round < 7; ++round)
        for (std::size_t m = 0; m < methods.size(); ++m) {
            double const start = cpu_seconds();
            for (std::size_t k = 0; k < drawn.size(); ++k)
                methods[m]->begin(drawn[k], inside[k]);
            double const middle = cpu_seconds();
            Walked const walked = walk(torture, *methods[m], drawn, inside);
            double const seconds = (cpu_seconds() - middle) - (middle - start);
            rounds[m].push_back(1e9 * seconds / static_cast<double>(walked.events));
        }
    std::vector<double> times;
    for (auto const& one : rounds)
        times.push_back(median(one));
    return times;
}

} // namespace

int main(int argc, char** argv) {
    Options const options = read(argc, argv);
    std::ofstream csv;
    if (options.csv) {
        csv.open(options.csv);
        csv << "case,of,variant,method,rays,events,wrong,lost,ambiguous,wrong_per_million,ns_per_event\n";
    }
    for (TortureCase const& torture : torture_cases(options.variant)) {
        if (torture.name.find(options.torture) == std::string::npos)
            continue;
        auto const rays =
            static_cast<std::uint64_t>(std::max(1.0, torture.share * static_cast<double>(options.rays)));
        std::vector<std::unique_ptr<Finder>> methods;
        std::vector<char const*> names;
        for (Way const& way : ways)
            if (way.knows(torture) &&
                (options.method.empty() ? way.make != ours_in_packets && way.make != ours_in_turn
                                        : way.name == options.method)) {
                methods.push_back(way.make(torture));
                names.push_back(way.name);
            }
        std::vector<double> times(methods.size());
        if (options.time)
            times = times_of(
                torture, methods, options.variant + 1,
                std::clamp<std::uint64_t>(rays / 10, 1,
                                          static_cast<std::uint64_t>(std::max(1.0, 20'000 * torture.share))));
        for (std::size_t m = 0; m < methods.size(); ++m) {
            Verdict const v = judge(torture, *methods[m], options.variant + 1, rays);
            std::printf("%-56s %-5s %-22s %9llu events %8llu wrong %6llu ambiguous %7.0f ns\n",
                        torture.name.c_str(), torture.of.c_str(), names[m],
                        static_cast<unsigned long long>(v.events), static_cast<unsigned long long>(v.wrong),
                        static_cast<unsigned long long>(v.ambiguous), times[m]);
            if (options.stories)
                for (std::string const& story : v.stories)
                    std::printf("    %s\n", story.c_str());
            std::fflush(stdout);
            if (csv)
                csv << '"' << torture.name << "\"," << torture.of << ',' << options.variant << ',' << names[m]
                    << ',' << v.rays << ',' << v.events << ',' << v.wrong << ',' << v.lost << ','
                    << v.ambiguous << ',' << v.wrong_per_million() << ',' << times[m]
                    << std::endl; // flushed: it takes long
        }
    }
    return 0;
}
