// In: a scene and a group of rays. Out: their trees, grown together, and what each leaves behind.
#pragma once

#include "trace/branch.h"
#include "trace/look_ahead.h"
#include "trace/sort_light.h"
#include "trace/tracer.h"

namespace sahl {

/// Is one branch followed of each ray, from its first interaction on?
inline bool one_path_a_ray(TraceOptions const& options) {
    return options.branch == BranchPolicy::roulette && options.split_depth == 0 && options.split_until >= 1.0;
}

/// The trees of a group of rays, grown breadth first.
class Grove {
  public:
    Grove(TraceContext const& context, BatchResult& result, SegmentSink& log);

    /// Rays that no source emits: somebody looks on, and nothing is summed.
    void watch(TreeWatch& watch, Bvh::Start const* start) {
        watch_ = &watch;
        start_ = start;
    }
    void grow(std::uint64_t first, std::uint32_t count);
    void grow(std::uint64_t first, std::span<Ray const> rays);

  private:
    void begin(std::uint64_t first, std::size_t count);
    void plant(Ray const& ray);
    void plant(Ray const& ray, Bvh::Start const& start);
    void grow_generations();
    void look_ahead(bool first);
    std::size_t number_of(Branch const& branch) const {
        return static_cast<std::size_t>(&branch - generation_.data());
    }
    void add(ExactSum& sum, double power) {
        if (!watch_)
            sum.add(power, context_.unit);
    }
    void trace(Branch const& branch);
    void follow_rounding(Branch const& branch, Interface const& interface);
    Event cut_or_none(Branch const& branch) const;
    double attenuate(Branch const& branch, Interface const& interface);
    void keep(Branch const& branch, DetectorHit const& hit);
    void detect(Branch const& branch, Interface const& interface, double power, double optical_path);
    void detect_escape(Branch const& branch, DetectorId id);
    void detect_arrival(Branch const& branch, Arrival const& arrival);
    bool cut_unseen(Branch const& branch, Interface const& interface, Outgoing const& outgoing);
    void push_children(Branch const& branch, Interface const& interface, Branches const& branches,
                       double optical_path);
    void pass_on(Branch const& branch, Interface const& interface, double power, double optical_path);
    void end(Branch const& branch, Event ended, double power, double length, double optical_path,
             Interface const* interface);
    void keep_segment(Branch const& branch, Event ended, double power, double length, double optical_path,
                      Interface const* interface);
    void lose(Branch const& branch, Event event, double power, double t);
    void order_by_ray();
    void apply_filters(std::size_t hits_before);
    void log_selected(std::span<Segment const> ray);

    TraceContext const& context_;
    BatchResult& result_;
    SegmentSink& log_;
    TreeWatch* watch_ = nullptr;
    Bvh::Start const* start_ = nullptr;
    std::uint64_t seed_;
    LookAhead ahead_;
    std::uint64_t first_ = 0;
    std::vector<Ray> rays_;
    std::vector<std::uint32_t> next_index_; // by ray: the number of its next segment
    std::vector<Branch> generation_, next_generation_;
    Interface interface_; // that is looked at: made once, and not for each branch
    std::vector<PolarisedLight> lights_, next_lights_; // of the same, where s and p are kept apart
    std::vector<Spread> spreads_, next_spreads_;       // of the same, where digits lost are asked for
    Spread spread_;                                    // at the end of the segment that is traced now
    double extent_ = 0.0;                              // m, the scene's largest coordinate, then too
    Bend bend_;                                        // where it ends
    SortedLight sorted_;                               // what leaves there
    std::vector<Segment> segments_, by_ray_;           // as they end; as the log has them
    std::vector<std::size_t> place_;                   // by ray: where its segments end in by_ray_
    std::vector<std::uint32_t> hit_segments_;          // of each hit of this group: where its path ends
    std::vector<Segment> selected_;
};

} // namespace sahl
