// In: a scene of the torture suite. Out: Sahl's own ways through it.
#include "torture/ours.h"

#include "geometry/mesh_tree.h"
#include "geometry/smooth_fans.h"
#include "scene/interface.h"

#include <array>
#include <cmath>

namespace sahl::bench {

namespace {

std::size_t faces_of(TorturePart const& part) {
    auto const* mesh = std::get_if<MeshRef>(&part.geometry);
    return mesh ? (*mesh)->soup.face_names.size() : face_names(std::get<Shape>(part.geometry)).size();
}

std::size_t shells_of(TorturePart const& part) {
    auto const* mesh = std::get_if<MeshRef>(&part.geometry);
    if (part.mirror)
        return 0;
    return mesh ? (*mesh)->shells.size() : 1;
}

enum class Ahead : std::uint8_t { nothing, in_packets, in_turn };

class Ours : public Finder {
  public:
    explicit Ours(TortureCase const& torture, Curving curving = Curving::none, Ahead ahead = Ahead::nothing)
        : scene_(sahl_scene(torture, curving)), ahead_(ahead) {
        if (ahead == Ahead::in_packets ? scene_.bvh->size_seen_ahead() == 0.0
                                       : !scene_.bvh->looks_ahead_in_turn())
            ahead_ = Ahead::nothing;
    }

    void begin(TortureRay const& ray, std::vector<std::uint32_t> const&) override {
        origin_ = ray.origin;
        direction_ = ray.direction;
        Bvh::Start const start = scene_.bvh->start_at(ray.origin, ray.direction);
        inside_ = start.inside;
        left_ = start.on;
        body_ = body_at(scene_, inside_);
    }
    Answer next() override {
        SeenAhead const ahead = ahead_ != Ahead::nothing ? seen_among_others() : SeenAhead{};
        Meeting const meeting =
            next_interface(scene_, origin_, direction_, inside_, body_, left_, found_, &ahead);
        if (meeting == Meeting::nothing)
            return {};
        Answer answer;
        answer.kind = meeting == Meeting::interface ? Answer::Kind::boundary : Answer::Kind::lost;
        if (meeting != Meeting::interface)
            return answer;
        answer.t = found_.t;
        answer.part = scene_.faces[found_.face.value].body.value;
        answer.face = found_.primitive >= 0 ? static_cast<std::uint32_t>(found_.primitive)
                                            : found_.face.value - first_face(answer.part);
        answer.normal = found_.normal;
        answer.before = medium_of(scene_, body_).value;
        answer.after = found_.medium_after.value;
        answer.mirror = found_.surface.has_value();
        return answer;
    }
    void go_on(dvec3 const& direction, bool crosses) override {
        origin_ = found_.point;
        direction_ = direction;
        inside_ = crosses ? found_.inside_after : found_.inside_before;
        body_ = crosses ? found_.body_after : found_.body_before;
        left_ = found_.left_by(crosses);
    }
    std::uint32_t medium() const override { return medium_of(scene_, body_).value; }
    dvec3 origin() const override { return origin_; }
    dvec3 direction() const override { return direction_; }
    double ulp() const override { return 0x1p-52; }

  private:
    /// Of the ray, somewhere among others that start there too and go nearly the same way.
    SeenAhead seen_among_others() {
        std::array<dvec3, Bvh::most_together> directions;
        std::array<SeenAhead, Bvh::most_together> seen;
        std::vector<Bvh::Line> lines;
        std::size_t const place = packets_++ % Bvh::most_together;
        dvec3 const side = perpendicular_to(direction_), other = cross(direction_, side);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            auto const turn = static_cast<double>(i);
            directions[i] = i == place ? direction_
                                       : normalize(direction_ + 0.02 * std::sqrt(turn) *
                                                                    (std::cos(2.4 * turn) * side +
                                                                     std::sin(2.4 * turn) * other));
            lines.push_back({&origin_, &directions[i], &inside_});
        }
        if (ahead_ == Ahead::in_packets) {
            scene_.bvh->look_ahead(lines, seen);
        } else {
            std::array<SeenAhead*, Bvh::most_together> places;
            std::transform(seen.begin(), seen.end(), places.begin(), [](SeenAhead& one) { return &one; });
            scene_.bvh->look_ahead_in_turn(lines, places);
        }
        return seen[place];
    }
    std::uint32_t first_face(std::uint32_t part) const {
        std::uint32_t face = found_.face.value;
        while (face > 0 && scene_.faces[face - 1].body.value == part)
            --face;
        return face;
    }

