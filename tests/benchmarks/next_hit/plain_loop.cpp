// No protection: ROBUST traversal, and the hit computed again in double from the triangle that was found.
#include "float_finder.h"

#include <cmath>

namespace sahl::bench {

namespace {

class PlainLoop : public Finder {
  public:
    explicit PlainLoop(TortureCase const& torture) : scene_(torture), torture_(torture) {}

    void begin(TortureRay const& ray, std::vector<std::uint32_t> const& inside) override {
        origin_ = ray.origin;
        direction_ = ray.direction;
        turns_.assign(torture_.parts.size(), 0);
        for (std::uint32_t const part : inside)
            turns_[part] = 1;
    }
    Answer next() override {
        Answer answer;
        answer.before = medium_in(turns_);
        after_ = turns_;
        dvec3 at = origin_;
        for (int silent = 0; silent < 16; ++silent) {
            FloatScene::Hit const hit = scene_.meet(fvec3(at), fvec3(direction_), 0.0f, {});
            if (!hit.any)
                return answer;
            auto const [a, b, c] = scene_.corners(hit.part, hit.triangle);
            dvec3 const normal = normalize(cross(b - a, c - a));
            double const along = dot(normal, direction_);
            at += dot(normal, a - at) / along * direction_;
            before_ = after_;
            after_[hit.part] += along < 0.0 ? 1 : -1;
            answer.after = medium_in(after_);
            if (answer.after != answer.before) {
                answer.kind = Answer::Kind::boundary;
                answer.t = dot(at - origin_, direction_);
                answer.part = hit.part;
                answer.face = hit.triangle;
                answer.normal = normal;
                found_ = at;
                return answer;
            }
        }
        answer.kind = Answer::Kind::lost;
        return answer;
    }
    void go_on(dvec3 const& direction, bool crosses) override {
        origin_ = found_;
        direction_ = direction;
        turns_ = crosses ? after_ : before_;
    }
    std::uint32_t medium() const override { return medium_in(turns_); }
    dvec3 origin() const override { return origin_; }
    dvec3 direction() const override { return direction_; }
    double ulp() const override { return 0x1p-23; } // Embree's, which decides

  private:
    std::uint32_t medium_in(std::vector<int> const& turns) const {
        TorturePart const* best = nullptr;
        for (std::size_t p = 0; p < turns.size(); ++p)
            if (turns[p] > 0 && (!best || torture_.parts[p].priority >= best->priority))
                best = &torture_.parts[p];
        return best ? best->medium : 0;
    }

    FloatScene scene_;
    TortureCase const& torture_;
    dvec3 origin_{0.0}, direction_{0.0}, found_{0.0};
    std::vector<int> turns_, before_, after_;
};

} // namespace

std::unique_ptr<Finder> plain_loop(TortureCase const& torture) {
    return std::make_unique<PlainLoop>(torture);
}

} // namespace sahl::bench
