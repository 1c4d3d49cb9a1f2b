// In: a case of the torture suite and a method. Out: how many events of its paths are right, wrong, or not to
// be told apart by rounding.
#include "torture/follow.h"

#include "optics/snell.h"
#include "torture/exact_scene.h"

#include <algorithm>
#include <sstream>

namespace sahl::bench {

namespace {

using Kind = Answer::Kind;

/// Where a method says that a ray starts.
struct Stand {
    dvec3 origin, direction;
    std::optional<std::uint32_t> part;
    std::uint32_t face = 0;
};

struct Turned {
    dvec3 direction;
    bool total;
    bool crosses;
};

Turned turn(TortureCase const& torture, Answer const& answer, dvec3 const& direction, bool through) {
    if (torture.rule == Rule::straight)
        return {direction, false, true};
    dvec3 const normal = dot(answer.normal, direction) > 0.0 ? -answer.normal : answer.normal;
    if (answer.mirror)
        return {reflect(direction, normal), false, false};
    auto const refracted =
        refract(direction, normal, torture.indices[answer.before], torture.indices[answer.after]);
    if (refracted && through)
        return {*refracted, false, true};
    return {reflect(direction, normal), !refracted, false};
}

template <class T>
ExactStart<T> exact(ExactScene<T> const& scene, Stand const& stand) {
    Wide3<T> const at(stand.origin);
    return {stand.part ? scene.onto(*stand.part, stand.face, at) : at, Wide3<T>(stand.direction), stand.part};
}

std::uint32_t bits_of(Turns const& turns) {
    std::uint32_t bits = 0;
    for (std::size_t p = 0; p < turns.size(); ++p)
        bits |= turns[p] > 0 ? 1u << p : 0u;
    return bits;
}

/// Attempts that say that rounding cannot have led to an answer; in float, where many are wrong, fewer do.
int jogs_for(double ulp) {
    return ulp < 1e-10 ? 2000 : 24;
}

TortureCase without_contact(TortureCase torture) {
    torture.contact = 0.0;
    return torture;
}

class Judge {
  public:
    Judge(TortureCase const& torture, Finder& method, std::uint64_t seed)
        : torture_(torture), method_(method), dice_(seed ^ 0xA5A5A5A5u), quick_(torture), slow_(torture),
          without_contact_(without_contact(torture)), apart_(without_contact_),
          torn_(std::any_of(torture.parts.begin(), torture.parts.end(),
                            [](TorturePart const& part) { return part.torn; })) {}

    void follow(TortureRay const& ray, std::uint64_t number);
    void follow_line(TortureRay const& ray, std::uint64_t number);
    Verdict verdict;

  private:
    template <class T>
    bool agrees(ExactScene<T> const& scene, ExactEvent<T> const& expected, Answer const& got,
                bool total) const;
    template <class T>
    std::optional<ExactEvent<T>> right(ExactScene<T> const& scene, Stand const& stand, Turns const& turns,
                                       Answer const& got, bool total) const;
    template <class T>
    bool agrees(ExactScene<T> const& scene, std::vector<ExactEvent<T>> const& expected,
                std::vector<Answer> const& got) const;
    bool possible(Stand const& stand, Turns const& turns, Answer const& got, bool total);
    Stand jogged(Stand stand, int attempt);
    void blame(bool possible, bool lost);
    void measure(double shift, Stand const& stand);
    void begin(TortureRay const& ray, Turns& turns, Stand& stand);
    void tell(char const* word, std::uint64_t ray, std::uint32_t event, Stand const& stand,
              Turns const& turns, Answer const& got);