    Scene scene_;
    Ahead ahead_;
    std::uint64_t packets_ = 0;
    dvec3 origin_{0.0}, direction_{0.0};
    ShellSet inside_;
    LeftSheets left_;
    std::optional<ObjectId> body_;
    Interface found_;
};

/// Every body in a hierarchy of its own: the nearest crossing of any is the next, one at a time.
class WithoutContact : public Finder {
  public:
    explicit WithoutContact(TortureCase const& torture) : torture_(torture) {
        for (TorturePart const& part : torture.parts) {
            std::vector<PlacedGeometry> alone;
            alone.push_back({part.geometry, part.place, {0}, {0}, false, false});
            bodies_.push_back({Bvh(std::move(alone)), {}, 0, shells_of(part)});
        }
    }
    void begin(TortureRay const& ray, std::vector<std::uint32_t> const&) override {
        origin_ = ray.origin;
        direction_ = ray.direction;
        for (Body& body : bodies_) {
            body.inside = body.bvh.start_at(ray.origin, ray.direction).inside;
            body.turns = turns_of(body);
        }
    }
    Answer next() override {
        after_ = bodies_state();
        Answer answer;
        answer.before = medium_in(after_);
        for (double from = 0.0;;) {
            NextHit nearest;
            nearest.t = INFINITY;
            for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
                NextHit const hit = bodies_[b].bvh.next(origin_, direction_, after_[b].inside, {}, from);
                if (hit.proof == Proof::leak) {
                    answer.kind = Answer::Kind::lost;
                    return answer;
                }
                if (hit.at_one_place.empty() || hit.t >= nearest.t)
                    continue;
                nearest = hit;
                answer.part = b;
            }
            if (nearest.t == INFINITY) {
                answer.kind = Answer::Kind::nothing;
                return answer;
            }
            crossing_ = nearest.at_one_place.front();
            State& state = after_[answer.part];
            for (Crossing const& c : nearest.at_one_place) {
                if (c.enters)
                    state.inside.insert(c.shell);
                else
                    state.inside.erase(c.shell);
            }
            answer.after = medium_in(after_);
            if (answer.after != answer.before) {
                answer.kind = Answer::Kind::boundary;
                answer.t = nearest.t;
                answer.face = crossing_.primitive >= 0 ? static_cast<std::uint32_t>(crossing_.primitive)
                                                       : crossing_.face.value;
                answer.normal = crossing_.normal;
                met_ = answer.part;
                return answer;
            }
            from = nearest.t;
        }
    }
    void go_on(dvec3 const& direction, bool crosses) override {
        origin_ = crossing_.point;
        direction_ = direction;
        for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
            // what was passed in silence on the way was passed, only the last boundary may not be
            if (b != met_ || crosses)
                bodies_[b].inside = after_[b].inside;
        }
    }
    std::uint32_t medium() const override { return medium_in(bodies_state()); }
    dvec3 origin() const override { return origin_; }
    dvec3 direction() const override { return direction_; }
    double ulp() const override { return 0x1p-52; }

  private:
    struct State {
        ShellSet inside;
    };
    struct Body {
        Bvh bvh;
        ShellSet inside;
        int turns;
        std::size_t shells;
    };
    int turns_of(Body const& body) const { return body.inside.empty() ? 0 : 1; }
    std::vector<State> bodies_state() const {
        std::vector<State> states;
        for (Body const& body : bodies_)
            states.push_back({body.inside});
        return states;
    }
    bool contains(std::uint32_t part, ShellSet const& inside) const {
        auto const* mesh = std::get_if<MeshRef>(&torture_.parts[part].geometry);
        int turns = 0;
        for (ShellId const shell : inside)
            turns += mesh ? (*mesh)->shells[shell.value].sign : 1;
        return turns > 0;
    }
    std::uint32_t medium_in(std::vector<State> const& states) const {
        std::uint32_t medium = 0;
        std::optional<int> priority;
        for (std::uint32_t p = 0; p < states.size(); ++p)
            if (contains(p, states[p].inside) && (!priority || torture_.parts[p].priority >= *priority)) {
                priority = torture_.parts[p].priority;
                medium = torture_.parts[p].medium;
            }
        return medium;
    }

    TortureCase const& torture_;
    std::vector<Body> bodies_;
    std::vector<State> after_;
    dvec3 origin_{0.0}, direction_{0.0};
    Crossing crossing_;
    std::uint32_t met_ = 0;
};

