#include "report/content.h"

#include "math/overloaded.h"
#include "report/outline.h"

#include <algorithm>
#include <cmath>

namespace sahl::report {

namespace {

constexpr double stray = 2.0; // times the size of all bodies and starts

struct Box3 {
    dvec3 low{INFINITY}, high{-INFINITY};

    void add(dvec3 const& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    dvec3 size() const { return low.x <= high.x ? high - low : dvec3(0.0); }
    bool holds(dvec3 const& p) const {
        return glm::all(glm::lessThanEqual(low, p)) && glm::all(glm::lessThanEqual(p, high));
    }
};

} // namespace

Sample sample_of(std::vector<Segment> const& paths, std::size_t most) {
    std::vector<std::size_t> starts; // of each ray
    for (std::size_t i = 0; i < paths.size(); ++i)
        if (i == 0 || paths[i].ray != paths[i - 1].ray)
            starts.push_back(i);
    std::size_t const every = most == 0 ? 1 : std::max<std::size_t>(1, (paths.size() + most - 1) / most);
    Sample sample;
    for (std::size_t ray = 0; ray < starts.size(); ray += every) {
        std::size_t const end = ray + 1 < starts.size() ? starts[ray + 1] : paths.size();
        if (sample.rays > 0 && sample.segments.size() + end - starts[ray] > most)
            continue;
        ++sample.rays;
        for (std::size_t i = starts[ray]; i < end && sample.segments.size() < most; ++i)
            sample.segments.push_back(&paths[i]);
    }
    return sample;
}

std::vector<SourceMark> source_marks(Scene const& scene) {
    std::vector<SourceMark> marks;
    for (SourceSpec const& source : scene.sources)
        std::visit(Overloaded{[&](Beam const& e) {
                                  marks.push_back({source.name, e.from});
                              },
                              [&](PointEmitter const& e) {
                                  marks.push_back({source.name, e.at});
                              },
                              [&](LambertianEmitter const& e) {
                                  marks.push_back({source.name, e.at});
                              },
                              [&](ExplicitRays const& e) {
                                  if (!e.rays.empty())
                                      marks.push_back({source.name, e.rays.front().origin});
                              }},
                   source.emitter);
    return marks;
}

Content content_of(Scene const& scene, std::size_t bodies, Sample const& sample) {
    Content content;
    Box3 box;
    for (std::size_t i = 0; i < bodies; ++i) {
        Body const& body = scene.bodies[i];
        for (dvec3 const& corner : body.shape  ? box_corners(*body.shape)
                                   : body.mesh ? box_corners(body.mesh->low, body.mesh->high)
                                               : std::vector<dvec3>())
            box.add(body.to_world.point(corner));
    }
    auto const add = [&](dvec3 const& p) {
        box.add(p);
        content.points.push_back(p);
    };
    for (SourceMark const& mark : source_marks(scene))
        add(mark.at);
    for (Segment const* s : sample.segments)
        if (s->parent < 0)
            add(s->origin);
    dvec3 const size = box.size();
    double const room = stray * std::max({size.x, size.y, size.z});
    Box3 const near =
        room > 0.0 ? Box3{box.low - room, box.high + room} : Box3{dvec3(-INFINITY), dvec3(INFINITY)};
    for (Segment const* s : sample.segments) {
        if (near.holds(s->origin))
            add(s->origin);
        if (dvec3 const end = s->origin + s->length * s->direction;
            std::isfinite(s->length) && near.holds(end))
            add(end);
    }
    content.size = box.size();
    return content;
}

} // namespace sahl::report
