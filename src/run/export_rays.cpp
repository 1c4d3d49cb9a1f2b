#include "run/export_rays.h"

#include "record/drawn_length.h"
#include "run/model_of_scene.h"
#include "run/write_glb.h"

namespace sahl {

void export_rays_glb(RayLogReader const& log, std::optional<ExperimentSource> const& bodies, unsigned turn,
                     ColourBy by, std::filesystem::path const& out, PathFilter const* where) {
    RayColours colours(by);
    auto const for_all = [&](auto visit) {
        read_rays(log, where, [&](std::span<Segment const> ray) {
            for (Segment const& segment : ray)
                visit(segment);
            return true;
        });
    };
    for_all([&](Segment const& segment) { colours.look_at(segment); });
    double const escape = drawn_escape(log, where);
    ModelLines lines{"rays", {}, {}};
    for_all([&](Segment const& segment) {
        auto const [start, end] = colours.of(segment);
        lines.places.push_back(segment.origin);
        lines.places.push_back(drawn_end(segment, escape));
        lines.colours.push_back(start);
        lines.colours.push_back(end);
    });
    Model model;
    if (bodies) {
        Scene const scene = build_scene(read_experiment(bodies->tree, bodies->file));
        model = model_of(scene, turn, true, bodies->file.string());
    }
    write_glb(model, {&lines, 1}, out);
}

} // namespace sahl