    TortureCase const& torture_;
    Finder& method_;
    Dice dice_;
    ExactScene<Long> quick_;
    ExactScene<Quad> slow_;
    TortureCase without_contact_;
    ExactScene<Quad> apart_;
    bool torn_;
};

template <class T>
bool Judge::agrees(ExactScene<T> const& scene, ExactEvent<T> const& expected, Answer const& got,
                   bool total) const {
    using Expected = typename ExactEvent<T>::Kind;
    if (expected.kind == Expected::nothing)
        return got.kind == Kind::nothing;
    if (expected.kind == Expected::unclear)
        return torn_ && got.kind == Kind::lost;
    if (got.kind != Kind::boundary || got.mirror != expected.mirror)
        return false;
    if (got.before != expected.before || got.after != expected.after)
        return false;
    if (torture_.rule != Rule::straight && total != expected.total)
        return false;
    if (!torture_.faces)
        return true;
    std::pair const place(got.part, scene.face_number(got.part, got.face));
    return std::find(expected.places.begin(), expected.places.end(), place) != expected.places.end();
}

template <class T>
std::optional<ExactEvent<T>> Judge::right(ExactScene<T> const& scene, Stand const& stand, Turns const& turns,
                                          Answer const& got, bool total) const {
    ExactEvent<T> const expected = scene.next(exact(scene, stand), turns);
    return agrees(scene, expected, got, total) ? std::optional(expected) : std::nullopt;
}

template <class T>
bool Judge::agrees(ExactScene<T> const& scene, std::vector<ExactEvent<T>> const& expected,
                   std::vector<Answer> const& got) const {
    if (got.size() < expected.size() && got.size() < torture_.events)
        return false;
    for (std::size_t k = 0; k < got.size(); ++k)
        if (k >= expected.size() || !agrees(scene, expected[k], got[k], false))
            return false;
    return true;
}

/// Whether rounding may have led to the answer: it is that of a line as near as rounding, or of a film that
/// is there though thinner than rounding, or it names another face of the same part on whose surface the
/// place lies too, to rounding, as that of a ball lens's rim, which has no width.
bool Judge::possible(Stand const& stand, Turns const& turns, Answer const& got, bool total) {
    if (right(apart_, stand, turns, got, total))
        return true;
    for (int k = 0; k < jogs_for(method_.ulp()); ++k)
        if (right(slow_, jogged(stand, k), turns, got, total))
            return true;
    ExactStart<Quad> const start = exact(slow_, stand);
    ExactEvent<Quad> expected = slow_.next(start, turns);
    if (got.kind != Kind::boundary || expected.places.empty() || expected.places.front().first != got.part)
        return false;
    Wide3<Quad> const place = start.origin + expected.t * start.direction;
    double const off = length(narrow(slow_.onto(got.part, got.face, place) - place));
    expected.places = {{got.part, slow_.face_number(got.part, got.face)}};
    return off <= 64.0 * method_.ulp() * slow_.coordinates() && agrees(slow_, expected, got, total);
}

/// As near as rounding in the method's arithmetic may bring it: up to 64 ulp of the coordinates.
Stand Judge::jogged(Stand stand, int attempt) {
    double const radius =
        std::ldexp(method_.ulp() * (slow_.coordinates() + length(stand.origin)), attempt % 7);
    stand.origin += radius * dice_.uniform() * dice_.direction();
    stand.direction += 2.0 * method_.ulp() * dice_.uniform() * dice_.direction();
    return stand;
}

void Judge::tell(char const* word, std::uint64_t ray, std::uint32_t event, Stand const& stand,
                 Turns const& turns, Answer const& got) {
    if (verdict.stories.size() >= (*word == 'w' ? 20 : 10)) // room for what is wrong
        return;
    ExactEvent<Quad> const expected = slow_.next(exact(slow_, stand), turns);
    std::ostringstream story;
    story.precision(17);
    story << word << ": ray " << ray << " event " << event << " from " << stand.origin.x << ' '
          << stand.origin.y << ' ' << stand.origin.z << " along " << stand.direction.x << ' '
          << stand.direction.y << ' ' << stand.direction.z;
    if (stand.part)
        story << " on part " << *stand.part << " face " << stand.face;
    story << ", inside " << bits_of(turns) << "; expected ";
    if (expected.kind == ExactEvent<Quad>::Kind::boundary) {
        story << expected.before << " to " << expected.after << (expected.total ? " (total)" : "") << " at "
              << static_cast<double>(expected.t) << " on";
        for (auto const& [part, face] : expected.places)
            story << ' ' << part << '.' << face;
    } else {
        story << (expected.kind == ExactEvent<Quad>::Kind::nothing ? "nothing" : "a contradiction");
    }
    story << ", got ";
    if (got.kind == Kind::boundary)
        story << got.before << " to " << got.after << " at " << got.t << " on " << got.part << '.'
              << got.face;
    else
        story << (got.kind == Kind::nothing ? "nothing" : "lost");
    verdict.stories.push_back(story.str());
}

void Judge::begin(TortureRay const& ray, Turns& turns, Stand& stand) {
    stand = {ray.origin, ray.direction, ray.part, ray.face};
    turns = slow_.turns_at(exact(slow_, stand));
    std::vector<std::uint32_t> inside;
    for (std::uint32_t p = 0; p < turns.size(); ++p)
        if (turns[p] > 0)
            inside.push_back(p);
    method_.begin(ray, inside);
    stand.origin = method_.origin();
    stand.direction = method_.direction();
}

void Judge::blame(bool possible, bool lost) {
    ++(possible ? verdict.ambiguous : verdict.wrong);
    verdict.lost += !possible && lost;
}

/// Straight on the whole path is one line, which is judged as a whole.
void Judge::follow_line(TortureRay const& ray, std::uint64_t number) {
    Turns turns;
    Stand stand;
    begin(ray, turns, stand);
    ++verdict.rays;
    std::vector<Answer> answers;
    double travelled = 0.0;
    while (answers.size() < torture_.events) {
        Answer got = method_.next();
        ++verdict.events;
        travelled += got.t;
        answers.push_back(got);
        answers.back().t = travelled;
        if (got.kind != Kind::boundary)
            break;
        method_.go_on(stand.direction, true);
    }
    auto const quick = quick_.line(exact(quick_, stand), turns);
    if (agrees(quick_, quick, answers)) {
        for (std::size_t k = 0; k < answers.size() && answers[k].kind == Kind::boundary; ++k)
            measure(std::abs(static_cast<double>((Long(answers[k].t) - quick[k].t) * quick[k].slope)), stand);
        return;
    }
    if (agrees(slow_, slow_.line(exact(slow_, stand), turns), answers))
        return;
    bool possible = false;
    for (int k = 0; k < jogs_for(method_.ulp()) && !possible; ++k) {
        ExactStart<Quad> const near = exact(slow_, jogged(stand, k));
        possible = agrees(slow_, slow_.line(near, turns), answers);
    }
    tell(possible ? "ambiguous" : "wrong", number, static_cast<std::uint32_t>(answers.size()) - 1, stand,
         turns, answers.back());
    blame(possible, answers.back().kind == Kind::lost);
}

void Judge::measure(double shift, Stand const& stand) {
    double const coordinates = slow_.coordinates() + length(stand.origin);
    verdict.worst_shift = std::max(verdict.worst_shift, shift / (method_.ulp() * coordinates));
}

void Judge::follow(TortureRay const& ray, std::uint64_t number) {
    Turns turns;
    Stand stand;
    begin(ray, turns, stand);
    ++verdict.rays;
    for (std::uint32_t event = 0; event < torture_.events; ++event) {
        Answer const got = method_.next();
        ++verdict.events;
        Turned turned{stand.direction, false, true};
        if (got.kind == Kind::boundary)
            turned = turn(torture_, got, stand.direction, goes_through(torture_.rule, number, event));
        bool total = turned.total;
        if (got.kind == Kind::boundary &&
            torture_.rule == Rule::reflect) // it reflects either way: which is it?
            total = turn(torture_, got, stand.direction, true).total;
        Turns before, after;
        double shift = 0.0;
        if (auto const quick = right(quick_, stand, turns, got, total)) {
            before = quick->turns_before;
            after = quick->turns_after;
            shift = std::abs(static_cast<double>((Long(got.t) - quick->t) * quick->slope));
        } else if (auto const slow = right(slow_, stand, turns, got, total)) {
            before = slow->turns_before;
            after = slow->turns_after;
            shift = std::abs(static_cast<double>((Quad(got.t) - slow->t) * slow->slope));
        } else {
            bool const rounding = possible(stand, turns, got, total);
            tell(rounding ? "ambiguous" : "wrong", number, event, stand, turns, got);
            blame(rounding, got.kind == Kind::lost);
            return;
        }
        if (got.kind != Kind::boundary)
            return;
        measure(shift, stand);
        method_.go_on(turned.direction, turned.crosses);
        turns = turned.crosses ? after : before;
        stand = {method_.origin(), method_.direction(), got.part, got.face};
    }
}

} // namespace

std::vector<TortureRay> rays_of(TortureCase const& torture, std::uint64_t seed, std::uint64_t rays) {
    std::vector<TortureRay> drawn;
    Dice dice(seed);
    for (std::uint64_t k = 0; k < rays; ++k)
        drawn.push_back(torture.ray(dice, k));
    return drawn;
}

std::vector<std::vector<std::uint32_t>> insides_of(TortureCase const& torture,
                                                   std::vector<TortureRay> const& rays) {
    ExactScene<Quad> const scene(torture);
    std::vector<std::vector<std::uint32_t>> insides;
    for (TortureRay const& ray : rays) {
        Turns const turns = scene.turns_at(exact(scene, {ray.origin, ray.direction, ray.part, ray.face}));
        auto& inside = insides.emplace_back();
        for (std::uint32_t p = 0; p < turns.size(); ++p)
            if (turns[p] > 0)
                inside.push_back(p);
    }
    return insides;
}

Verdict judge(TortureCase const& torture, Finder& method, std::uint64_t seed, std::uint64_t rays) {
    Judge judging(torture, method, seed);
    Dice dice(seed);
    for (std::uint64_t k = 0; k < rays; ++k)
        (torture.rule == Rule::straight ? judging.follow_line(torture.ray(dice, k), k)
                                        : judging.follow(torture.ray(dice, k), k));
    return judging.verdict;
}

Walked walk(TortureCase const& torture, Finder& method, std::vector<TortureRay> const& rays,
            std::vector<std::vector<std::uint32_t>> const& inside) {
    Walked walked;
    for (std::size_t k = 0; k < rays.size(); ++k) {
        method.begin(rays[k], inside[k]);
        dvec3 direction = method.direction();
        for (std::uint32_t event = 0; event < torture.events; ++event) {
            Answer const got = method.next();
            ++walked.events;
            if (got.kind != Kind::boundary)
                break;
            walked.sum += got.t;
            Turned const turned = turn(torture, got, direction, goes_through(torture.rule, k, event));
            method.go_on(turned.direction, turned.crosses);
            direction = method.direction();
        }
    }
    return walked;
}

} // namespace sahl::bench