/// Is each side of its triangles a crease, or has both its triangles in one plane? Then it is what it stands
/// for.
bool is_flat_faced(Mesh const& mesh) {
    if (!mesh.closed())
        return false;
    SmoothFans const fans = smooth_fans(std::make_shared<Mesh const>(mesh));
    for (auto const& triangle : fans.triangles) {
        dvec3 const normal = cross(fans.fans[triangle.fans[1]].place - fans.fans[triangle.fans[0]].place,
                                   fans.fans[triangle.fans[2]].place - fans.fans[triangle.fans[0]].place);
        for (std::uint32_t const fan : triangle.fans)
            if (!(dot(normalize(normal), fans.fans[fan].normal) > 1.0 - 1e-15))
                return false;
    }
    return true;
}

} // namespace

Scene sahl_scene(TortureCase const& torture, Curving curving) {
    Scene scene;
    for (std::size_t m = 0; m < torture.indices.size(); ++m)
        scene.media.push_back({"medium " + std::to_string(m), ConstantIndex{torture.indices[m]}, {}, {}});
    scene.surroundings = {0};
    scene.surfaces.push_back({"mirror", Shares{1.0, 0.0}});
    std::vector<PlacedGeometry> geometries;
    std::uint32_t shell = 0;
    for (TorturePart const& part : torture.parts) {
        ObjectId const id{static_cast<std::uint32_t>(scene.bodies.size())};
        std::string const name = "body " + std::to_string(id.value);
        auto const* mesh = std::get_if<MeshRef>(&part.geometry);
        Body& body = scene.bodies.emplace_back();
        body.name = name;
        body.open = part.mirror;
        body.medium = {part.medium};
        body.priority = part.priority;
        body.to_world = part.place;
        if (mesh)
            body.mesh = *mesh;
        else
            body.shape = std::get<Shape>(part.geometry);
        body.method = mesh ? sahl::Method::facet : sahl::Method::automatic;
        geometries.push_back({part.geometry,
                              part.place,
                              {static_cast<std::uint32_t>(scene.faces.size())},
                              {shell},
                              false,
                              false,
                              part.mirror,
                              mesh && !part.mirror ? curving : Curving::none});
        for (std::size_t face = 0; face < faces_of(part); ++face)
            scene.faces.push_back({name, id, part.mirror ? std::optional(SurfaceId{0}) : std::nullopt});
        for (std::size_t s = 0; s < shells_of(part); ++s)
            scene.shells.push_back({id, mesh ? (*mesh)->shells[s].sign : 1, shells_of(part) == 1});
        shell += static_cast<std::uint32_t>(shells_of(part));
    }
    scene.bvh = std::make_unique<Bvh const>(std::move(geometries));
    return scene;
}

std::unique_ptr<Finder> ours(TortureCase const& torture) {
    return std::make_unique<Ours>(torture);
}

std::unique_ptr<Finder> ours_curved(TortureCase const& torture, Curving curving) {
    return std::make_unique<Ours>(torture, curving);
}

bool is_flat_faced(TortureCase const& torture) {
    bool any = false;
    for (TorturePart const& part : torture.parts)
        if (auto const* const mesh = std::get_if<MeshRef>(&part.geometry)) {
            if (!part.mirror && !is_flat_faced(**mesh))
                return false;
            any = any || !part.mirror;
        }
    return any;
}

std::unique_ptr<Finder> ours_in_packets(TortureCase const& torture) {
    return std::make_unique<Ours>(torture, Curving::none, Ahead::in_packets);
}

std::unique_ptr<Finder> ours_in_turn(TortureCase const& torture) {
    return std::make_unique<Ours>(torture, Curving::none, Ahead::in_turn);
}

std::unique_ptr<Finder> ours_without_contact(TortureCase const& torture) {
    return std::make_unique<WithoutContact>(torture);
}

} // namespace sahl::bench
