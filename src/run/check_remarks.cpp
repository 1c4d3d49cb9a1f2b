// In: what pilot rays found. Out: what a person should know of it, in sentences.
#include "run/check_report.h"
#include "run/check_words.h"

namespace sahl {

namespace {

void of_sources(Checked const& checked, Remarks& remarks) {
    Scene const& scene = checked.scene;
    std::uint64_t meet_something = 0;
    for (std::size_t s = 0; s < scene.sources.size(); ++s) {
        PilotOfSource const& pilot = checked.census.sources[s];
        meet_something += pilot.meet_something;
        if (pilot.meet_something == 0)
            remarks.warnings.push_back("source " + scene.sources[s].name + ": none of its " +
                                       plural(pilot.rays, "pilot ray meets", "pilot rays meets") +
                                       " anything: see from_mm and toward");
        for (StartingPlace const& start : pilot.starts)
            if (start.body && checked.census.bodies[start.body->value].opaque) {
                remarks.warnings.push_back("source " + scene.sources[s].name + ": it starts inside " +
                                           scene.bodies[start.body->value].name + ", which is opaque");
                break;
            }
    }
    if (scene.sources.empty())
        remarks.problems.push_back("there is no source: nothing will be traced");
    else if (meet_something == 0)
        remarks.problems.push_back("no source points at anything");
}

void of_bodies(Checked const& checked, bool sweep, Remarks& remarks) {
    Scene const& scene = checked.scene;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        Body const& body = scene.bodies[b];
        PilotOfBody const& pilot = checked.census.bodies[b];
        if (body.detector)
            continue;
        std::string const name = "object " + body.name + ": ";
        if (pilot.opaque && !body.open && body.medium != scene.surroundings)
            remarks.warnings.push_back(name + "no light can enter it, all its faces are opaque; its medium " +
                                       scene.media[body.medium.value].name + " plays no part");
        if (pilot.walled_in)
            remarks.warnings.push_back(name + "no light can enter it, it stands inside " +
                                       scene.bodies[pilot.walled_in->value].name + ", which is opaque");
        else if (!pilot.reached && !pilot.entered)
            (sweep ? remarks.notes : remarks.warnings)
                .push_back(name + "no pilot ray reaches it" + (sweep ? ", before the sweep begins" : ""));
        else if (!pilot.entered && !pilot.opaque && !body.open)
            remarks.warnings.push_back(name + "pilot rays meet it, but none goes in: is it covered, or "
                                              "overlapped by a body of higher priority?");
    }
}

void of_detectors(Checked const& checked, Remarks& remarks) {
    for (std::size_t d = 0; d < checked.scene.detectors.size(); ++d)
        if (PilotOfDetector const& pilot = checked.census.detectors[d]; pilot.hits == 0)
            remarks.warnings.push_back(
                "detector " + checked.scene.detectors[d].name +
                (pilot.hits_from_behind
                     ? ": pilot rays meet it only from behind: turn `facing` round, or set back = true"
                     : ": no pilot ray reaches it"));
}

} // namespace

Remarks census_remarks(Checked const& checked, double leak_limit, bool sweep) {
    Remarks remarks;
    of_sources(checked, remarks);
    if (checked.scene.sources.empty())
        return remarks;
    of_bodies(checked, sweep, remarks);
    of_detectors(checked, remarks);
    Census const& census = checked.census;
    if (census.lost > 0) {
        std::string const line = words(
            "%llu of %llu segments of pilot rays are lost, the first at (%.4g, %.4g, %.4g) mm",
            static_cast<unsigned long long>(census.lost), static_cast<unsigned long long>(census.segments),
            census.first_lost_at->x * 1e3, census.first_lost_at->y * 1e3, census.first_lost_at->z * 1e3);
        bool const many =
            static_cast<double>(census.lost) > leak_limit * static_cast<double>(census.segments);
        (many ? remarks.problems : remarks.warnings).push_back(line);
    }
    return remarks;
}

} // namespace sahl
